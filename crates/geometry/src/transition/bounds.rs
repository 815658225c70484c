//! The bounds on the derivatives of a curve, axis by axis.

use crate::AxisVector;

/// The largest magnitude, per axis, of the derivatives by path position over a whole curve.
///
/// Upper bounds: never below the true maximum, above it by at most a few percent. At constant rate
/// `v` of path position, axis `i` needs `v·d1[i]`, `v²·d2[i]` and `v³·d3[i]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DerivativeBounds {
    /// The largest absolute first derivative, axis unit per mm.
    pub d1: AxisVector,
    /// The largest absolute second derivative, axis unit per mm².
    pub d2: AxisVector,
    /// The largest absolute third derivative, axis unit per mm³.
    pub d3: AxisVector,
}
