//! Tests of thread passes behind the spindle of the plant.
//!
//! Each sample holds a setpoint against the angle that the spindle really has when it applies.

use super::bench::{Bench, config};
use crate::testing::{blocks, mill, planned};
use glidepath_geometry::{AxisVector, Segment};
use glidepath_link::{Command, EndOfEpoch, FaultCause, MachineState, Setpoint, SetpointFrame};
use glidepath_plant::{InjectedFault, JointSettings, SpindleSettings};
use glidepath_program::{Effort, Event, FrameFlags, Item, ItemKind, PHASE_STEPS, PathMode, Rate};

const T: f64 = 0.004;
const START: [f64; 3] = [12.5, -3.0, 40.0];
const PITCH_MM: f64 = 1.5;
/// Planned for 24.75 mm/s.
const S: f64 = 900.0;
/// Between a step of the plant and the time at which the setpoint applies, s.
const TO_APPLY_T: f64 = 0.000_7;

/// A pass along Z, and the way back.
#[derive(Clone, Copy)]
struct Thread {
    pitch_mm: f64,
    length_mm: f64,
    speed: f64,
    phase: f64,
    direction: u32,
}

impl Thread {
    const USUAL: Self = Self {
        pitch_mm: PITCH_MM,
        length_mm: 30.0,
        speed: S,
        phase: 0.0,
        direction: 3,
    };

    /// The spindle, the pass, and the way back, from where the machine stands.
    fn items(&self, start: AxisVector) -> Vec<Item> {
        let end = start - AxisVector::z() * self.length_mm;
        let feed_v = self.pitch_mm * 1.1 * self.speed / 60.0;
        let to = |from, to, rate| ItemKind::Move {
            segment: Segment::line(from, to),
            rate,
            mode: PathMode::ExactStop,
        };
        let phase = (self.phase * f64::from(PHASE_STEPS)).round() as u32;
        let pitch_mm = self.pitch_mm;
        let kinds = [
            ItemKind::Event(Event::SpindleSpeed(self.speed)),
            ItemKind::Event(Event::MCode(self.direction)),
            ItemKind::Event(Event::Synchronise { pitch_mm, phase }),
            to(start, end, Rate::Synchronised(feed_v)),
            to(end, end + AxisVector::x() * 2.0, Rate::Rapid),
            to(
                end + AxisVector::x() * 2.0,
                start + AxisVector::x() * 2.0,
                Rate::Rapid,
            ),
            to(start + AxisVector::x() * 2.0, start, Rate::Rapid),
        ];
        blocks(kinds)
    }
}

fn frames(items: &[Item], start: AxisVector, effort: Effort) -> Vec<SetpointFrame> {
    planned(items, mill(), start, effort)
}

fn bench(spindle: SpindleSettings) -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let mut bench = Bench::new(config(false), &START.map(joint));
    bench.plant = bench.plant.with_spindle(spindle);
    bench.enable(MachineState::Idle);
    bench
}

/// A spindle with an encoder of 4096 counts.
const COUNTED: SpindleSettings = SpindleSettings {
    acceleration: 40.0,
    lag_t: 0.2,
    counts: 4096,
    angle: 0.37,
};

/// A setpoint of a pass with the angle and speed of the spindle when it applies.
#[derive(Clone, Copy)]
struct Sample {
    way_mm: f64,
    angle: f64,
    speed: f64,
}

/// A tick, and what it sampled.
fn sample(bench: &mut Bench, start_z: f64) -> (Setpoint, Sample) {
    let setpoint = bench.tick();
    let (angle, speed) = bench.plant.spindle();
    let sample = Sample {
        way_mm: start_z - setpoint.position[2],
        angle: angle + speed * TO_APPLY_T,
        speed,
    };
    (setpoint, sample)
}

/// Plays a thread to its end; `during` is called at every tick of the pass with the ticks since it
/// set out. Gives the samples in it.
fn cut(
    bench: &mut Bench,
    thread: &Thread,
    effort: Effort,
    mut during: impl FnMut(&mut Bench, usize),
) -> Vec<Sample> {
    let start = AxisVector::from(bench.last().position);
    bench.load_frames(frames(&thread.items(start), start, effort));
    let mut samples = Vec::new();
    for _ in 0..8_000 {
        let (setpoint, sample) = sample(bench, start[2]);
        if setpoint.has(FrameFlags::SYNC) {
            during(bench, samples.len());
            samples.push(sample);
        }
        let ended = matches!(
            setpoint.state(),
            Ok(MachineState::Idle | MachineState::Faulted)
        );
        if ended && !samples.is_empty() {
            return samples;
        }
    }
    panic!("the thread does not end: {:?}", bench.state());
}

/// How far the thread is off where it is to be, mm, at each sample between run-in and run-out.
fn errors(samples: &[Sample], thread: &Thread) -> Vec<f64> {
    let sign = if thread.direction == 3 { 1.0 } else { -1.0 };
    let is_thread = |sample: &&Sample| (2.0..thread.length_mm - 2.0).contains(&sample.way_mm);
    let error = |sample: &Sample| {
        let turns = sign * sample.angle - sample.way_mm / thread.pitch_mm - thread.phase;
        (turns - turns.round()) * thread.pitch_mm
    };
    samples.iter().filter(is_thread).map(error).collect()
}

fn worst(errors: &[f64]) -> f64 {
    assert!(errors.len() > 50, "{} samples", errors.len());
    errors
        .iter()
        .fold(0.0, |worst, error| error.abs().max(worst))
}

/// What a count of the encoder, time stamps to 10 µs, and extrapolation over three periods at an
/// acceleration of the spindle come to, mm.
fn allowed_mm(acceleration: f64, pitch_mm: f64) -> f64 {
    let count = 1.0 / f64::from(COUNTED.counts);
    let stamp = S / 60.0 * 1e-5;
    let extrapolated = 0.5 * acceleration * (3.0 * T) * (3.0 * T);
    pitch_mm * (count + stamp + extrapolated)
}

#[test]
fn the_phase_does_not_depend_on_the_speed_of_the_spindle() {
    for part in [0.51, 0.6, 0.75, 0.9, 1.0, 1.05, 1.085] {
        for effort in [Effort::Fast, Effort::Optimal] {
            let mut bench = bench(COUNTED);
            bench.inject(InjectedFault::SpindlePart(part));
            let samples = cut(&mut bench, &Thread::USUAL, effort, |_, _| {});
            assert_eq!(bench.fault(), None, "{part}");
            let off = worst(&errors(&samples, &Thread::USUAL));
            println!("{part} {effort:?}: {:.2} µm", off * 1e3);
            assert!(off < allowed_mm(0.0, PITCH_MM), "{part}: {off}");
            assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
        }
    }
}

#[test]
fn multiple_starts_and_left_hand_threads_are_where_they_are_to_be() {
    for (phase, direction, pitch_mm) in [(0.5, 3, 1.5), (1.0 / 3.0, 4, 1.5), (0.25, 4, 3.0)] {
        let thread = Thread {
            phase,
            direction,
            pitch_mm,
            ..Thread::USUAL
        };
        let mut bench = bench(COUNTED);
        let samples = cut(&mut bench, &thread, Effort::Optimal, |_, _| {});
        let off = worst(&errors(&samples, &thread));
        assert!(
            off < allowed_mm(0.0, pitch_mm),
            "{phase} {direction}: {off}"
        );
    }
}

#[test]
fn a_load_that_slows_the_spindle_is_followed() {
    for (part, tick) in [(0.9, 3), (0.9, 60), (0.8, 120), (1.08, 90)] {
        let mut bench = bench(COUNTED);
        let samples = cut(&mut bench, &Thread::USUAL, Effort::Optimal, |bench, now| {
            if now == tick {
                bench.inject(InjectedFault::SpindlePart(part));
            }
        });
        assert_eq!(bench.fault(), None, "{part}");
        let speeds: Vec<f64> = samples.iter().map(|sample| sample.speed).collect();
        let acceleration = speeds.windows(2).fold(0.0_f64, |most, pair| {
            most.max((pair[1] - pair[0]).abs() / T)
        });
        let off = worst(&errors(&samples, &Thread::USUAL));
        println!(
            "{part} at {tick}: {:.2} µm, {acceleration:.1} rev/s²",
            off * 1e3
        );
        assert!(off < allowed_mm(acceleration, PITCH_MM), "{part}: {off}");
        assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
    }
}

#[test]
fn a_second_pass_of_another_program_is_in_the_same_groove() {
    let mut bench = bench(COUNTED);
    let first = cut(&mut bench, &Thread::USUAL, Effort::Optimal, |_, _| {});
    bench.run(37);
    let second = cut(&mut bench, &Thread::USUAL, Effort::Optimal, |_, _| {});
    let off = worst(&errors(&first, &Thread::USUAL)).max(worst(&errors(&second, &Thread::USUAL)));
    assert!(off < allowed_mm(0.0, PITCH_MM), "{off}");
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Completed));
}

#[test]
fn hold_override_and_single_block_wait_until_the_pass_ends() {
    for command in [
        Command::Hold,
        Command::FeedOverride(0.0),
        Command::StopAtEndOfBlock,
    ] {
        let mut bench = bench(COUNTED);
        let start = AxisVector::from(bench.last().position);
        let thread = Thread::USUAL;
        bench.load_frames(frames(&thread.items(start), start, Effort::Optimal));
        let mut samples = Vec::new();
        let mut is_asked = false;
        while samples.len() < 2_000 {
            let (setpoint, sample) = sample(&mut bench, start[2]);
            if setpoint.has(FrameFlags::SYNC) {
                samples.push(sample);
            }
            if samples.len() == 100 && !core::mem::replace(&mut is_asked, true) {
                bench.command(command).unwrap();
            }
            let rests = [MachineState::Held, MachineState::ProgramStop].map(Ok);
            if rests.contains(&setpoint.state()) {
                break;
            }
        }
        let off = worst(&errors(&samples, &thread));
        assert!(off < allowed_mm(0.0, PITCH_MM), "{command:?}: {off}");
        let z = bench.last().position[2];
        assert!(
            (z - (start[2] - thread.length_mm)).abs() < 1e-6,
            "{command:?}: {z}"
        );
        bench.run(20);
        assert_eq!(bench.last().position[2], z);
        bench.command(Command::FeedOverride(1.0)).unwrap();
        // An override of 0 holds nothing that is to be resumed.
        let _resumed = bench.command(Command::Resume);
        assert!(bench.run_to(MachineState::Idle, 2_000), "{command:?}");
        assert_eq!(bench.fault(), None);
        assert!(bench.worst_ratio() < 1.0 + 1e-6);
    }
}

#[test]
fn an_abort_waits_for_the_run_out() {
    let mut bench = bench(COUNTED);
    let start = bench.last().position[2];
    let samples = cut(
        &mut bench,
        &Thread::USUAL,
        Effort::Optimal,
        |bench, tick| {
            if tick == 100 {
                bench.command(Command::Abort).unwrap();
            }
        },
    );
    let off = worst(&errors(&samples, &Thread::USUAL));
    assert!(off < allowed_mm(0.0, PITCH_MM), "{off}");
    let status = bench.status();
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
    assert!((status.position[2] - (start - Thread::USUAL.length_mm)).abs() < 1e-6);
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn a_spindle_that_makes_no_sense_any_more_stops_the_thread() {
    let cases = [
        (InjectedFault::SpindleStuck(true), FaultCause::ThreadLost),
        (InjectedFault::SpindlePart(0.4), FaultCause::SpindleSpeed),
        (InjectedFault::SpindlePart(1.2), FaultCause::SpindleSpeed),
        (InjectedFault::IndexLost(true), FaultCause::SpindleAngle),
        (InjectedFault::EncoderLost(true), FaultCause::SpindleSpeed),
    ];
    for (upset, cause) in cases {
        let mut bench = bench(COUNTED);
        let samples = cut(
            &mut bench,
            &Thread::USUAL,
            Effort::Optimal,
            |bench, tick| {
                if tick == 100 {
                    bench.inject(upset);
                }
            },
        );
        assert_eq!(bench.fault(), Some(cause), "{upset:?}");
        let last = samples[samples.len() - 1].way_mm;
        assert!(last < Thread::USUAL.length_mm - 1.0, "{upset:?}: {last}");
        assert!(bench.worst_ratio() < 1.0 + 1e-6, "{upset:?}");
    }
}

#[test]
fn frames_that_stay_away_in_a_thread_end_it() {
    let mut bench = bench(COUNTED);
    let start = AxisVector::from(bench.last().position);
    let mut all = frames(&Thread::USUAL.items(start), start, Effort::Optimal);
    let is_pass = |f: &SetpointFrame| matches!(f.event(), Ok(Some(Event::Synchronise { .. })));
    let begins = all.iter().position(is_pass).unwrap();
    all.truncate(begins + 220);
    bench.load_frames(all);
    assert!(
        bench.run_to(MachineState::Faulted, 3_000),
        "{:?}",
        bench.state()
    );
    assert_eq!(bench.fault(), Some(FaultCause::ThreadLost));
    assert!(bench.worst_ratio() < 1.0 + 1e-6);
}

#[test]
fn a_pass_waits_for_a_spindle_that_is_not_at_speed() {
    let mut bench = bench(COUNTED);
    bench.inject(InjectedFault::SpindlePart(0.3));
    let start = AxisVector::from(bench.last().position);
    bench.load_frames(frames(&Thread::USUAL.items(start), start, Effort::Optimal));
    assert!(bench.run_to(MachineState::Awaiting, 200));
    bench.run(500);
    assert_eq!(bench.state(), MachineState::Awaiting);
    assert_eq!(bench.last().position[2], start[2]);
    // Turning up the speed is all that it takes.
    bench.inject(InjectedFault::SpindlePart(1.0));
    assert!(
        bench.run_to(MachineState::Idle, 3_000),
        "{:?}",
        bench.state()
    );
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Completed));
}

#[test]
fn a_hold_before_the_pass_keeps_it_from_beginning_and_an_abort_ends_it() {
    let mut bench = bench(COUNTED);
    let start = AxisVector::from(bench.last().position);
    let all = frames(&Thread::USUAL.items(start), start, Effort::Optimal);
    bench.inject(InjectedFault::SpindlePart(0.3));
    bench.load_frames(all);
    assert!(bench.run_to(MachineState::Awaiting, 200));
    bench.command(Command::Hold).unwrap();
    bench.inject(InjectedFault::SpindlePart(1.0));
    bench.run(500);
    assert_eq!(bench.last().position[2], start[2]);
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 100));
    assert_eq!(bench.status().end_of_epoch(), Ok(EndOfEpoch::Aborted));
}
