//! The machine that a program is read for: its axes and their travel.

use glidepath_geometry::{AXES, Axis};

/// The travel of an axis, in machine coordinates: mm, or degrees for a rotary axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisTravel {
    /// Smallest coordinate.
    pub min: f64,
    /// Largest coordinate, ≥ `min`.
    pub max: f64,
}

/// The axes a machine has, and their soft limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Machine {
    configured: [bool; AXES],
    travel: [Option<AxisTravel>; AXES],
}

impl Machine {
    /// A machine with these axes and no soft limits.
    #[must_use]
    pub fn new(axes: &[Axis]) -> Self {
        let mut configured = [false; AXES];
        for axis in axes {
            configured[axis.index()] = true;
        }
        Self {
            configured,
            travel: [None; AXES],
        }
    }

    /// A machine with all nine axes and no soft limits.
    #[must_use]
    pub fn unlimited() -> Self {
        Self::new(&Axis::ALL)
    }

    /// The same machine with the travel of one axis limited; the axis is added if it was missing.
    #[must_use]
    pub const fn with_travel(mut self, axis: Axis, travel: AxisTravel) -> Self {
        self.configured[axis.index()] = true;
        self.travel[axis.index()] = Some(travel);
        self
    }

    /// True if the machine has the axis.
    #[must_use]
    pub const fn has(&self, axis: Axis) -> bool {
        self.configured[axis.index()]
    }

    /// True for a machine with X and Z, and without Y.
    #[must_use]
    pub const fn is_lathe(&self) -> bool {
        self.has(Axis::X) && self.has(Axis::Z) && !self.has(Axis::Y)
    }

    /// Soft limits of an axis; `None`: not checked.
    #[must_use]
    pub const fn travel(&self, axis: Axis) -> Option<AxisTravel> {
        self.travel[axis.index()]
    }
}
