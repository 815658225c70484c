//! Where a machine may rest whose path is dropped.

use crate::shared::config::Config;
use glidepath_geometry::AxisVector;
use glidepath_program::Travel;

/// The travel that a machine rests in when its path is dropped.
///
/// Frames are inside; between two of them the motion may swing over an end by nanometres
/// ([`Travel::SWING_R`]), and a hold may rest just there. The next program, and a jog, begin inside.
#[derive(Debug)]
pub(crate) struct RestingTravel {
    lowest: AxisVector,
    highest: AxisVector,
    swing: AxisVector,
}

impl RestingTravel {
    pub(crate) fn of(config: &Config) -> Self {
        let t = config.period_t();
        Self {
            lowest: config.soft_limits.lowest,
            highest: config.soft_limits.highest,
            swing: config.limits.jerk * (Travel::SWING_R * t * t * t),
        }
    }

    /// The place at an end of travel for each axis that has swung over it. Axes that are further
    /// beyond stay there: they are not homed, or were left there.
    pub(crate) fn nearest(&self, position: &AxisVector) -> AxisVector {
        let inside = position.sup(&self.lowest).inf(&self.highest);
        AxisVector::from_fn(|i, _| {
            let has_swung = (position[i] - inside[i]).abs() <= self.swing[i];
            if has_swung { inside[i] } else { position[i] }
        })
    }
}
