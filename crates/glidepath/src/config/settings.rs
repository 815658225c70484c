//! The settings of a machine by what they are about: an axis, the path, the real-time side, moving by hand, feedback, an
//! M code.

use glidepath_gcode::WaitsAt;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_interpolator::{AnswerSource, MCodeWait};
use glidepath_program::{Corners, Effort, PathBounds, Smoothing};

/// One axis: mm, or degrees for A, B and C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisConfig {
    /// The axis.
    pub axis: Axis,
    /// Soft limits in machine coordinates, `None` for a rotary axis that turns without end.
    pub travel: Option<(f64, f64)>,
    /// mm/s.
    pub max_velocity: f64,
    /// mm/s².
    pub max_acceleration: f64,
    /// mm/s³.
    pub max_jerk: f64,
    /// Which of the three the file gives. The others are what joints let the axis do alone, anywhere in
    /// its travel: motion by hand keeps to that, plans to the joints themselves.
    pub has_own: [bool; 3],
}

/// What no axis exceeds, as far as the file may give it: velocity, acceleration and jerk.
pub(super) const MOST_OF_AXES: [f64; 3] = [1e5, 1e7, 1e10];

/// The tolerance and how it is used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathConfig {
    /// mm, smoothing and chord error together.
    pub tolerance_mm: f64,
    /// Degrees, of the direction of the tool, or of rotary axes that turn none; `None`: as many as the tolerance has mm.
    pub direction_deg: Option<f64>,
    /// The curve at corners.
    pub smoothing: Smoothing,
    /// The side of corners.
    pub corners: Corners,
    /// Planning effort.
    pub effort: Effort,
    /// mm/min where the program has no F; `None` refuses such a program.
    pub default_feed: Option<f64>,
    /// Limits along the path.
    pub bounds: PathBounds,
}

/// The real-time side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterpolatorConfig {
    /// µs.
    pub period_us: u32,
    /// `SCHED_FIFO` priority, 1…99.
    pub priority: u8,
    /// CPU the real-time thread is pinned to.
    pub cpu: Option<usize>,
    /// Seconds of motion published ahead.
    pub horizon_t: f64,
    /// Ticks that may be missed within a second before the motion stops with a fault.
    pub max_missed_ticks: u64,
}

/// The settings of moving by hand.
#[derive(Debug, Clone, PartialEq)]
pub struct JogConfig {
    /// Top speed of each axis, mm/s or °/s; no limit for those that the machine does not have.
    pub velocity: AxisVector,
    /// Top speed of any axis while the machine does not know where it is, mm/s or °/s.
    pub unhomed_velocity: f64,
    /// Top speed of the way back to the path, mm/s.
    pub return_velocity: f64,
    /// The steps that jogging by keys offers, mm or degrees.
    pub increments: Vec<f64>,
    /// ms without a sign of life after which a jog stops.
    pub dead_man_ms: u32,
    /// The axis that goes last on the way back to the path.
    pub tool_axis: Axis,
    /// By how much it goes up behind an abort of a program, mm; 0: it stays.
    pub lift: f64,
}

/// The means by which joints come home.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HomingBy {
    /// Nobody: the position is believed.
    Nobody,
    /// Every drive by itself.
    Drive,
    /// The controller, as the `[home.J0]` tables say.
    Controller,
}

/// The settings by which the drives' feedback is judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackConfig {
    /// Whether drives answer; if not, they are taken to do what the setpoints say.
    pub is_expected: bool,
    /// Who brings joints home, before a program starts.
    pub homing: HomingBy,
    /// How far a joint may be from its demand at its highest speed, mm or degrees.
    pub following_error: f64,
    /// The same at rest.
    pub min_following_error: f64,
    /// Feedback older than this stops the motion, s; `None` for three periods.
    pub stale_t: Option<f64>,
    /// Feedback older than this takes the power from the drives, s.
    pub off_t: f64,
}

/// An M code, or a range of them, that the machine has or waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MCodeRule {
    /// The codes, and what answers them.
    pub m_code_wait: MCodeWait,
    /// Where the motion waits.
    pub at: WaitsAt,
}

/// A tool is changed by hand. Who goes on by himself cuts with the wrong one.
pub(super) const BY_HAND: MCodeWait = MCodeWait {
    first: 6,
    last: 6,
    answer: AnswerSource::Acknowledgement,
    within: None,
    is_late: false,
};
