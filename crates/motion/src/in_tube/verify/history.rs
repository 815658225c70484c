//! The positions handed out last, and the last word on a motion that continues them.
//!
//! Positions at the periods count: differences of first, second and third order against the limits of
//! every axis, the feed, and the way along the path ([`super::follow`]); travel between them, too
//! ([`super::travel`]).

use super::between_periods::BetweenPeriods;
use super::follow::Follower;
use super::near_pieces::NearPieces;
use super::travel;
use crate::in_tube::path::{ReferencePath, counted_length};
use crate::in_tube::period::State;
use glidepath_geometry::{AXES, AxisVector, feed_length};
use glidepath_program::Limits;

/// A limit counts as kept up to this factor.
const SLACK: f64 = 1.0 + 5e-7;
/// The feed counts as kept up to this factor.
pub(crate) const FEED_SLACK: f64 = 1.0 + 5e-4;

/// What has come of following a period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Followed {
    /// The motion is there, and has kept everything.
    Kept,
    /// The motion is there, and was faster than the feed: a rate may have been lowered meanwhile.
    TooFast,
    /// It breaks a limit, or leaves travel or the tube: all is as it was.
    Refused,
}

impl Followed {
    /// True if the motion has kept everything.
    pub(crate) fn is_kept(self) -> bool {
        self == Self::Kept
    }

    /// True if the motion is there, however fast it was.
    pub(crate) fn is_there(self) -> bool {
        self != Self::Refused
    }
}

/// The last positions handed out.
#[derive(Debug, Clone)]
pub(crate) struct History {
    /// Newest first.
    recent: [AxisVector; 3],
    /// The motion at the last four of them, newest first.
    states: [State; 4],
    /// Speed that is allowed although the feed is less: what it was before a change of rates. Zero
    /// once the motion has slowed down.
    pub(crate) overspeed_v: f64,
}

impl History {
    /// At rest.
    pub(crate) fn new(position: AxisVector) -> Self {
        Self {
            recent: [position; 3],
            states: [State::rest(position); 4],
            overspeed_v: 0.0,
        }
    }

    pub(crate) fn last(&self) -> AxisVector {
        self.recent[0]
    }

    /// The last positions handed out, newest first.
    pub(crate) const fn recent(&self) -> &[AxisVector; 3] {
        &self.recent
    }

    /// The motion at the last position.
    pub(crate) const fn state(&self) -> &State {
        &self.states[0]
    }

    /// The positions at a part `u` of the period to the next state and of the three before, newest first: where
    /// setpoints are when time has run slower for a while.
    pub(crate) fn between(&self, next: &State, period_t: f64, u: f64) -> [AxisVector; 4] {
        let [last, before, third, first] = &self.states;
        let at = |from, to| BetweenPeriods { from, to, period_t }.at(u);
        [
            at(last, next),
            at(before, last),
            at(third, before),
            at(first, third),
        ]
    }

    /// True if no chord of a period begins before the present rest.
    pub(crate) fn has_rested(&self) -> bool {
        self.recent
            .iter()
            .all(|position| *position == self.recent[0])
    }

    /// True if every axis keeps its limits on the way to the next position.
    pub(crate) fn allows(&self, limits: &Limits, period_t: f64, next: &AxisVector) -> bool {
        let t = period_t;
        let [p1, p2, p3] = &self.recent;
        (0..AXES).all(|i| {
            let magnitude = next[i].abs().max(p3[i].abs());
            let rounding = 0.5 * f64::EPSILON * magnitude;
            let d1 = next[i] - p1[i];
            let d2 = d1 - (p1[i] - p2[i]);
            let d3 = d2 - (p1[i] - 2.0 * p2[i] + p3[i]);
            d1.abs() <= limits.velocity[i] * t * SLACK + 2.0 * rounding
                && d2.abs() <= limits.acceleration[i] * t * t * SLACK + 4.0 * rounding
                && d3.abs() <= limits.jerk[i] * t * t * t * SLACK + 8.0 * rounding
        })
    }

    /// Follows a period along the path: limits, travel, tolerance, feed. Only what is [`Followed::Refused`]
    /// leaves all as it was.
    pub(crate) fn follow(
        &mut self,
        limits: &Limits,
        period_t: f64,
        (reference_path, follower): (&ReferencePath, &mut Follower),
        next: &State,
    ) -> Followed {
        let position = next.position;
        let bend = BetweenPeriods {
            from: &self.states[0],
            to: next,
            period_t,
        };
        if !self.allows(limits, period_t, &position) || !travel::is_inside(limits, &bend) {
            return Followed::Refused;
        }
        let from = follower.reachable.first;
        let near_start = NearPieces::of(reference_path, &follower.reachable, &self.recent[0]);
        if !follower.step(reference_path, &bend) {
            return Followed::Refused;
        }
        let near_end = NearPieces::of(reference_path, &follower.reachable, &position);
        let step = position - self.recent[0];
        let speed_v = feed_length(&step) / period_t;
        let reached = (from, follower.reachable.last());
        let pieces = near_start.of_period(&near_end, reference_path, reached);
        let feed_v = pieces
            .clone()
            .fold(0.0_f64, |most, piece| most.max(piece.counted_v));
        // Counted as the pieces count it: beside a rotary move, the least motion of XYZ is all that
        // the step's own feed length tells.
        let mut counted =
            pieces.map(|piece| counted_length(piece, &step) / (piece.counted_v * period_t));
        let is_slow = speed_v <= self.overspeed_v || counted.any(|ratio| ratio <= FEED_SLACK);
        self.recent = [position, self.recent[0], self.recent[1]];
        let [last, before, third, _] = self.states;
        self.states = [*next, last, before, third];
        if speed_v <= feed_v {
            self.overspeed_v = 0.0;
        }
        if is_slow && speed_v <= (feed_v * FEED_SLACK).max(self.overspeed_v) {
            Followed::Kept
        } else {
            Followed::TooFast
        }
    }
}
