//! The real-time thread's work, tick by tick, with a grid instead of a clock.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    clippy::float_cmp,
    clippy::unwrap_used,
    unreachable_pub,
    reason = "a test: numbers are small, bits are compared on purpose, failures are panics"
)]

use super::*;
use crate::message::Order;
use crate::testing::{Numbers, Rig, lines, mill, plan, records};
use glidepath_link::{Setpoint, SetpointMarks};
use proptest::prelude::*;

const INSIDE: f64 = 1.0 + 1e-6;

fn frames(seed: u64, axes: usize, ticks: usize) -> Vec<SetpointFrame> {
    records(
        &plan(seed, axes, ticks, &mill(), 0.004, AxisVector::zeros()),
        1,
        4_000_000,
    )
}

/// A rig with a whole plan still to be published.
fn rig(seed: u64, axes: usize, ticks: usize) -> (Rig, Vec<SetpointFrame>) {
    let mut rig = Rig::mill();
    let frames = frames(seed, axes, ticks);
    rig.feed.extend(&frames);
    (rig, frames)
}

fn is_idle(setpoint: &Setpoint) -> bool {
    setpoint.state() == Ok(MachineState::Idle)
}

#[test]
fn without_frames_the_machine_stands_where_it_is() {
    let mut config = Config::new(mill(), 4_000_000);
    config.start_position = AxisVector::repeat(12.5);
    let mut rig = Rig::new(config);
    for number in 0..5 {
        let setpoint = rig.tick();
        assert_eq!(setpoint.position, [12.5; 9]);
        assert_eq!(setpoint.velocity, [0.0; 9]);
        assert_eq!((setpoint.number, setpoint.tick), (number, number + 1));
        assert_eq!(setpoint.apply_ns - setpoint.scheduled_ns, 4_000_000);
        assert_eq!(setpoint.state(), Ok(MachineState::Idle));
    }
}

#[test]
fn at_full_rate_the_setpoints_are_the_frames_bit_for_bit() {
    let (mut rig, frames) = rig(5, 3, 400);
    assert!(rig.run_until(2_000, |s| s.epoch == 1 && is_idle(s)));
    let moving: Vec<_> = rig.setpoints.iter().filter(|s| s.epoch == 1).collect();
    let first = moving.iter().position(|s| s.sequence == 1).unwrap();
    for (setpoint, frame) in moving[first..].iter().zip(&frames[1..]) {
        assert_eq!(setpoint.sequence, frame.sequence);
        assert_eq!(
            setpoint.position.map(f64::to_bits),
            frame.position.map(f64::to_bits)
        );
        assert_eq!(
            setpoint.velocity.map(f64::to_bits),
            frame.velocity.map(f64::to_bits)
        );
        assert_eq!(
            setpoint.acceleration.map(f64::to_bits),
            frame.acceleration.map(f64::to_bits)
        );
        assert_eq!(setpoint.feed_v.to_bits(), frame.path_v.to_bits());
        assert_eq!(setpoint.path_s.to_bits(), frame.path_s.to_bits());
        assert_eq!((setpoint.line, setpoint.flags), (frame.line, frame.flags));
    }
    assert!(rig.setpoints.last().unwrap().sequence == frames.last().unwrap().sequence);
    assert_eq!(rig.last.unwrap().end_of_epoch, EndOfEpoch::Completed);
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn hold_stops_on_the_path_and_resume_goes_on_from_the_same_bits() {
    let frames = records(&lines(8, 3, 600, &mill(), 0.004), 1, 4_000_000);
    let mut rig = Rig::mill();
    rig.feed.extend(&frames);
    rig.run(100);
    rig.order(Order::Hold);
    assert!(rig.run_until(400, |s| s.state() == Ok(MachineState::Held)));
    let held = *rig.setpoints.last().unwrap();
    assert_eq!((held.velocity, held.acceleration), ([0.0; 9], [0.0; 9]));
    rig.run(50);
    let before = *rig.setpoints.last().unwrap();
    assert_eq!(
        before.position.map(f64::to_bits),
        held.position.map(f64::to_bits)
    );
    assert_eq!(
        (before.sequence, before.fraction),
        (held.sequence, held.fraction)
    );
    rig.order(Order::Resume);
    assert!(rig.run_until(3_000, is_idle));
    // Back at full rate it is back on the grid: the last setpoints are frames again.
    let end = rig
        .setpoints
        .iter()
        .position(|s| s.sequence == frames.len() as u64 - 1)
        .unwrap();
    for (setpoint, frame) in rig.setpoints[..=end]
        .iter()
        .rev()
        .zip(frames.iter().rev())
        .take(20)
    {
        assert_eq!(setpoint.position, frame.position);
        assert_eq!(setpoint.velocity, frame.velocity);
    }
    assert!(rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
}

#[test]
fn an_override_scales_time_and_zero_holds() {
    let (mut rig, _) = rig(2, 2, 600);
    rig.run(60);
    rig.order(Order::FeedOverride(0.5));
    assert!(rig.run_until(500, |s| (s.effective_override - 0.5).abs() < 1e-12));
    rig.run(20);
    let pair: Vec<_> = rig.setpoints.iter().rev().take(2).collect();
    let advanced =
        (pair[0].sequence - pair[1].sequence) as f64 + pair[0].fraction - pair[1].fraction;
    assert!((advanced - 0.5).abs() < 1e-9);
    rig.order(Order::FeedOverride(0.0));
    assert!(rig.run_until(500, |s| s.state() == Ok(MachineState::Held)));
    rig.order(Order::FeedOverride(1.5));
    assert!(rig.run_until(3_000, is_idle));
    assert!(rig.setpoints.iter().all(|s| s.effective_override <= 1.0));
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn a_planner_that_dies_leaves_the_machine_at_rest_on_the_path_with_the_cause() {
    let (mut rig, frames) = rig(4, 3, 600);
    rig.publish(200);
    for _ in 0..1_500 {
        rig.tick();
    }
    assert_eq!(rig.state(), MachineState::Faulted);
    let report = rig.last.unwrap();
    assert_eq!(report.fault.map(|f| f.cause), Some(FaultCause::PlannerLost));
    assert_eq!(report.end_of_epoch, EndOfEpoch::Faulted);
    assert!(rig.worst_ratio() <= INSIDE);
    assert!(
        rig.setpoints
            .iter()
            .any(|s| s.state() == Ok(MachineState::Starving))
    );
    assert!(
        rig.setpoints
            .iter()
            .any(|s| s.state() == Ok(MachineState::Starved))
    );
    // Another epoch needs a reset, and starts from here.
    let here = AxisVector::from(rig.setpoints.last().unwrap().position);
    assert!(here != AxisVector::from(frames[0].position));
    rig.order(Order::Reset);
    rig.tick();
    assert_eq!(rig.state(), MachineState::Idle);
    rig.feed = records(&plan(9, 2, 50, &mill(), 0.004, here), 2, 4_000_000).into();
    rig.run(5);
    assert!(rig.run_until(2_000, |s| s.epoch == 2 && is_idle(s)));
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn a_planner_that_comes_back_in_time_goes_on_from_where_the_machine_stands() {
    let (mut rig, _) = rig(4, 3, 600);
    rig.publish(200);
    let starved = |s: Setpoint| s.sequence > 0 && s.state() == Ok(MachineState::Starved);
    assert!((0..1_000).any(|_| starved(rig.tick())));
    let here = AxisVector::from(rig.setpoints.last().unwrap().position);
    rig.feed = records(&plan(6, 3, 80, &mill(), 0.004, here), 2, 4_000_000).into();
    assert!(rig.run_until(3_000, |s| s.epoch == 2 && is_idle(s)));
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn a_program_stop_rests_until_resume() {
    let period_ns = 4_000_000;
    let mut one = records(
        &plan(1, 2, 60, &mill(), 0.004, AxisVector::zeros()),
        1,
        period_ns,
    );
    let end = one.last_mut().unwrap();
    end.flags = FrameFlags::PROGRAM_STOP.0;
    let (stop, here) = (end.sequence, AxisVector::from(end.position));
    let mut two = records(&plan(2, 2, 60, &mill(), 0.004, here), 1, period_ns);
    for frame in &mut two {
        frame.sequence += stop;
        frame.flags &= FrameFlags::LAST.0;
    }
    let mut rig = Rig::mill();
    rig.feed.extend(one.iter().chain(&two[1..]));
    assert!(rig.run_until(1_000, |s| s.state() == Ok(MachineState::ProgramStop)));
    rig.run(30);
    let waiting = *rig.setpoints.last().unwrap();
    assert_eq!((waiting.sequence, waiting.position), (stop, here.into()));
    rig.order(Order::Resume);
    assert!(rig.run_until(1_000, is_idle));
    assert_eq!(
        rig.setpoints.last().unwrap().position,
        two.last().unwrap().position
    );
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn abort_ends_the_epoch_at_rest_and_drops_what_was_under_way() {
    let (mut rig, _) = rig(3, 3, 600);
    rig.run(120);
    rig.order(Order::Abort);
    assert!(rig.run_until(600, is_idle));
    assert_eq!(rig.last.unwrap().end_of_epoch, EndOfEpoch::Aborted);
    let here = rig.setpoints.last().unwrap().position;
    rig.run(50);
    assert_eq!(rig.state(), MachineState::Idle);
    assert_eq!(rig.setpoints.last().unwrap().position, here);
    assert!(rig.worst_ratio() <= INSIDE);
}

#[test]
fn each_event_is_published_once() {
    let (mut rig, frames) = rig(3, 1, 200);
    for frame in &mut rig.feed {
        frame.event_value = frame.sequence as f64;
        frame.event_kind = 1;
    }
    rig.run(40);
    rig.order(Order::Hold);
    rig.run(150);
    rig.order(Order::Resume);
    assert!(rig.run_until(3_000, is_idle));
    let events: Vec<_> = rig
        .setpoints
        .iter()
        .filter(|s| s.event_kind == 1)
        .map(|s| s.event_value as u64)
        .collect();
    assert_eq!(events, (0..frames.len() as u64).collect::<Vec<_>>());
}

#[test]
fn late_ticks_are_marked_and_missed_ones_do_not_move_program_time() {
    let (mut rig, frames) = rig(5, 2, 300);
    rig.run(40);
    let before = *rig.setpoints.last().unwrap();
    rig.publish(4);
    let late = rig.tick_late(0, 3_000_000);
    assert!(late.marks & SetpointMarks::LATE.0 != 0);
    assert_eq!(
        (late.sequence, late.tick),
        (before.sequence + 1, before.tick + 1)
    );
    let after = rig.tick_late(3, 0);
    assert!(after.marks & SetpointMarks::AFTER_MISSED.0 != 0);
    assert_eq!((after.number, after.missed_ticks), (late.number + 1, 3));
    assert_eq!(
        (after.sequence, after.tick),
        (late.sequence + 1, late.tick + 4)
    );
    assert_eq!(after.position, frames[after.sequence as usize].position);
}

#[test]
fn too_many_missed_ticks_stop_the_motion() {
    let mut config = Config::new(mill(), 4_000_000);
    config.missed_ticks_allowed = Some(3);
    let mut rig = Rig::new(config);
    rig.feed.extend(frames(5, 2, 600));
    rig.run(60);
    rig.tick_late(3, 0);
    assert_eq!(rig.state(), MachineState::Running);
    rig.tick_late(1, 0);
    assert!(rig.run_until(600, |s| s.state() == Ok(MachineState::Faulted)));
    assert_eq!(
        rig.last.unwrap().fault.map(|f| f.cause),
        Some(FaultCause::MissedTicks)
    );
    assert!(rig.worst_ratio() <= INSIDE);
}

proptest! {
    /// Whatever the pace of the planner, limits hold and the program is executed to its end.
    #[test]
    fn any_supply_of_frames_keeps_the_limits(
        seed in 0_u64..1_000_000, axes in 1_usize..5,
        bursts in prop::collection::vec((0_usize..120, 1_usize..150), 1..20),
    ) {
        let (mut rig, frames) = rig(seed, axes, 400);
        rig.interpolator.supply = Supply::new(&Config { planner_lost_after: None, ..rig.config });
        for (count, ticks) in bursts {
            rig.publish(count);
            for _ in 0..ticks {
                rig.tick();
            }
        }
        prop_assert!(rig.run_until(6_000, |s| s.epoch == 1 && is_idle(s)), "{:?}", rig.state());
        prop_assert_eq!(rig.setpoints.last().unwrap().position, frames.last().unwrap().position);
        let relaxed = rig.has_relaxed();
        prop_assert!(relaxed || rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
        prop_assert!(!relaxed || axes > 2, "limits relaxed with {axes} axes");
    }

    /// Any sequence of commands while the planner keeps up or dies.
    #[test]
    fn any_sequence_of_commands_keeps_the_limits(
        seed in 0_u64..1_000_000, axes in 1_usize..5, dies_after in 100_usize..1_500,
        commands in prop::collection::vec((0_u8..6, 1_usize..90), 1..15),
    ) {
        let (mut rig, _) = rig(seed, axes, 400);
        rig.feed.truncate(dies_after);
        let mut numbers = Numbers::new(seed);
        for (command, ticks) in commands {
            match command {
                0 | 1 => rig.order(Order::Hold),
                2 => rig.order(Order::Resume),
                3 => rig.order(Order::FeedOverride(numbers.unit() * 1.2)),
                4 => rig.order(Order::FeedOverride(1.0)),
                _ => if numbers.unit() < 0.2 { rig.order(Order::Abort) },
            }
            rig.run(ticks);
        }
        rig.order(Order::Resume);
        rig.order(Order::FeedOverride(1.0));
        // If it died where the plan rests, the machine waits there for more.
        let mut standing = 0;
        let ended = |s: &Setpoint| {
            standing = if s.state() == Ok(MachineState::Starved) { standing + 1 } else { 0 };
            matches!(s.state(), Ok(MachineState::Idle | MachineState::Faulted)) || standing > 1_000
        };
        prop_assert!(rig.run_until(8_000, ended), "{:?}", rig.state());
        prop_assert!(rig.state() != MachineState::Starved || rig.interpolator.supply.is_out());
        let relaxed = rig.has_relaxed();
        prop_assert!(relaxed || rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
        prop_assert!(!relaxed || axes > 2, "limits relaxed with {axes} axes");
    }
}

/// Publishes as a planner does: half a second ahead of what was executed.
fn publish_horizon(rig: &mut Rig, sent: &mut usize) {
    let executed = rig.interpolator.rate.now().time.sequence as usize;
    while *sent < executed + 125 && !rig.feed.is_empty() {
        rig.publish(1);
        *sent += 1;
    }
}

/// How long a hold takes to begin and to end. A figure for people; limits are checked too.
#[test]
fn holds_begin_soon() {
    for axes in [1, 2, 3, 5] {
        let (mut waits, mut stops) = (vec![], vec![]);
        for seed in 0..60 {
            let (mut rig, _) = rig(seed, axes, 700);
            let (mut sent, mut numbers) = (0, Numbers::new(seed));
            let moving = numbers.whole(1, 400);
            while rig.interpolator.rate.now().time.sequence < moving && rig.setpoints.len() < 3_000
            {
                publish_horizon(&mut rig, &mut sent);
                rig.tick();
            }
            rig.order(Order::Hold);
            let (mut wait, mut stop) = (0, 0);
            while rig.state() != MachineState::Held && rig.setpoints.len() < 3_000 {
                publish_horizon(&mut rig, &mut sent);
                let setpoint = rig.tick();
                wait += usize::from(setpoint.effective_override >= 1.0);
                stop += 1;
            }
            waits.push(wait);
            stops.push(stop);
            assert!(rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
        }
        waits.sort_unstable();
        stops.sort_unstable();
        let at = |v: &[usize], percent: usize| v[(v.len() - 1) * percent / 100];
        println!(
            "{axes} axes: hold begins after {} / {} / {} ticks, rest after {} / {} / {} (median, 90 %, most)",
            at(&waits, 50),
            at(&waits, 90),
            at(&waits, 100),
            at(&stops, 50),
            at(&stops, 90),
            at(&stops, 100),
        );
    }
}

/// The planner dies at any place of a plan that is at its limits: there is always a stop. With more
/// axes that are at their limits independently of each other, which no path asks for, there need not
/// be one; then it is said that limits were relaxed.
#[test]
fn there_is_always_a_stop_in_reserve() {
    for axes in 1..=6 {
        let mut relaxed = 0;
        for seed in 0..60 {
            let (mut rig, frames) = rig(seed, axes, 500);
            rig.feed
                .truncate(Numbers::new(seed).whole(150, 450) as usize);
            let mut sent = 0;
            for _ in 0..1_200 {
                publish_horizon(&mut rig, &mut sent);
                rig.tick();
            }
            let last = rig.setpoints.last().unwrap();
            assert!(last.sequence > 0 && last.sequence < frames.len() as u64);
            assert!(last.velocity.iter().all(|v| v.abs() < 1e-9));
            let ratio = rig.worst_ratio();
            if rig.has_relaxed() {
                relaxed += 1;
            } else {
                assert!(ratio <= INSIDE, "{axes} axes, seed {seed}: {ratio}");
            }
        }
        println!("{axes} axes: limits relaxed for {relaxed} of 60 stops");
        assert!(relaxed == 0 || axes > 2);
    }
}

/// While the planner keeps its horizon, planned time is run time, to the tick.
#[test]
fn a_healthy_supply_is_never_slowed_down() {
    for seed in 0..100 {
        let mut rig = Rig::mill();
        let frames = records(&lines(seed, 3, 600, &mill(), 0.004), 1, 4_000_000);
        rig.feed.extend(&frames);
        let mut sent = 0;
        for _ in 0..frames.len() + 100 {
            publish_horizon(&mut rig, &mut sent);
            rig.tick();
        }
        let at = |sequence| {
            rig.setpoints
                .iter()
                .position(|s| s.sequence == sequence)
                .unwrap()
        };
        let last = frames.len() - 1;
        assert_eq!(at(last as u64) - at(1), last - 1, "seed {seed}");
    }
}

/// A program that begins with a dwell, from a planner that is slow to start.
#[test]
fn motion_starts_once_and_is_not_held_up_again() {
    let motion = lines(4, 3, 300, &mill(), 0.004);
    let mut frames = vec![motion[0]; 5];
    frames.extend(motion);
    for (sequence, frame) in frames.iter_mut().enumerate() {
        frame.sequence = sequence as u64;
        frame.flags = FrameFlags(frame.flags.0 & !FrameFlags::FIRST.0);
    }
    frames[0].flags = FrameFlags::FIRST;
    let mut rig = Rig::mill();
    rig.feed.extend(records(&frames, 1, 4_000_000));
    for _ in 0..frames.len() + 200 {
        rig.publish(3);
        rig.tick();
    }
    let at = |sequence| {
        rig.setpoints
            .iter()
            .position(|s| s.sequence == sequence)
            .unwrap()
    };
    let last = frames.len() - 1;
    assert_eq!(at(last as u64) - at(1), last - 1);
}
