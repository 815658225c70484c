//! Tests of holes that are tapped behind a spindle that takes its time to turn back.

use super::bench::{Bench, config};
use crate::shared::config::Config;
use crate::testing::{blocks, happens, mill, planned};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_link::{Command, EndOfEpoch, FaultCause, MachineState, Setpoint, SetpointFrame};
use glidepath_plant::{InjectedFault, JointSettings, SpindleSettings};
use glidepath_program::{Effort, Event, ItemKind, PathMode, Rate};

const START: [f64; 3] = [12.5, -3.0, 40.0];
const PITCH_MM: f64 = 1.0;
const DEPTH_MM: f64 = 12.0;
const TO_APPLY_T: f64 = 0.000_7;

fn program(start: AxisVector) -> Vec<SetpointFrame> {
    let to = |from, to| ItemKind::Move {
        segment: Segment::line(from, to),
        rate: Rate::Rapid,
        mode: PathMode::ExactStop,
    };
    let tap = ItemKind::Event(Event::Tap {
        axis: 2,
        pitch_mm: -PITCH_MM,
        depth_um: (DEPTH_MM * 1e3) as u32,
    });
    let next = start + AxisVector::x() * 10.0;
    let kinds = [
        ItemKind::Event(Event::SpindleSpeed(600.0)),
        ItemKind::Event(Event::MCode(3)),
        tap,
        to(start, next),
        tap,
        to(next, start),
    ];
    planned(&blocks(kinds), mill(), start, Effort::Optimal)
}

fn bench() -> Bench {
    bench_with(config(false))
}

fn bench_with(config: Config) -> Bench {
    bench_beside(
        config,
        SpindleSettings {
            counts: 4096,
            lag_t: 0.05,
            angle: 0.37,
            ..SpindleSettings::default()
        },
    )
}

fn bench_beside(config: Config, spindle: SpindleSettings) -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let mut bench = Bench::new(config, &START.map(joint));
    bench.plant = bench.plant.with_spindle(spindle);
    bench.enable(MachineState::Idle);
    bench
}

/// The way into the hole and the angle of the spindle, tick by tick, of the first hole.
fn tap(bench: &mut Bench, during: impl FnMut(&mut Bench, f64)) -> Vec<(f64, f64)> {
    let start = AxisVector::from(bench.last().position);
    tap_by(bench, program(start), during)
}

fn tap_by(
    bench: &mut Bench,
    frames: Vec<SetpointFrame>,
    mut during: impl FnMut(&mut Bench, f64),
) -> Vec<(f64, f64)> {
    let start = AxisVector::from(bench.last().position);
    bench.load_frames(frames);
    let mut samples = Vec::new();
    for _ in 0..4_000 {
        let setpoint = bench.tick();
        let (angle, speed) = bench.plant.spindle();
        let depth = start[2] - setpoint.position[2];
        if depth > 0.0 && setpoint.position[0] == start[0] {
            during(bench, depth);
            samples.push((depth, angle + speed * TO_APPLY_T));
        }
        let ended = [MachineState::Idle, MachineState::Faulted].map(Ok);
        if ended.contains(&setpoint.state()) && !samples.is_empty() {
            return samples;
        }
    }
    panic!("the taps do not end: {:?}", bench.state());
}

#[test]
fn a_tap_comes_out_as_it_went_in_and_ends_where_it_began() {
    let mut bench = bench();
    let start = bench.last().position;
    let samples = tap(&mut bench, |_, _| {});
    assert_eq!(bench.fault(), None);
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert_eq!(status.position[2], start[2]);
    let deepest = samples
        .iter()
        .fold(0.0_f64, |most, (depth, _)| most.max(*depth));
    assert!((DEPTH_MM..DEPTH_MM + 2.5).contains(&deepest), "{deepest}");
    // Between run-in and run-out, in and out, the pitch is that of the tap.
    let with: Vec<f64> = samples
        .iter()
        .filter(|(depth, _)| *depth > 2.0)
        .map(|(depth, angle)| depth - PITCH_MM * angle)
        .collect();
    assert!(with.len() > 400, "{}", with.len());
    let (low, high) = with.iter().fold((f64::MAX, f64::MIN), |(low, high), off| {
        (low.min(*off), high.max(*off))
    });
    println!(
        "{:.2} µm over both ways, {deepest:.3} mm deep",
        (high - low) * 1e3
    );
    assert!(high - low < 0.02, "{} µm", (high - low) * 1e3);
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
}

#[test]
fn an_abort_leads_out_of_the_hole() {
    let mut bench = bench();
    let start = bench.last().position;
    let mut is_asked = false;
    let samples = tap(&mut bench, |bench, depth| {
        if depth > 5.0 && !core::mem::replace(&mut is_asked, true) {
            bench.command(Command::Abort).unwrap();
        }
    });
    let deepest = samples
        .iter()
        .fold(0.0_f64, |most, (depth, _)| most.max(*depth));
    assert!(deepest < 8.0, "{deepest}");
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
    // The move behind the hole has not begun.
    assert_eq!(status.position, start);
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn what_stops_the_motion_in_a_hole_stops_it_above_the_hole() {
    for stop in [Command::Hold, Command::StopAtEndOfBlock] {
        let mut bench = bench();
        let start = AxisVector::from(bench.last().position);
        bench.load_frames(program(start));
        let mut is_asked = false;
        for _ in 0..1_500 {
            let place = AxisVector::from(bench.tick().position);
            if start[2] - place[2] > 5.0 && !core::mem::replace(&mut is_asked, true) {
                bench.command(stop).unwrap();
            }
            assert_eq!(place[0], start[0], "{stop:?}");
        }
        assert!(is_asked);
        assert_eq!(AxisVector::from(bench.last().position), start, "{stop:?}");
        bench.command(Command::Resume).unwrap();
        assert!(bench.run_to(MachineState::Idle, 4_000), "{stop:?}");
        assert_eq!(AxisVector::from(bench.last().position), start);
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
    }
}

#[test]
fn a_spindle_that_is_blocked_in_a_hole_stops_the_axis_there() {
    let mut bench = bench();
    let start = bench.last().position[2];
    let _samples = tap(&mut bench, |bench, depth| {
        if depth > 5.0 {
            bench.inject(InjectedFault::SpindleStuck(true));
        }
    });
    let cause = bench.fault();
    assert!(
        matches!(
            cause,
            Some(FaultCause::SpindleSpeed | FaultCause::ThreadLost)
        ),
        "{cause:?}"
    );
    let depth = start - bench.last().position[2];
    assert!((5.0..8.0).contains(&depth), "{depth}");
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

/// A tap behind a spindle that changes its speed by so many rev/s² and is allowed so many revolutions:
/// how deep it comes, at most and at its end.
fn slow_spindle(
    acceleration: f64,
    overtravel: f64,
    during: impl FnMut(&mut Bench, f64),
) -> (Bench, f64, f64) {
    let config = Config {
        tap_overtravel: overtravel,
        ..config(false)
    };
    let spindle = SpindleSettings {
        acceleration,
        counts: 4096,
        ..SpindleSettings::default()
    };
    let mut bench = bench_beside(config, spindle);
    let start = bench.last().position[2];
    let samples = tap(&mut bench, during);
    let deepest = samples
        .iter()
        .fold(0.0_f64, |most, (depth, _)| most.max(*depth));
    let depth = start - bench.last().position[2];
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
    (bench, deepest, depth)
}

/// The spindle was told to turn back, and then to stop.
fn was_told_to_stop(bench: &Bench) -> bool {
    let told = |setpoint: &Setpoint| setpoint.event().ok().flatten();
    let codes: Vec<Event> = bench.setpoints.iter().filter_map(told).collect();
    // Nothing was told of the coolant since the start, so it counts as on and is told to stop.
    codes.ends_with(&[Event::MCode(4), Event::MCode(5), Event::MCode(9)])
}

#[test]
fn a_spindle_that_does_not_turn_back_in_time_stops_the_tap_where_it_may_go_at_most() {
    // From 10 rev/s it runs on for 50 / a revolutions.
    for (acceleration, overtravel, goes_back) in [
        (40.0, 10.0, true),
        (40.0, 1.4, true),
        (40.0, 1.1, false),
        (10.0, 5.2, true),
        (10.0, 4.9, false),
        (2.0, 10.0, false),
        (2.0, 3.0, false),
        (2.0, 0.3, false),
    ] {
        let (mut bench, deepest, depth) = slow_spindle(acceleration, overtravel, |_, _| {});
        let what = format!("{acceleration} {overtravel}: {deepest} {depth}");
        let most = DEPTH_MM + overtravel * PITCH_MM;
        assert!(deepest <= most, "{what}");
        if goes_back {
            assert_eq!((bench.fault(), depth), (None, 0.0), "{what}");
            continue;
        }
        assert_eq!(bench.fault(), Some(FaultCause::TapOvertravel), "{what}");
        assert!(was_told_to_stop(&bench), "{what}");
        // As far as it may, in the hole, at rest.
        assert!(most - depth < 0.3 * PITCH_MM, "{what}");
        assert!(bench.last().velocity[2] == 0.0, "{what}");
        assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Faulted));
    }
}

#[test]
fn an_abort_counts_the_overtravel_from_where_it_came() {
    let mut is_asked = false;
    let (mut bench, deepest, depth) = slow_spindle(2.0, 4.0, |bench, depth| {
        if depth > 5.0 && !core::mem::replace(&mut is_asked, true) {
            bench.command(Command::Abort).unwrap();
        }
    });
    assert_eq!(bench.fault(), Some(FaultCause::TapOvertravel));
    // The abort is heard a period or two later, at 10 mm/s.
    assert!((8.7..9.2).contains(&depth), "{depth}");
    assert!(deepest <= depth + 1e-9, "{deepest} {depth}");
}

#[test]
fn an_axis_that_cannot_follow_stops_from_where_it_is() {
    // The spindle goes on faster than the axis may.
    let mut bench = bench();
    let _samples = tap(&mut bench, |bench, depth| {
        if depth > 5.0 {
            bench.inject(InjectedFault::SpindlePart(30.0));
        }
    });
    assert_eq!(bench.fault(), Some(FaultCause::ThreadLost));
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
}

#[test]
fn the_pitch_is_that_of_the_tap_at_any_speed_and_without_index_pulses() {
    for part in [0.6, 1.2] {
        let mut bench = bench();
        bench.inject(InjectedFault::SpindlePart(part));
        bench.inject(InjectedFault::IndexLost(true));
        let samples = tap(&mut bench, |_, _| {});
        assert_eq!(bench.fault(), None);
        let off = |(depth, angle): &(f64, f64)| (*depth > 2.0).then(|| depth - PITCH_MM * angle);
        let (low, high) = samples
            .iter()
            .filter_map(off)
            .fold((f64::MAX, f64::MIN), |(low, high), off| {
                (low.min(off), high.max(off))
            });
        assert!(high - low < 0.02, "{part}: {} µm", (high - low) * 1e3);
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
    }
}

#[test]
fn without_a_planner_it_comes_out_of_the_hole_and_then_the_fault_is_told() {
    let mut bench = bench_with(Config {
        planner_lost_after: Some(core::time::Duration::from_millis(100)),
        ..config(false)
    });
    let start = AxisVector::from(bench.last().position);
    // What is behind the hole never comes.
    let mut frames = program(start);
    let is_tap = |frame: &SetpointFrame| matches!(frame.event(), Ok(Some(Event::Tap { .. })));
    let hole = frames.iter().position(is_tap).unwrap();
    frames.truncate(hole + 3);
    let samples = tap_by(&mut bench, frames, |_, _| {});
    let deepest = samples
        .iter()
        .fold(0.0_f64, |most, (depth, _)| most.max(*depth));
    assert!(deepest >= 1.0, "{deepest}");
    assert_eq!(bench.fault(), Some(FaultCause::PlannerLost));
    assert_eq!(bench.last().position[2], start[2]);
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn an_encoder_that_falls_silent_in_a_hole_stops_the_axis_there() {
    let mut bench = bench();
    let start = bench.last().position[2];
    let _samples = tap(&mut bench, |bench, depth| {
        if depth > 5.0 {
            bench.inject(InjectedFault::EncoderLost(true));
        }
    });
    assert!(bench.fault().is_some());
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Faulted));
    let depth = start - bench.last().position[2];
    assert!((5.0..8.0).contains(&depth), "{depth}");
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn a_spindle_that_never_turns_does_not_begin() {
    let mut bench = bench();
    let start = bench.last().position;
    let frames: Vec<_> = program(AxisVector::from(start))
        .into_iter()
        .map(|frame| match frame.event() {
            Ok(Some(Event::MCode(3))) => {
                let mut told = frame;
                happens(&mut told, Event::MCode(5));
                told
            }
            _ => frame,
        })
        .collect();
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Awaiting, 200));
    bench.run(500);
    assert_eq!(bench.state(), MachineState::Awaiting);
    assert_eq!(bench.last().position, start);
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 100));
}
