//! A phase of constant jerk.

/// Motion along the path at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathState {
    /// Position from the start of the profile, mm.
    pub position_s: f64,
    /// Speed, mm/s.
    pub speed_v: f64,
    /// Acceleration, mm/s².
    pub accel_a: f64,
}

/// One phase of constant jerk, with the state at its start.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Phase {
    pub(super) start_t: f64,
    pub(super) duration_t: f64,
    pub(super) jerk_j: f64,
    pub(super) accel_a: f64,
    pub(super) speed_v: f64,
    pub(super) position_s: f64,
}

impl Phase {
    pub(super) fn at(&self, t: f64) -> PathState {
        PathState {
            position_s: self.position_s
                + t * (self.speed_v + t * (self.accel_a / 2.0 + t * (self.jerk_j / 6.0))),
            speed_v: self.speed_v + t * (self.accel_a + t * (self.jerk_j / 2.0)),
            accel_a: self.accel_a + t * self.jerk_j,
        }
    }
}
