//! The pole of polar coordinates (SINUMERIK's G110, G111, G112), and what AP and RP said last.

/// The pole, program coordinates of X, Y and Z in mm, and the last radius and angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pole {
    /// The program's zero until a pole is set.
    pub(crate) at: [f64; 3],
    /// RP, mm; `None`: none was written since the pole was set.
    pub(crate) radius_mm: Option<f64>,
    /// AP, degrees; likewise.
    pub(crate) degrees: Option<f64>,
}
