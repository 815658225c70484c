//! Tests of anything an operator may do, in any order, at any time.

use glidepath_link::{Command, MachineState};
use glidepath_program::Effort;
use proptest::prelude::*;

use crate::supervisor::{BENCH, EFFORTS, Job, Supervisor, assert_limits};
use crate::times;

pub(crate) fn command() -> impl Strategy<Value = Command> {
    let stops = prop_oneof![
        3 => Just(Command::Hold),
        2 => Just(Command::StopAtEndOfBlock),
        2 => Just(Command::SingleBlock(true)),
        2 => Just(Command::SingleBlock(false)),
    ];
    let goes_on = prop_oneof![2 => Just(Command::Resume), 3 => Just(Command::Step)];
    let overrides = prop_oneof![
        Just(Command::FeedOverride(1.0)),
        (0.0..=2.0).prop_map(Command::FeedOverride),
        prop_oneof![Just(0.25), Just(0.5), Just(1.0)].prop_map(Command::RapidOverride),
        Just(Command::FeedOverride(0.999)),
    ];
    let turns = prop_oneof![
        3 => Just(Command::Reverse),
        3 => Just(Command::Forward),
        1 => (-2.0..=0.0).prop_map(Command::FeedOverride),
    ];
    prop_oneof![4 => stops, 3 => goes_on, 2 => overrides, 3 => turns]
}

fn short_programs() -> impl Strategy<Value = &'static str> {
    // Dense programs take long to plan in a debug build: in the long form only.
    let most = if times() > 1 { BENCH.len() } else { 10 };
    proptest::sample::select(BENCH[..most].to_vec())
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: u32::try_from(24 * times()).unwrap(),
        max_shrink_iters: 200,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]
    #[test]
    fn whatever_is_commanded_the_program_is_executed_within_its_limits(
        name in short_programs(),
        effort in proptest::sample::select(&EFFORTS[..]),
        commands in prop::collection::vec((command(), 1_usize..150), 1..25),
    ) {
        let job = Job::bench(name, effort);
        carry_out(&job, &commands)?;
    }
}

/// Carries out commands, each followed by some ticks, and the rest of the program.
fn carry_out(job: &Job, commands: &[(Command, usize)]) -> Result<(), TestCaseError> {
    carry_out_and(job, commands, |_| Ok(()))
}

/// The same, and judges what came of it.
pub(crate) fn carry_out_and(
    job: &Job,
    commands: &[(Command, usize)],
    judge: impl FnOnce(&Supervisor<'_, '_, '_>) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    job.supervised(|supervisor| {
        let mut largest_override = 1.0_f64;
        for &(command, ticks) in commands {
            if let Command::FeedOverride(ratio) = command {
                largest_override = largest_override.max(ratio.abs());
            }
            supervisor.command(command);
            supervisor.play(ticks);
        }
        finish(supervisor)?;
        let report = supervisor.audit(&job.settings, largest_override);
        assert_limits(&report);
        let end = supervisor.planned.frames.last().unwrap().position;
        prop_assert_eq!(supervisor.setpoints.last().unwrap().position, end);
        assert_bits(supervisor)?;
        judge(supervisor)
    })
}

/// The motion is back at the plan just when the way to the end of the block is settled: it began a
/// tick late, and ended in the next block.
#[test]
fn the_end_of_a_block_is_met_where_a_change_of_rate_just_ended() {
    let commands = [
        (Command::FeedOverride(0.843_617_697_821_566_7), 59),
        (Command::Resume, 78),
        (Command::StopAtEndOfBlock, 33),
        (Command::StopAtEndOfBlock, 114),
        (Command::Step, 1),
    ];
    carry_out(&Job::bench("star_seed", Effort::Fast), &commands).unwrap();
}

/// Goes on wherever the machine stands, to the end.
fn finish(supervisor: &mut Supervisor<'_, '_, '_>) -> Result<(), TestCaseError> {
    for command in [
        Command::SingleBlock(false),
        Command::FeedOverride(1.0),
        Command::RapidOverride(1.0),
    ] {
        supervisor.command(command);
        supervisor.play(1);
    }
    for _ in 0..50 {
        supervisor.command(Command::Forward);
        supervisor.command(Command::Resume);
        supervisor.play(1_000);
        if supervisor.is_over() {
            return Ok(());
        }
    }
    let last = supervisor
        .setpoints
        .last()
        .map(|s| (s.state(), s.sequence, s.fraction));
    Err(TestCaseError::fail(format!("not over: {last:?}")))
}

/// Where the motion follows the plan it is the plan, bit for bit; where it stands at the end of a
/// block, it stands at a frame.
fn assert_bits(supervisor: &Supervisor<'_, '_, '_>) -> Result<(), TestCaseError> {
    for pair in supervisor.setpoints.windows(2) {
        let (before, now) = (&pair[0], &pair[1]);
        let frames = &supervisor.planned.frames;
        let index = frames.binary_search_by_key(&now.sequence, |frame| frame.sequence);
        let frame = index.ok().and_then(|index| frames.get(index));
        let Some(frame) = frame.filter(|_| now.epoch > 0 && now.fraction <= 0.0) else {
            continue;
        };
        let is_steady = before.fraction <= 0.0;
        let follows = is_steady && now.sequence == before.sequence + 1;
        let goes_back = is_steady && now.sequence + 1 == before.sequence;
        let stands =
            now.state() == Ok(MachineState::ProgramStop) && now.position == before.position;
        if follows || stands || goes_back {
            prop_assert_eq!(
                now.position.map(f64::to_bits),
                frame.position.map(f64::to_bits)
            );
        }
        if follows {
            prop_assert_eq!(
                now.velocity.map(f64::to_bits),
                frame.velocity.map(f64::to_bits)
            );
        }
        if goes_back {
            let back = frame.velocity.map(|v| 0.0 - v);
            prop_assert_eq!(now.velocity.map(f64::to_bits), back.map(f64::to_bits));
        }
    }
    Ok(())
}
