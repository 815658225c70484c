//! Tests of single block, stop at the end of the block, and steps.

use super::planned::{planned, program};
use super::*;
use glidepath_geometry::{Arc, Plane, Segment};
use glidepath_program::{Effort, Item, ItemKind, PathMode, Rate as Speed};

/// Plays a program in single-block mode, going on by `command` wherever it has stood for some
/// ticks; returns where.
fn stands(rig: &mut Rig, command: Command, waits: u64) -> Vec<u64> {
    let mut stands = vec![];
    for _ in 0..60_000 {
        rig.publish_horizon();
        let setpoint = rig.tick();
        match setpoint.state() {
            Ok(MachineState::ProgramStop) => {
                let sequence = setpoint.sequence;
                if stands.last() != Some(&sequence) {
                    stands.push(sequence);
                    play(rig, waits);
                    rig.command(command);
                }
            }
            Ok(MachineState::Idle) if setpoint.epoch > 0 => return stands,
            _ => {}
        }
    }
    panic!("{:?} after {stands:?}", rig.state());
}

/// The last frames of all blocks but the last.
fn ends(frames: &[SetpointFrame]) -> Vec<u64> {
    let pairs = frames.windows(2);
    let last = pairs.filter(|pair| pair[0].line > 0 && pair[0].line != pair[1].line);
    last.map(|pair| pair[0].sequence).collect()
}

/// Wherever the motion stood it was on a frame, and at rate 1 every setpoint is a frame.
fn assert_bits(rig: &Rig, frames: &[SetpointFrame], stands: &[u64]) {
    let bits = |p: [f64; 9]| p.map(f64::to_bits);
    for setpoint in rig.setpoints.iter().filter(|s| s.epoch == 1) {
        let frame = &frames[setpoint.sequence as usize];
        let is_on_grid = setpoint.fraction == 0.0;
        if is_on_grid && (setpoint.effective_override >= 1.0 || stands.contains(&frame.sequence)) {
            assert_eq!(bits(setpoint.position), bits(frame.position));
        }
    }
}

/// Plays on to the end.
fn play_on(rig: &mut Rig) {
    for _ in 0..20_000 {
        rig.publish_horizon();
        if is_idle(&rig.tick()) {
            return;
        }
    }
    panic!("{:?}", rig.state());
}

/// Plays until a state.
fn play_until(rig: &mut Rig, state: MachineState) {
    for _ in 0..3_000 {
        rig.publish_horizon();
        if rig.tick().state() == Ok(state) {
            return;
        }
    }
    panic!("{:?}, not {state:?}", rig.state());
}

/// Plays some ticks.
fn play(rig: &mut Rig, ticks: u64) {
    for _ in 0..ticks {
        rig.publish_horizon();
        rig.tick();
    }
}

#[test]
fn single_block_rests_at_the_end_of_every_block() {
    for seed in 0..20 {
        let frames = program(seed, 30, Effort::Fast);
        for command in [Command::Resume, Command::Step] {
            let mut rig = Rig::playing(&frames);
            rig.command(Command::SingleBlock(true));
            let stands = stands(&mut rig, command, 0);
            assert_eq!(stands, ends(&frames), "seed {seed}");
            assert_bits(&rig, &frames, &stands);
            let ratio = rig.worst_ratio();
            assert!(ratio <= INSIDE, "seed {seed}: {ratio}");
            assert_eq!(rig.last.unwrap().end_of_epoch, EndOfEpoch::Completed);
        }
    }
}

/// Lines that an arc leads from one to the other, and a dwell behind them, planned in windows.
#[test]
fn single_block_rests_where_the_plan_rests() {
    let at = |x, y, z| {
        let mut at = AxisVector::zeros();
        (at[0], at[1], at[2]) = (x, y, z);
        at
    };
    let arc = Arc {
        start: at(40.0, 10.0, 1.0),
        end: at(50.0, 20.0, 1.0),
        plane: Plane::Xy,
        center: [40.0, 20.0],
        sweep_rad: core::f64::consts::FRAC_PI_2,
    };
    let along = |segment, rate| ItemKind::Move {
        segment,
        rate,
        mode: PathMode::Continuous { tolerance_mm: None },
    };
    let (feed, corner) = (Speed::Feed(100.0), at(50.0, 40.0, 0.0));
    let kinds = [
        along(
            Segment::line(at(0.0, 0.0, 0.0), at(10.0, 10.0, 1.0)),
            Speed::Rapid,
        ),
        along(Segment::line(at(10.0, 10.0, 1.0), arc.start), feed),
        along(Segment::Arc(arc), feed),
        along(Segment::line(arc.end, corner), feed),
        ItemKind::Dwell(0.05),
        along(Segment::line(corner, at(30.0, 35.0, 0.0)), feed),
    ];
    let items = (1..).zip(kinds).map(|(line, kind)| Item {
        block: 0,
        line,
        kind,
    });
    let items: Vec<_> = items.collect();
    for effort in [Effort::Fast, Effort::Optimal] {
        let frames = planned(&items, effort);
        for command in [Command::Resume, Command::Step] {
            let mut rig = Rig::playing(&frames);
            rig.command(Command::SingleBlock(true));
            let stands = stands(&mut rig, command, 100);
            assert_eq!(stands, ends(&frames), "{effort:?}");
            assert_bits(&rig, &frames, &stands);
        }
    }
}

#[test]
fn a_stop_at_the_end_of_the_block_is_made_once_and_anywhere() {
    for seed in 0..60 {
        let frames = program(seed, 30, Effort::Fast);
        let ends = ends(&frames);
        let mut rig = Rig::playing(&frames);
        play(
            &mut rig,
            Numbers::new(seed).whole(20, frames.len() as u64 / 2),
        );
        let ordered_at = rig.setpoints.last().unwrap().sequence;
        rig.command(Command::StopAtEndOfBlock);
        play_until(&mut rig, MachineState::ProgramStop);
        let stood_at = rig.setpoints.last().unwrap().sequence;
        assert!(
            stood_at >= ordered_at && ends.contains(&stood_at),
            "seed {seed}: {stood_at}"
        );
        play(&mut rig, 700);
        let waiting = *rig.setpoints.last().unwrap();
        assert_eq!((waiting.sequence, waiting.fraction), (stood_at, 0.0));
        assert_eq!(
            waiting.state(),
            Ok(MachineState::ProgramStop),
            "no fault while it waits"
        );
        rig.command(Command::Resume);
        play_on(&mut rig);
        assert_bits(&rig, &frames, &[stood_at]);
        assert!(
            rig.worst_ratio() <= INSIDE,
            "seed {seed}: {}",
            rig.worst_ratio()
        );
    }
}

/// Frames.
const NEAR: u64 = 9;

#[test]
fn a_step_from_a_hold_goes_to_the_end_of_the_block_and_single_block_can_be_left() {
    for seed in 0..20 {
        let frames = program(seed, 30, Effort::Fast);
        let mut rig = Rig::playing(&frames);
        play(&mut rig, 60);
        rig.command(Command::Hold);
        play_until(&mut rig, MachineState::Held);
        let held_at = rig.setpoints.last().unwrap().sequence;
        rig.command(Command::Step);
        play_until(&mut rig, MachineState::ProgramStop);
        // From a few frames before the end of a block there may be no way to rest just there.
        let end = rig.setpoints.last().unwrap().sequence;
        let mut ends = ends(&frames).into_iter().filter(|end| *end > held_at);
        let passed = ends.find(|passed| *passed >= end || *passed > held_at + NEAR);
        assert_eq!(passed, Some(end), "seed {seed}: held at {held_at}");
        rig.command(Command::SingleBlock(true));
        rig.command(Command::Resume);
        play(&mut rig, 3);
        // Also where it is on its way to rest already.
        rig.command(Command::SingleBlock(false));
        play_on(&mut rig);
        assert_bits(&rig, &frames, &[end]);
        assert!(
            rig.worst_ratio() <= INSIDE,
            "seed {seed}: {}",
            rig.worst_ratio()
        );
    }
}

#[test]
fn a_hold_comes_before_the_end_of_the_block() {
    let frames = records(&lines(8, 3, 600, &mill(), 0.004), 1, 4_000_000);
    let mut rig = Rig::playing(&frames);
    play(&mut rig, 100);
    rig.command(Command::StopAtEndOfBlock);
    play(&mut rig, 1);
    rig.command(Command::Hold);
    play_until(&mut rig, MachineState::Held);
    rig.command(Command::Abort);
    play_on(&mut rig);
    assert_eq!(rig.last.unwrap().end_of_epoch, EndOfEpoch::Aborted);
    assert!(rig.worst_ratio() <= INSIDE);
}
