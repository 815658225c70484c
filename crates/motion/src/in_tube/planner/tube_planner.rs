//! The planner of a stretch, as the engine uses it.

use super::state::{ActiveMotion, PlannerState};
use crate::in_tube::path::Reference;
use crate::in_tube::period::Period;
use crate::in_tube::verify::FEED_SLACK;
use crate::in_tube::window::SearchBias;
use crate::joints::SharedJoints;
use crate::programmed_rate::PieceRate;
use glidepath_geometry::AxisVector;
use glidepath_program::{Corners, Limits};

/// Plans one stretch of motion between two rests.
#[derive(Debug, Clone)]
pub(crate) struct TubePlanner {
    pub(crate) state: PlannerState,
    /// More of the path is needed, and has not come yet: it comes line by line, and all that planning
    /// finds out without it would be the same.
    is_waiting: bool,
}

impl TubePlanner {
    /// A planner for a machine at rest at `start`, period in seconds.
    pub(crate) fn new(limits: &Limits, period_t: f64, start: AxisVector, bias: SearchBias) -> Self {
        Self {
            state: PlannerState::new(limits, period_t, start, bias),
            is_waiting: false,
        }
    }

    /// The same planner, before its first piece, for joints that are not the axes.
    pub(crate) fn with_joints(mut self, joints: SharedJoints) -> Self {
        self.state = self.state.with_joints(joints);
        self
    }

    /// The same planner, before its first piece, on other sides of corners than the usual ones.
    pub(crate) const fn with_corners(mut self, corners: Corners) -> Self {
        self.state.corners = corners;
        self
    }

    /// The path goes on. A piece of length zero counts for nothing.
    ///
    /// Where merging has left out vertices, the path with them and the path without must be within
    /// some distance of each other both ways and in order, and the tolerance be smaller by that
    /// distance: then each vertex that was left out is within the full tolerance of the motion.
    pub(crate) fn push(&mut self, piece: Reference) {
        self.state.reference_path.push(piece);
        self.is_waiting = false;
    }

    /// The path ends with what has been pushed, at rest.
    pub(crate) fn finish(&mut self) {
        self.state.reference_path.finish();
        self.is_waiting = false;
    }

    /// True when the end of the path has been reached and handed out, or there is no path.
    pub(crate) fn is_over(&self) -> bool {
        self.state.is_over || self.state.reference_path.is_empty_and_finished()
    }

    /// Multiplications of the solvers so far.
    pub(crate) fn work(&self) -> usize {
        self.state.optimisers.work()
    }

    /// Other speeds for the path from here on, by tag; the motion is planned again from the state
    /// handed out last. Where no speed is another one it stays: a thread cut under another override
    /// is the same to the bit.
    pub(crate) fn set_rates(&mut self, rate_of: impl FnMut(u64) -> PieceRate) {
        let before_v = self.state.reference_path.counted_v();
        if !self.state.reference_path.set_rates(rate_of) {
            return;
        }
        self.is_waiting = false;
        self.state.history.overspeed_v = self.state.history.overspeed_v.max(before_v * FEED_SLACK);
        self.state.baseline = None;
        match (&mut self.state.active, &self.state.grid) {
            (
                ActiveMotion::Window {
                    is_end,
                    done,
                    commit,
                    ..
                },
                Some(grid),
            ) => {
                *is_end = false;
                *commit = (*commit).min(done.div_ceil(grid.periods) * grid.periods);
            }
            (ActiveMotion::Legs { is_stale, .. }, _) => *is_stale = true,
            _ => {}
        }
    }

    /// The state one period further, if what is known of the path settles it.
    ///
    /// `None`: more of the path is needed, or the motion is at rest at its end ([`Self::is_over`]).
    pub(crate) fn next_period(&mut self) -> Option<Period> {
        if self.state.is_over || self.is_waiting {
            return None;
        }
        let period = self.plan_period();
        self.is_waiting = period.is_none();
        period
    }

    fn plan_period(&mut self) -> Option<Period> {
        let mut period = loop {
            match &self.state.active {
                ActiveMotion::Window { done, commit, .. } if done < commit => {
                    break self.next_of_window()?;
                }
                ActiveMotion::Legs { leg: Some(_), .. } if !self.state.is_trial_due() => {
                    break self.state.next_of_legs()?;
                }
                _ => self.state.plan()?,
            }
        };
        self.state.clock += 1;
        let reachable = &self.state.follower.reachable;
        self.state.progress = reachable.nearest(
            &self.state.reference_path,
            &period.position,
            self.state.progress,
        );
        if let Some(piece) = self.state.reference_path.get(self.state.progress.0) {
            period.path_s = piece.start_s + piece.length_s * self.state.progress.1;
            period.tag = piece.tag;
            period.path_v = piece.path_v(&period.velocity);
        }
        let kept = self.state.follower.first().min(self.state.progress.0);
        self.state.reference_path.forget_before(kept);
        if let Some(baseline) = &mut self.state.baseline {
            baseline.forget_before(kept);
        }
        period.rest_at_end = self.state.is_over;
        Some(period)
    }

    /// One period of a window.
    fn next_of_window(&mut self) -> Option<Period> {
        let ActiveMotion::Window {
            points,
            is_end,
            done,
            ..
        } = &mut self.state.active
        else {
            return None;
        };
        let grid = self.state.grid.as_ref()?;
        *done += 1;
        let state = grid.state(points, *done);
        self.state.is_over = *is_end && *done == grid.periods_in(points.len() - 3);
        let way = (&self.state.reference_path, &mut self.state.follower);
        let followed =
            self.state
                .history
                .follow(&self.state.limits, self.state.period_t, way, &state);
        // Too fast for a rate that was lowered meanwhile is all that it may be.
        followed.is_there().then_some(Period {
            velocity: state.velocity,
            acceleration: state.acceleration,
            ..Period::rest(state.position)
        })
    }
}
