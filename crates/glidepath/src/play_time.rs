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
mod tests;
