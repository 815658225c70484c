//! The play time of a motion: how long it took, and why longer than it was planned.
//!
//! ```text
//!   played = planned + what was lost        by what the machine did while program time stood or
//!   (ticks)  (frames)                       ran slower: started, was held, starved, …
//! ```
//!
//! The planned time is that of the frames played. They were planned again where the override
//! changed, so what a lower override takes is in the plan, but for the moments until it is.

use glidepath_link::{MachineState, Setpoint};
use serde::Serialize;

/// A tick that advances program time by so little less than a period is a whole one.
const WHOLE: f64 = 1.0 - 1e-9;

/// What a motion was played slower for than it was planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cause {
    /// Frames had to come in before it began.
    StartUp,
    /// Feed hold, with slowing down for it and speeding up after it.
    Hold,
    /// Program stop or end of a block, until the operator went on.
    ProgramStop,
    /// Too few frames, likewise.
    Starvation,
    /// An override lower than that of the plan, or a rate that limits allowed no faster.
    Slower,
    /// Back along the path, and onward again to where it turned.
    WayBack,
}

/// The number of causes.
const CAUSES: usize = 6;

/// A setpoint, as far as it tells of time.
#[derive(Debug, Clone, Copy)]
struct Moment {
    epoch: u64,
    tick: u64,
    number: u64,
    sequence: u64,
    fraction: f64,
}

impl Moment {
    fn is_before(&self, other: &Self) -> bool {
        (self.sequence, self.fraction) < (other.sequence, other.fraction)
    }

    /// Periods of program time since another one.
    #[allow(clippy::cast_precision_loss, reason = "far below 2^53")]
    fn since(&self, other: &Self) -> f64 {
        self.sequence.saturating_sub(other.sequence) as f64 + (self.fraction - other.fraction)
    }
}

/// Ticks that went by.
#[derive(Debug, Clone, Copy, Default)]
struct Spent {
    all: u64,
    missed: u64,
    lost: [f64; CAUSES],
}

impl Spent {
    fn add(&mut self, other: &Self) {
        self.all += other.all;
        self.missed += other.missed;
        for (lost, other) in self.lost.iter_mut().zip(&other.lost) {
            *lost += other;
        }
    }
}

/// Follows the setpoints of a motion.
#[derive(Debug)]
pub struct PlayTime {
    period_t: f64,
    last: Option<Moment>,
    /// The furthest that the motion has come.
    furthest: Option<Moment>,
    /// The machine has moved in the present epoch; rests that a program begins with are no motion.
    has_moved: bool,
    cause: Cause,
    planned_ticks: f64,
    spent: Spent,
    /// Since program time last advanced: if it never does again, the motion was over before.
    standing: Spent,
    overrides: Option<[f64; 2]>,
}

/// The time that a motion took, s. The names are part of the command line's contract.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PlayedTime {
    /// Of the frames played.
    pub planned_s: f64,
    /// From the first tick of the motion to its last.
    pub played_s: f64,
    /// What makes the difference.
    pub time_lost_s: TimeLost,
    /// The lowest and the highest override that was planned with, 1 for 100 %.
    pub planned_override: [f64; 2],
}

/// Time by which a motion was played longer than planned, s.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TimeLost {
    /// Before it began.
    pub start_up: f64,
    /// By feed holds.
    pub hold: f64,
    /// By program stops and ends of blocks.
    pub program_stop: f64,
    /// For want of frames.
    pub starvation: f64,
    /// By an override lower than that of the plan, and where limits allowed no faster.
    pub slower: f64,
    /// Back along the path, and onward again.
    pub way_back: f64,
    /// By ticks that were missed.
    pub missed_ticks: f64,
}

impl PlayTime {
    /// Nothing has been played yet; period in s.
    #[must_use]
    pub fn new(period_t: f64) -> Self {
        Self {
            period_t,
            last: None,
            furthest: None,
            has_moved: false,
            cause: Cause::StartUp,
            planned_ticks: 0.0,
            spent: Spent::default(),
            standing: Spent::default(),
            overrides: None,
        }
    }

    /// Takes the next setpoint.
    pub fn take(&mut self, setpoint: &Setpoint) {
        let now = Moment {
            epoch: setpoint.epoch,
            tick: setpoint.tick,
            number: setpoint.number,
            sequence: setpoint.sequence,
            fraction: setpoint.fraction,
        };
        let before = self.last.replace(now);
        if now.epoch == 0 {
            return;
        }
        let Some(before) = before.filter(|before| before.epoch == now.epoch) else {
            (self.cause, self.has_moved) = (Cause::StartUp, false);
            self.furthest = Some(now);
            return;
        };
        let furthest = self.furthest.unwrap_or(before);
        let is_again = now.is_before(&furthest);
        if !is_again {
            self.furthest = Some(now);
        }
        let ticks = now.tick.saturating_sub(before.tick);
        let published = now.number.saturating_sub(before.number).min(ticks);
        #[allow(clippy::cast_precision_loss, reason = "far below 2^53")]
        let (advance, wanted) = if is_again {
            (0.0, published as f64)
        } else {
            (now.since(&furthest), published as f64)
        };
        let state = setpoint.state().unwrap_or(MachineState::Idle);
        if advance >= WHOLE * wanted {
            self.cause = Cause::Slower;
            if state == MachineState::Running {
                self.see_override(setpoint.effective_override);
            }
        }
        self.has_moved |= setpoint.velocity.iter().any(|v| *v != 0.0);
        self.cause = cause_of(state, self.has_moved).unwrap_or(self.cause);
        if is_again {
            self.cause = Cause::WayBack;
        }
        self.standing.all += ticks;
        self.standing.missed += ticks - published;
        self.standing.lost[self.cause as usize] += (wanted - advance).max(0.0);
        if advance > 0.0 {
            self.planned_ticks += advance;
            self.spent.add(&std::mem::take(&mut self.standing));
        }
    }

    /// An override at which time runs as planned is that of the plan.
    const fn see_override(&mut self, planned: f64) {
        self.overrides = match self.overrides {
            None => Some([planned, planned]),
            Some([low, high]) => Some([low.min(planned), high.max(planned)]),
        };
    }

    /// What it came to.
    #[must_use]
    pub fn played(&self) -> PlayedTime {
        #[allow(clippy::cast_precision_loss, reason = "far below 2^53")]
        let whole = |ticks: u64| ticks as f64 * self.period_t;
        let lost = |cause: Cause| self.spent.lost[cause as usize] * self.period_t;
        PlayedTime {
            planned_s: self.planned_ticks * self.period_t,
            played_s: whole(self.spent.all),
            time_lost_s: TimeLost {
                start_up: lost(Cause::StartUp),
                hold: lost(Cause::Hold),
                program_stop: lost(Cause::ProgramStop),
                starvation: lost(Cause::Starvation),
                slower: lost(Cause::Slower),
                way_back: lost(Cause::WayBack),
                missed_ticks: whole(self.spent.missed),
            },
            planned_override: self.overrides.unwrap_or([1.0; 2]),
        }
    }
}

/// Why time runs slower in a state; `None` where the state does not tell. Before the machine has
/// moved, frames are few by nature.
const fn cause_of(state: MachineState, has_moved: bool) -> Option<Cause> {
    match state {
        MachineState::Holding | MachineState::Held | MachineState::Stopping => Some(Cause::Hold),
        MachineState::ProgramStop => Some(Cause::ProgramStop),
        MachineState::Starving | MachineState::Starved | MachineState::Waiting => {
            Some(if has_moved {
                Cause::Starvation
            } else {
                Cause::StartUp
            })
        }
        MachineState::Idle
        | MachineState::Running
        | MachineState::Faulted
        | MachineState::Awaiting
        | MachineState::Jogging
        | MachineState::Homing
        | MachineState::Off
        | MachineState::NotHomed
        | MachineState::Preparing => None,
    }
}

impl PlayedTime {
    /// One line for people.
    #[must_use]
    pub fn text(&self) -> String {
        let TimeLost {
            start_up,
            hold,
            program_stop,
            starvation,
            slower,
            way_back,
            missed_ticks,
        } = self.time_lost_s;
        let parts: Vec<String> = [
            (start_up, "to start"),
            (hold, "held"),
            (program_stop, "at program stops"),
            (starvation, "for want of frames"),
            (slower, "below the planned override or at limits"),
            (way_back, "back and onward again"),
            (missed_ticks, "in missed ticks"),
        ]
        .into_iter()
        .filter(|(time_s, _)| *time_s >= 0.5e-3)
        .map(|(time_s, what)| format!("{time_s:.3} s {what}"))
        .collect();
        let why = if parts.is_empty() {
            "as planned".to_owned()
        } else {
            format!("planned {:.3} s; {}", self.planned_s, parts.join(", "))
        };
        let [low, high] = self.planned_override.map(|ratio| 100.0 * ratio);
        let overridden = if (low - 100.0).abs() < 0.5 && (high - 100.0).abs() < 0.5 {
            String::new()
        } else if (low - high).abs() < 0.5 {
            format!(" (planned at {low:.0} %)")
        } else {
            format!(" (planned at {low:.0} to {high:.0} %)")
        };
        format!(
            "  played in     {:.3} s, {why}{overridden}\n",
            self.played_s
        )
    }
}

#[cfg(test)]
mod tests {
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
}
