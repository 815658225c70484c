//! The definition of rest, of the same position, and of where a machine may rest, for both threads.

use crate::config::Config;
use glidepath_geometry::AxisVector;
use glidepath_link::SetpointFrame;
use glidepath_program::Travel;

/// How far the first frame of an epoch may be from where the machine stands, mm or degrees.
pub(crate) const SAME_POSITION: f64 = 1e-9;

/// Whether the planned motion is at rest at a frame.
pub(crate) fn is_at_rest(frame: &SetpointFrame) -> bool {
    /// mm/s and mm/s²; what is left of a planned stop after rounding.
    const REST: f64 = 1e-6;
    frame
        .velocity
        .iter()
        .chain(&frame.acceleration)
        .all(|value| value.abs() <= REST)
}

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
