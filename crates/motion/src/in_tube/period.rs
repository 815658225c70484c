//! The state of the machine, and what is told of it for a period.

use glidepath_geometry::AxisVector;

/// The state of the machine one period further.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Period {
    /// mm or degrees.
    pub(crate) position: AxisVector,
    /// Per second.
    pub(crate) velocity: AxisVector,
    /// Per second squared.
    pub(crate) acceleration: AxisVector,
    /// Path speed, mm/s of feed length.
    pub(crate) path_v: f64,
    /// Progress along the path, mm of feed length since the start of the stretch; never falls.
    pub(crate) path_s: f64,
    /// Tag of the piece it belongs to; never an earlier one than before.
    pub(crate) tag: u64,
    /// At rest, exactly at the end of the path: the last period.
    pub(crate) rest_at_end: bool,
}

impl Period {
    /// At rest somewhere.
    pub(crate) fn rest(position: AxisVector) -> Self {
        Self {
            position,
            velocity: AxisVector::zeros(),
            acceleration: AxisVector::zeros(),
            path_v: 0.0,
            path_s: 0.0,
            tag: 0,
            rest_at_end: false,
        }
    }
}

/// Position, velocity and acceleration.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    pub(crate) position: AxisVector,
    pub(crate) velocity: AxisVector,
    pub(crate) acceleration: AxisVector,
}

impl State {
    /// At rest somewhere.
    pub(crate) fn rest(position: AxisVector) -> Self {
        Self {
            position,
            velocity: AxisVector::zeros(),
            acceleration: AxisVector::zeros(),
        }
    }
}

impl From<&Period> for State {
    fn from(period: &Period) -> Self {
        Self {
            position: period.position,
            velocity: period.velocity,
            acceleration: period.acceleration,
        }
    }
}
