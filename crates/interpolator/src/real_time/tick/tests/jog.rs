//! Tests of moving by hand.

use super::*;
use crate::shared::config::SoftLimits;
use glidepath_link::{JogDemand, JogMode};
use glidepath_program::Limits;

/// Travel of the machine that is jogged, mm.
const TRAVEL: f64 = 50.0;

/// A client that keeps an owner's key.
pub(super) struct Hand {
    pub(super) demand: JogDemand,
}

impl Hand {
    pub(super) fn new(client: u64) -> Self {
        let demand = JogDemand {
            client,
            mask: 0b111,
            ..bytemuck::Zeroable::zeroed()
        };
        Self { demand }
    }

    /// Asks for something new.
    pub(super) fn ask(&mut self, rig: &mut Rig, mode: JogMode, value: [f64; 3]) {
        self.demand.number += 1;
        self.demand.mode = mode.code();
        self.demand.value[..3].copy_from_slice(&value);
        self.again(rig);
    }

    /// Says that it lives.
    pub(super) fn again(&mut self, rig: &mut Rig) {
        self.demand.sent_ns = rig.now_ns();
        rig.jog(&self.demand);
    }

    /// A key that is held down for so many ticks, and repeats every eight.
    pub(super) fn hold(&mut self, rig: &mut Rig, ticks: usize, velocity: [f64; 3]) {
        self.ask(rig, JogMode::Continuous, velocity);
        for tick in 1..=ticks {
            rig.tick();
            if tick % 8 == 0 {
                self.again(rig);
            }
        }
    }
}

/// A machine of three axes with travel.
pub(super) fn jogged() -> Rig {
    let mut config = Config::new(three_axes(), 4_000_000);
    config.soft_limits = SoftLimits {
        lowest: AxisVector::repeat(-TRAVEL),
        highest: AxisVector::repeat(TRAVEL),
    };
    Rig::new(config)
}

pub(super) fn three_axes() -> Limits {
    let mut limits = mill();
    for axis in 3..9 {
        limits.velocity[axis] = Limits::UNLIMITED;
        limits.acceleration[axis] = Limits::UNLIMITED;
        limits.jerk[axis] = Limits::UNLIMITED;
    }
    limits
}

fn x(rig: &Rig) -> f64 {
    rig.setpoints.last().unwrap().position[0]
}

/// Ticks until a state, without new frames.
pub(super) fn settle(rig: &mut Rig, state: MachineState) {
    assert!(
        rig.run_until(2_000, |s| s.state() == Ok(state)),
        "{:?}",
        rig.state()
    );
    rig.run(3);
}

#[test]
fn the_first_setpoint_moves_in_the_tick_that_sees_the_demand() {
    let mut rig = jogged();
    rig.run(5);
    Hand::new(1).ask(&mut rig, JogMode::Continuous, [50.0, 0.0, 0.0]);
    let setpoint = rig.tick();
    assert!(setpoint.position[0] > 0.0);
    assert_eq!(setpoint.state(), Ok(MachineState::Jogging));
    assert!(setpoint.state().unwrap().is_moving());
}

#[test]
fn a_key_that_is_released_or_lost_stops_the_motion_within_the_bound() {
    for lets_go in [true, false] {
        let mut rig = jogged();
        let mut hand = Hand::new(1);
        hand.hold(&mut rig, 50, [50.0, 0.0, 0.0]);
        let (before, last_sent) = (x(&rig), hand.demand.sent_ns);
        assert!((rig.setpoints.last().unwrap().velocity[0] - 50.0).abs() < 1e-9);
        if lets_go {
            hand.ask(&mut rig, JogMode::None, [0.0; 3]);
        }
        settle(&mut rig, MachineState::Idle);
        // d = v sqrt(v / J) of a stop from 50 mm/s, and two periods.
        let stop = 1.767_767;
        let held_t = if lets_go { 0.0 } else { 0.15 };
        let lost_t = held_t - (rig_time(50, &rig) - last_sent) as f64 * 1e-9;
        let bound = 50.0 * (lost_t.max(0.0) + 0.008) + stop + 1e-6;
        assert!(x(&rig) - before <= bound, "{} {bound}", x(&rig) - before);
        assert!(x(&rig) - before >= stop - 1e-6);
        assert!(rig.worst_ratio() <= INSIDE);
    }
}

/// When the tick of a number was due.
fn rig_time(number: usize, rig: &Rig) -> u64 {
    rig.setpoints[number - 1].scheduled_ns
}

#[test]
fn a_step_ends_where_it_should_and_is_done_once() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.ask(&mut rig, JogMode::Incremental, [10.0, 0.0, -2.5]);
    for _ in 0..30 {
        rig.run(8);
        hand.again(&mut rig);
    }
    settle(&mut rig, MachineState::Idle);
    let end = rig.setpoints.last().unwrap().position;
    assert_eq!(end[..3], [10.0, 0.0, -2.5]);
    // On the straight line.
    for setpoint in &rig.setpoints {
        let [x, _, z, ..] = setpoint.position;
        assert!((z + 0.25 * x).abs() < 1e-12, "{x} {z}");
    }
    // Nothing is pressed for a second: it goes on without a jog time-out.
    hand.ask(&mut rig, JogMode::Incremental, [20.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    assert_eq!(x(&rig), 30.0);
    hand.ask(&mut rig, JogMode::Incremental, [-20.0, 0.0, 0.0]);
    rig.run(10);
    rig.command(Command::Hold);
    settle(&mut rig, MachineState::Idle);
    assert!(x(&rig) > 20.0 && x(&rig) < 30.0, "{}", x(&rig));
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn steps_add_up() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    for _ in 0..3 {
        hand.ask(&mut rig, JogMode::Incremental, [5.0, 0.0, 0.0]);
        rig.run(12);
    }
    // A step of another axis leaves the first its place, and a step back is taken off.
    hand.ask(&mut rig, JogMode::Incremental, [0.0, 2.0, 0.0]);
    rig.run(12);
    hand.ask(&mut rig, JogMode::Incremental, [-4.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    let end = rig.setpoints.last().unwrap().position;
    assert_eq!(end[..3], [11.0, 2.0, 0.0]);
    // One that was let go of is over: the next counts from where the axes rest.
    hand.ask(&mut rig, JogMode::Incremental, [-20.0, 0.0, 0.0]);
    rig.run(12);
    hand.ask(&mut rig, JogMode::None, [0.0; 3]);
    settle(&mut rig, MachineState::Idle);
    let rest = x(&rig);
    assert!(rest > -8.0, "{rest}");
    hand.ask(&mut rig, JogMode::Incremental, [1.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    assert!((x(&rig) - rest - 1.0).abs() < 1e-12);
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn an_axis_at_its_end_keeps_no_other_from_its_step_and_steps_beyond_are_not_kept() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.ask(&mut rig, JogMode::Incremental, [30.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    for _ in 0..3 {
        hand.ask(&mut rig, JogMode::Incremental, [30.0, 10.0, -5.0]);
        rig.run(5);
    }
    settle(&mut rig, MachineState::Idle);
    let end = rig.setpoints.last().unwrap().position;
    assert_eq!(end[..3], [TRAVEL, 30.0, -15.0]);
    // What lay beyond is not to be stepped back first.
    hand.ask(&mut rig, JogMode::Incremental, [30.0, 0.0, 0.0]);
    rig.run(2);
    hand.ask(&mut rig, JogMode::Incremental, [-7.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    assert_eq!(x(&rig), TRAVEL - 7.0);
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn a_speed_asked_for_is_kept_and_so_is_the_override() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.demand.velocity_v = 10.0;
    hand.ask(&mut rig, JogMode::Incremental, [10.0, 10.0, 0.0]);
    rig.command(Command::JogOverride(0.5));
    settle(&mut rig, MachineState::Idle);
    let fastest = rig
        .setpoints
        .iter()
        .map(|s| AxisVector::from(s.velocity).norm());
    let fastest = fastest.fold(0.0, f64::max);
    assert!((fastest - 5.0).abs() < 1e-9, "{fastest}");
    // Nothing moves at 0; at 1 it goes on, as it is still wanted.
    rig.command(Command::JogOverride(0.0));
    hand.hold(&mut rig, 20, [50.0, 0.0, 0.0]);
    assert_eq!(x(&rig), 10.0);
    rig.command(Command::JogOverride(1.0));
    hand.again(&mut rig);
    rig.run(20);
    assert!(x(&rig) > 10.5);
}

#[test]
fn a_jog_ends_at_the_end_of_travel_and_only_leads_back_from_beyond() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.hold(&mut rig, 300, [150.0, 75.0, 0.0]);
    assert!((x(&rig) - TRAVEL).abs() < 1e-9, "{}", x(&rig));
    // Along the line up to there; then the other axis goes on by itself, to its own end.
    let is_on_line = |s: &&Setpoint| (s.position[1] - 0.5 * s.position[0]).abs() < 1e-9;
    let on_line = rig.setpoints.iter().rfind(is_on_line).unwrap();
    assert!((on_line.position[0] - TRAVEL).abs() < 1e-9);
    assert!((rig.setpoints.last().unwrap().position[1] - TRAVEL).abs() < 1e-9);
    assert_eq!(rig.state(), MachineState::Jogging);
    rig.run(60);
    assert_eq!(rig.state(), MachineState::Idle);
    assert!(rig.worst_ratio() <= INSIDE);

    let mut config = rig.config;
    config.start_position[0] = 60.0;
    let mut rig = Rig::new(config);
    hand.hold(&mut rig, 50, [150.0, 0.0, 0.0]);
    assert_eq!(x(&rig), 60.0);
    hand.ask(&mut rig, JogMode::None, [0.0; 3]);
    rig.run(5);
    hand.ask(&mut rig, JogMode::Incremental, [-5.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    assert_eq!(x(&rig), 55.0);
    hand.ask(&mut rig, JogMode::Incremental, [4.0, 0.0, 0.0]);
    rig.run(100);
    assert_eq!(x(&rig), 55.0);
}

#[test]
fn a_wheel_is_followed_to_and_fro() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.demand.scale = 0.1;
    // What it had counted before means nothing.
    hand.ask(&mut rig, JogMode::Wheel, [1_000.0, 0.0, 0.0]);
    rig.run(10);
    assert_eq!((x(&rig), rig.state()), (0.0, MachineState::Idle));
    for (counts, turns) in [(1_001.0, 0), (1_025.0, 3), (1_010.0, 5), (990.0, 1)] {
        hand.ask(&mut rig, JogMode::Wheel, [counts, 0.0, 0.0]);
        rig.run(turns);
    }
    settle(&mut rig, MachineState::Idle);
    assert!((x(&rig) + 1.0).abs() < 1e-9, "{}", x(&rig));
    assert!(rig.worst_ratio() <= INSIDE);
    // Turned faster than the axis can follow, what is too much is dropped: 15 mm from 200 mm/s.
    hand.ask(&mut rig, JogMode::Wheel, [990.0 + 500.0, 0.0, 0.0]);
    settle(&mut rig, MachineState::Idle);
    assert!((x(&rig) - 14.0).abs() < 1e-6, "{}", x(&rig));
}

#[test]
fn a_wheel_that_gives_a_velocity_stops_when_it_does() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.demand.scale = 0.1;
    let mut counts = 0.0;
    for _ in 0..40 {
        // A millimetre in ten ticks is 25 mm/s.
        hand.ask(&mut rig, JogMode::WheelVelocity, [counts, 0.0, 0.0]);
        rig.run(10);
        counts += 10.0;
    }
    let speed = rig.setpoints.last().unwrap().velocity[0];
    assert!((speed - 25.0).abs() < 1e-9, "{speed}");
    let before = x(&rig);
    for _ in 0..10 {
        hand.again(&mut rig);
        rig.run(10);
    }
    settle(&mut rig, MachineState::Idle);
    assert!(
        x(&rig) - before < 25.0 * 0.108 + 0.7,
        "{}",
        x(&rig) - before
    );
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn a_wheel_with_a_wrong_clock_is_not_taken_for_a_fast_one() {
    let mut rig = jogged();
    let mut hand = Hand::new(1);
    hand.demand.scale = 0.1;
    for turn in 0..40 {
        hand.ask(
            &mut rig,
            JogMode::WheelVelocity,
            [10.0 * f64::from(turn), 0.0, 0.0],
        );
        if turn == 20 {
            // Once it says that it is tomorrow.
            let sent_ns = hand.demand.sent_ns;
            hand.demand.sent_ns += 86_400_000_000_000;
            rig.jog(&hand.demand);
            hand.demand.sent_ns = sent_ns;
        }
        rig.run(10);
        let speed = rig.setpoints.last().unwrap().velocity[0];
        // Heard of up to a tick late, which makes 40 ms 36.
        assert!(speed < 28.0, "turn {turn}: {speed} mm/s");
    }
    settle(&mut rig, MachineState::Idle);
}

#[test]
fn only_the_first_client_moves_the_axes_until_they_rest() {
    let mut rig = jogged();
    let (mut one, mut other) = (Hand::new(1), Hand::new(2));
    one.hold(&mut rig, 20, [20.0, 0.0, 0.0]);
    other.ask(&mut rig, JogMode::Continuous, [-100.0, 0.0, 0.0]);
    one.again(&mut rig);
    rig.run(10);
    assert!(rig.setpoints.iter().all(|s| s.velocity[0] >= 0.0));
    one.ask(&mut rig, JogMode::None, [0.0; 3]);
    settle(&mut rig, MachineState::Idle);
    other.ask(&mut rig, JogMode::Continuous, [-100.0, 0.0, 0.0]);
    rig.run(10);
    assert!(rig.setpoints.last().unwrap().velocity[0] < 0.0);
}

#[test]
fn what_was_demanded_before_a_stop_and_is_heard_with_it_moves_nothing() {
    let (mut rig, mut hand) = (jogged(), Hand::new(1));
    rig.tick();
    for stop in [Command::Hold, Command::Abort, Command::Hold] {
        // Both wait for the same tick, which takes orders first.
        hand.ask(&mut rig, JogMode::Incremental, [5.0, 0.0, 0.0]);
        rig.command(stop);
        let before = x(&rig);
        for _ in 0..50 {
            rig.tick();
        }
        assert_eq!(x(&rig).to_bits(), before.to_bits(), "{stop:?}");
        rig.command(stop);
        hand.ask(&mut rig, JogMode::Incremental, [5.0, 0.0, 0.0]);
        rig.tick();
        assert!(x(&rig) > before, "{stop:?}");
        settle(&mut rig, MachineState::Idle);
    }
}

#[test]
fn a_key_that_was_down_before_or_comes_late_starts_nothing() {
    let (mut rig, _) = rig(5, 3, 200);
    let mut hand = Hand::new(1);
    rig.run(20);
    hand.ask(&mut rig, JogMode::Continuous, [20.0, 0.0, 0.0]);
    // Held down through the program and after its end.
    for _ in 0..60 {
        rig.run(5);
        hand.again(&mut rig);
    }
    assert_eq!(rig.state(), MachineState::Idle);
    let end = x(&rig);
    // One that was on its way for too long.
    let mut late = Hand::new(2);
    late.demand.number = 1;
    late.demand.mode = JogMode::Incremental.code();
    late.demand.value[0] = 5.0;
    late.demand.sent_ns = rig.now_ns() - 150_000_000;
    rig.jog(&late.demand);
    rig.run(10);
    assert_eq!((x(&rig), rig.state()), (end, MachineState::Idle));
    // Let go, it may be pressed again.
    hand.ask(&mut rig, JogMode::None, [0.0; 3]);
    hand.hold(&mut rig, 8, [20.0, 0.0, 0.0]);
    assert!(x(&rig) > end);
}
