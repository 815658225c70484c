//! Tests of random demands for jogs, in any order: limits, travel, and the stop after the last of
//! it.

use super::jog::{Hand, jogged, three_axes};
use super::*;
use crate::shared::config::SoftLimits;
use crate::testing::hexapod;
use glidepath_kinematics::{JointLimit, JointLimits, JointWatch};
use glidepath_link::JogMode;

/// How many sequences: a sample in every run, all of them where the environment says so.
fn sequences(usual: u64) -> u64 {
    let wanted = std::env::var("GLIDEPATH_JOGS").ok();
    wanted.map_or(usual, |text| text.parse().unwrap())
}

/// Most way of a step, mm.
const STEP_MM: f64 = 30.0;
/// How far an axis goes at most that stops from whatever it does, mm: at 150 mm/s and the full
/// acceleration it takes 50 ms and 9.17 mm until that is gone and the speed is 200 mm/s, and 15 mm
/// from there.
const FARTHEST_STOP_MM: f64 = 24.17;

/// How long a stop from a constant speed of an axis takes, s.
fn stop_t(v: f64) -> f64 {
    if v <= 100.0 {
        2.0 * (v / 40_000.0).sqrt()
    } else {
        v / 2_000.0 + 0.05
    }
}

/// What two clients and an operator do, at random; then nothing more comes from anybody.
fn play(rig: &mut Rig, numbers: &mut Numbers, most_v: f64) {
    let mut hands = [Hand::new(1), Hand::new(2)];
    let mut counts = [0.0; 3];
    for hand in &mut hands {
        hand.demand.scale = 0.05;
        hand.demand.number = rig.now_ns(); // Above those of clients before.
    }
    for _ in 0..numbers.whole(3, 15) {
        let hand = &mut hands[numbers.whole(0, 5) as usize / 5];
        let mut vector = |size: f64| -> [f64; 3] {
            std::array::from_fn(|_| match numbers.whole(0, 2) {
                0 => 0.0,
                _ => size * (2.0 * numbers.unit() - 1.0),
            })
        };
        let (speed, step, turn) = (vector(1.5 * most_v), vector(STEP_MM), vector(60.0));
        hand.demand.velocity_v = most_v * (0.1 + 0.9 * numbers.unit());
        match numbers.whole(0, 11) {
            0..=3 => hand.ask(rig, JogMode::Continuous, speed),
            4..=5 => hand.ask(rig, JogMode::Incremental, step),
            kind @ 6..=7 => {
                counts = std::array::from_fn(|axis| counts[axis] + turn[axis].round());
                let mode = [JogMode::Wheel, JogMode::WheelVelocity][kind as usize - 6];
                hand.ask(rig, mode, counts);
            }
            8 => hand.ask(rig, JogMode::None, [0.0; 3]),
            9 => rig.command(Command::JogOverride(0.1 + 0.9 * numbers.unit())),
            10 => rig.command(if numbers.whole(0, 1) == 0 {
                Command::Hold
            } else {
                Command::Abort
            }),
            _ => {
                // It comes late: as if it had been sent long ago.
                hand.ask(rig, JogMode::Continuous, speed);
                hand.demand.sent_ns = hand.demand.sent_ns.saturating_sub(200_000_000);
            }
        }
        // The client repeats itself, or stalls.
        let repeats = numbers.whole(0, 3) > 0;
        for _ in 0..numbers.whole(0, 6) {
            rig.run(numbers.whole(1, 12) as usize);
            if repeats {
                hand.again(rig);
            }
        }
    }
}

#[test]
fn at_random_the_axes_stay_inside_limits_and_travel_and_stop_when_nobody_demands() {
    for seed in 0..sequences(300) {
        let mut rig = jogged();
        rig.run(1);
        let mut numbers = Numbers::new(seed + 1);
        play(&mut rig, &mut numbers, 200.0);
        // Killed: what was demanded last ends within the jog time-out and a stop, or where its way
        // does: that of a step, or 15 mm ahead of a wheel. A step begins where the axis was when it
        // was asked for, which may be on the way in the other direction.
        let from = rig.setpoints.len() - 1;
        let last = |rig: &Rig| AxisVector::from(rig.setpoints.last().unwrap().position);
        let before = last(&rig);
        let stopped = rig.run_until(8_000, |s| s.state() == Ok(MachineState::Idle));
        assert!(stopped, "seed {seed}: {:?}", rig.setpoints.last().unwrap());
        let (rest, way) = (last(&rig), (last(&rig) - before).amax());
        let after = &rig.setpoints[from..];
        let speeds = after.iter().map(|s| AxisVector::from(s.velocity).amax());
        let v = speeds.fold(0.0_f64, f64::max);
        let bound = if after.len() as f64 * 0.004 <= 0.158 + stop_t(v) {
            v * 0.158 + 0.5 * v * stop_t(v) + 1e-6
        } else {
            STEP_MM + FARTHEST_STOP_MM
        };
        assert!(way <= bound, "seed {seed}: {way} mm instead of {bound}");
        rig.run(50);
        assert_eq!(last(&rig), rest);
        let beyond = rig
            .positions()
            .iter()
            .map(AxisVector::amax)
            .fold(0.0, f64::max);
        assert!(beyond <= 50.0 + 1e-9, "seed {seed}: at {beyond}");
        let ratio = rig.worst_ratio();
        assert!(ratio <= INSIDE, "seed {seed}: {ratio} of a limit");
        assert_eq!(rig.last.unwrap().fault, None, "seed {seed}");
    }
}

/// Where joints are not axes, at random: no joint above its limits, by an independent judge.
#[test]
fn at_random_the_joints_of_a_hexapod_stay_inside_theirs() {
    let mut config = Config::new(three_axes(), 4_000_000);
    config.mechanism = hexapod();
    config.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-300.0),
        highest: AxisVector::repeat(300.0),
    };
    let home = JointWatch::new(config.mechanism, JointLimits::NONE, 0.004);
    let lengths = home.stand(&AxisVector::zeros()).unwrap();
    let joint = |length: f64| JointLimit {
        // The reach is what ends most of these motions, and not travel.
        min_position: length - 25.0,
        max_position: length + 25.0,
        velocity: 120.0,
        acceleration: 8_000.0,
        jerk: 160_000.0,
    };
    config.joint_limits = JointLimits::NONE;
    for (limit, length) in config.joint_limits.0.iter_mut().zip(&lengths).take(6) {
        *limit = joint(*length);
    }
    let mut farthest = 0.0_f64;
    for seed in 0..sequences(80).div_ceil(4) {
        let mut rig = Rig::new(config);
        play(&mut rig, &mut Numbers::new(seed + 1_000), 200.0);
        assert!(rig.run_until(8_000, |s| s.state() == Ok(MachineState::Idle)));
        rig.run(5);
        let mut judge = JointWatch::new(config.mechanism, config.joint_limits, 0.004);
        for position in rig.positions() {
            let verdict = judge.take(&position);
            assert!(verdict.is_ok(), "seed {seed}: {verdict:?}");
        }
        for s in &rig.setpoints {
            farthest = farthest.max((s.joint_position[0] - lengths[0]).abs());
        }
        assert!(rig.worst_ratio() <= INSIDE, "seed {seed}");
    }
    assert!(farthest > 20.0, "no motion came near the reach: {farthest}");
}

/// Away from the path and back, at random, and the path is the same to the bit.
#[test]
fn at_random_away_and_back_the_path_is_the_same() {
    for seed in 0..sequences(40).div_ceil(8) {
        let frames = frames(seed + 1, 3, 300);
        let run = |jogs: bool| {
            let mut rig = Rig::playing(&frames);
            let mut numbers = Numbers::new(seed + 77);
            rig.run(numbers.whole(20, 250) as usize);
            rig.command(Command::Hold);
            assert!(rig.run_until(300, |s| s.state() == Ok(MachineState::Held)));
            rig.run(5);
            if jogs {
                play(&mut rig, &mut numbers, 100.0);
                rig.run(8_000);
            }
            // An abort was among it, and has ended the epoch.
            if !rig.last.unwrap().end_of_epoch.eq(&EndOfEpoch::Open) {
                return None;
            }
            rig.command(Command::JogOverride(1.0));
            rig.command(Command::Return);
            rig.run(2_500);
            assert_eq!(rig.state(), MachineState::Held, "seed {seed}");
            rig.command(Command::Resume);
            let from = rig.setpoints.len();
            assert!(rig.run_until(3_000, is_idle), "seed {seed}");
            assert!(rig.worst_ratio() <= INSIDE, "seed {seed}");
            let after = rig.setpoints[from..].iter();
            Some(
                after
                    .map(|s| s.position.map(f64::to_bits))
                    .collect::<Vec<_>>(),
            )
        };
        if let Some(jogged) = run(true) {
            assert_eq!(run(false), Some(jogged), "seed {seed}");
        }
    }
}
