//! How a stop is found: down step by step, as soon and as far as the plan lets go.
//!
//! A plan that is near the least time possible has some axis at a limit nearly everywhere. Where one
//! brakes at its limit the rate cannot fall, and where there is room there often is for a moment only,
//! too short for a ramp to rest. But with a rate of 0.95 the plan itself takes 14 % less jerk and 10 %
//! less acceleration, wherever it is: each small step makes room for a larger one.
//!
//! ```text
//! r ──────╮                          one step down after the other, each the largest of a few that
//!          ╰──╮                      passes; where none does, the rate stays for a tick
//!             ╰───╮
//!                  ╲
//!                   ╰───────  0
//! ```
//!
//! Where none passes for too long there is another way: see [`super::fall`].
//!
//! Every step is played through from the very positions that the ones before it end with, so what is
//! found keeps the limits as it stands. The search can pause between any two samples, and go on in the
//! next tick: it is about places on the path, not about when they are looked at.

use super::fall::{Fall, Fallen};
use super::play::{Cue, Played, Playing, SET_UP};
use super::steps::{Later, Steps};
use super::{FASTEST, Scene};
use crate::ramp::{Bounds, Ramp};

/// A step to try: which part of the rate goes, and how fast.
#[derive(Debug, Clone, Copy)]
struct Shape {
    part: f64,
    pace: f64,
}

const fn shape(part: f64, pace: f64) -> Shape {
    Shape { part, pace }
}

/// Largest first. The last is the gentlest: where it does not pass, hardly any other does.
const SHAPES: [Shape; 12] = [
    shape(1.0, 1.0),
    shape(1.0, 0.7),
    shape(1.0, 0.45),
    shape(0.6, 0.8),
    shape(0.3, 1.0),
    shape(0.3, 0.6),
    shape(0.12, 1.0),
    shape(0.12, 0.6),
    shape(0.12, 0.35),
    shape(0.05, 0.7),
    shape(0.05, 0.35),
    shape(0.02, 0.4),
];
const GENTLEST: usize = SHAPES.len() - 1;
/// At every so many places all shapes are tried, whatever the gentlest says.
const THOROUGH: u32 = 4;

/// What a search has come to.
#[derive(Debug, Clone, Copy)]
pub(super) enum Outcome {
    /// By the steps of the descent.
    Rest,
    /// There was no time to try everything.
    Open,
    /// The frames at hand do not last.
    Lost,
}

/// A way down, as far as it is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Descent {
    at: Cue,
    rate: f64,
    falls: bool,
    /// A way to a lower rate where no step passes.
    fall: Option<Fall>,
    /// Ticks since the last step.
    waited: u32,
    steps: Steps,
    /// The shape that is tried next at this place, and whether the gentlest has passed here.
    turn: usize,
    may_go: bool,
    /// What the last tick had no time to play to its end.
    playing: Option<Playing>,
    /// Of ramps here and at the next few places.
    bounds: Option<Bounds>,
}

impl Descent {
    /// A search that begins at a place where the rate is steady, and falls where no step passes there
    /// or waits.
    pub(super) const fn new(at: Cue, rate: f64, falls: bool) -> Self {
        Self {
            at,
            rate,
            falls,
            fall: None,
            waited: 0,
            steps: Steps::new(),
            turn: 0,
            may_go: true,
            playing: None,
            bounds: None,
        }
    }

    /// Begins anew. What is not in use is not written.
    pub(super) const fn begin(&mut self, at: Cue, rate: f64, falls: bool) {
        (self.at, self.rate, self.falls) = (at, rate, falls);
        (self.fall, self.playing, self.bounds) = (None, None, None);
        (self.waited, self.turn, self.may_go) = (0, 0, true);
        self.steps.clear();
    }

    /// The way to rest, once it is known.
    pub(super) const fn steps(&self) -> &Steps {
        &self.steps
    }

    /// Goes on until rest, or until the budget is used up.
    pub(super) fn go_on(&mut self, scene: &Scene<'_>, budget: &mut u32) -> Outcome {
        while *budget > SET_UP {
            if let Some(fall) = &mut self.fall {
                match fall.go_on(scene, budget) {
                    Fallen::Lower(at, rate, slopes) => {
                        self.begin(at, rate, false);
                        self.steps = Steps::after(slopes);
                    }
                    Fallen::Open => return Outcome::Open,
                    Fallen::Lost => return Outcome::Lost,
                }
            }
            *budget = budget.saturating_sub(SET_UP);
            let sequence = self.at.time.sequence;
            let bounds = *self
                .bounds
                .get_or_insert_with(|| scene.fastest_from(sequence));
            loop {
                match self.try_next(bounds, scene, budget) {
                    Try::Rest => return Outcome::Rest,
                    Try::Lower => break,
                    Try::Failed if self.turn_to_next() => {}
                    Try::Failed if self.falls => {
                        self.fall = Some(Fall::new(self.at, self.rate, bounds.alpha));
                        break;
                    }
                    Try::Failed => {
                        if !self.wait(scene, budget) {
                            return Outcome::Lost;
                        }
                        break;
                    }
                    Try::Full => return Outcome::Lost,
                    Try::OutOfBudget => return Outcome::Open,
                }
            }
        }
        Outcome::Open
    }

    /// Turns to the next shape at this place; false if there is none.
    const fn turn_to_next(&mut self) -> bool {
        if !self.may_go {
            return false;
        }
        self.turn += 1;
        self.turn < SHAPES.len()
    }

    fn try_next(&mut self, bounds: Bounds, scene: &Scene<'_>, budget: &mut u32) -> Try {
        let mut playing = match self.playing.take() {
            Some(playing) => playing,
            None => match self.next_ramp(bounds) {
                Some(ramp) => Playing::new(ramp, self.at),
                None => return Try::Failed,
            },
        };
        let end = match playing.go_on(scene.track, scene.allowed, budget) {
            Played::Passed(end) => end,
            Played::Barred => return Try::Failed,
            Played::OutOfBudget => {
                self.playing = Some(playing);
                return Try::OutOfBudget;
            }
        };
        if !self.may_go {
            // There is room: now for the largest that passes.
            (self.may_go, self.turn) = (true, 0);
            return Try::Lower;
        }
        let ramp = *playing.ramp();
        let target = ramp.target();
        let step = Later {
            in_ticks: self.waited,
            ramp,
        };
        if !self.steps.push(step) {
            return Try::Full;
        }
        (self.at, self.rate, self.waited, self.turn) = (end, target, 0, 0);
        (self.bounds, self.falls) = (None, false);
        if target > 0.0 { Try::Lower } else { Try::Rest }
    }

    /// The ramp whose turn it is at this place.
    fn next_ramp(&self, bounds: Bounds) -> Option<Ramp> {
        let turn = if self.may_go { self.turn } else { GENTLEST };
        let Shape { part, pace } = *SHAPES.get(turn)?;
        let target = self.rate * (1.0 - part);
        Ramp::plan(self.rate, 0.0, target, bounds.paced(pace))
    }

    /// Stays at the rate for a tick; false if that cannot be.
    fn wait(&mut self, scene: &Scene<'_>, budget: &mut u32) -> bool {
        *budget = budget.saturating_sub(1);
        self.at.time = self.at.time.after(self.rate);
        self.waited += 1;
        self.turn = 0;
        self.may_go = self.waited.is_multiple_of(THOROUGH);
        if self.may_go {
            self.bounds = None;
        }
        let Cue {
            time, published, ..
        } = &mut self.at;
        scene.track.take(*time, published, scene.allowed)
    }
}

/// What trying one step has shown.
enum Try {
    Rest,
    /// A step down, or room for one.
    Lower,
    Failed,
    /// Too many steps.
    Full,
    OutOfBudget,
}

impl Scene<'_> {
    /// Bounds of the fastest ramp worth trying at a place: no axis needs more than its limits for it
    /// at the highest speed ahead.
    pub(super) fn fastest_from(&self, sequence: u64) -> Bounds {
        let stop = self.track.longest_stop(sequence, self.reach);
        Bounds {
            alpha: FASTEST.alpha.min(1.0 / stop.by_acceleration),
            beta: FASTEST.beta.min(1.0 / stop.by_jerk_squared),
        }
    }
}
