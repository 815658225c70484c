//! What an audit found.

use crate::along::AlongAudit;
use crate::limits::LimitAudit;
use crate::matching::Matching;
use core::fmt;
use glidepath_geometry::{Axis, AxisVector};

/// The largest of a quantity, and where it was met.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Worst {
    /// The quantity over what is allowed; above 1 is too much.
    pub ratio: f64,
    /// Index of the axis, where the quantity is one of an axis.
    pub axis: Option<Axis>,
    /// Tick of the sample.
    pub tick: u64,
    /// Source line of the sample.
    pub line: u32,
}

/// A rule that was broken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ViolationKind {
    /// An axis was faster than its velocity limit.
    Velocity {
        /// The axis.
        axis: Axis,
        /// Velocity over limit.
        ratio: f64,
    },
    /// An axis accelerated more than its limit.
    Acceleration {
        /// The axis.
        axis: Axis,
        /// Acceleration over limit.
        ratio: f64,
    },
    /// An axis had more jerk than its limit.
    Jerk {
        /// The axis.
        axis: Axis,
        /// Jerk over limit.
        ratio: f64,
    },
    /// Acceleration along the path beyond its limit.
    AlongPath {
        /// Acceleration over limit.
        ratio: f64,
    },
    /// Acceleration across the path beyond its limit.
    AcrossPath {
        /// Acceleration over limit.
        ratio: f64,
    },
    /// Jerk along the path beyond its limit.
    PathJerk {
        /// Jerk over limit.
        ratio: f64,
    },
    /// The path was run faster than the programmed feed.
    Feed {
        /// Path speed over feed.
        ratio: f64,
    },
    /// Reported velocity or acceleration do not fit the positions.
    Inconsistent {
        /// The axis.
        axis: Axis,
        /// What was found wrong.
        what: Inconsistency,
    },
    /// The tick does not follow the one before.
    Gap {
        /// The tick before.
        after: u64,
    },
    /// A coordinate is not a number.
    NotFinite,
    /// Farther from the programmed path, or the path from the motion, than the tolerance.
    Deviation {
        /// The distance a monotone matching needs, mm or degrees.
        deviation_mm: f64,
    },
    /// An exact stop, or the start or end of the program, was not met.
    ExactStop {
        /// The distance by which it was missed, mm or degrees.
        deviation_mm: f64,
    },
    /// A dwell was cut short by more than a period.
    Dwell {
        /// By how much, s.
        missing_t: f64,
    },
    /// The motion left the path by so much that it could not be followed any more; what comes
    /// after is not checked for deviation.
    Lost,
    /// The motion ended before the program did.
    Incomplete,
}

/// Which report of a sample does not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inconsistency {
    /// Position after a period does not follow from velocity and acceleration.
    Position,
    /// Velocity after a period does not follow from acceleration.
    Velocity,
    /// Acceleration steps.
    Acceleration,
}

/// A broken rule, and where.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Violation {
    /// Tick of the sample.
    pub tick: u64,
    /// Source line.
    pub line: u32,
    /// The rule.
    pub kind: ViolationKind,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, tick {}: ", self.line, self.tick)?;
        match self.kind {
            ViolationKind::Velocity { axis, ratio } => {
                write!(f, "{axis} moves at {ratio:.6} of its velocity limit")
            }
            ViolationKind::Acceleration { axis, ratio } => {
                write!(f, "{axis} accelerates at {ratio:.6} of its limit")
            }
            ViolationKind::Jerk { axis, ratio } => {
                write!(f, "{axis} has {ratio:.6} of its jerk limit")
            }
            ViolationKind::AlongPath { ratio } => {
                write!(f, "{ratio:.6} of the acceleration allowed along the path")
            }
            ViolationKind::AcrossPath { ratio } => {
                write!(f, "{ratio:.6} of the acceleration allowed across the path")
            }
            ViolationKind::PathJerk { ratio } => {
                write!(f, "{ratio:.6} of the jerk allowed along the path")
            }
            ViolationKind::Feed { ratio } => write!(f, "{ratio:.6} of the programmed feed"),
            ViolationKind::Inconsistent { axis, what } => {
                write!(
                    f,
                    "{axis}: reported state does not fit the positions ({what:?})"
                )
            }
            ViolationKind::Gap { after } => write!(f, "no samples since tick {after}"),
            ViolationKind::NotFinite => write!(f, "a coordinate is not a number"),
            ViolationKind::Deviation { deviation_mm } => {
                write!(f, "{deviation_mm:.6} mm off the programmed path")
            }
            ViolationKind::ExactStop { deviation_mm } => {
                write!(f, "exact stop missed by {deviation_mm:.6} mm")
            }
            ViolationKind::Dwell { missing_t } => write!(f, "dwell cut short by {missing_t:.6} s"),
            ViolationKind::Lost => write!(f, "the motion does not follow the program any more"),
            ViolationKind::Incomplete => write!(f, "the motion ends before the program does"),
        }
    }
}

/// Violations kept in full; the others are counted.
pub(super) const KEPT_VIOLATIONS: usize = 100;

/// The first violations, and how many there were.
#[derive(Debug, Default)]
pub(super) struct ViolationList {
    pub(super) kept: Vec<Violation>,
    pub(super) count: u64,
}

impl ViolationList {
    pub(super) fn push(&mut self, tick: u64, line: u32, kind: ViolationKind) {
        self.count += 1;
        if self.kept.len() < KEPT_VIOLATIONS {
            self.kept.push(Violation { tick, line, kind });
        }
    }
}

/// The verdict on a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Samples seen.
    pub samples: u64,
    /// Largest velocity over limit, of any axis.
    pub max_velocity_ratio: Worst,
    /// Largest acceleration over limit, of any axis.
    pub max_acceleration_ratio: Worst,
    /// Largest jerk over limit, of any axis.
    pub max_jerk_ratio: Worst,
    /// Largest path speed over programmed feed, between two samples.
    pub max_feed_ratio: Worst,
    /// Largest acceleration along and across the path and jerk along it, over their limits.
    pub max_path_ratios: [Worst; 3],
    /// Largest velocity of each axis, mm/s or °/s.
    pub max_velocity: AxisVector,
    /// Largest acceleration of each axis.
    pub max_acceleration: AxisVector,
    /// Largest jerk of each axis.
    pub max_jerk: AxisVector,
    /// Largest distance met by a best matching of motion and program, both ways and in order, mm
    /// (degrees for rotary axes); not less than its resolution of 1e-6. Where the motion is out of
    /// tolerance it may be an over-estimate; the violation has the distance.
    pub max_deviation_mm: f64,
    /// Tick where it was met.
    pub max_deviation_tick: u64,
    /// Line where it was met.
    pub max_deviation_line: u32,
    /// Largest tolerance met in the program, mm.
    pub tolerance_mm: f64,
    /// Whether the motion ran through the whole program, in order.
    pub is_complete: bool,
    /// Moves in the program.
    pub segments: u64,
    /// Feed length of the program, mm.
    pub path_length_mm: f64,
    /// Tick at which motion starts: the last sample at the first position.
    pub first_motion_tick: u64,
    /// Tick at which the last motion ends.
    pub last_motion_tick: u64,
    /// From the first to the last motion, dwells in between included, s.
    pub cycle_time_s: f64,
    /// Position of the last sample.
    pub final_position: AxisVector,
    /// The first violations, in the order found.
    pub violations: Vec<Violation>,
    /// All violations, kept or not.
    pub violation_count: u64,
}

impl Report {
    /// True if nothing was found.
    #[must_use]
    pub const fn is_clean(&self) -> bool {
        self.violation_count == 0
    }

    pub(super) fn new(limits: &LimitAudit, along: &AlongAudit, matching: &Matching) -> Self {
        let mut violations = limits.violations.kept.clone();
        violations.extend_from_slice(&along.violations.kept);
        violations.extend_from_slice(&matching.violations.kept);
        violations.sort_by_key(|violation| violation.tick);
        violations.truncate(KEPT_VIOLATIONS);
        Self {
            samples: limits.samples,
            max_velocity_ratio: limits.worst[0],
            max_acceleration_ratio: limits.worst[1],
            max_jerk_ratio: limits.worst[2],
            max_feed_ratio: matching.max_feed,
            max_path_ratios: along.worst,
            max_velocity: limits.maxima[0],
            max_acceleration: limits.maxima[1],
            max_jerk: limits.maxima[2],
            max_deviation_mm: matching.max_deviation.ratio,
            max_deviation_tick: matching.max_deviation.tick,
            max_deviation_line: matching.max_deviation.line,
            tolerance_mm: matching.rows.max_tolerance_mm(),
            is_complete: matching.is_complete,
            segments: matching.rows.moves(),
            path_length_mm: matching.rows.path_length_mm(),
            first_motion_tick: limits.first_motion_tick.unwrap_or(0),
            last_motion_tick: limits.last_motion_tick,
            cycle_time_s: limits.cycle_time_s(),
            final_position: limits.last_position(),
            violations,
            violation_count: limits.violations.count
                + along.violations.count
                + matching.violations.count,
        }
    }
}
