//! The table `[spindle]`.

/// A spindle whose angle is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpindleConfig {
    /// G84 and G74 tap rigidly.
    pub rigid_tapping: bool,
    /// How fast its speed changes when it turns back, rev/s²; `None`: nobody knows.
    pub acceleration: Option<f64>,
}
