//! What moves the machine next: a leg, a window, or what is left of the last window.
//!
//! ```text
//!            ┌────────── leg from vertex to vertex ◄── at rest
//!            ▼ shortly before it would brake
//!     window from its state ──► ahead of the leg: window ──► window ──► …
//!                          └──► else: the leg goes on, and some more legs follow
//! ```
//!
//! Whatever is taken keeps the gain over [`Baseline`]: a leg does by itself, a window
//! is taken if it leads by more than what would be done without it.

use super::state::{ActiveMotion, MOST_LEGS, PlannerState};
use super::worth::{Candidate, commit};
use crate::in_tube::fallback::{Baseline, StopLeg};
use crate::in_tube::path::{Bounds, Displacement, TubePiece, directional};
use crate::in_tube::verify::NearPieces;
use crate::in_tube::window::{
    FEED_INTERVALS, Grid, LEAST_INTERVALS, View, WindowContext, WindowSearch, first_work, left_work,
};
use crate::joints::alone;
use glidepath_geometry::{AXES, AxisVector, ROTARY_ABC, feed_length};

/// Intervals before a leg brakes at which a window is tried: it begins nearly as fast as the leg
/// gets. No measurement of it is kept.
const TRIAL_INTERVALS: f64 = 4.0;
/// One part in so many of what is usually handed out of a window is worth handing out by itself. No
/// measurement of it is kept.
const LEAST_COMMIT: usize = 4;
/// A window that would have to stop in less than one part in so many of the way that takes is not
/// tried. No measurement of it is kept.
const FAR_TOO_FAST: f64 = 2.0;

impl PlannerState {
    /// True if a window is to be tried before the leg under way goes on.
    pub(crate) fn is_trial_due(&self) -> bool {
        match (&self.active, &self.grid) {
            (ActiveMotion::Legs { is_stale: true, .. }, _) => true,
            (
                ActiveMotion::Legs {
                    leg: Some(leg),
                    leg_t,
                    wait: 0,
                    ..
                },
                Some(grid),
            ) => {
                // In front of a short cruise the leg has acceleration left, with which a window would be too fast.
                let brakes_in_t = leg.eager_t() - leg_t;
                let is_cruising = *leg_t >= leg.cruise_from_t();
                brakes_in_t <= TRIAL_INTERVALS * grid.knot_t
                    && (is_cruising || brakes_in_t <= self.period_t)
            }
            _ => false,
        }
    }

    /// Plans what moves the machine next. `None` if more of the path is needed, or none is left.
    pub(crate) fn plan(&mut self) -> Option<()> {
        let grid = match self.grid {
            Some(grid) => grid,
            None => wanted_grid(self, self.reference_path.get(0)?),
        };
        self.grid = Some(grid);
        if self.is_at_rest(&grid) {
            return self.set_out();
        }
        let view = self.view(&grid, LEAST_INTERVALS)?;
        if let ActiveMotion::Legs {
            wait,
            is_stale: false,
            ..
        } = &mut self.active
            && view.pieces.end - self.progress.0 == 1
        {
            // Nothing is faster along the last piece.
            *wait = usize::MAX;
            return Some(());
        }
        let far = if self.is_at_feed(self.progress.0, self.history.state()) {
            Some(self.view(&grid, FEED_INTERVALS)?)
        } else {
            None
        };
        let work = self.optimisers.work();
        let stay_t = self.stay_gain_t(&grid);
        let mut seen = view.pieces.end;
        let going_on = far.and_then(|far| {
            let window = self.go_on_at_feed(&grid, &far, stay_t)?;
            seen = far.pieces.end;
            Some(window)
        });
        let best = going_on.or_else(|| self.best_window(&grid, &view, (stay_t, work)));
        // Never less than before: what is left of the last window may go as far as that one saw.
        self.follower.end = self.follower.end.max(seen);
        if let Some(Candidate { motion, commit, .. }) = best {
            self.legs = 1;
            self.active = ActiveMotion::Window {
                points: motion.points,
                is_end: motion.is_end,
                done: 0,
                commit,
            };
            return Some(());
        }
        match &mut self.active {
            ActiveMotion::Legs { wait, is_stale, .. } => {
                *is_stale = false;
                *wait = self.legs;
                self.legs = (2 * self.legs).min(MOST_LEGS);
            }
            _ => {
                // From a little further on a window may be found, before this one has slowed down.
                let points = self.tail(&grid, view.intervals);
                let soon = commit(&grid, &view) / LEAST_COMMIT;
                self.active = ActiveMotion::Window {
                    commit: soon.next_multiple_of(grid.periods).max(grid.periods),
                    points,
                    is_end: false,
                    done: 0,
                };
            }
        }
        Some(())
    }

    /// The window to take, if there is one that is better than to go on without, which gains
    /// `stay_t`. `work` was done before planning began.
    fn best_window(
        &mut self,
        grid: &Grid,
        view: &View,
        (stay_t, work): (Option<f64>, usize),
    ) -> Option<Candidate> {
        let tail = &self.tail(grid, view.intervals);
        let has_joints = self.joints.is_some();
        let first_work = first_work(has_joints);
        let window = self.try_window(grid, view, tail, WindowSearch::Whole(first_work));
        let is_late = |window: &Candidate| window.gain_t.is_none_or(|gain_t| gain_t < 0.0);
        let may_halt =
            matches!(self.active, ActiveMotion::Window { .. }) && self.baseline.is_some();
        if !may_halt || window.as_ref().is_some_and(|window| !is_late(window)) {
            return window.filter(|window| window.is_worth(stay_t, self.period_t));
        }
        let usual = commit(grid, view);
        let is_early =
            |window: &Candidate| window.commit < usual && LEAST_COMMIT * window.commit >= usual;
        if window.as_ref().is_some_and(is_early) {
            // It is too early to know.
            return window;
        }
        let left_work = left_work(has_joints, self.optimisers.work() - work);
        let halt = self.try_halt(grid, view, tail, WindowSearch::Whole(left_work));
        // A gain that is known beats none: `None` is less than any. While the last window leads by as much, from a
        // little further on a better one may be found.
        let halt = halt.filter(|halt| halt.gain_t >= stay_t);
        let mut all = [window, halt].into_iter().flatten();
        let first = all.next()?;
        let best = all.fold(first, |a, b| if b.gain_t > a.gain_t { b } else { a });
        Some(best).filter(|best| best.is_worth(stay_t, self.period_t))
    }

    /// From rest: a leg to the next vertex.
    fn set_out(&mut self) -> Option<()> {
        if self.is_at_end() {
            self.is_over = true;
            return None;
        }
        // What is only within a wide tolerance is driven to when the feed before it has ended.
        let from = self.history.last();
        let near = NearPieces::of(&self.reference_path, &self.follower.reachable, &from);
        let leg = self.leg_from(from, near.last)?;
        if self.baseline.is_none() {
            let end_t = self.clock_t() + leg.arrival_t();
            self.baseline = Some(Baseline::new(leg.piece, end_t));
        }
        self.active = ActiveMotion::Legs {
            leg: Some(Box::new(leg)),
            leg_t: 0.0,
            wait: 0,
            is_stale: false,
        };
        Some(())
    }

    pub(super) fn view(&self, grid: &Grid, least_intervals: usize) -> Option<View> {
        let first = self.follower.first();
        View::new(
            &self.limits,
            &self.reference_path,
            grid,
            first,
            self.progress,
            least_intervals,
        )
    }

    /// A window in which nothing but the feed binds, if it is one.
    fn go_on_at_feed(
        &mut self,
        grid: &Grid,
        view: &View,
        stay_t: Option<f64>,
    ) -> Option<Candidate> {
        let tail = self.tail(grid, view.intervals);
        let window = self.try_window(grid, view, &tail, WindowSearch::AtFeed)?;
        Some(window).filter(|window| window.is_worth(stay_t, self.period_t))
    }

    /// A window, and what it is worth.
    fn try_window(
        &mut self,
        grid: &Grid,
        view: &View,
        tail: &[AxisVector],
        search: WindowSearch,
    ) -> Option<Candidate> {
        let setting = WindowContext {
            limits: &self.limits,
            period_t: self.period_t,
            joints: &self.joints,
            corners: self.corners,
            grid,
            reference_path: &self.reference_path,
            history: &self.history,
            follower: &self.follower,
            progress: self.progress,
            end: view.pieces.end,
            commit: commit(grid, view),
            keeps_rates: !matches!(self.active, ActiveMotion::Legs { is_stale: true, .. }),
            search,
            bias: self.bias,
        };
        let motion = self.optimisers.attempt(&setting, view, tail)?;
        Some(self.appraise(grid, view, motion))
    }

    /// A window that rests at the end of the piece the motion is on, if that is in view.
    fn try_halt(
        &mut self,
        grid: &Grid,
        view: &View,
        tail: &[AxisVector],
        search: WindowSearch,
    ) -> Option<Candidate> {
        let end = self.follower.reachable.last() + 1;
        if end >= view.pieces.end || !self.may_rest_before(end) {
            return None;
        }
        let view = View {
            pieces: view.pieces.start..end,
            is_halt: true,
            ..*view
        };
        self.try_window(grid, &view, tail, search)
    }

    /// False if the motion is far too fast to rest at the end of the piece before `end`.
    fn may_rest_before(&self, end: usize) -> bool {
        let Some(piece) = self.reference_path.get(end - 1) else {
            return false;
        };
        let velocity = &self.history.state().velocity;
        let speed_v = feed_length(velocity);
        if speed_v <= 0.0 {
            return true;
        }
        let along = directional(&self.limits, &(velocity / speed_v));
        let Bounds { path, .. } = piece.within_joints(along, 1.0);
        let stop_s = 0.5 * speed_v * speed_v / path.accel_a;
        let in_mm = |way: AxisVector| piece.in_mm(Displacement::of(&way));
        let stop_mm = in_mm(velocity * (stop_s / speed_v));
        let rest_mm = in_mm(piece.end - self.history.last());
        stop_mm <= FAR_TOO_FAST * (rest_mm + piece.tolerance_mm)
    }

    /// True if nothing moves or will move without a new plan.
    fn is_at_rest(&self, grid: &Grid) -> bool {
        match &self.active {
            ActiveMotion::Nothing => true,
            ActiveMotion::Legs { leg, .. } => leg.is_none(),
            ActiveMotion::Window { .. } => {
                let tail = self.tail(grid, 0);
                tail.iter().all(|point| *point == tail[0])
            }
        }
    }

    /// True if the motion handed out so far is exactly at the end of the path.
    fn is_at_end(&self) -> bool {
        let reachable = &self.follower.reachable;
        let end = self
            .reference_path
            .get(reachable.last())
            .map(|piece| piece.end);
        reachable.is_at_end(&self.reference_path) && end == Some(self.history.last())
    }

    /// The motion from the present state on, as control points: what is left of the last window
    /// down to its rest, or so many intervals of the leg under way, which need not be a motion.
    pub(super) fn tail(&self, grid: &Grid, intervals: usize) -> Vec<AxisVector> {
        match &self.active {
            ActiveMotion::Window { points, done, .. } => {
                let passed = done * grid.knots / grid.periods;
                let last = points.len() - 1;
                (passed..passed.max(last - 2) + 3)
                    .map(|k| points[k.min(last)])
                    .collect()
            }
            ActiveMotion::Legs {
                leg: Some(leg),
                leg_t,
                ..
            } => leg_tail(leg, *leg_t, grid, intervals),
            _ => vec![self.history.last(); 4],
        }
    }
}

/// Control points of a leg from some time on: exact at that time, positions at the knots after it.
fn leg_tail(leg: &StopLeg, leg_t: f64, grid: &Grid, intervals: usize) -> Vec<AxisVector> {
    let h = grid.knot_t;
    let state = leg.at(leg_t);
    let bend = state.acceleration * (h * h / 6.0);
    let step = state.velocity * h;
    // The three that have the state at their knot: (x₀ + 4x₁ + x₂)/6, (x₂ − x₀)/2h, (x₀ − 2x₁ + x₂)/h².
    let mut points = vec![
        state.position - step + bend * 2.0,
        state.position - bend,
        state.position + step + bend * 2.0,
    ];
    #[expect(clippy::cast_precision_loss, reason = "hundreds")]
    points.extend((3..=intervals.max(6)).map(|k| leg.position(leg_t + (k - 1) as f64 * h)));
    let last = points[points.len() - 1];
    points.extend([last; 2]);
    points
}

/// Half the time in which jerk strays by a tolerance: the grid on which corners are still resolved. On a mill
/// (tolerance .02 mm, jerk 4e4) that is 4 ms, and 8 ms were too coarse for small figures; on a stiff machine
/// (.03 mm, 1e6) it is 1.6 ms, where 2 ms did and 1 ms gained nothing.
///
/// It is chosen for a whole stretch by its first piece alone, and by the axes that move there: how much of the path
/// a window sees is counted in its knots, so it has to be known first. If it is too coarse for a later piece,
/// that costs time only, because the judge looks at periods. No measurement of that is kept.
fn wanted_grid(planner: &PlannerState, piece: &TubePiece) -> Grid {
    let mut limits = planner.limits;
    if let Some([acceleration, jerk]) = planner
        .joints
        .as_deref()
        .and_then(|joints| alone(joints, &piece.start))
    {
        limits.acceleration = limits.acceleration.inf(&acceleration);
        limits.jerk = limits.jerk.inf(&jerk);
    }
    let moved = piece.end - piece.start;
    let least_of = |of_axis: &dyn Fn(usize) -> f64| {
        let moving = (0..AXES).filter(|&i| moved[i] != 0.0);
        moving.map(of_axis).fold(f64::INFINITY, f64::min)
    };
    let wanted_t = least_of(&|i| {
        let is_rotary = ROTARY_ABC.contains(&i);
        let tolerance = if is_rotary {
            piece.tolerance_deg
        } else {
            piece.tolerance_mm
        };
        0.5 * (tolerance / limits.jerk[i]).cbrt()
    });
    let ramp_t = least_of(&|i| limits.acceleration[i] / limits.jerk[i]);
    Grid::new(planner.period_t, wanted_t, ramp_t)
}
