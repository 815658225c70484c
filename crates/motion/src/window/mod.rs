//! The near time-optimal planner of a stretch of motion between two rests.
//!
//! It is given the path as straight pieces with a tolerance and a speed each, and gives the state of
//! every axis at every period. Geometry and time law come out together: the motion may be anywhere
//! inside the tolerance.
//!
//! ```text
//!   push ──► Track ──► optimised window, verified ──► periods ──► next_period
//!            ring of   otherwise: rest of the last
//!            pieces    window, which ends at rest;
//!                      at rest: straight legs to the
//!                      next vertices (StopLeg)
//! ```
//!
//! Whatever leaves this module has passed the check of `follow` (both ways, in order, within tolerance), keeps
//! every limit, and is continued by a motion that ends at rest.
//!
//! The motion depends on the sequence of calls that change the path or its speed and on how many
//! periods were taken before a change of speed, on nothing else: a plan is made when a definite
//! amount of path is known, and of no more than that.

#![allow(
    clippy::needless_range_loop,
    reason = "vectors and blocks of a few axes are clearest by index"
)]

mod attempt;
mod bend;
mod beside;
mod budget;
mod cuts;
mod follow;
mod guess;
mod judge;
mod lead;
mod legs;
mod opening;
mod optimiser;
mod planning;
mod rounds;
mod samples;
mod scene;
mod solver;
mod spline;
mod stop_leg;
#[cfg(test)]
mod tests;
mod track;
mod tube;

use attempt::Optimisers;
use follow::{Follower, Place};
use glidepath_geometry::AxisVector;
use glidepath_program::Limits;
use judge::History;
use lead::Rival;
use spline::Grid;
use stop_leg::StopLeg;
use track::Track;

/// One straight piece of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reference {
    /// Where it ends; it starts where the piece before it ended.
    pub(crate) end: AxisVector,
    /// Largest path speed, in mm/s of [`glidepath_geometry::feed_length`], > 0 and finite. For a rapid: the speed at
    /// which some axis is at its limit.
    pub(crate) top_v: f64,
    /// How far the motion may be from the path, and each vertex from the motion, in XYZ and in UVW,
    /// mm, > 0. At a vertex the smaller tolerance of both sides holds.
    pub(crate) tolerance_mm: f64,
    /// The same for each rotary axis, degrees, > 0.
    pub(crate) tolerance_deg: f64,
    /// Given back with each period, and asked for when rates change.
    pub(crate) tag: u64,
}

/// The state of the machine one period further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Period {
    /// mm or degrees.
    pub(crate) position: AxisVector,
    /// Per second.
    pub(crate) velocity: AxisVector,
    /// Per second squared.
    pub(crate) acceleration: AxisVector,
    /// Path speed, mm/s of feed length.
    pub(crate) path_v: f64,
    /// Progress along the path, mm of feed length since the start of the stretch; never falls.
    pub(crate) path_s: f64,
    /// Tag of the piece it belongs to; never an earlier one than before.
    pub(crate) tag: u64,
    /// At rest, exactly at the end of the path: the last period.
    pub(crate) rest_at_end: bool,
}

impl Period {
    /// At rest somewhere.
    fn rest(position: AxisVector) -> Self {
        Self {
            position,
            velocity: AxisVector::zeros(),
            acceleration: AxisVector::zeros(),
            path_v: 0.0,
            path_s: 0.0,
            tag: 0,
            rest_at_end: false,
        }
    }
}

/// Most legs from vertex to vertex before windows are tried again.
const MOST_LEGS: usize = 8;

/// What moves the machine.
#[derive(Debug)]
enum Force {
    /// At rest.
    Nothing,
    /// Legs from vertex to vertex: the one under way, the time since its start, how many are to end
    /// before a window is tried; rates have changed since its start.
    Legs {
        leg: Option<Box<StopLeg>>,
        leg_t: f64,
        wait: usize,
        is_stale: bool,
    },
    /// A window that ends at rest, periods of it that have been handed out and that will be.
    Window {
        points: Vec<AxisVector>,
        is_end: bool,
        done: usize,
        commit: usize,
    },
}

/// Plans one stretch of motion between two rests.
#[derive(Debug)]
pub(crate) struct WindowPlanner {
    limits: Limits,
    period_t: f64,
    track: Track,
    /// Positions handed out last, and where on the path the last one is.
    history: History,
    follower: Follower,
    progress: (usize, f64),
    force: Force,
    grid: Option<Grid>,
    optimisers: Optimisers,
    /// Legs to run when the next window is refused: the more, the more have been.
    legs: usize,
    /// Stopping at every vertex; `None` after rates have changed, until the next rest.
    rival: Option<Rival>,
    /// Periods handed out.
    clock: usize,
    is_over: bool,
}

impl WindowPlanner {
    /// A planner for a machine at rest at `start`, period in seconds.
    pub(crate) fn new(limits: &Limits, period_t: f64, start: AxisVector) -> Self {
        Self {
            limits: *limits,
            period_t,
            track: Track::new(start),
            history: History::new(start),
            follower: Follower::new(Place::start_of(0), 0),
            progress: (0, 0.0),
            force: Force::Nothing,
            grid: None,
            optimisers: Optimisers::default(),
            legs: 1,
            rival: None,
            clock: 0,
            is_over: false,
        }
    }

    /// The path goes on. A piece of length zero counts for nothing.
    ///
    /// Where merging has left out vertices, the path with them and the path without must be within
    /// some distance of each other both ways and in order, and the tolerance be smaller by that
    /// distance: then each vertex that was left out is within the full tolerance of the motion.
    pub(crate) fn push(&mut self, piece: Reference) {
        self.track.push(piece);
    }

    /// The path ends with what has been pushed, at rest.
    pub(crate) fn finish(&mut self) {
        self.track.finish();
    }

    /// True when the end of the path has been reached and handed out, or there is no path.
    pub(crate) fn is_over(&self) -> bool {
        self.is_over || self.track.is_empty_and_finished()
    }

    /// Other speeds for the path from here on, by tag; the motion is planned again from the state
    /// handed out last.
    pub(crate) fn set_rates(&mut self, rate_of: impl FnMut(u64) -> f64) {
        let before_v = self.track.top_v();
        self.track.set_rates(rate_of);
        self.history.overspeed_v = self.history.overspeed_v.max(before_v * judge::FEED_SLACK);
        self.rival = None;
        match (&mut self.force, &self.grid) {
            (
                Force::Window {
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
            (Force::Legs { is_stale, .. }, _) => *is_stale = true,
            _ => {}
        }
    }

    /// The state one period further, if what is known of the path settles it.
    ///
    /// `None`: more of the path is needed, or the motion is at rest at its end ([`Self::is_over`]).
    pub(crate) fn next_period(&mut self) -> Option<Period> {
        if self.is_over {
            return None;
        }
        let mut period = loop {
            match &self.force {
                Force::Window { done, commit, .. } if done < commit => {
                    break self.next_of_window()?;
                }
                Force::Legs { leg: Some(_), .. } if !self.is_trial_due() => {
                    break self.next_of_legs()?;
                }
                _ => self.plan()?,
            }
        };
        self.clock += 1;
        let place = &self.follower.place;
        self.progress = place.nearest(&self.track, &period.position, self.progress);
        if let Some(piece) = self.track.get(self.progress.0) {
            period.path_s = piece.start_s + piece.length_s * self.progress.1;
            period.tag = piece.tag;
            period.path_v = piece.path_v(&period.velocity);
        }
        let kept = self.follower.first().min(self.progress.0);
        self.track.forget_before(kept);
        if let Some(rival) = &mut self.rival {
            rival.forget_before(kept);
        }
        period.rest_at_end = self.is_over;
        Some(period)
    }

    /// One period of a window.
    fn next_of_window(&mut self) -> Option<Period> {
        let Force::Window {
            points,
            is_end,
            done,
            ..
        } = &mut self.force
        else {
            return None;
        };
        let grid = self.grid.as_ref()?;
        *done += 1;
        let state = grid.state(points, *done);
        self.is_over = *is_end && *done == grid.periods_in(points.len() - 3);
        let way = (&self.track, &mut self.follower);
        let is_kept = self
            .history
            .follow(&self.limits, self.period_t, way, &state);
        // Too fast for a rate that was lowered meanwhile is all that it may be.
        let is_followed = is_kept || self.history.last() == state.position;
        is_followed.then_some(Period {
            velocity: state.velocity,
            acceleration: state.acceleration,
            ..Period::rest(state.position)
        })
    }
}
