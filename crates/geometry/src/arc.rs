//! Circular arcs and helices in one of the coordinate planes.

use serde::{Deserialize, Serialize};

use crate::{Axis, AxisVector};

/// The plane of an arc: two axes, the first turning towards the second for a positive sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Plane {
    /// G17.
    Xy,
    /// G18. The positive turn is from Z to X (right-hand about Y).
    Zx,
    /// G19.
    Yz,
    /// G17.1.
    Uv,
    /// G18.1.
    Wu,
    /// G19.1.
    Vw,
}

impl Plane {
    /// First and second axis of the plane.
    #[must_use]
    pub const fn axes(self) -> (Axis, Axis) {
        match self {
            Self::Xy => (Axis::X, Axis::Y),
            Self::Zx => (Axis::Z, Axis::X),
            Self::Yz => (Axis::Y, Axis::Z),
            Self::Uv => (Axis::U, Axis::V),
            Self::Wu => (Axis::W, Axis::U),
            Self::Vw => (Axis::V, Axis::W),
        }
    }

    /// The axis normal to the plane, along which a helix rises.
    #[must_use]
    pub const fn normal(self) -> Axis {
        match self {
            Self::Xy => Axis::Z,
            Self::Zx => Axis::Y,
            Self::Yz => Axis::X,
            Self::Uv => Axis::W,
            Self::Wu => Axis::V,
            Self::Vw => Axis::U,
        }
    }
}

/// An arc of any sweep, several turns included, with every other axis moving in proportion.
///
/// Start and end need not be at exactly the same distance from the centre (programs round their
/// coordinates): the radius then goes linearly from one to the other, so both ends are met exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Where it starts.
    pub start: AxisVector,
    /// Where it ends.
    pub end: AxisVector,
    /// Its plane.
    pub plane: Plane,
    /// Centre: coordinates on the first and second axis of the plane, mm.
    pub center: [f64; 2],
    /// Signed sweep in radians, positive from the plane's first axis to its second; not zero; a
    /// full turn is ±2π.
    pub sweep_rad: f64,
}

impl Arc {
    /// Distance of the start from the centre, mm.
    #[must_use]
    pub fn start_radius(&self) -> f64 {
        let (first, second) = self.plane.axes();
        (self.start[first.index()] - self.center[0])
            .hypot(self.start[second.index()] - self.center[1])
    }

    /// Distance of the end from the centre, mm.
    #[must_use]
    pub fn end_radius(&self) -> f64 {
        let (first, second) = self.plane.axes();
        (self.end[first.index()] - self.center[0]).hypot(self.end[second.index()] - self.center[1])
    }

    /// Direction from the centre to the start, radians.
    #[must_use]
    pub fn start_angle_rad(&self) -> f64 {
        let (first, second) = self.plane.axes();
        (self.start[second.index()] - self.center[1])
            .atan2(self.start[first.index()] - self.center[0])
    }

    /// Feed length: in-plane length at the mean radius together with the rise along the third axis
    /// of the plane's group, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        let radius = 0.5 * (self.start_radius() + self.end_radius());
        let normal = self.plane.normal().index();
        let rise = self.end[normal] - self.start[normal];
        (radius * self.sweep_rad).hypot(rise)
    }

    /// Smallest and largest coordinate of the arc on every axis, bulges included.
    #[must_use]
    pub fn bounding_box(&self) -> (AxisVector, AxisVector) {
        self.prepared().bounding_box()
    }
}
