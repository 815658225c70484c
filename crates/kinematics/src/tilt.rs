//! The tilt of a five-axis machine: about which direction its tilting axis turns.
//!
//! An axis A turns about x and B about y. A skewed one, as of a nutating head or table, turns about a direction in
//! between that and z, at 45° as a rule: half a turn of it leans the tool from upright to level, along a cone, and
//! C has to turn with it. With α the angle between the tilt axis and z, the tool leans by β where
//!
//! ```text
//!   sin(β/2) = sin α · sin(θ/2)         so at most by 2 α
//! ```

use crate::space::Turn;
use glidepath_geometry::Axis;
use glidepath_geometry::number::{Number, Series};
use nalgebra::Vector3;

/// The axis that tilts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tilt {
    /// About x.
    A,
    /// About y.
    B,
    /// About another direction.
    Skewed(SkewedTilt),
}

/// A tilt axis in a direction of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkewedTilt {
    axis: Axis,
    direction: Vector3<f64>,
}

/// Least angle between a tilt axis and that of C, degrees: below it the tool hardly leans.
const LEAST_DEG: f64 = 5.0;

impl SkewedTilt {
    /// A tilt axis of a letter, A or B, about a direction of any length; none for another letter, a direction without
    /// length, and one that is within five degrees of z.
    #[must_use]
    pub fn new(axis: Axis, direction: &Vector3<f64>) -> Option<Self> {
        let direction = direction.try_normalize(1e-9)?;
        let flat = direction.x.hypot(direction.y);
        // Written so that what is not a number is refused.
        let is_apart = flat >= LEAST_DEG.to_radians().sin();
        (is_apart && matches!(axis, Axis::A | Axis::B)).then_some(Self { axis, direction })
    }

    /// The letter of the axis.
    #[must_use]
    pub const fn axis_letter(&self) -> Axis {
        self.axis
    }

    /// The direction, of length 1.
    #[must_use]
    pub const fn direction(&self) -> &Vector3<f64> {
        &self.direction
    }

    /// The angle by which the tool leans at most, degrees: 2 α, or as far below z.
    #[must_use]
    pub fn most_lean_deg(&self) -> f64 {
        let flat = self.direction.x.hypot(self.direction.y);
        2.0 * flat.atan2(self.direction.z.abs()).to_degrees()
    }

    /// The angle θ from 0° to 180° at which the tool leans to a direction of length 1, degrees; none if it leans no
    /// further than [`most_lean_deg`](Self::most_lean_deg), and that is less.
    pub(crate) fn angle_deg(&self, tool_axis: &Vector3<f64>) -> Option<f64> {
        let flat_square = tool_axis.x * tool_axis.x + tool_axis.y * tool_axis.y;
        // 1 − cos β, without cancelling where the tool is nearly upright.
        let fallen = if tool_axis.z > 0.0 {
            flat_square / (1.0 + tool_axis.z)
        } else {
            1.0 - tool_axis.z
        };
        let skew = self.direction.x * self.direction.x + self.direction.y * self.direction.y;
        let square = fallen / (2.0 * skew);
        // Rounding must not put what is just in reach out of it.
        if square > 1.0 + 1e-12 {
            return None;
        }
        let square = square.min(1.0);
        Some(2.0 * square.sqrt().atan2((1.0 - square).sqrt()).to_degrees())
    }
}

impl Tilt {
    /// The letter of the axis.
    #[must_use]
    pub const fn axis(&self) -> Axis {
        match self {
            Self::A => Axis::A,
            Self::B => Axis::B,
            Self::Skewed(skewed) => skewed.axis_letter(),
        }
    }

    /// A turn by an angle in degrees.
    pub(crate) fn turn<const N: usize, T: Number>(&self, angle_deg: Series<N, T>) -> Turn<N, T> {
        match self {
            Self::A => Turn::new(0, angle_deg),
            Self::B => Turn::new(1, angle_deg),
            Self::Skewed(skewed) => Turn::about(skewed.direction, angle_deg),
        }
    }
}
