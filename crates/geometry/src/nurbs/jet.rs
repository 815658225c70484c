//! A point of a NURBS with its derivatives.

use crate::{AxisVector, Jet};
use core::ops::Range;

/// A point of a curve and its derivatives by the curve's own parameter `u`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NurbsJet {
    /// Position.
    pub position: AxisVector,
    /// First derivative by `u`.
    pub d1: AxisVector,
    /// Second derivative by `u`.
    pub d2: AxisVector,
    /// Third derivative by `u`.
    pub d3: AxisVector,
}

impl NurbsJet {
    /// The same by path position instead of `u`, the feed measured in `axes` (see
    /// [`Nurbs::feed_axes`](crate::Nurbs::feed_axes)). Where the curve stands still there is no such
    /// derivative: all are zero.
    #[must_use]
    pub fn by_path_position(&self, axes: Range<usize>) -> Jet {
        let dot = |a: &AxisVector, b: &AxisVector| axes.clone().map(|i| a[i] * b[i]).sum::<f64>();
        let s1 = dot(&self.d1, &self.d1).sqrt();
        if s1 <= 0.0 {
            let zero = AxisVector::zeros();
            return Jet {
                position: self.position,
                d1: zero,
                d2: zero,
                d3: zero,
            };
        }
        let s2 = dot(&self.d1, &self.d2) / s1;
        let s3 = (dot(&self.d2, &self.d2) + dot(&self.d1, &self.d3) - s2 * s2) / s1;
        let u1 = 1.0 / s1;
        let u2 = -s2 * u1 * u1 * u1;
        let u3 = (3.0 * s2 * s2 - s1 * s3) * u1.powi(5);
        Jet {
            position: self.position,
            d1: self.d1 * u1,
            d2: self.d2 * (u1 * u1) + self.d1 * u2,
            d3: self.d3 * (u1 * u1 * u1) + self.d2 * (3.0 * u1 * u2) + self.d1 * u3,
        }
    }
}
