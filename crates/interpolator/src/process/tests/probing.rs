//! Tests of a probe that touches a plane somewhere on its way, or does not.

use super::bench::{Bench, PERIOD_NS, config, numbers};
use crate::shared::config::Config;
use crate::shared::config::feedback::{FeedbackSettings, ProbeInput};
use crate::testing::happens;
use core::f64::consts::TAU;
use glidepath_geometry::AxisVector;
use glidepath_link::{
    Command, ContactKind, EndOfEpoch, FaultCause, MachineState, Setpoint, SetpointFrame,
};
use glidepath_plant::{InjectedFault, JointSettings};
use glidepath_program::{Event, FrameFlags};

const T: f64 = 0.004;
/// Between two samples of the drives, s.
const SAMPLE_T: f64 = 0.001;
const ACCELERATION: f64 = 2_000.0;
const JERK: f64 = 40_000.0;
const START: [f64; 3] = [12.5, -3.0, 40.0];

pub(super) fn bench(
    lag_t: f64,
    change: impl FnOnce(glidepath_plant::Plant) -> glidepath_plant::Plant,
) -> Bench {
    guarded(false, lag_t, change)
}

fn guarded(
    protects: bool,
    lag_t: f64,
    change: impl FnOnce(glidepath_plant::Plant) -> glidepath_plant::Plant,
) -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        lag_t,
        ..JointSettings::default()
    };
    let usual = config(false);
    let input = ProbeInput {
        protects,
        number: 0,
        high: true,
    };
    let mut bench = Bench::new(
        Config {
            feedback: usual.feedback.map(|feedback| FeedbackSettings {
                probe: Some(input),
                ..feedback
            }),
            ..usual
        },
        &START.map(joint),
    );
    bench.plant = change(bench.plant);
    bench.enable(MachineState::Idle);
    bench
}

/// Whole periods that the speed takes to come up and go down, as a sine does.
fn ramp_t(v: f64) -> f64 {
    let t = (2.0 * v / ACCELERATION).max((TAU * v / JERK).sqrt());
    (t / T).ceil() * T
}

/// A search along a line at the speed `v`, to a place `way` from where the machine stands.
pub(super) fn search(bench: &Bench, way: AxisVector, v: f64, release: bool) -> Vec<SetpointFrame> {
    let (start, length) = (AxisVector::from(bench.last().position), way.norm());
    let ramp_t = ramp_t(v);
    let steady_t = ((length / v - ramp_t) / T).ceil().max(0.0) * T;
    let v = length / (steady_t + ramp_t);
    let up = |t: f64| {
        let u = t / ramp_t;
        [
            v * ramp_t * (u * u / 2.0 + ((TAU * u).cos() - 1.0) / (TAU * TAU)),
            v * (u - (TAU * u).sin() / TAU),
            v / ramp_t * (1.0 - (TAU * u).cos()),
        ]
    };
    let at = |t: f64| {
        let end_t = 2.0 * ramp_t + steady_t;
        if t <= ramp_t {
            up(t)
        } else if t <= ramp_t + steady_t {
            [v * (t - ramp_t / 2.0), v, 0.0]
        } else {
            let [s, v, a] = up((end_t - t).max(0.0));
            [length - s, v, -a]
        }
    };
    let ticks = ((2.0 * ramp_t + steady_t) / T).round() as u64;
    let mut frames: Vec<SetpointFrame> = (0..2)
        .map(|_| 0.0)
        .chain((0..=ticks).map(|k| k as f64 * T))
        .zip(0..)
        .map(|(t, sequence)| {
            let [s, v, a] = at(t);
            SetpointFrame {
                sequence,
                period_ns: PERIOD_NS,
                line: 1,
                planned_override: 1.0,
                path_s: s,
                path_v: v,
                position: (start + way * (s / length)).into(),
                velocity: (way * (v / length)).into(),
                acceleration: (way * (a / length)).into(),
                ..<SetpointFrame as bytemuck::Zeroable>::zeroed()
            }
        })
        .collect();
    frames[0].flags = FrameFlags::FIRST.0;
    happens(&mut frames[1], Event::Probe { release });
    let last = frames.len() - 1;
    frames[last].flags = FrameFlags::LAST.0;
    frames
}

fn play(bench: &mut Bench, frames: Vec<SetpointFrame>) -> EndOfEpoch {
    let most = frames.len() + 400;
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Running, 50));
    assert!(
        bench.run_to(MachineState::Waiting, most),
        "{:?}",
        bench.state()
    );
    bench.status().end_of_epoch().unwrap()
}

/// What a machine needs to stop from a speed, as its configuration promises.
fn most_overtravel(v: f64) -> f64 {
    let stop = if v <= ACCELERATION * ACCELERATION / JERK {
        v * (v / JERK).sqrt()
    } else {
        0.5 * v * (v / ACCELERATION + ACCELERATION / JERK)
    };
    4.0 * T * v + 2.0 * stop
}

fn assert_on_line(setpoints: &[Setpoint], start: AxisVector, way: AxisVector) {
    let unit = way.normalize();
    for setpoint in setpoints {
        let from_start = AxisVector::from(setpoint.position) - start;
        let off = from_start - unit * from_start.dot(&unit);
        assert!(off.amax() < 1e-9, "{off:?}");
    }
}

/// One search for a plane; how far it went on behind it, as a part of what it may.
fn one_case(seed: u64) -> f64 {
    let mut numbers = numbers(seed);
    let v = 0.3 * 200.0_f64.powf(numbers.unit());
    let lag_t = if numbers.unit() < 0.5 {
        0.0
    } else {
        0.004 * numbers.unit()
    };
    let depth = (1.0 + 9.0 * numbers.unit()) * (v / 10.0).clamp(0.2, 2.0);
    let way = AxisVector::from_fn(|axis, _| match axis {
        0 | 1 => depth * (2.0 * numbers.unit() - 1.0),
        2 => -depth,
        _ => 0.0,
    });
    let plane = START[2] - depth * 1.15 * numbers.unit();
    let bounce_ns = (numbers.unit() * 12e6) as u64;
    let latency_ns = (numbers.unit() * 2e6) as u64;
    let mut bench = bench(lag_t, |plant| {
        plant
            .with_probe(2, plane)
            .with_bounce(bounce_ns)
            .with_latency(latency_ns)
    });
    let begun = bench.setpoints.len();
    let start = AxisVector::from(bench.last().position);
    let frames = search(&bench, way, v, false);
    let end = play(&mut bench, frames);
    bench.run(50);
    let status = bench.status();
    assert_on_line(&bench.setpoints[begun..], start, way);
    assert!(
        bench.worst_ratio() < 1.0 + 1e-6,
        "seed {seed}: {}",
        bench.worst_ratio()
    );
    assert_eq!(status.fault(), Ok(None), "seed {seed}");
    let end_z = START[2] - depth;
    if plane < end_z {
        assert_eq!(end, EndOfEpoch::Completed, "seed {seed}");
        assert_eq!(status.contact(), Ok(ContactKind::None), "seed {seed}");
        assert!((status.position[2] - end_z).abs() < 1e-9, "seed {seed}");
        return 0.0;
    }
    // What is touched at the very end is known when the way is over, and not found.
    if status.contact() == Ok(ContactKind::None) {
        let last_way = JERK * (4.0 * T).powi(3) / 6.0;
        assert!(
            plane - end_z < lag_t * v + last_way,
            "seed {seed}: {plane} {end_z}"
        );
        return 0.0;
    }
    assert_eq!(status.contact(), Ok(ContactKind::Made), "seed {seed}");
    let along = depth / way.norm() * v;
    let error = plane - status.contact[2];
    assert!(
        (-1e-9..=along * SAMPLE_T + 1e-9).contains(&error),
        "seed {seed}: {error}"
    );
    let beyond = plane - status.position[2];
    let allowed = most_overtravel(v) + lag_t * v;
    assert!(
        beyond <= allowed,
        "seed {seed}: {beyond} of {allowed} at {v}"
    );
    beyond / allowed
}

/// Cases of a run: `GLIDEPATH_PROBES` for more of them.
fn cases() -> u64 {
    std::env::var("GLIDEPATH_PROBES").map_or(1000, |text| text.parse().unwrap())
}

#[test]
fn a_plane_anywhere_is_found_and_the_machine_stops_behind_it() {
    let worst = (0..cases()).map(one_case).fold(0.0, f64::max);
    println!(
        "{} searches, at most {worst:.3} of the overtravel allowed",
        cases()
    );
    assert!(worst > 0.1, "{worst}: the bound says nothing");
}

#[test]
fn a_contact_that_was_there_before_stops_at_once_and_one_that_ends_is_found() {
    let mut bench = bench(0.0, |plant| plant.with_probe(2, START[2] + 1.0));
    let way = AxisVector::z() * -5.0;
    let frames = search(&bench, way, 5.0, false);
    assert_eq!(play(&mut bench, frames), EndOfEpoch::Tripped);
    let status = bench.status();
    assert_eq!(status.contact(), Ok(ContactKind::AlreadySo));
    assert_eq!(status.contact[2], START[2]);
    assert!(
        START[2] - status.position[2] < 0.01,
        "{}",
        status.position[2]
    );

    let frames = search(&bench, -way, 5.0, true);
    assert_eq!(play(&mut bench, frames), EndOfEpoch::Tripped);
    let status = bench.status();
    assert_eq!(status.contact(), Ok(ContactKind::Made));
    let error = status.contact[2] - (START[2] + 1.0);
    // In the middle between two samples: nothing latches that edge.
    assert!(error.abs() <= 5.0 * SAMPLE_T / 2.0 + 1e-9, "{error}");

    // The next motion knows nothing of it.
    let frames = search(&bench, AxisVector::x() * 3.0, 20.0, false);
    bench.load_frames(
        frames
            .into_iter()
            .map(|f| SetpointFrame {
                event_count: 0,
                ..f
            })
            .collect(),
    );
    assert!(bench.run_to(MachineState::Running, 50) && bench.run_to(MachineState::Idle, 900));
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert_eq!(status.contact(), Ok(ContactKind::None));
}

/// Of a probe that opens its contact where it touches, a cable that is lost looks like a touch; of one
/// that closes it, like none at all: that is found at the end of the way alone.
#[test]
fn a_lost_cable_stops_the_search_or_is_found_at_its_end() {
    const INPUT: u8 = 5;
    let way = AxisVector::z() * -5.0;
    for (high, is_before) in [(false, true), (false, false), (true, false)] {
        let joint = |start| JointSettings {
            start,
            count: start,
            ..JointSettings::default()
        };
        let input = ProbeInput {
            protects: false,
            number: INPUT,
            high,
        };
        let usual = config(false);
        let feedback = usual.feedback.map(|feedback| FeedbackSettings {
            probe: Some(input),
            ..feedback
        });
        let mut bench = Bench::new(Config { feedback, ..usual }, &START.map(joint));
        let signal = |bench: &mut Bench, is_there: bool| {
            bench.inject(InjectedFault::Input(u32::from(INPUT), is_there && !high));
        };
        signal(&mut bench, !is_before);
        bench.enable(MachineState::Idle);
        let begun = bench.setpoints.len();
        let start = AxisVector::from(bench.last().position);
        let frames = search(&bench, way, 5.0, false);
        let most = frames.len() + 400;
        bench.load_frames(frames);
        assert!(bench.run_to(MachineState::Running, 50));
        bench.run(100);
        let lost_at = bench.last().position[2];
        signal(&mut bench, false);
        assert!(bench.run_to(MachineState::Waiting, most));
        let status = bench.status();
        assert_on_line(&bench.setpoints[begun..], start, way);
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
        let found = (status.end_of_epoch(), status.contact());
        let z = status.position[2];
        if high {
            let none = (Ok(EndOfEpoch::Completed), Ok(ContactKind::None));
            assert_eq!(found, none);
            assert!((z - (START[2] - 5.0)).abs() < 1e-9);
        } else if is_before {
            let already = (Ok(EndOfEpoch::Tripped), Ok(ContactKind::AlreadySo));
            assert_eq!(found, already);
            assert!(START[2] - z < 0.01, "{z}");
        } else {
            let made = (Ok(EndOfEpoch::Tripped), Ok(ContactKind::Made));
            assert_eq!(found, made);
            assert!(lost_at - z < most_overtravel(5.0), "{z}");
        }
    }
    // Nothing is heard any more.
    let mut bench = bench(0.0, |plant| plant.with_probe(2, START[2] - 4.0));
    let frames = search(&bench, way, 5.0, false);
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(100);
    let lost_at = bench.last().position[2];
    bench.inject(InjectedFault::Dropout(true));
    assert!(
        bench.run_to(MachineState::Faulted, 400),
        "{:?}",
        bench.state()
    );
    let last = bench.last().position[2];
    assert!(
        (0.0..5.0 * 0.1).contains(&(lost_at - last)),
        "{lost_at} {last}"
    );
    assert_eq!(bench.fault(), Some(FaultCause::FeedbackLost));
}

#[test]
fn a_search_is_held_goes_on_and_is_aborted_like_any_motion() {
    let mut bench = bench(0.0, |plant| plant.with_probe(2, START[2] - 4.0));
    let frames = search(&bench, AxisVector::z() * -5.0, 5.0, false);
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(60);
    bench.command(Command::Hold).unwrap();
    assert!(bench.run_to(MachineState::Held, 100));
    bench.run(100);
    bench.command(Command::Resume).unwrap();
    assert!(bench.run_to(MachineState::Waiting, 900));
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Tripped));
    assert!((status.contact[2] - (START[2] - 4.0)).abs() < 5.0 * SAMPLE_T);

    let frames = search(&bench, AxisVector::z() * 8.0, 5.0, true);
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 200));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Aborted));
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

/// A short way that looks for nothing.
fn way(bench: &Bench) -> Vec<SetpointFrame> {
    let frames = search(bench, AxisVector::x() * 3.0, 20.0, false);
    let plain = |frame| SetpointFrame {
        event_count: 0,
        ..frame
    };
    frames.into_iter().map(plain).collect()
}

/// A machine that waits behind a search.
fn behind_a_search() -> Bench {
    let mut bench = bench(0.0, |plant| plant.with_probe(2, START[2] - 1.0));
    let frames = search(&bench, AxisVector::z() * -2.0, 5.0, false);
    assert_eq!(play(&mut bench, frames), EndOfEpoch::Tripped);
    bench
}

#[test]
fn a_hold_behind_a_search_is_in_force_when_the_program_goes_on() {
    let mut bench = behind_a_search();
    bench.command(Command::Hold).unwrap();
    let stands = bench.last().position;
    let frames = way(&bench);
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Held, 50), "{:?}", bench.state());
    bench.run(100);
    assert_eq!(bench.last().position, stands);
    bench.command(Command::Resume).unwrap();
    assert!(bench.run_to(MachineState::Idle, 900));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn an_abort_behind_a_search_ends_the_program_and_what_is_under_way() {
    let mut bench = behind_a_search();
    let homing = bench.command(Command::Home(1));
    bench.run(5);
    assert_eq!(bench.state(), MachineState::Waiting, "{homing:?}");
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 5));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Aborted));
    let stands = bench.last().position;
    let frames = way(&bench);
    bench.load_frames(frames);
    bench.run(60);
    assert_eq!(
        (bench.state(), bench.last().position),
        (MachineState::Idle, stands)
    );
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Aborted));
    // Whoever begins anew may.
    bench.run(200);
    let frames = way(&bench);
    bench.load_frames(frames);
    assert!(bench.run_to(MachineState::Running, 50) && bench.run_to(MachineState::Idle, 900));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Completed));
}

#[test]
fn a_contact_that_nobody_looks_for_stops_the_motion_where_that_is_wanted() {
    const PLANE: f64 = 35.0;
    let down = |bench: &Bench, z: f64| {
        let mut way = AxisVector::zeros();
        way[2] = z - bench.last().position[2];
        search(bench, way, 10.0, false)
    };
    for (protects, bounce_ns) in [(false, 0), (true, 0), (true, 8_000_000)] {
        let mut bench = guarded(protects, 0.004, |plant| {
            plant.with_probe(2, PLANE).with_bounce(bounce_ns)
        });
        bench.run(60);
        // A search, and the way back from it, are none.
        let frames = down(&bench, 30.0);
        bench.load_frames(frames);
        assert!(bench.run_to(MachineState::Waiting, 3000));
        let mut back = down(&bench, 38.0);
        back[1].silence();
        bench.load_frames(back);
        assert!(bench.run_to(MachineState::Running, 100));
        assert!(bench.run_to(MachineState::Idle, 3000));
        bench.run(60);
        assert_eq!(bench.fault(), None);

        let mut frames = down(&bench, 30.0);
        frames[1].silence();
        bench.load_frames(frames);
        assert!(bench.run_to(MachineState::Running, 100));
        let end = if protects {
            MachineState::Faulted
        } else {
            MachineState::Idle
        };
        assert!(bench.run_to(end, 3000), "{:?}", bench.state());
        let cause = protects.then_some(FaultCause::ProbeContact);
        assert_eq!(bench.fault(), cause);
        let z = bench.last().position[2];
        let expected = if protects { 34.3..PLANE } else { 29.9..30.1 };
        assert!(expected.contains(&z), "{z}");
        assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
    }
}
