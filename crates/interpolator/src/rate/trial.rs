//! Trying a ramp: it must pass, and a stop after it must be known.
//!
//! Where the motion stands the next tick finds everything as it was: there a trial that has used up the
//! budget of a tick is kept, and goes on. Where it moves, the next tick is another place.

use super::arrival::{Arrival, Search};
use super::descent::{Descent, Outcome};
use super::play::{Cue, Played, Playing};
use super::reserve::{Reserve, Steady};
use super::{Rate, Scene};
use crate::ramp::Ramp;

/// The stop after a ramp begins no earlier than so many ticks after its end, if there are frames for
/// that: in these a later one is found.
const AFTERWARDS: u32 = 12;

/// What trying a ramp has shown.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum Trial {
    Passed(Option<Reserve>),
    Barred,
    /// There was no time to try everything: on the way to the end of a block, from this approach on.
    OutOfBudget {
        approach: Option<usize>,
    },
}

/// A trial, as far as it has come.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trying {
    ramp: Ramp,
    /// The approach with which the search for a rest at the end of the block begins.
    search_at: usize,
    stage: Stage,
    /// Ticks of the steady rate between the ramp and a stop.
    goes_on: u32,
    /// What held the motion, and was to, when it began.
    stop: Option<u64>,
    block_end: Option<u64>,
}

#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one of them; no boxes here"
)]
enum Stage {
    Ramp(Playing),
    /// After it: down to any rest, or to the one at the end of the block.
    Descent(Descent),
    Arrival(Arrival),
}

impl Trying {
    fn new(ramp: &Ramp, cue: Cue, search_at: usize, scene: &Scene<'_>) -> Self {
        Self {
            ramp: *ramp,
            search_at,
            stage: Stage::Ramp(Playing::new(*ramp, cue)),
            goes_on: 0,
            stop: scene.track.stop(),
            block_end: scene.block_end,
        }
    }

    fn go_on(&mut self, scene: &Scene<'_>, budget: &mut u32) -> Trial {
        if let Stage::Ramp(playing) = &mut self.stage {
            let end = match playing.go_on(scene.track, scene.allowed, budget) {
                Played::Passed(_) if self.ramp.target() <= 0.0 => return Trial::Passed(None),
                Played::Passed(end) => end,
                Played::Barred => return Trial::Barred,
                Played::OutOfBudget => return Trial::OutOfBudget { approach: None },
            };
            let rate = self.ramp.target();
            let steady = Steady {
                time: end.time,
                rate,
            };
            if let Some(frame) = self.block_end {
                let Some(arrival) = Arrival::at(frame, steady, self.search_at, scene) else {
                    return Trial::Barred;
                };
                self.stage = Stage::Arrival(arrival);
            } else if self.stop.is_some() {
                return Trial::Passed(None);
            } else {
                let later = scene.is_fully_supplied.then_some(AFTERWARDS);
                let at = later.and_then(|ticks| steady.cue(f64::from(ticks), scene));
                self.goes_on = later.filter(|_| at.is_some()).unwrap_or(0);
                let at = at.unwrap_or(Cue {
                    is_held: false,
                    ..end
                });
                self.stage = Stage::Descent(Descent::new(at, rate, false));
            }
        }
        self.rest_after(scene, budget)
    }

    /// Looks for a rest after the ramp.
    fn rest_after(&mut self, scene: &Scene<'_>, budget: &mut u32) -> Trial {
        match &mut self.stage {
            Stage::Ramp(_) => Trial::Barred,
            Stage::Descent(descent) => match descent.go_on(scene, budget) {
                Outcome::Rest => {
                    let mut steps = *descent.steps();
                    steps.delay(self.goes_on);
                    Trial::Passed(Some(Reserve {
                        steps,
                        arrives_at: None,
                    }))
                }
                Outcome::Open => Trial::OutOfBudget { approach: None },
                Outcome::Lost => Trial::Barred,
            },
            Stage::Arrival(arrival) => match arrival.go_on(scene, budget) {
                Search::Found(reserve) => Trial::Passed(Some(reserve)),
                Search::Open => Trial::OutOfBudget {
                    approach: Some(arrival.place()),
                },
                Search::Barred | Search::OutOfReach => Trial::Barred,
            },
        }
    }
}

impl Rate {
    /// Plays a ramp through, and looks for a stop after it if it does not end in one. With a rest at
    /// the end of a block in view, the search for that begins with approach `search_at`.
    pub(super) fn try_ramp(
        &mut self,
        ramp: &Ramp,
        scene: &Scene<'_>,
        search_at: usize,
        budget: &mut u32,
    ) -> Trial {
        let cue = Cue {
            time: self.now,
            published: *scene.published,
            is_held: true,
        };
        let mut trying = Trying::new(ramp, cue, search_at, scene);
        let trial = trying.go_on(scene, budget);
        if matches!(trial, Trial::OutOfBudget { .. }) {
            if self.rate <= 0.0 && scene.published.is_at_rest() {
                self.set_out = Some(trying);
            } else if matches!(trying.stage, Stage::Descent(_)) {
                return Trial::Barred;
            }
        }
        trial
    }

    /// Goes on trying a ramp that leaves a rest. True if that is all there is time for.
    pub(super) fn go_on_setting_out(
        &mut self,
        goal: f64,
        scene: &Scene<'_>,
        budget: &mut u32,
    ) -> bool {
        let Some(mut trying) = self.set_out.take() else {
            return false;
        };
        let is_as_it_was = self.rate <= 0.0
            && self.ramp.is_none()
            && scene.published.is_at_rest()
            && scene.track.stop() == trying.stop
            && scene.block_end == trying.block_end;
        if !is_as_it_was || trying.ramp.target() > goal {
            return false;
        }
        match trying.go_on(scene, budget) {
            Trial::Passed(reserve) => {
                self.commit(trying.ramp, 0.0, reserve);
                self.held_at = trying.stop;
            }
            Trial::OutOfBudget { .. } => self.set_out = Some(trying),
            Trial::Barred => {
                self.resume_at += 1;
                self.barred += 1;
                return false;
            }
        }
        true
    }
}
