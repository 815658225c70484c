//! The published pair of rational cubic Bézier curves, by arc length.
//!
//! One half runs from the arriving line to the junction, the other is its mirror image:
//!
//! ```text
//! half A:  P − d·T1,  P − d·T1/2,  P − d·T1/4,  P + d·(T2 − T1)/8      weights s1, 1, 1, s2
//! ```
//!
//! With unit weights the two are one cubic, P − d·T1·(1−u)³ + d·T2·u³, cut in the middle. The
//! deviation δ = d·sin β/4 does not depend on the weights. Curvature meets that of the lines
//! (zero), its derivative does not: at speed v the jerk steps there by v³ times
//! [`PairShape::end_curvature_rate`]. At the junction the derivative is continuous exactly if
//! s2·(4 − s1) = 3. (The conditions printed in the paper hold for any symmetric pair and do not
//! imply it; nor does continuous torsion, which is zero for every planar curve.)
//!
//! The speed along the parameter changes by 2/cos β and more, so the curve is run by arc length:
//! lengths up to graded parameter values are tabulated, then Newton's method on a Gauss rule.

use super::bounds::DerivativeBounds;
use super::constant_speed::Frame;
use super::error::TransitionError;
use crate::quadrature::{PANELS, gauss_12, graded_boundary};
use crate::{AxisVector, Jet};

mod enclosure;
mod half;
mod shape;

pub use shape::PairShape;

use enclosure::PairHalf;
use half::HalfCurve;

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

    /// Arc length up to parameter `t` of the first half, mm; `t` from 0, the line, to 1, the
    /// junction.
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
