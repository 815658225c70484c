//! Trying a ramp: it must pass, and a stop after it must be known.

use super::arrival::Search;
use super::descent::{Descent, Outcome};
use super::play::{Cue, Played, play};
use super::reserve::{Reserve, Steady};
use super::{BUDGET, Rate, Scene};
use crate::ramp::Ramp;

/// What trying a ramp has shown.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum Trial {
    Passed(Option<Reserve>),
    Barred,
    OutOfBudget,
}

impl Rate {
    /// Plays a ramp through, and looks for a stop after it if it does not end in one.
    pub(super) fn try_ramp(
        &mut self,
        ramp: &Ramp,
        scene: &Scene<'_>,
        search_at: &mut usize,
        budget: &mut u32,
    ) -> Trial {
        let cue = Cue {
            time: self.now,
            published: *scene.published,
            is_held: true,
        };
        let end = match play(ramp, cue, scene, budget) {
            Played::Passed(_) if ramp.target() <= 0.0 => return Trial::Passed(None),
            Played::Passed(end) => end,
            Played::Barred => return Trial::Barred,
            Played::OutOfBudget => return Trial::OutOfBudget,
        };
        if let Some(frame) = scene.block_end {
            let steady = Steady {
                time: end.time,
                rate: ramp.target(),
            };
            return match Reserve::arriving_at(frame, steady, scene, search_at, budget) {
                Search::Found(reserve) => Trial::Passed(Some(reserve)),
                Search::Open => Trial::OutOfBudget,
                Search::Barred | Search::OutOfReach => Trial::Barred,
            };
        }
        if scene.track.stop().is_some() {
            return Trial::Passed(None);
        }
        let at = Cue {
            is_held: false,
            ..end
        };
        let mut descent = Descent::new(at, ramp.target());
        match descent.go_on(scene, budget) {
            Outcome::Rest(steps) => Trial::Passed(Some(Reserve {
                steps,
                arrives_at: None,
            })),
            // Where the motion stands the next tick finds everything as it was, and goes on.
            Outcome::Open if self.rate <= 0.0 && scene.published.is_at_rest() => {
                self.set_out = Some((*ramp, descent));
                Trial::OutOfBudget
            }
            Outcome::Open | Outcome::Lost => Trial::Barred,
        }
    }

    /// Goes on with the search for a stop after a ramp that leaves a rest. True if that is all there
    /// is time for.
    pub(super) fn go_on_setting_out(&mut self, goal: f64, scene: &Scene<'_>) -> bool {
        let Some((ramp, mut descent)) = self.set_out.take() else {
            return false;
        };
        let is_as_it_was = self.rate <= 0.0
            && self.ramp.is_none()
            && scene.published.is_at_rest()
            && scene.track.stop().or(scene.block_end).is_none();
        if !is_as_it_was || ramp.target() > goal {
            return false;
        }
        match descent.go_on(scene, &mut scene.budget(BUDGET)) {
            Outcome::Rest(steps) => {
                let arrives_at = None;
                self.commit(ramp, 0.0, Some(Reserve { steps, arrives_at }));
            }
            Outcome::Open => self.set_out = Some((ramp, descent)),
            Outcome::Lost => {
                self.resume_at += 1;
                return false;
            }
        }
        true
    }
}
