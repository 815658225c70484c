//! The table `[spindle]`.

use glidepath_geometry::Axis;

/// A spindle whose angle is known, which is turned to an angle, or which is an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleConfig {
    /// Its angle is known.
    pub encoder: bool,
    /// It turns to an angle, and stands there (M19 R).
    pub orientation: bool,
    /// The axis that its drive follows while M3 and M4 do not turn it.
    pub axis: Option<Axis>,
    /// G84 and G74 tap rigidly.
    pub rigid_tapping: bool,
    /// How fast its speed changes when it turns back, rev/s²; `None`: nobody knows.
    pub acceleration: Option<f64>,
    /// Revolutions for which a tap goes on at most from where it is told to turn back.
    pub overtravel: f64,
}
