//! A demand for a jog, as the real-time thread gets it: checked, and about axes.

use glidepath_geometry::AxisVector;
use glidepath_link::JogMode;

/// A demand for a jog.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Demand {
    pub(crate) client: u64,
    pub(crate) number: u64,
    pub(crate) sent_ns: u64,
    /// It was asked for before the machine was stopped last.
    pub(crate) is_outdated: bool,
    /// Stops that were ordered before it was passed on.
    pub(crate) behind_stops: u64,
    pub(crate) mode: JogMode,
    /// How fast at most where no velocity is given; infinite for as fast as may be.
    pub(crate) most_v: f64,
    /// What a count of a wheel is.
    pub(crate) scale: f64,
    /// Velocities, distances or counts; 0 for the axes that are not meant.
    pub(crate) value: AxisVector,
}

impl Demand {
    /// Whether it wants the axes to move, or to go on moving.
    pub(crate) fn wants_motion(&self) -> bool {
        let is_wheel = matches!(self.mode, JogMode::Wheel | JogMode::WheelVelocity);
        self.mode != JogMode::None && (is_wheel || self.value.amax() > 0.0)
    }
}

/// The demand that was followed last; all 0 before the first.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Jogged {
    pub(crate) client: u64,
    pub(crate) number: u64,
}
