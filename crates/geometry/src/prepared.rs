//! Segments made ready to be evaluated many times: what does not depend on path position is
//! computed once. The values are those of [`Segment::jet`], bit for bit.

use core::f64::consts::FRAC_PI_2;

use crate::{Arc, AxisVector, Jet, Line, Segment, feed_length};

/// The quarters of a turn that begins anywhere, counted.
const QUARTERS: [f64; 6] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];

/// A segment made ready for many evaluations.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "one is kept at a time, or two")]
pub enum Prepared {
    /// Straight.
    Line(PreparedLine),
    /// Circular, helical, or slightly spiral.
    Arc(PreparedArc),
    /// A piece of another curve, which needs no preparation.
    Curve(crate::Quintic),
}

/// A line, its length and its direction.
#[derive(Debug, Clone)]
pub struct PreparedLine {
    line: Line,
    displacement: AxisVector,
    length: f64,
    d1: AxisVector,
}

/// An arc, its length, and where it begins in polar coordinates.
#[derive(Debug, Clone)]
pub struct PreparedArc {
    arc: Arc,
    displacement: AxisVector,
    length: f64,
    radii: [f64; 2],
    start_angle_rad: f64,
}

impl Segment {
    /// The same segment, made ready for many evaluations.
    #[must_use]
    pub fn prepared(&self) -> Prepared {
        match self {
            Self::Line(line) => Prepared::Line(line.prepared()),
            Self::Arc(arc) => Prepared::Arc(arc.prepared()),
            Self::Curve(curve) => Prepared::Curve(*curve),
        }
    }
}

impl Prepared {
    /// Position and derivatives at path position `s`, as [`Segment::jet`].
    #[must_use]
    #[inline]
    pub fn jet(&self, s: f64) -> Jet {
        match self {
            Self::Line(line) => line.jet(s),
            Self::Arc(arc) => arc.jet(s),
            Self::Curve(curve) => curve.jet(s),
        }
    }

    /// The position at path position `s`.
    #[must_use]
    pub fn position(&self, s: f64) -> AxisVector {
        match self {
            Self::Line(line) => line.position(s),
            Self::Arc(arc) => arc.position(s),
            Self::Curve(curve) => curve.jet(s).position,
        }
    }
}

impl Line {
    /// The same line, made ready for many evaluations.
    #[must_use]
    #[inline]
    pub fn prepared(&self) -> PreparedLine {
        let displacement = self.displacement();
        let length = feed_length(&displacement);
        let d1 = if length <= 0.0 {
            AxisVector::zeros()
        } else {
            displacement / length
        };
        PreparedLine {
            line: *self,
            displacement,
            length,
            d1,
        }
    }
}

impl PreparedLine {
    /// The line.
    #[must_use]
    pub const fn line(&self) -> &Line {
        &self.line
    }

    /// End minus start.
    #[must_use]
    pub const fn displacement(&self) -> &AxisVector {
        &self.displacement
    }

    /// Position and derivatives at path position `s`, as [`Segment::jet`].
    #[must_use]
    #[inline]
    pub fn jet(&self, s: f64) -> Jet {
        let zero = AxisVector::zeros();
        Jet {
            position: self.position(s),
            d1: self.d1,
            d2: zero,
            d3: zero,
        }
    }

    /// The position at path position `s`.
    #[must_use]
    #[inline]
    pub fn position(&self, s: f64) -> AxisVector {
        if self.length <= 0.0 {
            return self.line.start;
        }
        // From the nearer end, so that both ends are met exactly.
        let fraction = s / self.length;
        if fraction <= 0.5 {
            self.line.start + self.displacement * fraction
        } else {
            self.line.end - self.displacement * ((self.length - s) / self.length)
        }
    }
}

impl Arc {
    /// The same arc, made ready for many evaluations.
    #[must_use]
    pub fn prepared(&self) -> PreparedArc {
        PreparedArc {
            arc: *self,
            displacement: self.end - self.start,
            length: self.length(),
            radii: [self.start_radius(), self.end_radius()],
            start_angle_rad: self.start_angle_rad(),
        }
    }

    /// Position and derivatives at path position `s`.
    ///
    /// For a radius that changes, `s` is proportional to the swept angle and differs from the true
    /// arc length by the relative size of that change.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        self.prepared().jet(s)
    }
}

impl PreparedArc {
    /// The arc.
    #[must_use]
    pub const fn arc(&self) -> &Arc {
        &self.arc
    }

    /// [`Arc::start_angle_rad`].
    #[must_use]
    pub const fn start_angle_rad(&self) -> f64 {
        self.start_angle_rad
    }

    /// The position at path position `s`.
    #[must_use]
    pub fn position(&self, s: f64) -> AxisVector {
        self.place(s).0
    }

    /// Smallest and largest coordinate of the arc on every axis, as [`Arc::bounding_box`].
    #[must_use]
    pub fn bounding_box(&self) -> (AxisVector, AxisVector) {
        let arc = &self.arc;
        let (mut low, mut high) = (arc.start.inf(&arc.end), arc.start.sup(&arc.end));
        let (first, second) = arc.plane.axes();
        let from = self.start_angle_rad;
        let to = from + arc.sweep_rad;
        let (a, b) = if from < to { (from, to) } else { (to, from) };
        let [radius_0, radius_1] = self.radii;
        let drift = (radius_1 - radius_0) / arc.sweep_rad;
        let (k_first, k_last) = ((a / FRAC_PI_2).floor(), (b / FRAC_PI_2).ceil());
        // With a radius that only grows or only shrinks, the first or the last turn bulges most.
        let first_turn = QUARTERS.map(|i| k_first + i);
        let last_turn = QUARTERS.map(|i| k_last - i);
        let others = last_turn
            .into_iter()
            .filter(|k| *k < k_first || *k > first_turn[5]);
        for k in first_turn.into_iter().chain(others) {
            let middle = k * FRAC_PI_2;
            let radius = radius_0 + drift * (middle - from);
            // The extreme is within a quarter of there.
            let is_beside = middle + FRAC_PI_2 <= a || middle - FRAC_PI_2 >= b;
            if is_beside && radius > 0.0 {
                continue;
            }
            // r cos(φ − k·90°) is extreme where tan(φ − k·90°) = r′/r.
            let angle = middle + drift.atan2(radius);
            if angle > a && angle < b {
                let (point, ..) = self.place(self.length * (angle - from) / arc.sweep_rad);
                for axis in [first.index(), second.index()] {
                    low[axis] = low[axis].min(point[axis]);
                    high[axis] = high[axis].max(point[axis]);
                }
            }
        }
        (low, high)
    }

    /// The position at path position `s`; the radius, and sine and cosine of the direction there.
    #[inline]
    fn place(&self, s: f64) -> (AxisVector, f64, (f64, f64)) {
        let arc = &self.arc;
        let fraction = if self.length > 0.0 {
            s / self.length
        } else {
            0.0
        };
        let [radius_0, radius_1] = self.radii;
        let radius = radius_0 + (radius_1 - radius_0) * fraction;
        let (sin, cos) = (self.start_angle_rad + arc.sweep_rad * fraction).sin_cos();
        let position = if fraction >= 1.0 {
            arc.end + (self.displacement * (fraction - 1.0))
        } else {
            let (first, second) = arc.plane.axes();
            let mut position = arc.start + self.displacement * fraction;
            position[first.index()] = arc.center[0] + radius * cos;
            position[second.index()] = arc.center[1] + radius * sin;
            position
        };
        (position, radius, (sin, cos))
    }

    /// Position and derivatives at path position `s`, as [`Arc::jet`].
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let (arc, length) = (&self.arc, self.length);
        let (first, second) = arc.plane.axes();
        let (first, second) = (first.index(), second.index());
        let per_s = if length > 0.0 { 1.0 / length } else { 0.0 };

        let mut d1 = self.displacement * per_s;
        let mut d2 = AxisVector::zeros();
        let mut d3 = AxisVector::zeros();

        let (position, radius, (sin, cos)) = self.place(s);
        let [radius_0, radius_1] = self.radii;
        let radius_d1 = (radius_1 - radius_0) * per_s;
        let omega = arc.sweep_rad * per_s;

        // r·e(φ): e' = ω n, e'' = −ω² e, e''' = −ω³ n, with r' constant.
        d1[first] = radius_d1 * cos - radius * omega * sin;
        d1[second] = radius_d1 * sin + radius * omega * cos;
        let (along, across) = (-radius * omega * omega, 2.0 * radius_d1 * omega);
        d2[first] = along * cos - across * sin;
        d2[second] = along * sin + across * cos;
        let (along, across) = (
            -3.0 * radius_d1 * omega * omega,
            -radius * omega * omega * omega,
        );
        d3[first] = along * cos - across * sin;
        d3[second] = along * sin + across * cos;
        Jet {
            position,
            d1,
            d2,
            d3,
        }
    }
}
