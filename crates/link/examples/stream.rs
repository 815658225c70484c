//! Streams a square to a listening planner, as a CAM program or an operator panel would.
//!
//! Start `glidepath interpolator --best-effort` and `glidepath planner --listen` first. The
//! argument is the name of the instance, `default` if there is none.

use glidepath_geometry::{AxisVector, Segment};
use glidepath_link::{
    Client, Ipc, LinkConfig, LinkError, SegmentRefusal, SegmentReply, SegmentRequest, StreamItem,
    Transport,
};
use glidepath_program::{Item, ItemKind, PathMode, Rate};
use glidepath_realtime::{Clock as _, Monotonic};
use std::time::Duration;

const PATIENCE: Duration = Duration::from_secs(5);
const SIDE: f64 = 20.0;
const FEED_V: f64 = 50.0;

type Port = dyn Client<SegmentRequest, SegmentReply>;

/// Sends a request until the planner has room for it, and returns the answer.
fn send(port: &mut Port, number: u64, item: &StreamItem) -> Result<SegmentReply, LinkError> {
    let session = u64::from(std::process::id());
    loop {
        let request = SegmentRequest::new(session, number, item);
        if let Some(reply) = port.call(&request, PATIENCE)?
            && reply.outcome()? != Err(SegmentRefusal::NoCredit)
        {
            return Ok(reply);
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

fn side(line: u32, start: AxisVector, end: AxisVector) -> StreamItem {
    StreamItem::Item(Item {
        block: 0,
        line,
        kind: ItemKind::Move {
            segment: Segment::line(start, end),
            rate: Rate::Feed(FEED_V),
            mode: PathMode::Continuous { tolerance_mm: None },
        },
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let instance = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "default".to_owned());
    let transport = Ipc::connect(&LinkConfig::new(&instance))?;
    let mut port = transport.segment_client()?;

    // The answer to the first request tells where the machine stands: the path starts there.
    // An abort after this counts for the stream, also if its planner hangs until then.
    let asked_ns = Monotonic.now_ns();
    let opened = send(&mut *port, 0, &StreamItem::Open { asked_ns })?;
    let mut position = AxisVector::from(opened.position);
    let mut number = 1;
    for (dx, dy) in [(SIDE, 0.0), (0.0, SIDE), (-SIDE, 0.0), (0.0, -SIDE)] {
        let mut end = position;
        end[0] += dx;
        end[1] += dy;
        let reply = send(&mut *port, u64::from(number), &side(number, position, end))?;
        if reply.outcome()?.is_err() {
            return Err(format!("side {number} refused: {}", reply.message.as_str()).into());
        }
        position = end;
        number += 1;
    }
    // A repeated request is answered again and changes nothing: the end, until it is executed.
    loop {
        let reply = send(&mut *port, u64::from(number), &StreamItem::End)?;
        match reply.outcome()? {
            Ok(()) => std::thread::sleep(Duration::from_millis(50)),
            Err(SegmentRefusal::NotOpen) => return Ok(()),
            Err(_) => return Err(format!("stopped: {}", reply.message.as_str()).into()),
        }
    }
}
