//! The fuzz target: any sequence of segments, in order or not, whole or garbled: the listening
//! planner answers or refuses them, and gives out only frames that are usable.
#![no_main]

use core::cell::RefCell;
use core::sync::atomic::{AtomicBool, Ordering};

use glidepath_geometry::AxisVector;
use glidepath_link::{InProcess, Record, SegmentRequest, StreamItem, Transport};
use glidepath_planner::{Listening, Pace, SoftLimits, listen};
use libfuzzer_sys::fuzz_target;
use support::attended;
use support::interpolator::Interpolator;
use support::items::{PERIOD_NS, settings, staircase};

#[allow(unused, reason = "what the tests share")]
#[path = "../../tests/it/support/mod.rs"]
mod support;

/// Pauses of the planner until it is told to end.
const PAUSES: u32 = 600;

/// What a request is changed into: bytes from a place on, and its number.
type Change = (u8, u16, Vec<u8>, Option<u8>);

fn requests(changes: Vec<Change>) -> Vec<SegmentRequest> {
    let mut items = vec![StreamItem::Open { asked_ns: 0 }];
    items.extend(staircase(6).into_iter().map(StreamItem::Item));
    items.push(StreamItem::End);
    let mut all: Vec<_> = (0..)
        .zip(&items)
        .map(|(number, item)| SegmentRequest::new(1, number, item))
        .collect();
    for (which, at, bytes, number) in changes {
        let which = usize::from(which) % all.len();
        let mut request = all[which];
        let record = bytemuck::bytes_of_mut(&mut request);
        let at = usize::from(at) % record.len();
        for (byte, new) in record[at..].iter_mut().zip(bytes) {
            *byte = new;
        }
        if let Some(number) = number {
            request.number = number.into();
        }
        all[which] = request;
    }
    all
}

fuzz_target!(|changes: Vec<Change>| {
    let transport = InProcess::default();
    let interpolator = RefCell::new(Interpolator::new(&transport, 128));
    let mut client = transport.segment_client().expect("a client");
    let mut waiting = requests(changes).into_iter().peekable();
    let stop = AtomicBool::new(false);
    let mut pauses = 0;
    let listening = Listening {
        joints: None,
        settings: settings(),
        pace: Pace {
            period_ns: PERIOD_NS,
            horizon_frames: 50,
        },
        limits: Some(SoftLimits {
            low: AxisVector::repeat(-100.0),
            high: AxisVector::repeat(100.0),
        }),
    };
    let _ = attended(
        &stop,
        |time| {
            interpolator.borrow_mut().pass(time);
            while let Ok(Some(reply)) = client.reply() {
                reply.outcome().expect("a reply of its own").ok();
            }
            if let Some(request) = waiting.peek()
                && client.ask(request).is_ok()
            {
                waiting.next();
            }
            pauses += 1;
            stop.store(pauses > PAUSES, Ordering::Relaxed);
        },
        |control| listen(&transport, &listening, control),
    );
    for frame in &interpolator.into_inner().executed {
        frame.check().expect("a usable frame");
        assert!(frame.position.iter().all(|p| p.abs() <= 100.001));
    }
});
