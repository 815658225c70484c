//! Tests of the supply: planners that are slow, die, and come back.

use super::*;
use crate::real_time::queue_level::QueueLevel;

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
    rig.command(Command::Reset);
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
    let mut told = 0;
    assert!((0..1_000).any(|_| {
        assert_eq!(rig.interpolator.statistics.counters().starved_ticks(), told);
        let setpoint = rig.tick();
        // Few frames before the motion begins are no starvation.
        let state = setpoint.state();
        let is_short = [Ok(MachineState::Starving), Ok(MachineState::Starved)].contains(&state);
        told += u64::from(is_short && setpoint.sequence > 0);
        starved(setpoint)
    }));
    assert!(told > 1, "the machine slows before it stands");
    assert_eq!(rig.interpolator.statistics.counters().starved_ticks(), told);
    let here = AxisVector::from(rig.setpoints.last().unwrap().position);
    rig.feed = records(&plan(6, 3, 80, &mill(), 0.004, here), 2, 4_000_000).into();
    assert!(rig.run_until(3_000, |s| s.epoch == 2 && is_idle(s)));
    assert!(rig.worst_ratio() <= INSIDE);
}

/// The planner dies anywhere in a plan that is at its limits: there is always a stop, also where
/// more axes are at their limits independently of each other than any path asks for.
#[test]
fn there_is_always_a_stop_in_reserve() {
    for axes in 1..=9 {
        let mut stops = 0;
        for seed in 0..60 {
            let (mut rig, frames) = rig(seed, axes, 500);
            rig.feed
                .truncate(Numbers::new(seed).whole(150, 450) as usize);
            for _ in 0..1_200 {
                rig.publish_horizon();
                rig.tick();
            }
            let last = rig.setpoints.last().unwrap();
            assert!(last.sequence > 0 && last.sequence < frames.len() as u64);
            assert!(last.velocity.iter().all(|v| v.abs() < 1e-9));
            let ratio = rig.worst_ratio();
            assert!(ratio <= INSIDE, "{axes} axes, seed {seed}: {ratio}");
            stops += rig.interpolator.statistics.counters().reserve_stops();
        }
        println!("{axes} axes: {stops} stops in reserve for 60 deaths");
        assert!(stops > 30);
    }
}

/// While the planner keeps its horizon, planned time is run time, to the tick.
#[test]
fn a_healthy_supply_is_never_slowed_down() {
    for seed in 0..100 {
        let mut rig = Rig::mill();
        let frames = records(&lines(seed, 3, 600, &mill(), 0.004), 1, 4_000_000);
        rig.feed.extend(&frames);
        for _ in 0..frames.len() + 100 {
            rig.publish_horizon();
            rig.tick();
        }
        let last = frames.len() - 1;
        assert_eq!(rig.ticks_from(1, last as u64), last - 1, "seed {seed}");
        assert_eq!(rig.interpolator.statistics.counters().reserve_stops(), 0);
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
    let last = frames.len() - 1;
    assert_eq!(rig.ticks_from(1, last as u64), last - 1);
}

/// Publishes in bursts: so many frames, then so many ticks.
fn supply_in_bursts(
    seed: u64,
    axes: usize,
    bursts: &[(usize, usize)],
) -> Result<(), TestCaseError> {
    let (mut rig, frames) = rig(seed, axes, 400);
    rig.interpolator.queue_level = QueueLevel::new(&Config {
        planner_lost_after: None,
        ..rig.config
    });
    for &(count, ticks) in bursts {
        rig.publish(count);
        for _ in 0..ticks {
            rig.tick();
        }
    }
    let has_ended = rig.run_until(6_000, |s| s.epoch == 1 && is_idle(s));
    prop_assert!(has_ended, "{:?}", rig.state());
    prop_assert_eq!(
        rig.setpoints.last().unwrap().position,
        frames.last().unwrap().position
    );
    prop_assert!(rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
    Ok(())
}

proptest! {
    /// Whatever the pace of the planner, limits hold and the program is executed to its end.
    #[test]
    fn any_supply_of_frames_keeps_the_limits(
        seed in 0_u64..1_000_000, axes in 1_usize..=9,
        bursts in prop::collection::vec((0_usize..120, 1_usize..150), 1..20),
    ) {
        supply_in_bursts(seed, axes, &bursts)?;
    }
}

#[test]
fn frames_that_come_too_late_stop_the_motion_within_the_limits() {
    let bursts = [(22, 2), (89, 25), (31, 13), (58, 76), (55, 70)];
    supply_in_bursts(425_778, 2, &bursts).unwrap();
}
