//! Tests of the real-time thread's work, tick by tick, with a grid instead of a clock.

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

mod block_ends;
mod commands;
mod compensation;
mod cross_compensation;
mod end_of_travel;
mod jog;
mod jog_in_a_hold;
mod jog_random;
mod planned;
mod queue_level;
mod rapid_override;
mod retracing;
mod tap_by_axis;

use super::*;
use crate::shared::config::Config;
use crate::testing::{Numbers, Rig, happens, lines, mill, plan, random_cases, records};
use glidepath_geometry::AxisVector;
use glidepath_link::SetpointFrame;
use glidepath_link::{Command, EndOfEpoch, EventRecord, MachineState, SetpointMarks};
use glidepath_program::{Event, FrameFlags};
use proptest::prelude::*;

const INSIDE: f64 = 1.0 + 1e-6;

/// How many random cases a test runs, unless the environment says otherwise.
fn cases(usual: u32) -> ProptestConfig {
    ProptestConfig::with_cases(random_cases(usual))
}

fn frames(seed: u64, axes: usize, ticks: usize) -> Vec<SetpointFrame> {
    records(
        &plan(seed, axes, ticks, &mill(), 0.004, AxisVector::zeros()),
        1,
        4_000_000,
    )
}

/// A rig with a whole plan still to be published.
fn rig(seed: u64, axes: usize, ticks: usize) -> (Rig, Vec<SetpointFrame>) {
    let frames = frames(seed, axes, ticks);
    (Rig::playing(&frames), frames)
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
    let told = rig.last.unwrap().fault.map(|fault| fault.to_string());
    let told = told.unwrap_or_default();
    assert!(
        told.contains("4 within a second, where 3 are allowed"),
        "{told}"
    );
    assert!(rig.worst_ratio() <= INSIDE);
}
