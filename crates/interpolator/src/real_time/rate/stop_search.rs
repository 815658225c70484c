//! The search for a stop: down step by step, as soon and as far as the plan lets go.
//!
//! A plan that is near the least time possible has some axis at a limit nearly everywhere. Where
//! one brakes at its limit the rate cannot fall, and where there is room there often is for a
//! moment only, too short for a ramp to rest. But with a rate of 0.95 the plan itself takes 14 %
//! less jerk and 10 % less acceleration, wherever it is: each small step makes room for a larger
//! one.
//!
//! ```text
//! r ──────╮                          one step down after the other, each the largest of a few that
//!          ╰──╮                      passes; where none does, the rate stays for a tick
//!             ╰───╮
//!                  ╲
//!                   ╰───────  0
//! ```
//!
//! Where none passes for too long there is another way: see [`super::greedy_slow_down`].
//!
//! Every step is played through from the very positions that the ones before it end with, so what
//! is found keeps the limits as it stands. The search can pause between any two samples, and go on
//! in the next tick: it depends on the position along the path, not on when that is looked at.

use super::kept_stop::{DelayedRamp, KeptStop};
use super::play::{PlaybackPosition, Playthrough, PlaythroughOutcome};
use super::situation::{SET_UP, Situation};
use crate::real_time::ramp::{Bounds, Ramp};

/// A step to try: which share of the rate goes, and at which pace.
#[derive(Debug, Clone, Copy)]
struct StepDown {
    share: f64,
    pace: f64,
}

const fn step_down(share: f64, pace: f64) -> StepDown {
    StepDown { share, pace }
}

/// Largest first, because each costs a play and fewer are needed. The last is the gentlest: where it does
/// not pass, hardly any other does, so at most ticks it alone is tried. Of shares and paces no measurement
/// is kept; a stop of small shares alone would need more ramps than it has room for
/// ([`super::kept_stop`]).
const STEPS_DOWN: [StepDown; 12] = [
    step_down(1.0, 1.0),
    step_down(1.0, 0.7),
    step_down(1.0, 0.45),
    step_down(0.6, 0.8),
    step_down(0.3, 1.0),
    step_down(0.3, 0.6),
    step_down(0.12, 1.0),
    step_down(0.12, 0.6),
    step_down(0.12, 0.35),
    step_down(0.05, 0.7),
    step_down(0.05, 0.35),
    step_down(0.02, 0.4),
];
const GENTLEST: usize = STEPS_DOWN.len() - 1;
/// At every so many ticks all steps are tried, whatever the gentlest says: with fewer, more of a tick's
/// samples go into steps that fail; with more, room for a steep step is seen later.
const THOROUGH: u32 = 4;

/// What a search for a stop has come to.
#[derive(Debug, Clone, Copy)]
pub(super) enum StopOutcome {
    /// The stop is known.
    Rest,
    /// There was no time to try everything.
    Open,
    /// The frames at hand do not last.
    Lost,
}

/// A way down, as far as it is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct StopSearch {
    /// The end of what is known so far, where the rate is steady.
    at: PlaybackPosition,
    rate: f64,
    /// Ticks since the last step.
    waited: u32,
    /// The steps so far.
    stop: KeptStop,
    /// The step that is tried next at this tick, and whether all of them are: the gentlest has
    /// passed here, or it is time to be thorough.
    turn: usize,
    tries_all: bool,
    /// What the last tick had no time to play to its end.
    playthrough: Option<Playthrough>,
    /// The bounds of ramps here and at the next few ticks.
    bounds: Option<Bounds>,
}

impl StopSearch {
    /// A search that begins where the rate is steady.
    pub(super) const fn new(at: PlaybackPosition, rate: f64) -> Self {
        Self {
            at,
            rate,
            waited: 0,
            stop: KeptStop::new(),
            turn: 0,
            tries_all: true,
            playthrough: None,
            bounds: None,
        }
    }

    /// Begins anew. What is not in use is not written.
    pub(super) const fn begin(&mut self, at: PlaybackPosition, rate: f64) {
        (self.at, self.rate) = (at, rate);
        (self.playthrough, self.bounds) = (None, None);
        (self.waited, self.turn, self.tries_all) = (0, 0, true);
        self.stop.clear();
    }

    /// The stop, once it is known.
    pub(super) const fn stop(&self) -> &KeptStop {
        &self.stop
    }

    /// Goes on until rest, or until the budget is used up.
    pub(super) fn go_on(&mut self, situation: &Situation<'_>, budget: &mut u32) -> StopOutcome {
        while *budget > SET_UP {
            *budget = budget.saturating_sub(SET_UP);
            let sequence = self.at.time.sequence;
            let bounds = *self
                .bounds
                .get_or_insert_with(|| situation.fastest_from(sequence));
            loop {
                match self.try_next(bounds, situation, budget) {
                    StepOutcome::Rest => return StopOutcome::Rest,
                    StepOutcome::Lower => break,
                    StepOutcome::Failed if self.turn_to_next() => {}
                    StepOutcome::Failed => {
                        if !self.wait(situation, budget) {
                            return StopOutcome::Lost;
                        }
                        break;
                    }
                    StepOutcome::Full => return StopOutcome::Lost,
                    StepOutcome::OutOfBudget => return StopOutcome::Open,
                }
            }
        }
        StopOutcome::Open
    }

    /// Turns to the next step at this tick; false if there is none.
    const fn turn_to_next(&mut self) -> bool {
        if !self.tries_all {
            return false;
        }
        self.turn += 1;
        self.turn < STEPS_DOWN.len()
    }

    fn try_next(
        &mut self,
        bounds: Bounds,
        situation: &Situation<'_>,
        budget: &mut u32,
    ) -> StepOutcome {
        let mut playthrough = match self.playthrough.take() {
            Some(playthrough) => playthrough,
            None => match self.next_ramp(bounds) {
                Some(ramp) => Playthrough::new(ramp, self.at),
                None => return StepOutcome::Failed,
            },
        };
        let end = match playthrough.go_on(situation.track, situation.allowed, budget) {
            PlaythroughOutcome::Passed(end) => end,
            PlaythroughOutcome::Barred => return StepOutcome::Failed,
            PlaythroughOutcome::OutOfBudget => {
                self.playthrough = Some(playthrough);
                return StepOutcome::OutOfBudget;
            }
        };
        if !self.tries_all {
            // There is room: now for the largest that passes.
            (self.tries_all, self.turn) = (true, 0);
            return StepOutcome::Lower;
        }
        let ramp = *playthrough.ramp();
        let target = ramp.target();
        let step = DelayedRamp {
            in_ticks: self.waited,
            ramp,
        };
        if !self.stop.push(step) {
            return StepOutcome::Full;
        }
        (self.at, self.rate, self.waited, self.turn) = (end, target, 0, 0);
        self.bounds = None;
        if target > 0.0 {
            StepOutcome::Lower
        } else {
            StepOutcome::Rest
        }
    }

    /// The ramp whose turn it is at this tick.
    fn next_ramp(&self, bounds: Bounds) -> Option<Ramp> {
        let turn = if self.tries_all { self.turn } else { GENTLEST };
        let StepDown { share, pace } = *STEPS_DOWN.get(turn)?;
        let target = self.rate * (1.0 - share);
        Ramp::plan(self.rate, 0.0, target, bounds.paced(pace))
    }

    /// Stays at the rate for a tick; false if that cannot be.
    fn wait(&mut self, situation: &Situation<'_>, budget: &mut u32) -> bool {
        *budget = budget.saturating_sub(1);
        self.waited += 1;
        self.turn = 0;
        self.tries_all = self.waited.is_multiple_of(THOROUGH);
        if self.tries_all {
            self.bounds = None;
        }
        let Situation { track, allowed, .. } = situation;
        self.at.go_on(self.rate, track, allowed)
    }
}

/// What trying one step has shown.
enum StepOutcome {
    /// A step to rest.
    Rest,
    /// A step down, or room for one.
    Lower,
    /// A limit would be broken.
    Failed,
    /// Too many steps.
    Full,
    /// There was no time to play it to its end.
    OutOfBudget,
}
