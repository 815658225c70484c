//! Tests of commands and supply with motion as the planner makes it: polylines with rounded
//! corners, arcs' worth of short chords, exact stops, dwells.

use super::*;
use glidepath_geometry::Segment;
use glidepath_motion::Planner;
use glidepath_program::{Effort, Item, ItemKind, PathMode, Rate as Speed, Settings, Smoothing};

/// Frames of a random program of up to three axes.
pub(super) fn program(seed: u64, moves: usize, effort: Effort) -> Vec<SetpointFrame> {
    let mut numbers = Numbers::new(seed);
    let mut items = Vec::new();
    let (mut at, mut heading) = (AxisVector::zeros(), 0.0_f64);
    for line in 1..=moves {
        // Long moves between runs of short chords that turn a little each.
        let is_chord = numbers.unit() < 0.7;
        let length = if is_chord {
            0.05 + numbers.unit()
        } else {
            1.0 + 30.0 * numbers.unit()
        };
        heading += if is_chord { 0.4 } else { 6.0 } * (numbers.unit() - 0.5);
        let mut to = at;
        to[0] += length * heading.cos();
        to[1] += length * heading.sin();
        to[2] += 0.2 * length * (numbers.unit() - 0.5);
        let rate = if numbers.unit() < 0.2 {
            Speed::Rapid
        } else {
            Speed::Feed(20.0 + 180.0 * numbers.unit())
        };
        let mode = if numbers.unit() < 0.1 {
            PathMode::ExactStop
        } else {
            PathMode::Continuous { tolerance_mm: None }
        };
        let kind = ItemKind::Move {
            segment: Segment::line(at, to),
            rate,
            mode,
        };
        items.push(Item {
            block: 0,
            line: line as u32,
            kind,
        });
        at = to;
    }
    planned(&items, effort)
}

/// Frames of a program.
pub(super) fn planned(items: &[Item], effort: Effort) -> Vec<SetpointFrame> {
    crate::testing::planned(items, mill(), AxisVector::zeros(), effort)
}

fn positions(frames: &[SetpointFrame]) -> Vec<AxisVector> {
    frames
        .iter()
        .map(|f| AxisVector::from(f.position))
        .collect()
}

/// Also where a plan is at its limits on one axis or another for longer than a stop takes. The
/// near-optimal ones here are the hardest of 200; with `GLIDEPATH_PLANNED=200` those are run.
#[test]
fn planned_time_is_run_time() {
    let fast = (0..40).map(|seed| (seed, Effort::Fast));
    let many = std::env::var("GLIDEPATH_PLANNED").map(|n| n.parse().unwrap());
    let seeds = many.map_or(vec![2, 21, 29, 31, 46, 47, 48], |n| (0..n).collect());
    let optimal = seeds.into_iter().map(|seed| (seed, Effort::Optimal));
    let mut late = Vec::new();
    for (seed, effort) in fast.chain(optimal) {
        let frames = program(seed, 60, effort);
        let mut rig = Rig::playing(&frames);
        for _ in 0..frames.len() + 200 {
            rig.publish_horizon();
            rig.tick();
        }
        let last = frames.len() - 1;
        let ticks = rig.ticks_from(1, last as u64);
        let reserve_stops = rig.interpolator.statistics.counters().reserve_stops();
        if ticks != last - 1 || reserve_stops > 0 {
            late.push((seed, effort, ticks + 1 - last, last, reserve_stops));
        }
    }
    assert!(
        late.is_empty(),
        "seed, effort, ticks late, of, reserve: {late:?}"
    );
}

/// A stop from full speed takes 170 ticks here: a tick must be able to play one through.
#[test]
fn a_short_period_gets_under_way() {
    let settings = Settings {
        limits: mill(),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Sextic,
        corners: glidepath_program::Corners::default(),
        period_t: 0.000_9,
        effort: Effort::Fast,
    };
    let mut to = AxisVector::zeros();
    (to[0], to[1]) = (200.0, 200.0);
    let kind = ItemKind::Move {
        segment: Segment::line(AxisVector::zeros(), to),
        rate: Speed::Rapid,
        mode: PathMode::ExactStop,
    };
    let mut planner = Planner::new(settings, AxisVector::zeros());
    planner
        .push(&Item {
            block: 0,
            line: 1,
            kind,
        })
        .unwrap();
    planner.finish();
    let frames: Vec<_> = std::iter::from_fn(|| planner.pop_frame().unwrap()).collect();
    let mut rig = Rig::new(Config::new(mill(), 900_000));
    rig.feed.extend(records(&frames, 1, 900_000));
    let last = frames.len() as u64 - 1;
    let ended = rig.run_until(2 * frames.len(), |s| s.epoch == 1 && s.sequence == last);
    assert!(ended, "{:?}", rig.state());
    assert!(rig.worst_ratio() <= 1.0 + 1e-6);
}

/// Commands by number, each with ticks after it, from a planner that dies at that part of the
/// frames.
fn command_planned(
    effort: Effort,
    seed: u64,
    dies_at: f64,
    commands: &[(u8, usize)],
) -> Result<(), TestCaseError> {
    let frames = program(seed, 40, effort);
    let mut rig = Rig::mill();
    let kept = ((frames.len() as f64 * dies_at) as usize).clamp(10, frames.len());
    rig.feed.extend(&frames[..kept]);
    let mut numbers = Numbers::new(seed);
    for &(command, ticks) in commands {
        match command {
            0 | 1 => rig.command(Command::Hold),
            2 => rig.command(Command::Resume),
            3 => rig.command(Command::FeedOverride(numbers.unit())),
            4 => rig.command(Command::RapidOverride(
                (1.3 * numbers.unit() - 0.3).max(0.0),
            )),
            5 => rig.command(Command::StopAtEndOfBlock),
            6 => rig.command(Command::SingleBlock(true)),
            7 => rig.command(Command::SingleBlock(false)),
            8 => rig.command(Command::Step),
            10 => rig.command(Command::Reverse),
            11 => rig.command(Command::Forward),
            12 => rig.command(Command::FeedOverride(-numbers.unit())),
            _ => rig.command(Command::FeedOverride(1.0)),
        }
        for _ in 0..ticks {
            rig.publish_horizon();
            rig.tick();
        }
    }
    rig.command(Command::SingleBlock(false));
    rig.command(Command::Forward);
    rig.command(Command::Resume);
    rig.command(Command::FeedOverride(1.0));
    rig.command(Command::RapidOverride(1.0));
    for _ in 0..frames.len() * 2 + 1_500 {
        rig.publish_horizon();
        if rig.tick().state() == Ok(MachineState::ProgramStop) {
            rig.command(Command::Resume);
        }
    }
    let has_ended = matches!(rig.state(), MachineState::Idle | MachineState::Faulted);
    prop_assert!(has_ended, "{:?}", rig.state());
    let (ratio, planned) = (rig.worst_ratio(), planned_ratio(&frames));
    prop_assert!(ratio <= INSIDE, "{ratio} planned {planned}");
    Ok(())
}

fn planned_ratio(frames: &[SetpointFrame]) -> f64 {
    let ratios = crate::testing::audit(&positions(frames), &mill(), 0.004);
    ratios.into_iter().fold(1.0, f64::max)
}

proptest! {
    #![proptest_config(cases(100))]
    #[test]
    fn commands_and_death_keep_the_limits_of_planned_motion(
        seed in 0_u64..1_000_000,
        dies_at in 0.2_f64..2.0,
        commands in prop::collection::vec((0_u8..13, 1_usize..120), 0..12),
    ) {
        command_planned(Effort::Fast, seed, dies_at, &commands)?;
    }
}

proptest! {
    // Planning takes most of the time.
    #![proptest_config(ProptestConfig { cases: 6, max_shrink_iters: 0, ..ProptestConfig::default() })]
    #[test]
    fn commands_and_death_keep_the_limits_of_motion_planned_with_effort(
        seed in 0_u64..1_000_000,
        dies_at in 0.2_f64..2.0,
        commands in prop::collection::vec((0_u8..13, 1_usize..120), 0..12),
    ) {
        command_planned(Effort::Optimal, seed, dies_at, &commands)?;
    }
}

#[test]
fn an_end_of_a_block_in_the_last_frames_of_a_planner_keeps_the_limits() {
    command_planned(
        Effort::Fast,
        345_455,
        0.2,
        &[(3, 17), (5, 62), (0, 1), (0, 1)],
    )
    .unwrap();
}
