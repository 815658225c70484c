//! Uniform blends: the velocity goes from one direction to the other along a polynomial.
//!
//! With path position s from 0 to 2d and u = s/2d,
//!
//! ```text
//! dr/ds = (1 − g(u))·T1 + g(u)·T2        r = P − d·T1·f(1−u) + d·T2·f(u),   f' = 2g
//! sextic   g = 10u³ − 15u⁴ + 6u⁵          f = 5u⁴ − 6u⁵ + 2u⁶
//! quartic  g = 3u² − 2u³                  f = 2u³ − u⁴
//! ```
//!
//! These are Bézier curves whose control points are evenly spaced along the two sides (seven, five).
//! Run at constant ds/dt = V the velocity joins that of the lines; it dips to V·cos β in the middle
//! of the corner. Acceleration and jerk point along the fixed direction T2 − T1, so limits per axis
//! are exact and nothing has to be sampled, and no arc length has to be inverted. For the sextic
//! they start and end at zero: no jerk step at the lines. Regular for every turn, reversal included
//! (there it turns back δ short of the tip).

use super::DerivativeBounds;
use crate::turn::{feed_group, norm_in};
use crate::{AxisVector, Jet, Turn, quadrature};

/// Which polynomial blends the directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Profile {
    /// Degree six: jerk continuous.
    Sextic,
    /// Degree four: acceleration continuous; a lower curvature for the same length.
    Quartic,
}

impl Profile {
    /// δ / (d · sin β).
    const fn deviation_factor(self) -> f64 {
        match self {
            Self::Sextic => 5.0 / 16.0,
            Self::Quartic => 3.0 / 8.0,
        }
    }

    /// Largest g'.
    const fn max_g1(self) -> f64 {
        match self {
            Self::Sextic => 15.0 / 8.0,
            Self::Quartic => 3.0 / 2.0,
        }
    }

    /// Largest |g''|.
    fn max_g2(self) -> f64 {
        match self {
            Self::Sextic => 10.0 / 3.0_f64.sqrt(),
            Self::Quartic => 6.0,
        }
    }

    /// Largest distance of the corner from the curve, mm, for length `d` on each side. `sb` is
    /// [`Turn::sb`], or [`crate::tolerance_half_turn`] where axes mix.
    #[must_use]
    pub fn deviation(self, d: f64, sb: f64) -> f64 {
        self.deviation_factor() * d * sb
    }

    /// The length `d` that gives a deviation; infinite for `sb` = 0.
    #[must_use]
    pub fn distance_for(self, deviation_mm: f64, sb: f64) -> f64 {
        deviation_mm / (self.deviation_factor() * sb)
    }

    /// Largest curvature, 1/mm, at the middle: it matters only to constant speed along the curve.
    #[must_use]
    pub fn max_curvature(self, d: f64, turn: Turn) -> f64 {
        self.max_g1() * turn.sb / (d * turn.cb * turn.cb)
    }

    /// Derivative of curvature by arc length where the curve leaves the line, 1/mm².
    #[must_use]
    pub fn end_curvature_rate(self, d: f64, turn: Turn) -> f64 {
        match self {
            Self::Sextic => 0.0,
            Self::Quartic => 1.5 * turn.sin_theta() / (d * d),
        }
    }

    /// Largest acceleration along (T2 − T1)/(2 sb) at rate `v` of path position, mm/s².
    #[must_use]
    pub fn peak_acceleration(self, d: f64, sb: f64, v: f64) -> f64 {
        self.max_g1() * v * v * sb / d
    }

    /// Largest jerk along (T2 − T1)/(2 sb) at rate `v` of path position, mm/s³.
    #[must_use]
    pub fn peak_jerk(self, d: f64, sb: f64, v: f64) -> f64 {
        0.5 * self.max_g2() * v * v * v * sb / (d * d)
    }

    /// The rate of path position at which the acceleration reaches `limit_a`, mm/s; infinite for
    /// `sb` = 0. Any lower rate is feasible.
    #[must_use]
    pub fn acceleration_cap(self, d: f64, sb: f64, limit_a: f64) -> f64 {
        (limit_a * d / (self.max_g1() * sb)).sqrt()
    }

    /// The rate of path position at which the jerk reaches `limit_j`, mm/s; infinite for `sb` = 0.
    #[must_use]
    pub fn jerk_cap(self, d: f64, sb: f64, limit_j: f64) -> f64 {
        (2.0 * limit_j * d * d / (self.max_g2() * sb)).cbrt()
    }

    /// The smallest length `d` at which neither cap is below `v`: more only wastes accuracy.
    #[must_use]
    pub fn distance_for_speed(self, sb: f64, v: f64, limit_a: f64, limit_j: f64) -> f64 {
        let by_a = self.max_g1() * sb * v * v / limit_a;
        let by_j = (0.5 * self.max_g2() * sb * v * v * v / limit_j).sqrt();
        by_a.max(by_j)
    }

    fn f(self, u: f64) -> f64 {
        match self {
            Self::Sextic => u * u * u * u * (5.0 + u * (2.0 * u - 6.0)),
            Self::Quartic => u * u * u * (2.0 - u),
        }
    }

    /// g, g' and g''.
    fn g(self, u: f64) -> [f64; 3] {
        let v = 1.0 - u;
        match self {
            Self::Sextic => [
                u * u * u * (10.0 + u * (6.0 * u - 15.0)),
                30.0 * u * u * v * v,
                60.0 * u * v * (v - u),
            ],
            Self::Quartic => [u * u * (3.0 - 2.0 * u), 6.0 * u * v, 6.0 * (v - u)],
        }
    }
}

/// A uniform blend at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Blend {
    profile: Profile,
    corner: AxisVector,
    /// Direction of arrival times its length on that side.
    arrive: AxisVector,
    /// Direction of departure times its length on that side.
    leave: AxisVector,
    /// The two lengths.
    d: [f64; 2],
}

impl Blend {
    /// The blend that takes `d` > 0 from each side of the corner. `t1`, `t2`: unit feed length.
    #[must_use]
    pub fn new(
        profile: Profile,
        corner: AxisVector,
        t1: AxisVector,
        t2: AxisVector,
        d: f64,
    ) -> Self {
        Self::asymmetric(profile, corner, t1, t2, [d, d])
    }

    /// The blend that takes `d[0]` before and `d[1]` after the corner, both > 0.
    ///
    /// It leaves and joins the lines at rates of path position in the ratio d\[0\] : d\[1\], with
    /// the same continuity. Deviation: at most that of the symmetric blend of length √(d\[0\]·d\[1\]).
    #[must_use]
    pub fn asymmetric(
        profile: Profile,
        corner: AxisVector,
        t1: AxisVector,
        t2: AxisVector,
        d: [f64; 2],
    ) -> Self {
        Self {
            profile,
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
        let [g, g1, g2] = self.profile.g(u);
        let position =
            self.corner - self.arrive * self.profile.f(1.0 - u) + self.leave * self.profile.f(u);
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
            d2: change * (2.0 * self.profile.max_g1() * per_s * per_s),
            d3: change * (2.0 * self.profile.max_g2() * per_s * per_s * per_s),
        }
    }

    /// True length of the curve in the metric of the feed, mm.
    #[must_use]
    pub fn arc_length(&self) -> f64 {
        let axes = feed_group(&(self.arrive / self.d[0]), &(self.leave / self.d[1]));
        let rate = |u: f64| {
            let g = self.profile.g(u)[0];
            norm_in(&(self.arrive * (1.0 - g) + self.leave * g), axes.clone())
        };
        // Each half on its own, panels halving towards the middle.
        quadrature::graded_half(|x| rate(0.5 * x))
            + quadrature::graded_half(|x| rate(1.0 - 0.5 * x))
    }
}
