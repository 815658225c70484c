//! Limits of joints as limits of path speed, item by item.
//!
//! ```text
//!   item ── places along it, STEP apart ──▶ least of the speeds joints allow there ──▶ rate "up to"
//! ```
//!
//! An item keeps its rate where no override could make joints too fast.

use glidepath_geometry::{Axis, AxisVector, Segment, limit_along};
use glidepath_kinematics::{PathCaps, PlaceCaps};
use glidepath_motion::{Item, ItemKind, Limits};

/// Largest change of any axis between two places that are looked at, mm or degrees.
const STEP: f64 = 1.0;
/// Speeds are rounded down to a power of two to so many steps, so that neighbours are alike.
const STEPS_PER_OCTAVE: f64 = 16.0;

/// Keeps the speed of items where joints can follow.
#[derive(Debug)]
pub(crate) struct JointSpeed {
    caps: PathCaps,
    /// Limits of the axes: no item is driven faster than they allow.
    velocity: AxisVector,
    /// The place that was looked at last.
    place: Option<(AxisVector, PlaceCaps)>,
}

impl JointSpeed {
    pub(crate) fn new(caps: PathCaps, limits: &Limits) -> Self {
        Self {
            caps,
            velocity: limits.velocity,
            place: None,
        }
    }

    /// The same item, at a rate that joints can follow.
    pub(crate) fn keep(&mut self, item: Item) -> Item {
        let ItemKind::Move {
            segment,
            rate,
            mode,
        } = item.kind
        else {
            return item;
        };
        let (joints_v, axes_v) = self.along(&segment);
        if joints_v >= axes_v {
            return item;
        }
        let octaves = (joints_v.log2() * STEPS_PER_OCTAVE).floor() / STEPS_PER_OCTAVE;
        Item {
            kind: ItemKind::Move {
                segment,
                rate: rate.up_to(octaves.exp2()),
                mode,
            },
            ..item
        }
    }

    /// The least speeds that joints and axes allow on a segment.
    fn along(&mut self, segment: &Segment) -> (f64, f64) {
        let length_s = segment.length();
        // The fastest axis per unit of path position, which rotary axes may be many times over.
        let fastest = (0..=8)
            .map(|i| segment.jet(length_s * f64::from(i) / 8.0).d1.amax())
            .fold(1.0, f64::max);
        let steps = (length_s * fastest / STEP).ceil().clamp(1.0, 1e6);
        let (mut joints_v, mut axes_v) = (f64::INFINITY, f64::INFINITY);
        let mut step = 0.0;
        while step <= steps {
            let at = segment.jet(length_s * step / steps);
            axes_v = axes_v.min(limit_along(&at.d1, &self.velocity));
            // Where a machine cannot go is told by those who look at the path for that.
            if let Some(speed_v) = self.at(&at.position, &at.d1) {
                joints_v = joints_v.min(speed_v);
            }
            step += 1.0;
        }
        (joints_v, axes_v)
    }

    fn at(&mut self, position: &AxisVector, d1: &AxisVector) -> Option<f64> {
        let is_near = |(place, _): &(AxisVector, PlaceCaps)| {
            Axis::ALL
                .into_iter()
                .all(|axis| (place[axis.index()] - position[axis.index()]).abs() < STEP)
        };
        if !self.place.as_ref().is_some_and(is_near) {
            self.place = Some((*position, self.caps.at(position).ok()?));
        }
        let (_, caps) = self.place.as_ref()?;
        caps.speed(position, d1).ok()
    }
}
