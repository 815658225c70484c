//! The choice of a ramp to a goal: the candidates one after the other, within the budget of a tick.

use super::candidate::{CANDIDATES, Candidate, PACES, partial_target, ramp_to};
use super::play::PlaybackPosition;
use super::ramp_trial::{RampTrial, TrialOutcome};
use super::situation::Situation;
use super::state::Rate;
use crate::real_time::ramp::Ramp;

/// Samples a tick may spend on playing candidates through, unless stops are longer. The dearest ticks are
/// made by this and by searches for stops; what is left over goes on in the next tick. No measurement of it
/// is kept.
const BUDGET: u32 = 170;
/// The least change of the rate worth a ramp part of the way: less frees 3 ‰ of the jerk at most.
const LEAST_CHANGE: f64 = 1e-3;
/// A better ramp ends at least this much earlier, ticks.
const GAIN: f64 = 0.5;

impl Rate {
    /// Chooses how to get to a rate: commits a ramp if there is one that passes and is better than
    /// what is committed.
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    pub(crate) fn choose_ramp(&mut self, goal: f64, situation: &Situation<'_>) {
        let heading = self.heading(goal, situation);
        if heading == Some(goal) && self.ramp.as_ref().is_none_or(|ramp| ramp.pace >= PACES[0]) {
            return;
        }
        // On the way to rest at the end of a block nothing but a stop before it is wanted.
        if self.arrives_at().is_some() && goal > 0.0 {
            return;
        }
        if self.now.rate > 0.0 || !situation.published.is_at_rest() {
            self.candidates.barred = 0;
        }
        self.try_candidates(goal, heading, situation);
    }

    /// Tries ramps to a goal, or part of the way, until one passes. Not in line, like all that
    /// looks for a ramp or a stop: what most ticks do not do is not to spread their code and their
    /// stack.
    #[inline(never)]
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    fn try_candidates(&mut self, goal: f64, heading: Option<f64>, situation: &Situation<'_>) {
        let is_heading_there = heading == Some(goal);
        let mut budget = situation.budget(BUDGET);
        if self.go_on_setting_out(goal, situation, &mut budget) {
            return;
        }
        let fastest = situation.fastest_from(self.now.time.sequence);
        let first = core::mem::take(&mut self.candidates.resume_at);
        let mut first_approach = core::mem::take(&mut self.candidates.approach);
        for k in 0..CANDIDATES.len() {
            let turn = (first + k) % CANDIDATES.len();
            let Some(&Candidate { share, pace }) = CANDIDATES.get(turn) else {
                continue;
            };
            if self.now.rate <= 0.0 && self.candidates.barred >= CANDIDATES.len() {
                // Nothing gets away from here that rests at the end of the block, where the plan
                // moves.
                self.arrival.has_missed = situation.block_end.is_some();
                self.candidates.barred = 0;
            }
            self.candidates.barred += 1;
            if !self.is_better(share, pace, goal, heading) {
                continue;
            }
            let target = partial_target(self.now.rate, share, goal);
            if share < 1.0 && (target - self.now.rate).abs() < LEAST_CHANGE {
                continue;
            }
            let within = if is_heading_there {
                self.remaining() - GAIN
            } else {
                f64::INFINITY
            };
            let bounds = fastest.paced(pace);
            let Some(ramp) = ramp_to(&self.now, target, bounds, within, &mut budget) else {
                continue;
            };
            match self.try_ramp(&ramp, situation, first_approach, &mut budget) {
                TrialOutcome::Passed(reserve) => {
                    self.commit(ramp, pace, situation.track.holding_frame(), reserve);
                    return;
                }
                TrialOutcome::Barred => first_approach = 0,
                TrialOutcome::OutOfBudget { approach } => {
                    self.pause_at(turn, k == 0, approach, first_approach);
                    return;
                }
            }
        }
    }

    /// Remembers where the next tick goes on: with the candidate whose turn it is, and with an
    /// approach to the end of a block. What does not fit into the budget of a tick that begins with
    /// it never will; unless it is kept as a trial, it is passed over.
    fn pause_at(
        &mut self,
        turn: usize,
        is_first: bool,
        approach: Option<usize>,
        first_approach: usize,
    ) {
        let candidates = &mut self.candidates;
        candidates.barred -= 1;
        let is_kept = candidates.set_out.is_some();
        let never = usize::from(is_first && !is_kept);
        candidates.resume_at = turn + never * usize::from(approach.is_none());
        candidates.approach = approach
            .filter(|_| !is_kept)
            .map_or(0, |approach| approach.max(first_approach + never));
    }

    /// The rate that is committed; none if a ramp is followed that leads past the end of the block.
    fn heading(&self, goal: f64, situation: &Situation<'_>) -> Option<f64> {
        let Some(followed) = &self.ramp else {
            return Some(self.now.rate);
        };
        let arrives = situation
            .block_end
            .is_none_or(|frame| self.is_to_arrive_at(frame));
        (arrives || goal <= 0.0).then(|| followed.ramp.target())
    }

    /// Whether a candidate, if it passes, is better than what is committed.
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    fn is_better(&self, share: f64, pace: f64, goal: f64, heading: Option<f64>) -> bool {
        let Some(heading) = heading else {
            return true;
        };
        if heading == goal {
            // A steady rate that is the goal is left as it is: this is a ramp.
            return share >= 1.0
                && self
                    .ramp
                    .as_ref()
                    .is_some_and(|followed| pace > followed.pace);
        }
        // The share of the way to the goal that what is committed goes.
        let already = (heading - self.now.rate) / (goal - self.now.rate);
        !already.is_finite() || share > already
    }

    /// Plays a ramp through, and looks for a stop after it if it does not end in one. With a rest
    /// at the end of a block in view, the search for that begins with approach `first_approach`.
    pub(super) fn try_ramp(
        &mut self,
        ramp: &Ramp,
        situation: &Situation<'_>,
        first_approach: usize,
        budget: &mut u32,
    ) -> TrialOutcome {
        let playback = PlaybackPosition {
            time: self.now.time,
            published: *situation.published,
            is_held: true,
        };
        let mut trial = RampTrial::new(ramp, playback, first_approach, situation);
        let outcome = trial.go_on(situation, budget);
        if matches!(outcome, TrialOutcome::OutOfBudget { .. }) {
            if self.now.rate <= 0.0 && situation.published.is_at_rest() {
                self.candidates.set_out = Some(trial);
            } else if trial.searches_stop() {
                return TrialOutcome::Barred;
            }
        }
        outcome
    }

    /// Goes on trying a ramp that leaves a rest. True if that is all there is time for.
    fn go_on_setting_out(
        &mut self,
        goal: f64,
        situation: &Situation<'_>,
        budget: &mut u32,
    ) -> bool {
        let Some(mut trial) = self.candidates.set_out.take() else {
            return false;
        };
        let is_as_it_was = self.now.rate <= 0.0
            && self.ramp.is_none()
            && situation.published.is_at_rest()
            && trial.is_about(situation);
        if !is_as_it_was || trial.ramp().target() > goal {
            return false;
        }
        match trial.go_on(situation, budget) {
            TrialOutcome::Passed(reserve) => {
                self.commit(*trial.ramp(), 0.0, trial.holding_frame(), reserve);
            }
            TrialOutcome::OutOfBudget { .. } => self.candidates.set_out = Some(trial),
            TrialOutcome::Barred => {
                self.candidates.resume_at += 1;
                self.candidates.barred += 1;
                return false;
            }
        }
        true
    }
}
