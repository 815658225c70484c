//! A whole machine without a thread or a clock: planner, interpolator, bridge, drives.

mod case;
mod life;
mod reality;
mod setup;

pub(crate) use case::{Case, Hands, Outcome};
pub(crate) use setup::{COUNTS, START_NS, Setup, drive, limits, servo};

use crate::wire::MemoryWire;
use core::sync::atomic::AtomicBool;
use glidepath_emulator::Segment;
use glidepath_ethercat::{Ends, Settings, drive_bus};
use glidepath_interpolator::served;
use glidepath_link::InProcess;
use life::{Life, Queue, Source};
use reality::Reality;
use rtrb::RingBuffer;
use setup::config;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::mpsc::channel;

/// Runs a machine until its case ends it.
pub(crate) fn run(setup: &Setup, case: &mut dyn Case) -> Outcome {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    run_on(setup, case, segment, START_NS)
}

/// The same with drives that have a past, which ends before `start_ns`.
pub(crate) fn run_on(
    setup: &Setup,
    case: &mut dyn Case,
    segment: Segment,
    start_ns: u64,
) -> Outcome {
    let (config, links) = (config(setup), [InProcess::default(), InProcess::default()]);
    let [first, second] = &links;
    served(&config, 11, Box::new(first.clone()), |a| {
        served(&config, 22, Box::new(second.clone()), |b| {
            let lives = [Some(Life::new(first, a)), Some(Life::new(second, b))];
            with_bridge(setup, case, (segment, start_ns), lives)
        })
    })
    .unwrap()
    .unwrap()
}

fn with_bridge(
    setup: &Setup,
    case: &mut dyn Case,
    (segment, start_ns): (Segment, u64),
    lives: [Option<Life<'_>>; 2],
) -> Outcome {
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives.clone(),
        drive_inputs: setup.drive_inputs.clone(),
        terminals: setup.terminals.clone(),
        servo: servo(),
    };
    let queue = Queue::default();
    let (auxiliary, heard) = RingBuffer::new(1024);
    let (feedback, records) = RingBuffer::new(256);
    let (events, happened) = RingBuffer::new(256);
    let (log, _said) = channel();
    let mut ends = Ends {
        feedback,
        events,
        log,
        demands: None,
        auxiliary: (!setup.terminals.is_empty()).then_some(heard),
    };
    let stop = Rc::new(AtomicBool::new(false));
    let (told, setpoints) = (Rc::default(), Rc::default());
    let reality = Reality {
        lives,
        lives_now: true,
        case,
        queue: Rc::clone(&queue),
        auxiliary,
        records,
        happened,
        events: Rc::clone(&told),
        stop: Rc::clone(&stop),
        killed: Rc::default(),
        start_ns: start_ns + setup.phase_ns,
        feed: VecDeque::new(),
        epoch: 0,
        sent: 0,
        tick: 0,
        last: None,
        status: None,
        feedback: None,
        said: None,
        paused: 0,
        setpoints: Rc::clone(&setpoints),
    };
    let mut wire = MemoryWire::new(segment, reality, start_ns);
    let mut lives = 0;
    let boot_id = &mut || {
        lives += 1;
        lives
    };
    let counts = drive_bus(
        &mut wire,
        &settings,
        Source(queue),
        &mut ends,
        &stop,
        boot_id,
    )
    .unwrap();
    while let Ok(event) = wire.world.happened.pop() {
        told.borrow_mut().push(event);
    }
    let end_ns = glidepath_ethercat::Wire::now_ns(&wire);
    let mut segment = wire.segment;
    let records = setup
        .drives
        .iter()
        .map(|drive| segment.take_axis_records(drive.position, drive.axis.into()))
        .collect();
    Outcome {
        counts,
        events: told.take(),
        setpoints: setpoints.take(),
        records,
        allocations: wire.counted,
        left: (segment, end_ns),
    }
}
