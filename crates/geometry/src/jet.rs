//! A point of a path with its derivatives.

use crate::AxisVector;

/// Position and its first three derivatives by path position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jet {
    /// Position.
    pub position: AxisVector,
    /// First derivative by `s`, units of the axis per unit of `s`.
    pub d1: AxisVector,
    /// Second derivative by `s`.
    pub d2: AxisVector,
    /// Third derivative by `s`.
    pub d3: AxisVector,
}
