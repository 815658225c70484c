//! The travel of a jog: the box that it stays in.

use crate::shared::config::SoftLimits;
use crate::shared::rest::SAME_POSITION;
use glidepath_geometry::{AXES, AxisVector};

/// The box that a jog stays in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Travel {
    lowest: AxisVector,
    highest: AxisVector,
}

impl Travel {
    /// From where the axes are. One that knows where that is has its travel, and where it stands
    /// outside of it, the way inwards; one that does not has the whole length of travel to either
    /// side of where it began.
    pub(crate) fn from(
        soft_limits: &SoftLimits,
        position: &AxisVector,
        began_at: &AxisVector,
        is_homed: &[bool; AXES],
    ) -> Self {
        let SoftLimits { lowest, highest } = soft_limits.beginning_at(position);
        let mut travel = Self { lowest, highest };
        let length = soft_limits.highest - soft_limits.lowest;
        let ends = travel.lowest.iter_mut().zip(travel.highest.iter_mut());
        let around = began_at.iter().zip(&length);
        for (((low, high), (began_at, length)), is_homed) in ends.zip(around).zip(is_homed) {
            if !is_homed {
                (*low, *high) = (began_at - length, began_at + length);
            }
        }
        travel
    }

    pub(crate) const fn lowest(&self) -> &AxisVector {
        &self.lowest
    }

    pub(crate) const fn highest(&self) -> &AxisVector {
        &self.highest
    }

    /// The place inside that is nearest to one, axis by axis.
    pub(crate) fn nearest(&self, place: &AxisVector) -> AxisVector {
        place.sup(&self.lowest).inf(&self.highest)
    }

    /// What is left of velocities where axes stand at the end of their travel: they go no further,
    /// and the others go on.
    pub(crate) fn open_to(&self, position: &AxisVector, speeds: &AxisVector) -> AxisVector {
        let mut open = *speeds;
        let ends = self.lowest.iter().zip(&self.highest);
        for ((v, x), (low, high)) in open.iter_mut().zip(position).zip(ends) {
            let is_at_end =
                (*v < 0.0 && x - low <= SAME_POSITION) || (*v > 0.0 && high - x <= SAME_POSITION);
            if is_at_end {
                *v = 0.0;
            }
        }
        open
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
