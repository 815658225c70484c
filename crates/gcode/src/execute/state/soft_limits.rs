//! Soft limits: where the moves of each axis may end.

use glidepath_geometry::{Axis, AxisVector};

use crate::setup::machine::{Machine, Travel};

/// Relative slack of the soft limits, for the rounding of unit conversions.
const LIMIT_SLACK: f64 = 1e-9;

/// The soft limits with their slack, infinite where there is none.
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
            if let Some(Travel { min, max }) = machine.travel(axis) {
                limits.low[axis.index()] = min - LIMIT_SLACK * min.abs().max(1.0);
                limits.high[axis.index()] = max + LIMIT_SLACK * max.abs().max(1.0);
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
