//! Soft limits: where the moves of each axis may end.

use glidepath_geometry::{Axis, AxisVector};
use glidepath_program::Travel as Ends;

use crate::setup::machine::{AxisTravel, Machine};

/// The soft limits with what rounding may put a coordinate beyond them, infinite where there is none. It
/// is no more than whoever plays the motion allows: what is accepted can be driven.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SoftLimits {
    pub(crate) low: AxisVector,
    pub(crate) high: AxisVector,
}

impl SoftLimits {
    pub(crate) fn of(machine: &Machine) -> Self {
        let mut limits = Self {
            low: AxisVector::repeat(f64::NEG_INFINITY),
            high: AxisVector::repeat(f64::INFINITY),
        };
        for axis in Axis::ALL {
            if let Some(AxisTravel { min, max }) = machine.travel(axis) {
                limits.low[axis.index()] = min - Ends::ROUNDING;
                limits.high[axis.index()] = max + Ends::ROUNDING;
            }
        }
        limits
    }

    /// True if a coordinate is beyond a limit of its axis, which has that index.
    #[inline]
    pub(crate) fn is_beyond(&self, axis: usize, coordinate: f64) -> bool {
        (coordinate < self.low[axis]) | (coordinate > self.high[axis])
    }
}
