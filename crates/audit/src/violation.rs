//! The violations that an audit finds, and the list of the first of them.

use core::fmt;
use glidepath_geometry::Axis;

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
    /// An axis left its travel, at a sample or before it.
    Travel {
        /// The axis.
        axis: Axis,
        /// Where it was furthest beyond, mm or degrees.
        position: f64,
        /// The end of travel.
        end: f64,
    },
    /// A joint did more than it can.
    Joint {
        /// The joint, 0 for J0.
        joint: usize,
        /// Which of its limits.
        rate: JointRate,
        /// What it did over the limit.
        ratio: f64,
    },
    /// A joint left its range.
    JointRange {
        /// The joint, 0 for J0.
        joint: usize,
        /// Where it was, mm or degrees.
        position: f64,
        /// The end of its range.
        end: f64,
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
    /// The direction of the tool farther from the programmed one than its tolerance.
    Direction {
        /// The angle, degrees.
        off_deg: f64,
        /// What is allowed there, degrees.
        allowed_deg: f64,
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
    /// An axis that the program leaves alone was not where it should rest: see [`crate::tremor`].
    NotStill {
        /// The axis.
        axis: Axis,
        /// Distance from the programmed coordinate, mm or degrees.
        off_mm: f64,
    },
    /// Jerk that the path does not ask for, at constant feed: see [`crate::tremor`].
    Unsteady {
        /// The axis; the first one of the plane for both axes of an arc together.
        axis: Axis,
        /// How far its jerk is off that of the path, mm/s³ or °/s³.
        over_j: f64,
        /// How far it may be off.
        allowed_j: f64,
    },
    /// The motion slowed down where the feed was reached before and behind: see [`crate::tremor`].
    SlowedDown {
        /// The slowest it was, mm/s.
        speed_v: f64,
        /// The programmed feed, mm/s.
        feed_v: f64,
    },
    /// The motion left the path by so much that it could not be followed any more; what comes
    /// after is not checked for deviation.
    Lost,
    /// The motion ended before the program did.
    Incomplete,
}

/// The report of a sample that does not fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inconsistency {
    /// Position after a period does not follow from velocity and acceleration.
    Position,
    /// Velocity after a period does not follow from acceleration.
    Velocity,
    /// Acceleration steps.
    Acceleration,
}

impl Inconsistency {
    /// What does not fit.
    const fn text(self) -> &'static str {
        match self {
            Self::Position => "its position does not follow",
            Self::Velocity => "its velocity does not follow",
            Self::Acceleration => "its acceleration steps",
        }
    }
}

/// The quantity of a joint that a limit is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointRate {
    /// Velocity.
    Velocity,
    /// Acceleration.
    Acceleration,
    /// Jerk.
    Jerk,
}

impl JointRate {
    /// In the order of the differences.
    pub(crate) const ALL: [Self; 3] = [Self::Velocity, Self::Acceleration, Self::Jerk];

    const fn text(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
            Self::Jerk => "jerk",
        }
    }
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
            ViolationKind::Travel {
                axis,
                position,
                end,
            } => write!(
                f,
                "{axis} is at {position:.6}{unit}, {:.6}{unit} beyond the end of its travel at {end}{unit}",
                (position - end).abs(),
                unit = unit(axis)
            ),
            ViolationKind::Joint { joint, rate, ratio } => {
                write!(f, "J{joint} has {ratio:.6} of its {} limit", rate.text())
            }
            ViolationKind::JointRange {
                joint,
                position,
                end,
            } => write!(
                f,
                "J{joint} is at {position:.6}, {:.6} beyond the end of its range at {end}",
                (position - end).abs()
            ),
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
                    "{axis}: the reported state does not fit the positions ({})",
                    what.text()
                )
            }
            ViolationKind::Gap { after } => write!(f, "no samples since tick {after}"),
            ViolationKind::NotFinite => write!(f, "a coordinate is not a number"),
            ViolationKind::Deviation { deviation_mm } => {
                write!(f, "{deviation_mm:.6} mm off the programmed path")
            }
            ViolationKind::Direction {
                off_deg,
                allowed_deg,
            } => write_direction(f, [off_deg, allowed_deg]),
            ViolationKind::ExactStop { deviation_mm } => {
                write!(f, "exact stop missed by {deviation_mm:.6} mm")
            }
            ViolationKind::Dwell { missing_t } => write!(f, "dwell cut short by {missing_t:.6} s"),
            ViolationKind::NotStill { axis, off_mm } => {
                write!(
                    f,
                    "{axis} is left alone by the program and off by {off_mm:.3e}{}",
                    unit(axis)
                )
            }
            ViolationKind::Unsteady {
                axis,
                over_j,
                allowed_j,
            } => write_unsteady(f, axis, [over_j, allowed_j]),
            ViolationKind::SlowedDown { speed_v, feed_v } => write_slowed_down(f, speed_v, feed_v),
            ViolationKind::Lost => write!(f, "the motion does not follow the program any more"),
            ViolationKind::Incomplete => write!(f, "the motion ends before the program does"),
        }
    }
}

fn write_direction(f: &mut fmt::Formatter<'_>, [off_deg, allowed_deg]: [f64; 2]) -> fmt::Result {
    write!(
        f,
        "the tool's direction is {off_deg:.6}° off the programmed one, where {allowed_deg:.6}° is allowed"
    )
}

fn write_slowed_down(f: &mut fmt::Formatter<'_>, speed_v: f64, feed_v: f64) -> fmt::Result {
    write!(
        f,
        "slowed down to {speed_v:.3} of {feed_v:.3} mm/s in the middle of a move"
    )
}

fn write_unsteady(
    f: &mut fmt::Formatter<'_>,
    axis: Axis,
    [over_j, allowed_j]: [f64; 2],
) -> fmt::Result {
    write!(
        f,
        "{axis} has jerk at constant feed that is {over_j:.1}{unit}/s³ off that of the path, where {allowed_j:.1}{unit}/s³ is allowed",
        unit = unit(axis)
    )
}

/// The unit of an axis, as it stands behind a number.
fn unit(axis: Axis) -> &'static str {
    if axis.is_rotary() { "°" } else { " mm" }
}

/// Violations kept in full; the others are counted.
pub(crate) const KEPT_VIOLATIONS: usize = 100;

/// The first violations, and how many there were.
#[derive(Debug, Default)]
pub(crate) struct ViolationList {
    pub(crate) kept: Vec<Violation>,
    pub(crate) count: u64,
}

impl ViolationList {
    pub(crate) fn push(&mut self, tick: u64, line: u32, kind: ViolationKind) {
        self.count += 1;
        if self.kept.len() < KEPT_VIOLATIONS {
            self.kept.push(Violation { tick, line, kind });
        }
    }
}
