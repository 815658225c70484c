//! One attempt: rounds of giving out samples, solving and projecting, in phases that leave more and more room.

use super::{JudgeQuestion, Optimiser};
use crate::in_tube::window::rounds::{BestMotion, ENOUGH_VIOLATION, RoundState, gains};
use crate::in_tube::window::scaled_path::ScaledPath;
use crate::in_tube::window::tube::{FEED_R, SEARCH_STEERING, STEERING, Style};
use crate::in_tube::window::window_start::WindowStart;

/// Rounds in which samples change pieces, and rounds in which they do not; what of the radius is
/// used in them.
struct Phase {
    search: usize,
    polish: usize,
    keep_r: f64,
}

/// The rounds of one attempt: what comes and goes at the edge of the tube is given more and more
/// room. A phase ends with the first round of polishing that passes or exceeds rows for good; the attempt once
/// progress settles, or where from the second phase on rows are exceeded and nothing has passed. (If the first
/// phase ended it, too, five of 35 programs would be .1 to 2 % faster and one .1 % slower; if none did, three .3 to
/// .8 % slower.)
/// The fastest motion that has passed is kept, so the smaller radii of later phases cost no time of it.
/// Of the numbers no measurement is kept.
const PHASES: [Phase; 3] = [
    Phase {
        search: 3,
        polish: 3,
        keep_r: 0.995,
    },
    Phase {
        search: 2,
        polish: 3,
        keep_r: 0.97,
    },
    Phase {
        search: 2,
        polish: 3,
        keep_r: 0.92,
    },
];
/// Rounds of polishing more where joints are not the axes.
const MORE_POLISH: usize = 3;
/// Lines may leave the path by this many radii while searching: large, so that a sample that is on a
/// piece too early or too late does not bind the motion before it is given out again. Careful attempts
/// and rounds of polishing have 1 in its place. No measurement of it is kept.
const SEARCH_STRAY_R: f64 = 12.0;
/// A motion of no solution whose samples are further off than this, in radii, is not gone on from. No
/// measurement of it is kept.
const FAR_OFF_R: f64 = 3.0;
/// Where samples come out further off than this while searching, in radii, they are given out half-way
/// back, from the third round on: else some problems go there and back between too early and too late.
const TOO_FAR_R: f64 = 1.02;
/// Rounds of a search that may go there and back ([`TOO_FAR_R`]).
const FREE_ROUNDS: usize = 2;

impl<const D: usize> Optimiser<D> {
    /// One attempt: rounds of giving out, solving and projecting, in which `found` gets the best
    /// motion that passes. In the later rounds of a phase the samples stay where they are.
    pub(super) fn iterate(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        is_careful: bool,
        judge: &mut impl FnMut(&[[f64; D]], JudgeQuestion) -> bool,
        found: &mut BestMotion<D>,
    ) {
        let mut round_state = RoundState::starting(window_start.tail);
        let has_joints = path.joints().is_some();
        let more = if has_joints { MORE_POLISH } else { 0 };
        for (number, phase) in PHASES.iter().enumerate() {
            let best_before = found.best.as_ref().map(|best| best.0);
            for round in 0..phase.search + phase.polish + more {
                if self.interior.is_spent() {
                    return;
                }
                // The first round of polishing still takes what the last search has shown.
                if round <= phase.search {
                    self.samples.assign(path, window_start.piece);
                }
                let is_polish = round >= phase.search;
                let is_wide = !is_polish && !is_careful;
                let usual = window_start.style(round_state.has_motion);
                let style = Style {
                    stray_r: if is_wide { SEARCH_STRAY_R } else { 1.0 },
                    steering: if is_wide { SEARCH_STEERING } else { STEERING },
                    is_feed_firm: is_polish || round_state.is_exceeding,
                    keep_r: phase.keep_r,
                    feed_r: if is_polish {
                        round_state.feed_r
                    } else {
                        FEED_R
                    },
                    attraction: if is_polish && number > 0 {
                        round_state.firm_pull(usual.attraction)
                    } else {
                        usual.attraction
                    },
                    keeps_progress: is_polish && has_joints,
                    ..usual
                };
                let given = self.samples.progress.clone();
                let may_lead = round + 1 < phase.search;
                let is_solved =
                    self.take_round(path, window_start, &style, may_lead, &mut round_state);
                if is_polish && is_solved {
                    round_state.learn_feed(style.feed_r);
                }
                let mean_t = self.samples.mean_t(path);
                let passes = is_solved && judge(&round_state.points, JudgeQuestion::IsValid);
                if passes {
                    found.add(mean_t, &round_state.points, &self.samples);
                }
                let has_settled = if style.keeps_progress {
                    // Against the phase before: within this one it does not go on.
                    best_before.is_some_and(|best_t| !gains(best_t, mean_t))
                } else {
                    round_state.has_settled(mean_t)
                };
                if passes && has_settled {
                    return;
                }
                round_state.mean_t = mean_t;
                if is_polish && round_state.is_exceeding && number > 0 && found.best.is_none() {
                    // Samples are on pieces that the motion cannot reach in time.
                    return;
                }
                if is_polish && (passes || round_state.is_exceeding) {
                    break;
                }
                if !is_polish && self.samples.worst_r > TOO_FAR_R && round >= FREE_ROUNDS {
                    self.samples.go_half_way(&given);
                }
            }
        }
    }

    /// Solves and projects. True if there is a solution.
    pub(in crate::in_tube::window) fn take_round(
        &mut self,
        path: &ScaledPath<D>,
        window_start: &WindowStart<'_, D>,
        style: &Style,
        may_lead: bool,
        round_state: &mut RoundState<D>,
    ) -> bool {
        let mut next = round_state.points.clone();
        let is_exact = style.stray_r <= 1.0;
        let is_solved = self.solve(path, style, &mut next, false, is_exact);
        if is_solved {
            round_state.speed_r =
                self.cutting_planes
                    .learn(path, &self.samples, &next, &window_start.grid);
        }
        round_state.is_exceeding = self.interior.violation() > ENOUGH_VIOLATION;
        let grid = &window_start.grid;
        self.samples
            .project(path, &next, window_start.piece, grid, may_lead);
        // What is not solved may still be a better start than the last one, if it is near the path.
        if is_solved || self.samples.worst_r < FAR_OFF_R {
            round_state.points = next;
            round_state.has_motion = true;
        }
        is_solved
    }
}
