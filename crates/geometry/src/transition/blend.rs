//! The uniform blend: the velocity goes from one direction to the other along a polynomial.
//!
//! With path position s from 0 to 2d and u = s/2d,
//!
//! ```text
//! dr/ds = (1 − g(u))·T1 + g(u)·T2        r = P − d·T1·f(1−u) + d·T2·f(u),   f' = 2g
//! g = 10u³ − 15u⁴ + 6u⁵                  f = 5u⁴ − 6u⁵ + 2u⁶
//! ```
//!
//! This is the sextic Bézier curve whose seven control points are evenly spaced along the two
//! sides. Run at constant ds/dt = V the velocity joins that of the lines; it dips to V·cos β in
//! the middle of the corner. Acceleration and jerk point along the fixed direction T2 − T1, so
//! limits per axis are exact and nothing has to be sampled, and no arc length has to be inverted.
//! They start and end at zero: no jerk step at the lines. Regular for every turn, reversal
//! included (there it turns back δ short of the tip).

use super::bounds::DerivativeBounds;
use crate::turn::{feed_group, norm_in};
use crate::{AxisVector, Jet, Turn, quadrature};

/// δ / (d · sin β).
const DEVIATION_FACTOR: f64 = 5.0 / 16.0;
/// Largest g'.
const MAX_G1: f64 = 15.0 / 8.0;

/// Largest |g''|.
fn max_g2() -> f64 {
    10.0 / 3.0_f64.sqrt()
}

fn f(u: f64) -> f64 {
    u * u * u * u * (5.0 + u * (2.0 * u - 6.0))
}

/// g, g' and g''.
fn g(u: f64) -> [f64; 3] {
    let v = 1.0 - u;
    [
        u * u * u * (10.0 + u * (6.0 * u - 15.0)),
        30.0 * u * u * v * v,
        60.0 * u * v * (v - u),
    ]
}

/// A uniform blend at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blend {
    corner: AxisVector,
    /// Direction of arrival times its length on that side.
    arrive: AxisVector,
    /// Direction of departure times its length on that side.
    leave: AxisVector,
    /// The two lengths.
    d: [f64; 2],
}

impl Blend {
    /// Largest distance of the corner from the curve, mm, for length `d` on each side. `sb` is
    /// [`Turn::sb`], or [`crate::tolerance_half_turn`] where axes mix.
    #[must_use]
    pub fn deviation(d: f64, sb: f64) -> f64 {
        DEVIATION_FACTOR * d * sb
    }

    /// The length `d` that gives a deviation; infinite for `sb` = 0.
    #[must_use]
    pub fn distance_for(deviation_mm: f64, sb: f64) -> f64 {
        deviation_mm / (DEVIATION_FACTOR * sb)
    }

    /// Largest curvature, 1/mm, at the middle: it matters only to constant speed along the curve.
    #[must_use]
    pub fn max_curvature(d: f64, turn: Turn) -> f64 {
        MAX_G1 * turn.sb / (d * turn.cb * turn.cb)
    }

    /// Largest acceleration along (T2 − T1)/(2 sb) at rate `v` of path position, mm/s².
    #[must_use]
    pub fn peak_acceleration(d: f64, sb: f64, v: f64) -> f64 {
        MAX_G1 * v * v * sb / d
    }

    /// Largest jerk along (T2 − T1)/(2 sb) at rate `v` of path position, mm/s³.
    #[must_use]
    pub fn peak_jerk(d: f64, sb: f64, v: f64) -> f64 {
        0.5 * max_g2() * v * v * v * sb / (d * d)
    }

    /// The rate of path position at which the acceleration reaches `limit_a`, mm/s; infinite for
    /// `sb` = 0. Any lower rate is feasible.
    #[must_use]
    pub fn acceleration_cap(d: f64, sb: f64, limit_a: f64) -> f64 {
        (limit_a * d / (MAX_G1 * sb)).sqrt()
    }

    /// The rate of path position at which the jerk reaches `limit_j`, mm/s; infinite for `sb` = 0.
    #[must_use]
    pub fn jerk_cap(d: f64, sb: f64, limit_j: f64) -> f64 {
        (2.0 * limit_j * d * d / (max_g2() * sb)).cbrt()
    }

    /// The smallest length `d` at which neither cap is below `v`: more only wastes accuracy.
    #[must_use]
    pub fn distance_for_speed(sb: f64, v: f64, limit_a: f64, limit_j: f64) -> f64 {
        let by_a = MAX_G1 * sb * v * v / limit_a;
        let by_j = (0.5 * max_g2() * sb * v * v * v / limit_j).sqrt();
        by_a.max(by_j)
    }

    /// The blend that takes `d` > 0 from each side of the corner. `t1`, `t2`: unit feed length.
    #[must_use]
    pub fn new(corner: AxisVector, t1: AxisVector, t2: AxisVector, d: f64) -> Self {
        Self::asymmetric(corner, t1, t2, [d, d])
    }

    /// The blend that takes `d[0]` before and `d[1]` after the corner, both > 0.
    ///
    /// It leaves and joins the lines at rates of path position in the ratio d\[0\] : d\[1\], with
    /// the same continuity. Deviation: at most that of the symmetric blend of length
    /// √(d\[0\]·d\[1\]).
    #[must_use]
    pub fn asymmetric(corner: AxisVector, t1: AxisVector, t2: AxisVector, d: [f64; 2]) -> Self {
        Self {
            corner,
            arrive: t1 * d[0],
            leave: t2 * d[1],
            d,
        }
    }

    /// Path position at the end, mm: the sum of what it takes from the two sides.
    #[must_use]
    pub const fn length(&self) -> f64 {
        self.d[0] + self.d[1]
    }

    /// Position and derivatives at path position `s`.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let per_s = 1.0 / self.length();
        let u = s * per_s;
        let [g, g1, g2] = g(u);
        let position = self.corner - self.arrive * f(1.0 - u) + self.leave * f(u);
        let change = self.leave - self.arrive;
        Jet {
            position,
            d1: (self.arrive * (1.0 - g) + self.leave * g) * (2.0 * per_s),
            d2: change * (2.0 * g1 * per_s * per_s),
            d3: change * (2.0 * g2 * per_s * per_s * per_s),
        }
    }

    /// Largest derivatives per axis: exact.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        let per_s = 1.0 / self.length();
        let change = (self.leave - self.arrive).abs();
        DerivativeBounds {
            d1: self.arrive.abs().sup(&self.leave.abs()) * (2.0 * per_s),
            d2: change * (2.0 * MAX_G1 * per_s * per_s),
            d3: change * (2.0 * max_g2() * per_s * per_s * per_s),
        }
    }

    /// True length of the curve in the metric of the feed, mm.
    #[must_use]
    pub fn arc_length(&self) -> f64 {
        let axes = feed_group(&(self.arrive / self.d[0]), &(self.leave / self.d[1]));
        let rate = |u: f64| {
            let [g, ..] = g(u);
            norm_in(&(self.arrive * (1.0 - g) + self.leave * g), axes.clone())
        };
        // Each half on its own, panels halving towards the middle.
        quadrature::graded_half(|x| rate(0.5 * x))
            + quadrature::graded_half(|x| rate(1.0 - 0.5 * x))
    }
}
