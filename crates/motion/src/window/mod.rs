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

mod follow;
mod stop_leg;
#[cfg(test)]
mod tests;
mod track;

use crate::Limits;
use follow::{Follower, Place};
use glidepath_geometry::AxisVector;
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

/// Plans one stretch of motion between two rests.
#[derive(Debug)]
pub(crate) struct WindowPlanner {
    limits: Limits,
    period_t: f64,
    track: Track,
    /// The state last handed out, and where on the path that is.
    position: AxisVector,
    follower: Follower,
    progress: (usize, f64),
    /// The leg under way, and the time since its start.
    leg: Option<StopLeg>,
    leg_t: f64,
    is_over: bool,
}

impl WindowPlanner {
    /// A planner for a machine at rest at `start`, period in seconds.
    pub(crate) fn new(limits: &Limits, period_t: f64, start: AxisVector) -> Self {
        Self {
            limits: *limits,
            period_t,
            track: Track::new(start),
            position: start,
            follower: Follower::new(Place::start_of(0)),
            progress: (0, 0.0),
            leg: None,
            leg_t: 0.0,
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

    /// The state one period further, if what is known of the path settles it.
    ///
    /// `None`: more of the path is needed, or the motion is at rest at its end ([`Self::is_over`]).
    pub(crate) fn next_period(&mut self) -> Option<Period> {
        if self.is_over {
            return None;
        }
        let mut period = self.next_of_legs()?;
        self.position = period.position;
        let place = &self.follower.place;
        self.progress = place.nearest(&self.track, &self.position, self.progress);
        if let Some(piece) = self.track.get(self.progress.0) {
            period.path_s = piece.start_s + piece.length_s * self.progress.1;
            period.tag = piece.tag;
        }
        self.track
            .forget_before(self.follower.place.first.min(self.progress.0));
        self.is_over = self.leg.is_none() && self.follower.place.is_at_end(&self.track);
        period.rest_at_end = self.is_over;
        Some(period)
    }

    /// True when the end of the path has been reached and handed out, or there is no path.
    pub(crate) fn is_over(&self) -> bool {
        self.is_over || self.track.is_empty_and_finished()
    }

    /// Other speeds for the path from here on, by tag; the motion is planned again from the state
    /// handed out last.
    pub(crate) fn set_rates(&mut self, rate_of: impl FnMut(u64) -> f64) {
        self.track.set_rates(rate_of);
    }

    /// One period of straight legs from vertex to vertex.
    fn next_of_legs(&mut self) -> Option<Period> {
        let mut leg = match &self.leg {
            Some(leg) => leg.clone(),
            None => self.leg_from(self.position, self.follower.place.last())?,
        };
        let first = leg.clone();
        let mut t = self.leg_t + self.period_t;
        let mut is_resting = false;
        while t >= leg.duration_t() {
            t -= leg.duration_t();
            if self.track.is_last(leg.piece) {
                is_resting = true;
                break;
            }
            leg = self.leg_from(leg.to, leg.piece + 1)?;
        }
        let mut period = if is_resting {
            Period::rest(leg.to)
        } else {
            leg.at(t)
        };
        if !self
            .follower
            .step(&self.track, &self.position, &period.position)
        {
            // The chord between two periods cuts off a vertex: rest there until the next period.
            period = Period::rest(first.to);
            is_resting = true;
            self.follower
                .step(&self.track, &self.position, &period.position);
        }
        self.leg = Some(leg).filter(|_| !is_resting);
        self.leg_t = if is_resting { 0.0 } else { t };
        Some(period)
    }

    /// The leg to the end of the first piece from `index` on that does not end here.
    fn leg_from(&self, from: AxisVector, index: usize) -> Option<StopLeg> {
        (index..self.track.end())
            .take_while(|&index| self.track.is_settled(index))
            .find_map(|index| StopLeg::new(&self.limits, from, index, self.track.get(index)?))
    }
}
