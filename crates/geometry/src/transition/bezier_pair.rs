//! The published pair of rational cubic Bézier curves, by arc length.
//!
//! One half runs from the arriving line to the junction, the other is its mirror image:
//!
//! ```text
//! half A:  P − d·T1,  P − d·T1/2,  P − d·T1/4,  P + d·(T2 − T1)/8      weights s1, 1, 1, s2
//! ```
//!
//! With unit weights the two are one cubic, P − d·T1·(1−u)³ + d·T2·u³, cut in the middle. The deviation
//! δ = d·sin β/4 does not depend on the weights. Curvature meets that of the lines (zero), its
//! derivative does not: at speed v the jerk steps there by v³ times
//! [`PairShape::end_curvature_rate`]. At the junction the derivative is continuous exactly if
//! s2·(4 − s1) = 3. (The conditions printed in the paper hold for any symmetric pair and do not imply
//! it; nor does continuous torsion, which is zero for every planar curve.)
//!
//! The speed along the parameter changes by 2/cos β and more, so the curve is run by arc length:
//! lengths up to graded parameter values are tabulated, then Newton's method on a Gauss rule.

use super::constant_speed::{Frame, PlanarJet};
use super::{DerivativeBounds, TransitionError};
use crate::quadrature::{PANELS, gauss_12, graded_boundary};
use crate::{AxisVector, Jet, Turn};

mod enclosure;
use enclosure::PairHalf;

/// Shape invariants of a half: s1 = w0·w2/w1², s2 = w1·w3/w2², both > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairShape {
    /// At the line.
    pub s1: f64,
    /// At the junction.
    pub s2: f64,
}

impl PairShape {
    /// Unit weights: one polynomial cubic.
    pub const CUBIC: Self = Self { s1: 1.0, s2: 1.0 };
    /// A sensible fixed choice among the pairs whose curvature is smooth at the junction: 12 % less
    /// peak curvature than the cubic.
    pub const SMOOTH: Self = Self {
        s1: 0.6,
        s2: 15.0 / 17.0,
    };

    /// True if the derivative of curvature is continuous at the junction, to a relative 1e-12.
    #[must_use]
    pub fn is_smooth_at_junction(self) -> bool {
        (self.s2 * (4.0 - self.s1) - 3.0).abs() <= 3e-12
    }

    /// Largest distance of the corner from the curve, mm; `sb` as for [`super::Profile::deviation`].
    #[must_use]
    pub fn deviation(d: f64, sb: f64) -> f64 {
        0.25 * d * sb
    }

    /// The length `d` that gives a deviation; infinite for `sb` = 0.
    #[must_use]
    pub fn distance_for(deviation_mm: f64, sb: f64) -> f64 {
        4.0 * deviation_mm / sb
    }

    /// Curvature at the junction, 1/mm. It is the largest if [`PairShape::peaks_at_junction`].
    #[must_use]
    pub fn junction_curvature(self, d: f64, turn: Turn) -> f64 {
        self.s2 * 8.0 * turn.sb / (3.0 * d * turn.cb * turn.cb)
    }

    /// Whether the curvature peaks at the junction, for a shape that is smooth there. Where it does
    /// not, the peak was at most 0.3 % higher for 0.02 ≤ s1.
    #[must_use]
    pub fn peaks_at_junction(self, turn: Turn) -> bool {
        let tan = turn.sb / turn.cb;
        3.0 * tan * tan + 3.0 * self.s1 * self.s1 - self.s1 >= 0.0
    }

    /// Derivative of curvature by arc length where the curve leaves the line, 1/mm²: never zero.
    #[must_use]
    pub fn end_curvature_rate(self, d: f64, turn: Turn) -> f64 {
        2.0 * self.s1 * self.s1 * self.s2 * turn.sin_theta() / (9.0 * d * d)
    }

    /// Derivative of curvature by arc length arriving at the junction, 1/mm²; it leaves with the
    /// opposite sign.
    #[must_use]
    pub fn junction_curvature_rate(self, d: f64, turn: Turn) -> f64 {
        let Self { s1, s2 } = self;
        32.0 / 3.0 * s2 * (4.0 * s2 - s1 * s2 - 3.0) * turn.sb / (d * d * turn.cb.powi(3))
    }
}

/// A pair at a corner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BezierPair {
    frame: Frame,
    half: HalfCurve,
    /// Arc length up to each graded parameter value of the first half.
    table: [f64; PANELS + 1],
}

impl BezierPair {
    /// The pair that takes `d` > 0 from each side of the corner. `t1`, `t2`: unit feed length.
    ///
    /// # Errors
    /// For a reversal, and for directions that are not both unit in the same axes.
    pub fn new(
        corner: AxisVector,
        t1: AxisVector,
        t2: AxisVector,
        d: f64,
        shape: PairShape,
    ) -> Result<Self, TransitionError> {
        let frame = Frame::new(corner, &t1, &t2)?;
        let half = HalfCurve {
            d,
            shape,
            turn: frame.turn,
        };
        let mut table = [0.0; PANELS + 1];
        for i in 0..PANELS {
            let panel = gauss_12(graded_boundary(i), graded_boundary(i + 1), |t| {
                half.speed(t)
            });
            table[i + 1] = table[i] + panel;
        }
        Ok(Self { frame, half, table })
    }

    /// Arc length of the whole curve, mm.
    #[must_use]
    pub const fn length(&self) -> f64 {
        2.0 * self.table[PANELS]
    }

    /// Arc length up to parameter `t` of the first half, mm; `t` from 0, the line, to 1, the junction.
    #[must_use]
    pub fn arc_length_at(&self, t: f64) -> f64 {
        let panel = (0..PANELS)
            .rev()
            .find(|&i| graded_boundary(i) <= t)
            .unwrap_or(0);
        self.table[panel] + gauss_12(graded_boundary(panel), t, |t| self.half.speed(t))
    }

    /// Position and derivatives at arc length `s`.
    #[must_use]
    pub fn jet(&self, s: f64) -> Jet {
        let second_half = s > self.table[PANELS];
        let s = if second_half { self.length() - s } else { s };
        self.frame
            .jet(&self.half.by_arc_length(self.parameter_at(s)), second_half)
    }

    /// Largest derivatives per axis.
    #[must_use]
    pub fn bounds(&self) -> DerivativeBounds {
        let unit = PairHalf::new(&HalfCurve {
            d: 1.0,
            ..self.half
        });
        let mut bounds = self.frame.bounds(&unit);
        bounds.d2 /= self.half.d;
        bounds.d3 /= self.half.d * self.half.d;
        bounds
    }

    /// The parameter of the first half at arc length `s`.
    fn parameter_at(&self, s: f64) -> f64 {
        let panel = self.table[1..PANELS]
            .iter()
            .take_while(|&&up_to| up_to < s)
            .count();
        let (mut low, mut high) = (graded_boundary(panel), graded_boundary(panel + 1));
        let share = (s - self.table[panel]) / (self.table[panel + 1] - self.table[panel]);
        let mut t = low + (high - low) * share;
        let start = low;
        // Newton, kept inside the panel; converges in four or five steps from the linear guess.
        for _ in 0..20 {
            let error = self.table[panel] + gauss_12(start, t, |t| self.half.speed(t)) - s;
            if error > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let step = error / self.half.speed(t);
            let next = if (low..=high).contains(&(t - step)) {
                t - step
            } else {
                0.5 * (low + high)
            };
            let moved = (next - t).abs();
            t = next;
            if moved <= 1e-15 {
                break;
            }
        }
        t
    }
}

/// First half of a pair in the planar frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct HalfCurve {
    d: f64,
    shape: PairShape,
    turn: Turn,
}

impl HalfCurve {
    /// Homogeneous Bézier points: weighted coordinates along and across, and the weight.
    const fn homogeneous(&self) -> [[f64; 4]; 3] {
        let PairShape { s1, s2 } = self.shape;
        let d = self.d;
        [
            [-d * s1, -0.5 * d, -0.25 * d, 0.0],
            [d * s1, 0.5 * d, 0.25 * d, 0.25 * d * s2],
            [s1, 1.0, 1.0, s2],
        ]
    }

    /// Coordinates and three derivatives by the parameter.
    fn by_parameter(&self, t: f64) -> PlanarJet {
        let [x, y, w] = self.homogeneous().map(|c| cubic(&c, t));
        let mut jet = [[0.0; 2]; 4];
        for (axis, n) in [x, y].into_iter().enumerate() {
            let r0 = n[0] / w[0];
            let r1 = (n[1] - r0 * w[1]) / w[0];
            let r2 = (n[2] - 2.0 * r1 * w[1] - r0 * w[2]) / w[0];
            let r3 = (n[3] - 3.0 * r2 * w[1] - 3.0 * r1 * w[2] - r0 * w[3]) / w[0];
            for (order, value) in [r0, r1, r2, r3].into_iter().enumerate() {
                jet[order][axis] = value;
            }
        }
        jet
    }

    fn dot(&self, a: [f64; 2], b: [f64; 2]) -> f64 {
        let Turn { sb, cb } = self.turn;
        cb * cb * a[0] * b[0] + sb * sb * a[1] * b[1]
    }

    /// |r'| = |N'·w − N·w'| / w².
    fn speed(&self, t: f64) -> f64 {
        let [x, y, w] = self.homogeneous().map(|c| cubic(&c, t));
        let velocity = [x[1] * w[0] - x[0] * w[1], y[1] * w[0] - y[0] * w[1]];
        self.dot(velocity, velocity).sqrt() / (w[0] * w[0])
    }

    /// Coordinates and three derivatives by arc length, at a parameter.
    fn by_arc_length(&self, t: f64) -> PlanarJet {
        let [r0, r1, r2, r3] = self.by_parameter(t);
        // With v = |r'|: t' = 1/v, t'' = −v'/v³, t''' = (3v'² − v·v'')/v⁵.
        let v = self.dot(r1, r1).sqrt();
        let v_1 = self.dot(r1, r2) / v;
        let v_v2 = self.dot(r2, r2) + self.dot(r1, r3) - v_1 * v_1;
        let t1 = 1.0 / v;
        let t2 = -v_1 / v.powi(3);
        let t3 = (3.0 * v_1 * v_1 - v_v2) / v.powi(5);
        let mut jet = [r0, [0.0; 2], [0.0; 2], [0.0; 2]];
        for axis in 0..2 {
            jet[1][axis] = r1[axis] * t1;
            jet[2][axis] = r2[axis] * t1 * t1 + r1[axis] * t2;
            jet[3][axis] = r3[axis] * t1 * t1 * t1 + 3.0 * r2[axis] * t1 * t2 + r1[axis] * t3;
        }
        jet
    }
}

/// Value and three derivatives of a cubic in Bernstein form.
fn cubic(c: &[f64; 4], t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    let d = [c[1] - c[0], c[2] - c[1], c[3] - c[2]];
    let e = [d[1] - d[0], d[2] - d[1]];
    [
        c[0] * s * s * s + 3.0 * t * s * (c[1] * s + c[2] * t) + c[3] * t * t * t,
        3.0 * (d[0] * s * s + 2.0 * d[1] * s * t + d[2] * t * t),
        6.0 * (e[0] * s + e[1] * t),
        6.0 * (e[1] - e[0]),
    ]
}
