//! What a window is worth, against stopping at every vertex and against going on without it.

use super::state::{ActiveMotion, PlannerState};
use crate::in_tube::fallback::{TRUST_PERIODS, arrival_t};
use crate::in_tube::period::State;
use crate::in_tube::window::{Grid, LEAST_INTERVALS, View, WindowMotion, at_feed_r};
use glidepath_geometry::feed_length;

/// What goes on at the feed is handed out without another window, up to so long before it slows
/// down, s. No measurement of it is kept.
const SETTLING_T: f64 = 0.05;

/// What a window may lose of its lead over the baseline, of the time it is handed out for. No measurement
/// of it is kept.
const LITTLE_R: f64 = 0.05;

/// What a rest at the end of the path counts, in periods, because a baseline rests there until its period is over,
/// too. A little less than the whole, so that the baseline wins a tie. With the whole none of 35 programs changed.
const END_PERIODS: f64 = 1.0 - 1e-6;

/// A window that may be taken.
pub(super) struct Candidate {
    pub(super) motion: WindowMotion,
    /// Its gain, from the next window on.
    pub(super) gain_t: Option<f64>,
    /// Periods that can be handed out without falling behind: up to the next window, or less.
    pub(super) commit: usize,
}

impl Candidate {
    /// True if it is better than what is done without it, whose gain is given: it leads by more, or
    /// by hardly less and is ahead of the baseline at all. To halt for what a window has lost by
    /// keeping a little below the feed would lose far more.
    ///
    /// Without a baseline, as after a change of rates, no gain is known, and `None` is less than any that is:
    /// every window is worth it then. That it goes about as far as the tail was asked when it was found
    /// (`NO_LESS_R`).
    pub(super) fn is_worth(&self, stay_t: Option<f64>, period_t: f64) -> bool {
        #[expect(clippy::cast_precision_loss, reason = "hundreds")]
        let little_t = LITTLE_R * self.commit as f64 * period_t;
        match (self.gain_t, stay_t) {
            (Some(gain_t), Some(stay_t)) => gain_t >= stay_t.min((stay_t - little_t).max(0.0)),
            (gain_t, stay_t) => gain_t >= stay_t,
        }
    }
}

impl PlannerState {
    /// What a motion from now on is worth. It has passed the judge: what is found here is its gain.
    pub(super) fn appraise(&mut self, grid: &Grid, view: &View, motion: WindowMotion) -> Candidate {
        let mut history = self.history.clone();
        let mut follower = self.follower.to(view.pieces.end);
        let periods = grid.periods_in(motion.points.len() - 3);
        let usual = if motion.is_rest {
            periods
        } else {
            commit(grid, view).min(periods)
        };
        let mut candidate = Candidate {
            motion,
            gain_t: None,
            commit: usual,
        };
        let mut gains_t = Vec::with_capacity(periods);
        let mut feed_until = usual;
        for period in 1..=periods {
            let points = &candidate.motion.points;
            let next = grid.state(points, period);
            let way = (&self.reference_path, &mut follower);
            history.follow(&self.limits, self.period_t, way, &next);
            let index = follower.reachable.last();
            if period == feed_until + 1 && self.is_at_feed(index, &next) {
                feed_until = period;
            }
            gains_t.push(self.state_gain_t(index, &next, period));
        }
        let settled = feed_until.saturating_sub(self.settling_periods());
        let usual = usual.max(settled / grid.periods * grid.periods);
        candidate.commit = usual;
        let mut safe = None;
        for (period, gain_t) in (1..).zip(gains_t) {
            let Some(mut gain_t) = gain_t else {
                continue;
            };
            match (period == periods, candidate.motion.is_end) {
                (true, true) => gain_t += END_PERIODS * self.period_t,
                (true, false) => {}
                _ => gain_t -= TRUST_PERIODS * self.period_t,
            }
            if period >= usual {
                candidate.gain_t = Some(candidate.gain_t.map_or(gain_t, |most| most.max(gain_t)));
            } else if gain_t >= 0.0 && period % grid.periods == 0 {
                safe = Some(period);
            }
        }
        if let Some(safe) = safe.filter(|_| candidate.gain_t.is_none_or(|gain_t| gain_t < 0.0)) {
            candidate.commit = safe;
        }
        candidate
    }

    /// True if a motion on a piece is as fast as it may be.
    pub(super) fn is_at_feed(&self, index: usize, state: &State) -> bool {
        let turned_v = feed_length(&state.acceleration) * self.period_t;
        let turn = turned_v / feed_length(&state.velocity);
        self.reference_path
            .get(index)
            .is_some_and(|piece| piece.path_v(&state.velocity) >= at_feed_r(turn) * piece.top_v)
    }

    /// Periods before a motion slows down in which it may be shaped by that.
    fn settling_periods(&self) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few periods, or some hundred"
        )]
        let periods = (SETTLING_T / self.period_t).ceil() as usize;
        periods
    }

    /// The gain of a state some periods from now.
    fn state_gain_t(&mut self, index: usize, state: &State, period: usize) -> Option<f64> {
        let piece = self.reference_path.get(index)?;
        let arrival_t = arrival_t(&self.limits, piece, state)?;
        let machine = (&self.limits, self.joint_rows.as_ref());
        let baseline = self.baseline.as_mut()?;
        let baseline_t = baseline.end_t(machine, &self.reference_path, index)?;
        Some(baseline_t - self.periods_t(self.clock + period) - arrival_t)
    }

    /// The gain if no window is found: of the leg, or of the rest that the last window ends with.
    pub(super) fn stay_gain_t(&mut self, grid: &Grid) -> Option<f64> {
        if let ActiveMotion::Legs {
            leg: Some(leg),
            leg_t,
            ..
        } = &self.active
        {
            let end_t = self.clock_t() - leg_t + leg.arrival_t();
            let machine = (&self.limits, self.joint_rows.as_ref());
            let baseline = self.baseline.as_mut()?;
            let baseline_t = baseline.end_t(machine, &self.reference_path, leg.piece)?;
            return Some(baseline_t - end_t);
        }
        let points = self.tail(grid, 0);
        let view = self.view(grid, LEAST_INTERVALS)?;
        let rest = WindowMotion {
            points,
            is_rest: true,
            is_end: false,
        };
        self.appraise(grid, &view, rest).gain_t
    }
}

/// Periods after which the next window starts: those of a third of the intervals, for the reason that is
/// told at [`LEAST_INTERVALS`].
pub(super) fn commit(grid: &Grid, view: &View) -> usize {
    grid.periods_in(grid.whole_periods(view.intervals / 3).max(grid.knots))
}
