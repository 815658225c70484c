//! Tests of the operator's commands.

use super::*;

#[test]
fn hold_stops_on_the_path_and_resume_goes_on_from_the_same_bits() {
    let frames = records(&lines(8, 3, 600, &mill(), 0.004), 1, 4_000_000);
    let mut rig = Rig::playing(&frames);
    rig.run(100);
    rig.command(Command::Hold);
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
    rig.command(Command::Resume);
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
    rig.command(Command::FeedOverride(0.5));
    assert!(rig.run_until(500, |s| (s.effective_override - 0.5).abs() < 1e-12));
    rig.run(20);
    let pair: Vec<_> = rig.setpoints.iter().rev().take(2).collect();
    let advanced =
        (pair[0].sequence - pair[1].sequence) as f64 + pair[0].fraction - pair[1].fraction;
    assert!((advanced - 0.5).abs() < 1e-9);
    rig.command(Command::FeedOverride(0.0));
    assert!(rig.run_until(500, |s| s.state() == Ok(MachineState::Held)));
    rig.command(Command::FeedOverride(1.5));
    assert!(rig.run_until(3_000, is_idle));
    assert!(rig.setpoints.iter().all(|s| s.effective_override <= 1.0));
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
    rig.command(Command::Resume);
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
    rig.command(Command::Abort);
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
        let speed = frame.sequence as f64;
        happens(frame, Event::SpindleSpeed(speed));
    }
    rig.run(40);
    rig.command(Command::Hold);
    rig.run(150);
    rig.command(Command::Resume);
    assert!(rig.run_until(3_000, is_idle));
    let events: Vec<_> = rig
        .setpoints
        .iter()
        .flat_map(|s| s.events())
        .map(|event| event.value as u64)
        .collect();
    assert_eq!(events, (0..frames.len() as u64).collect::<Vec<_>>());
}

#[test]
fn events_happen_in_their_places_at_any_rate() {
    for factor in [1.0, 0.37] {
        let (mut rig, frames) = rig(3, 1, 200);
        // Three in every period; two of them at once.
        let offsets_ns = [400_000, 3_000_000, 3_000_000];
        for frame in rig.feed.iter_mut().skip(1) {
            let number = frame.sequence as f64;
            for (slot, offset_ns) in frame.events.iter_mut().zip(offsets_ns) {
                *slot = EventRecord::new(Event::SpindleSpeed(number), offset_ns);
            }
            frame.event_count = 3;
        }
        rig.command(Command::FeedOverride(factor));
        rig.command(Command::RapidOverride(factor));
        rig.run(60);
        rig.command(Command::Hold);
        rig.run(150);
        rig.command(Command::Resume);
        assert!(rig.run_until(6_000, is_idle));
        let mut numbers = Vec::new();
        for pair in rig.setpoints.windows(2) {
            let [from, to] = [&pair[0], &pair[1]];
            let is_steady = to.fraction == 0.0 && from.fraction == 0.0;
            for event in to.events() {
                numbers.push(event.value as u64);
                // Where the plan is at that time, and where the setpoints are.
                let [last, frame] = [-1, 0].map(|k| {
                    let index = (event.value as i64 + k) as usize;
                    AxisVector::from(frames[index].position)
                });
                let first_ns = event.offset_ns;
                if is_steady && from.sequence + 1 == to.sequence {
                    assert!(
                        offsets_ns.contains(&first_ns),
                        "{first_ns} at a steady rate"
                    );
                }
                let part = f64::from(event.offset_ns) / 4e6;
                let found = AxisVector::from(from.position) * (1.0 - part)
                    + AxisVector::from(to.position) * part;
                let near = offsets_ns.map(|ns| {
                    let part = f64::from(ns) / 4e6;
                    (last * (1.0 - part) + frame * part - found).amax()
                });
                let off_mm = near.into_iter().fold(f64::INFINITY, f64::min);
                assert!(off_mm < 0.01, "off by {off_mm} mm");
            }
        }
        let expected: Vec<u64> = (1..frames.len() as u64).flat_map(|k| [k; 3]).collect();
        assert_eq!(numbers, expected);
    }
}

/// How long a hold takes to begin and to end. A figure for people; limits are checked too.
#[test]
fn holds_begin_soon() {
    for axes in [1, 2, 3, 5] {
        let (mut waits, mut stops) = (vec![], vec![]);
        for seed in 0..60 {
            let (mut rig, _) = rig(seed, axes, 700);
            let mut numbers = Numbers::new(seed);
            let moving = numbers.whole(1, 400);
            while rig.interpolator.rate.now().time.sequence < moving && rig.setpoints.len() < 3_000
            {
                rig.publish_horizon();
                rig.tick();
            }
            rig.command(Command::Hold);
            let (mut wait, mut stop) = (0, 0);
            while rig.state() != MachineState::Held && rig.setpoints.len() < 3_000 {
                rig.publish_horizon();
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

/// Commands by number, each with ticks after it, from a planner that publishes so many frames.
fn command_all(
    seed: u64,
    axes: usize,
    dies_after: usize,
    commands: &[(u8, usize)],
) -> Result<(), TestCaseError> {
    let (mut rig, _) = rig(seed, axes, 400);
    rig.feed.truncate(dies_after);
    let mut numbers = Numbers::new(seed);
    for &(command, ticks) in commands {
        match command {
            0 | 1 => rig.command(Command::Hold),
            2 => rig.command(Command::Resume),
            3 => rig.command(Command::FeedOverride(numbers.unit() * 1.2)),
            4 => rig.command(Command::FeedOverride(1.0)),
            _ => {
                if numbers.unit() < 0.2 {
                    rig.command(Command::Abort);
                }
            }
        }
        rig.run(ticks);
    }
    rig.command(Command::Resume);
    rig.command(Command::FeedOverride(1.0));
    // If it died where the plan rests, the machine waits there for more.
    let mut standing = 0;
    let ended = |s: &Setpoint| {
        let is_starved = s.state() == Ok(MachineState::Starved);
        standing = if is_starved { standing + 1 } else { 0 };
        let is_over = matches!(s.state(), Ok(MachineState::Idle | MachineState::Faulted));
        is_over || standing > 1_000
    };
    prop_assert!(rig.run_until(8_000, ended), "{:?}", rig.state());
    prop_assert!(rig.state() != MachineState::Starved || rig.interpolator.queue_level.is_out());
    prop_assert!(rig.worst_ratio() <= INSIDE, "{}", rig.worst_ratio());
    Ok(())
}

proptest! {
    /// Any sequence of commands while the planner keeps up or dies.
    #[test]
    fn any_sequence_of_commands_keeps_the_limits(
        seed in 0_u64..1_000_000, axes in 1_usize..=9, dies_after in 100_usize..1_500,
        commands in prop::collection::vec((0_u8..6, 1_usize..90), 1..15),
    ) {
        command_all(seed, axes, dies_after, &commands)?;
    }
}

#[test]
fn a_hold_resumed_before_the_planner_dies_keeps_the_limits() {
    let commands = [(0, 27), (2, 36), (0, 45), (2, 63), (2, 25), (0, 9)];
    command_all(265_441, 3, 171, &commands).unwrap();
}
