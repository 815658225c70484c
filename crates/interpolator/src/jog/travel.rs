//! Where a jog may go.

use crate::config::SoftLimits;
use glidepath_geometry::AxisVector;

/// The box that a jog stays in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Travel {
    lowest: AxisVector,
    highest: AxisVector,
}

impl Travel {
    /// From where the axes are: the travel, and where an axis stands outside of it, the way
    /// inwards.
    pub(crate) fn from(soft_limits: &SoftLimits, position: &AxisVector) -> Self {
        Self {
            lowest: soft_limits.lowest.inf(position),
            highest: soft_limits.highest.sup(position),
        }
    }

    /// From where the axes are when nobody knows where that is: the whole length of travel to
    /// either side.
    pub(crate) fn around(soft_limits: &SoftLimits, position: &AxisVector) -> Self {
        let length = soft_limits.highest - soft_limits.lowest;
        Self {
            lowest: position - length,
            highest: position + length,
        }
    }

    pub(crate) const fn lowest(&self) -> &AxisVector {
        &self.lowest
    }

    pub(crate) const fn highest(&self) -> &AxisVector {
        &self.highest
    }

    /// Whether a box lies inside, but for rounding.
    pub(crate) fn holds(&self, (low, high): &(AxisVector, AxisVector)) -> bool {
        /// mm or degrees: what a first frame may be off, too.
        const ROUNDING: f64 = 1e-9;
        let above = low
            .iter()
            .zip(&self.lowest)
            .all(|(x, low)| *x >= low - ROUNDING);
        above
            && high
                .iter()
                .zip(&self.highest)
                .all(|(x, high)| *x <= high + ROUNDING)
    }
}
