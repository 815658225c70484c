//! The work offsets: coordinate systems, reference positions, and the offset of G92, as the
//! operator has set them. A program may change all of it.

use glidepath_geometry::AxisVector;
use serde::{Deserialize, Serialize};

/// Number of coordinate systems: G54 … G59, G59.1 … G59.3.
pub const SYSTEMS: usize = 9;

/// A coordinate system, one of G54 … G59.3.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CoordinateSystem {
    /// Machine coordinates of its zero: mm, degrees.
    pub origin: AxisVector,
    /// How far X and Y are turned about the Z axis, degrees.
    pub rotation_deg: f64,
}

impl Default for CoordinateSystem {
    fn default() -> Self {
        Self {
            origin: AxisVector::zeros(),
            rotation_deg: 0.0,
        }
    }
}

impl CoordinateSystem {
    /// Turns X and Y by the rotation of the system, times `sign`.
    pub(crate) fn rotate(&self, mut v: AxisVector, sign: f64) -> AxisVector {
        if self.rotation_deg != 0.0 {
            let (sin, cos) = (sign * self.rotation_deg.to_radians()).sin_cos();
            (v[0], v[1]) = (v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos);
        }
        v
    }
}

/// The work offsets that a program starts with, or leaves behind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct WorkOffsets {
    /// G54 … G59.3.
    pub systems: [CoordinateSystem; SYSTEMS],
    /// Index of the one in force, below [`SYSTEMS`]; 0 is G54.
    pub active: usize,
    /// Machine positions of G28 and G30.
    pub reference: [AxisVector; 2],
    /// Offset of G92 or G52 in force.
    pub shift: AxisVector,
    /// The offset that G92.3 puts in force.
    pub saved_shift: AxisVector,
}

impl Default for WorkOffsets {
    /// Everything at machine zero, in G54.
    fn default() -> Self {
        Self {
            systems: [CoordinateSystem::default(); SYSTEMS],
            active: 0,
            reference: [AxisVector::zeros(); 2],
            shift: AxisVector::zeros(),
            saved_shift: AxisVector::zeros(),
        }
    }
}
