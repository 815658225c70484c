//! A straight line through the axes, and the motion along it.

use crate::shared::tracker::{Bounds, Motion, Target, Tracker};
use glidepath_geometry::AxisVector;
use glidepath_program::Limits;

/// By how much two directions may differ to be the same: rounding.
const SAME_DIRECTION: f64 = 1e-12;

/// The motion of the axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AxesMotion {
    pub(crate) position: AxisVector,
    pub(crate) velocity: AxisVector,
    pub(crate) acceleration: AxisVector,
}

/// A motion along a straight line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    origin: AxisVector,
    /// Of length 1 over all axes together, mm and degrees alike.
    pub(super) direction: AxisVector,
    pub(super) tracker: Tracker,
    /// What the axes may do together along the line.
    pub(super) bounds: Bounds,
    /// The way to where it is to end, and that place, without rounding.
    end: Option<(f64, AxisVector)>,
}

impl Line {
    /// At rest, to go along a vector; `None` if it has no length.
    pub(super) fn from_rest(
        origin: AxisVector,
        along: &AxisVector,
        limits: &Limits,
    ) -> Option<Self> {
        let length = along.norm();
        if length <= 0.0 || !length.is_finite() {
            return None;
        }
        let direction = along / length;
        Some(Self {
            origin,
            direction,
            tracker: Tracker::new(Motion::at(0.0)),
            bounds: bounds_along(&direction, limits),
            end: None,
        })
    }

    /// The signed length of a vector along the line; `None` if it points elsewhere.
    pub(super) fn along(&self, vector: &AxisVector) -> Option<f64> {
        let length = vector.dot(&self.direction);
        let beside = vector - self.direction * length;
        (beside.amax() <= SAME_DIRECTION * vector.amax()).then_some(length)
    }

    /// The signed way to a place from the origin; `None` if it is not on the line.
    pub(super) fn way_to(&self, place: &AxisVector) -> Option<f64> {
        let vector = place - self.origin;
        let way = vector.dot(&self.direction);
        // Places have the rounding of their numbers, not of their distance.
        let size = place.amax().max(self.origin.amax()).max(1.0);
        let beside = vector - self.direction * way;
        (beside.amax() <= SAME_DIRECTION * size).then_some(way)
    }

    /// Sets out for a velocity along the line.
    pub(super) fn aim_at_speed(&mut self, v: f64) {
        self.end = None;
        self.tracker
            .aim(Target::Speed(v), self.bounds.with_speed(v.abs()));
    }

    /// Sets out for rest after a way from the origin, which is at `place` if that matters to the
    /// bit.
    pub(super) fn aim_at_way(&mut self, way: f64, place: Option<&AxisVector>, most_v: f64) {
        let bounds = self.bounds.with_speed(most_v);
        self.end = place.map(|place| (way, *place));
        self.tracker.aim(Target::Rest(way), bounds);
    }

    /// Comes to rest as soon as possible.
    pub(super) fn brake(&mut self) {
        self.end = None;
        self.tracker.aim(Target::Speed(0.0), self.bounds);
    }

    /// The place after a way.
    #[allow(clippy::float_cmp, reason = "the end of the way is a copy of it")]
    pub(super) fn place(&self, way: f64) -> AxisVector {
        match &self.end {
            Some((end, place)) if way == *end => *place,
            _ => self.origin + self.direction * way,
        }
    }

    pub(super) fn motion(&self) -> AxesMotion {
        let now = self.tracker.now();
        AxesMotion {
            position: self.place(now.x),
            velocity: self.direction * now.v,
            acceleration: self.direction * now.a,
        }
    }

    /// How far it may go to either side before an axis leaves a box, as ways from the origin.
    pub(super) fn room(&self, lowest: &AxisVector, highest: &AxisVector) -> (f64, f64) {
        let mut room = (f64::NEG_INFINITY, f64::INFINITY);
        for (((d, from), low), high) in self
            .direction
            .iter()
            .zip(&self.origin)
            .zip(lowest)
            .zip(highest)
        {
            if *d == 0.0 {
                continue;
            }
            let (one, other) = ((low - from) / d, (high - from) / d);
            room = (room.0.max(one.min(other)), room.1.min(one.max(other)));
        }
        room
    }
}

/// The limits of all axes that move along a direction, as limits of the way.
fn bounds_along(direction: &AxisVector, limits: &Limits) -> Bounds {
    let along = |limit: &AxisVector| {
        direction
            .iter()
            .zip(limit)
            .filter(|(d, _)| **d != 0.0)
            .map(|(d, limit)| limit / d.abs())
            .fold(f64::INFINITY, f64::min)
    };
    Bounds {
        v: along(&limits.velocity),
        a: along(&limits.acceleration),
        j: along(&limits.jerk),
    }
}
