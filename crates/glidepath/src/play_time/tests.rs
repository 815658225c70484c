//! Tests of the time that a program is played in.

use super::*;

const PERIOD_T: f64 = 0.004;

/// Plays ticks of so many periods of program time each, in states.
fn play(ticks: &[(MachineState, f64, usize)]) -> PlayTime {
    let mut play_time = PlayTime::new(PERIOD_T);
    let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
    let mut time = 0.0;
    setpoint.state = MachineState::Idle.code();
    play_time.take(&setpoint);
    for &(state, advance, count) in ticks {
        for _ in 0..count {
            setpoint.epoch = 1;
            (setpoint.tick, setpoint.number) = (setpoint.tick + 1, setpoint.number + 1);
            time += advance;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "small and not negative"
            )]
            (setpoint.sequence = f64::floor(time) as u64);
            setpoint.fraction = time.fract();
            setpoint.state = state.code();
            setpoint.effective_override = advance;
            setpoint.velocity[0] = 50.0 * advance;
            play_time.take(&setpoint);
        }
    }
    play_time
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn a_run_as_planned_loses_nothing() {
    use MachineState::{Idle, Running};
    let ticks = [
        (Running, 0.0, 1),
        (Running, 1.0, 500),
        (Running, 0.0, 1),
        (Idle, 0.0, 100),
    ];
    let played = play(&ticks).played();
    assert!(near(played.planned_s, 2.0) && near(played.played_s, 2.0));
    assert_eq!(played.text(), "  played in     2.000 s, as planned\n");
}

#[test]
fn what_is_lost_has_its_cause_and_adds_up() {
    use MachineState::{Held, Holding, Idle, ProgramStop, Running, Starved, Starving};
    let play_time = play(&[
        (Starved, 0.0, 3),
        (Running, 1.0, 100),
        (Holding, 0.5, 10),
        (Held, 0.0, 50),
        (Running, 0.5, 10), // Speeding up after the hold.
        (Running, 1.0, 10),
        (Starving, 0.25, 4),
        (Starved, 0.0, 7),
        (Running, 0.5, 2),
        (Running, 1.0, 10),
        (Running, 0.8, 5), // An override that is not in the plan yet.
        (Running, 1.0, 1),
        (ProgramStop, 0.0, 20),
        (Running, 1.0, 10),
        (Holding, -0.5, 2),
        (Running, -1.0, 9),
        (Held, 0.0, 3),
        (Running, 1.0, 20), // Ten of them where it was before.
        (Idle, 0.0, 30),
    ]);
    let played = play_time.played();
    let lost = played.time_lost_s;
    let ticks = |count: f64| count * PERIOD_T;
    assert!(near(lost.start_up, ticks(2.0)), "{lost:?}");
    assert!(near(lost.hold, ticks(60.0)), "{lost:?}");
    assert!(near(lost.starvation, ticks(3.0 + 7.0 + 1.0)), "{lost:?}");
    assert!(near(lost.slower, ticks(1.0)), "{lost:?}");
    assert!(near(lost.program_stop, ticks(20.0)), "{lost:?}");
    assert!(
        near(lost.way_back, ticks(2.0 + 9.0 + 3.0 + 10.0)),
        "{lost:?}"
    );
    let sum = lost.start_up
        + lost.hold
        + lost.starvation
        + lost.slower
        + lost.way_back
        + lost.program_stop;
    assert!(near(played.played_s, played.planned_s + sum), "{played:?}");
    assert!(
        played.text().contains("0.044 s for want of frames"),
        "{}",
        played.text()
    );
}

#[test]
fn rests_at_the_start_are_no_motion_yet() {
    let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
    let mut play_time = PlayTime::new(PERIOD_T);
    play_time.take(&setpoint);
    // Two frames at rest, a tick without one, and motion.
    let ticks = [(0, 0.0), (1, 0.0), (2, 0.0), (2, 0.0), (3, 9.0), (4, 9.0)];
    for (tick, (sequence, velocity)) in (1..).zip(ticks) {
        let is_late = tick == 4;
        let state = if is_late {
            MachineState::Starved
        } else {
            MachineState::Running
        };
        (setpoint.epoch, setpoint.tick, setpoint.number) = (1, tick, tick);
        (setpoint.sequence, setpoint.velocity[0]) = (sequence, velocity);
        setpoint.state = state.code();
        setpoint.effective_override = 1.0;
        play_time.take(&setpoint);
    }
    let lost = play_time.played().time_lost_s;
    assert!(near(lost.starvation, 0.0), "{lost:?}");
    assert!(near(lost.start_up, PERIOD_T), "{lost:?}");
}

#[test]
fn missed_ticks_are_lost_and_lost_setpoints_are_not() {
    let mut play_time = PlayTime::new(PERIOD_T);
    let mut setpoint: Setpoint = bytemuck::Zeroable::zeroed();
    (setpoint.epoch, setpoint.state) = (1, MachineState::Running.code());
    // Ticks, numbers and frames: three ticks missed, then two setpoints lost on the way.
    for (tick, number, sequence) in [(0, 0, 0), (1, 1, 1), (5, 2, 2), (8, 5, 5)] {
        (setpoint.tick, setpoint.number, setpoint.sequence) = (tick, number, sequence);
        setpoint.effective_override = 1.0;
        play_time.take(&setpoint);
    }
    let played = play_time.played();
    assert!(near(played.played_s, 8.0 * PERIOD_T), "{played:?}");
    assert!(near(played.time_lost_s.missed_ticks, 3.0 * PERIOD_T));
    assert!(near(played.planned_s, 5.0 * PERIOD_T));
}
