//! The settings of a plan: everything that it depends on besides the program.

use serde::{Deserialize, Serialize};

use crate::Limits;
use glidepath_geometry::AxisVector;

/// The way in which corners are passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Smoothing {
    /// As the effort does it best: anywhere within the tolerance ([`Effort::Optimal`]), or by the
    /// uniform sextic ([`Effort::Fast`]).
    #[default]
    Auto,
    /// The uniform sextic ("B6") replaces a corner, whatever the effort.
    Sextic,
    /// The rational Bézier pair of the published method, at constant corner speed, whatever the
    /// effort.
    BezierPair,
    /// No curve: the machine rests at every corner.
    ExactStop,
}

/// The side of the program on which the motion may be, within the tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Corners {
    /// On the inner side of corners between straight feed moves, as a rounded corner is; and an axis
    /// that comes to a rest, sets out from one or turns round does not pass that place.
    #[default]
    Inner,
    /// On either side: the motion may swing out of corners, and axes may pass the places where they stop.
    Either,
}

/// The effort of planning: how much work it may cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Effort {
    /// Geometry and time are optimised together, in the tube that the tolerance makes around the
    /// path: near the least time that the limits and the tolerance allow.
    #[default]
    Optimal,
    /// The path is settled first, with transitions at corners, and its time is optimised along it
    /// by closed-form S-curves: some hundred times less work.
    Fast,
}

impl Effort {
    /// Its name in configurations.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Fast => "fast",
        }
    }
}

/// How far the direction of the tool may be from the programmed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectionTolerance {
    /// Degrees, > 0, whatever the tolerance of the tip is. `None`: as many degrees as that has mm; then a flank is
    /// off by no more than the tip may be, up to 57 mm above it (1 mm is a degree there).
    pub angle_deg: Option<f64>,
    /// By how many degrees the direction turns at most where the rotary axes turn by one together (the root of
    /// their sum of squares), > 0.
    pub turn_r: f64,
}

/// As many degrees as the tolerance of the tip has mm, for rotary axes that turn the tool by no more than they turn.
impl Default for DirectionTolerance {
    fn default() -> Self {
        Self {
            angle_deg: None,
            turn_r: 1.0,
        }
    }
}

impl DirectionTolerance {
    /// Share of the tolerance by which whoever reads a program may change a direction where it passes the pole. What it
    /// gives out may be off by twice that, and the rest is left to the motion.
    pub const POLE_R: f64 = 0.05;

    /// Degrees, where the tolerance of the tip is so many mm.
    #[must_use]
    pub fn in_force_deg(&self, tolerance_mm: f64) -> f64 {
        self.angle_deg.unwrap_or(tolerance_mm)
    }

    /// What a degree of the rotary axes counts for in [`crate::tolerance_norm`], where the tolerance of the tip is
    /// so many mm: within it the direction is within its tolerance.
    #[must_use]
    pub fn mm_per_deg(&self, tolerance_mm: f64) -> f64 {
        self.turn_r * self.angle_deg.map_or(1.0, |deg| tolerance_mm / deg)
    }
}

/// Everything a plan depends on besides the program.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// What each axis can do.
    pub limits: Limits,
    /// Tolerance in mm, smoothing and chord error together, > 0; G64 P overrides it. It holds for
    /// the XYZ group and for the UVW group.
    pub tolerance_mm: f64,
    /// That of the rotary axes.
    pub direction: DirectionTolerance,
    /// How corners are passed; what names a curve is planned with [`Effort::Fast`].
    pub smoothing: Smoothing,
    /// On which side of them [`Effort::Optimal`] may be. [`Effort::Fast`] rounds them, on the inner one.
    pub corners: Corners,
    /// Interpolation period in seconds, > 0.
    pub period_t: f64,
    /// Planning effort.
    pub effort: Effort,
}

impl Settings {
    /// The same for a motion that begins at a place: an axis that stands beyond its travel there may stay or come
    /// inwards ([`crate::Travel::beginning_at`]).
    #[must_use]
    pub fn beginning_at(mut self, start: &AxisVector) -> Self {
        self.limits.travel = self.limits.travel.beginning_at(start);
        self
    }
}
