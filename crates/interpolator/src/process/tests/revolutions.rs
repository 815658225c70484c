//! Tests of a feed per revolution behind a spindle that does not turn as fast as it was told.

use super::bench::{Bench, config};
use crate::testing::{blocks, mill, planned};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_link::{MachineState, Setpoint, SetpointFrame};
use glidepath_plant::{InjectedFault, JointSettings, SpindleSettings};
use glidepath_program::{Effort, Event, FrameFlags, ItemKind, PathMode, Rate};

const START: [f64; 3] = [12.5, -3.0, 40.0];
/// 0.5 mm a revolution at 20 revolutions a second.
const PER_TURN_MM: f64 = 0.5;
const TURN_V: f64 = 20.0;
const WAY_MM: f64 = 40.0;

/// The spindle is told to turn, the machine waits a second, and moves: at the feed per revolution,
/// at a rapid, and at a feed per minute.
fn program(start: AxisVector, turns: bool) -> Vec<SetpointFrame> {
    let to = |from, to, rate| ItemKind::Move {
        segment: Segment::line(from, to),
        rate,
        mode: PathMode::ExactStop,
    };
    let end = start + AxisVector::x() * WAY_MM;
    let per_revolution = Rate::PerRevolution {
        feed_v: PER_TURN_MM * TURN_V,
        most_v: f64::INFINITY,
    };
    let mut kinds = vec![ItemKind::Event(Event::SpindleSpeed(60.0 * TURN_V))];
    kinds.extend(turns.then_some(ItemKind::Event(Event::MCode(3))));
    kinds.extend([
        ItemKind::Dwell(1.5),
        to(start, end, per_revolution),
        to(end, start, Rate::Rapid),
        to(start, end, Rate::Feed(50.0)),
    ]);
    planned(&blocks(kinds), mill(), start, Effort::Optimal)
}

fn bench() -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let mut bench = Bench::new(config(false), &START.map(joint));
    bench.plant = bench.plant.with_spindle(SpindleSettings {
        acceleration: 40.0,
        lag_t: 0.2,
        counts: 4096,
        angle: 0.37,
    });
    bench.enable(MachineState::Idle);
    bench
}

/// Lines up the program.
fn load(bench: &mut Bench, turns: bool) {
    let start = AxisVector::from(bench.last().position);
    bench.load_frames(program(start, turns));
}

/// Ticks at the feed per revolution, until `most` of them or the end of its move: the way and the
/// angle of the spindle at each.
fn turn(bench: &mut Bench, most: usize) -> Vec<(Setpoint, f64)> {
    let mut samples = Vec::new();
    for _ in 0..8_000 {
        let setpoint = bench.tick();
        if setpoint.has(FrameFlags::PER_REV) {
            samples.push((setpoint, bench.plant.spindle().0));
        }
        let has_passed = !samples.is_empty() && !setpoint.has(FrameFlags::PER_REV);
        if samples.len() >= most || has_passed {
            return samples;
        }
    }
    panic!("it does not end: {:?}", bench.state());
}

/// mm of way for each revolution, over samples.
fn per_turn_mm(samples: &[(Setpoint, f64)]) -> f64 {
    let (first, last) = (&samples[0], &samples[samples.len() - 1]);
    (last.0.position[0] - first.0.position[0]) / (last.1 - first.1)
}

#[test]
fn the_way_of_a_revolution_is_the_programmed_one_however_fast_the_spindle_turns() {
    for part in [0.5, 0.6, 0.75, 0.9, 0.97, 0.985, 0.995, 1.0, 1.05, 1.09] {
        let mut bench = bench();
        bench.inject(InjectedFault::SpindlePart(part));
        load(&mut bench, true);
        let samples = turn(&mut bench, usize::MAX);
        let steady = &samples[120..samples.len() - 40];
        let off_r = per_turn_mm(steady) / PER_TURN_MM - 1.0;
        // The worst tenth of a second, too.
        let of_parts = steady
            .windows(25)
            .map(|part| per_turn_mm(part) / PER_TURN_MM - 1.0);
        let worst_r = of_parts.fold(
            0.0_f64,
            |worst, off| if off.abs() > worst.abs() { off } else { worst },
        );
        println!(
            "at {:5.1} % of S: {:+.2} %, {:+.2} % in a tenth of a second",
            100.0 * part,
            100.0 * off_r,
            100.0 * worst_r
        );
        // A plan is never gone through faster than it is: above S there is less way.
        let wanted_r = if part > 1.0 { 1.0 / part - 1.0 } else { 0.0 };
        assert!((off_r - wanted_r).abs() < 0.015, "{part}: {off_r}");
        assert!((worst_r - wanted_r).abs() < 0.02, "{part}: {worst_r}");
        // Rapids and feeds per minute do not wait for the spindle.
        let mut fastest = (0.0_f64, 0.0_f64);
        while bench.tick().state() == Ok(MachineState::Running) {
            let last = bench.last();
            let most = if last.has(FrameFlags::RAPID) {
                &mut fastest.0
            } else {
                &mut fastest.1
            };
            *most = most.max(last.velocity[0].abs());
        }
        assert!(
            fastest.0 > 150.0 && (fastest.1 - 50.0).abs() < 0.15,
            "{fastest:?}"
        );
        assert_eq!(bench.fault(), None);
        assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
    }
}

#[test]
fn a_load_is_followed_and_a_spindle_at_its_speed_changes_no_frame() {
    let mut bench = bench();
    load(&mut bench, true);
    let start = bench.last().position[0];
    let frames = program(AxisVector::from(bench.last().position), true);
    let before = turn(&mut bench, 200);
    // The spindle has its speed: every setpoint is a frame.
    for (setpoint, _) in &before[10..] {
        let frame = &frames[setpoint.sequence as usize];
        assert_eq!(setpoint.position, frame.position);
    }
    bench.inject(InjectedFault::SpindlePart(0.7));
    turn(&mut bench, 250);
    let loaded = turn(&mut bench, 100);
    assert!((per_turn_mm(&loaded) / PER_TURN_MM - 1.0).abs() < 0.015);
    bench.inject(InjectedFault::SpindlePart(1.0));
    turn(&mut bench, 250);
    let after = turn(&mut bench, 100);
    assert!((per_turn_mm(&after) / PER_TURN_MM - 1.0).abs() < 0.015);
    assert!(bench.run_to(MachineState::Idle, 4_000));
    assert!((bench.last().position[0] - start - WAY_MM).abs() < 1e-9);
    assert_eq!(bench.fault(), None);
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
}

#[test]
fn a_spindle_that_stands_holds_the_motion_and_is_told_of() {
    let mut bench = bench();
    load(&mut bench, true);
    turn(&mut bench, 200);
    bench.inject(InjectedFault::SpindleStuck(true));
    assert!(bench.run_to(MachineState::Held, 500));
    let held = bench.last().position;
    let status = bench.status();
    assert_eq!(status.adaptive_feed, 0.0);
    assert_eq!(
        status.last_error.as_str(),
        "the feed per revolution (G95) waits for the spindle, which stands"
    );
    bench.run(300);
    assert_eq!(bench.last().position, held);
    bench.inject(InjectedFault::SpindleStuck(false));
    assert!(bench.run_to(MachineState::Running, 500));
    assert!(bench.run_to(MachineState::Idle, 4_000));
    assert_eq!(bench.fault(), None);
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());

    // One that nobody turned on.
    let mut bench = self::bench();
    let start = bench.last().position;
    load(&mut bench, false);
    assert!(bench.run_to(MachineState::Held, 1_000));
    let way_mm = bench.last().position[0] - start[0];
    println!("{way_mm:.3} mm until it is noticed");
    // Two hundredths of a second at the feed.
    assert!(way_mm < 0.02 * PER_TURN_MM * TURN_V, "{way_mm}");
}
