//! Tests of a rapid override of 0: no rapid begins.

use super::planned::{planned, program};
use super::*;
use glidepath_geometry::Segment;
use glidepath_program::{Effort, Item, ItemKind, PathMode, Rate as Speed};

/// Plays until the machine is held and has stood for some ticks, or the program ends; returns whether
/// it is held.
fn is_held(rig: &mut Rig) -> bool {
    for _ in 0..60_000 {
        rig.publish_horizon();
        let setpoint = rig.tick();
        match setpoint.state() {
            Ok(MachineState::Held) => {
                for _ in 0..20 {
                    rig.publish_horizon();
                    let later = rig.tick();
                    assert_eq!(later.state(), Ok(MachineState::Held));
                    assert_eq!(later.position, setpoint.position);
                }
                return true;
            }
            Ok(MachineState::Idle) if setpoint.epoch > 0 => return false,
            _ => {}
        }
    }
    panic!("{:?}", rig.state());
}

/// The frames behind which a rapid begins.
fn fronts(frames: &[SetpointFrame]) -> Vec<u64> {
    let is_rapid = |frame: &SetpointFrame| frame.has(FrameFlags::RAPID);
    let pairs = frames.windows(2);
    let fronts = pairs.filter(|pair| !is_rapid(&pair[0]) && is_rapid(&pair[1]));
    fronts.map(|pair| pair[0].sequence).collect()
}

fn assert_stands_at(rig: &Rig, frame: &SetpointFrame) {
    let setpoint = rig.setpoints.last().unwrap();
    assert_eq!(
        (setpoint.sequence, setpoint.fraction),
        (frame.sequence, 0.0)
    );
    assert_eq!(setpoint.position, frame.position);
}

/// The motion comes to rest in front of the first rapid, whatever the feed override, and goes on to the
/// end of the program once rapids may go.
#[test]
fn the_first_rapid_does_not_begin() {
    for (seed, effort) in (0..30).flat_map(|seed| [(seed, Effort::Fast), (seed, Effort::Optimal)]) {
        let frames = program(seed, 25, effort);
        let fronts = fronts(&frames);
        for feed in [1.0, 0.37] {
            let mut rig = Rig::playing(&frames);
            rig.command(Command::RapidOverride(0.0));
            rig.command(Command::FeedOverride(feed));
            assert_eq!(
                is_held(&mut rig),
                !fronts.is_empty(),
                "{seed} {effort:?} {feed}"
            );
            let Some(front) = fronts.first() else {
                continue;
            };
            assert_stands_at(&rig, &frames[*front as usize]);
            rig.command(Command::RapidOverride(1.0));
            assert!(!is_held(&mut rig), "{seed} {effort:?} {feed}");
            let ratio = rig.worst_ratio();
            assert!(ratio <= INSIDE, "{seed} {effort:?} {feed}: {ratio}");
            assert_eq!(rig.last.unwrap().end_of_epoch, EndOfEpoch::Completed);
        }
    }
}

/// Feeds of some length, with a rapid behind each, that blend, rest, or dwell between.
fn feeds_and_rapids(seed: u64) -> Vec<SetpointFrame> {
    let mut numbers = Numbers::new(seed);
    let mut items = Vec::new();
    let mut at = AxisVector::zeros();
    for line in 1..=24_u32 {
        let mut to = at;
        to[0] += 30.0 + 20.0 * numbers.unit();
        to[1] += 40.0 * (numbers.unit() - 0.5);
        let mode = match numbers.unit() {
            part if part < 0.3 => PathMode::ExactStop,
            _ => PathMode::Continuous { tolerance_mm: None },
        };
        let rate = if line % 2 == 0 {
            Speed::Rapid
        } else {
            Speed::Feed(20.0 + 40.0 * numbers.unit())
        };
        let segment = Segment::line(at, to);
        let (block, kind) = (
            line,
            ItemKind::Move {
                segment,
                rate,
                mode,
            },
        );
        items.push(Item { block, line, kind });
        at = to;
    }
    planned(&items, Effort::Fast)
}

/// Every rapid is waited for, in single block, too; after a step there the rapid still does not begin.
#[test]
fn no_rapid_begins_where_each_is_let_go_alone() {
    for seed in 0..20 {
        let frames = feeds_and_rapids(seed);
        let fronts = fronts(&frames);
        assert_eq!(fronts.len(), 12);
        let mut rig = Rig::playing(&frames);
        rig.command(Command::RapidOverride(0.0));
        for (place, front) in fronts.iter().enumerate() {
            assert!(is_held(&mut rig), "{seed} {place}");
            assert_stands_at(&rig, &frames[*front as usize]);
            rig.command(Command::RapidOverride(1.0));
            let is_behind = |s: &Setpoint| {
                let here = &frames[s.sequence as usize];
                s.sequence > *front && !here.has(FrameFlags::RAPID)
            };
            for _ in 0..5_000 {
                rig.publish_horizon();
                let setpoint = rig.tick();
                if setpoint.state() == Ok(MachineState::Idle) || is_behind(&setpoint) {
                    break;
                }
            }
            rig.command(Command::RapidOverride(0.0));
        }
        assert!(!is_held(&mut rig), "{seed}");
        assert!(rig.worst_ratio() <= INSIDE, "{seed}");
    }
}

/// A single block that ends in front of a rapid is left by a step; the rapid does not begin before
/// rapids may go.
#[test]
fn a_step_does_not_begin_a_rapid() {
    let frames = feeds_and_rapids(1);
    let front = fronts(&frames)[0];
    let mut rig = Rig::playing(&frames);
    rig.command(Command::RapidOverride(0.0));
    rig.command(Command::SingleBlock(true));
    for _ in 0..5_000 {
        rig.publish_horizon();
        if rig.tick().state() == Ok(MachineState::ProgramStop) {
            break;
        }
    }
    assert_stands_at(&rig, &frames[front as usize]);
    rig.command(Command::Step);
    assert!(is_held(&mut rig));
    assert_stands_at(&rig, &frames[front as usize]);
    rig.command(Command::RapidOverride(1.0));
    for _ in 0..5_000 {
        rig.publish_horizon();
        if rig.tick().state() == Ok(MachineState::ProgramStop) {
            break;
        }
    }
    assert!(rig.setpoints.last().unwrap().sequence > front);
}
