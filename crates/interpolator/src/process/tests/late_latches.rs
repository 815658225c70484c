//! Tests of hardware that tells where the probe touched after it has told that it did.

use super::bench::Bench;
use super::probing::{bench, search};
use glidepath_geometry::AxisVector;
use glidepath_link::{Command, ContactKind, EndOfEpoch, Feedback, LatchKind, MachineState};

/// Where the plane is, and where the hardware says that it is.
const PLANE: f64 = 38.0;
const KEPT: f64 = 38.012_345;
/// How long it takes to tell.
const LATE_NS: u64 = 400_000_000;

/// Awaited for a while, then the place.
fn late(feedback: &mut Feedback, now_ns: u64) {
    let latch = &mut feedback.latch[0];
    if latch.count > 0 {
        latch.kind = LatchKind::Awaited.code();
        if now_ns > latch.latch_ns + LATE_NS {
            latch.kind = LatchKind::Drive.code();
            latch.position[2] = KEPT;
        }
    }
}

/// Awaited for a while, and then there is none.
fn never(feedback: &mut Feedback, now_ns: u64) {
    let latch = &mut feedback.latch[0];
    let is_late = now_ns > latch.latch_ns + LATE_NS;
    if latch.count > 0 {
        latch.kind = LatchKind::Awaited.code();
    }
    if is_late {
        (latch.count, latch.kind) = (0, LatchKind::None.code());
    }
}

/// A machine that stands behind a contact, whose place is not told yet.
fn waiting(on_the_way: fn(&mut Feedback, u64)) -> Bench {
    let mut bench = bench(0.0, |plant| plant.with_probe(2, PLANE));
    bench.on_the_way = on_the_way;
    let frames = search(&bench, AxisVector::z() * -5.0, 5.0, false);
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(bench.run_to(MachineState::Waiting, 1000));
    bench.run(5);
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Open));
    bench
}

#[test]
fn the_end_of_a_search_is_told_with_the_place_that_comes_late() {
    for (on_the_way, place, most) in [
        (late as fn(&mut Feedback, u64), KEPT, 1e-9),
        (never, PLANE, 0.005),
    ] {
        let mut bench = waiting(on_the_way);
        bench.run(120);
        let status = bench.status();
        assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Tripped));
        assert_eq!(status.contact(), Ok(ContactKind::Made));
        let error = (status.contact[2] - place).abs();
        assert!(error <= most, "{error}");
    }
}

#[test]
fn an_abort_does_not_wait_for_the_place() {
    let mut bench = waiting(late);
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 5));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Aborted));
    bench.run(200);
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Aborted));
}
