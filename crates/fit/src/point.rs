//! Points of a run.

use nalgebra::Vector3;

/// X, Y and Z of a point, mm.
pub type Point = Vector3<f64>;
