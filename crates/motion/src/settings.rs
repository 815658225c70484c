//! What a plan is made with.

use crate::Limits;

/// Which curve replaces a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Smoothing {
    /// The uniform sextic ("B6").
    #[default]
    Sextic,
    /// The rational Bézier pair of the published method, at constant corner speed.
    BezierPair,
    /// No curve: the machine rests at every corner.
    ExactStop,
}

/// How much work planning may cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Effort {
    /// Corner transitions and closed-form S-curves.
    #[default]
    Fast,
}

/// Everything a plan depends on besides the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// What each axis can do.
    pub limits: Limits,
    /// Tolerance in mm, smoothing and chord error together, > 0; G64 P overrides it. It holds for
    /// the XYZ group, the UVW group, and (in degrees) for the rotary axes.
    pub tolerance_mm: f64,
    /// The curve at corners.
    pub smoothing: Smoothing,
    /// Interpolation period in seconds, > 0.
    pub period_t: f64,
    /// Planning effort.
    pub effort: Effort,
}
