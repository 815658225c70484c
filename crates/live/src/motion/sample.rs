//! One sample of a motion, and what keeps it from being faster.

/// The place of one axis in a sample, and its limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisScale {
    /// Its place in the positions of a sample.
    pub index: usize,
    /// Largest velocity, acceleration and jerk, mm or degrees and seconds; all > 0.
    pub limits: [f64; 3],
}

/// The kind of limit that keeps the motion from being faster.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[repr(u8)]
pub enum LimitKind {
    /// The machine rests.
    Rest = 0,
    /// The programmed feed.
    Feed = 1,
    /// An axis' velocity.
    Velocity = 2,
    /// An axis' acceleration.
    Acceleration = 3,
    /// An axis' jerk.
    Jerk = 4,
    /// The tolerance of the path.
    Tolerance = 5,
    /// The straight line between two setpoints.
    ChordError = 6,
    /// No single limit.
    #[default]
    None = 7,
}

/// A sample of a motion; samples are a period from each other.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionSample {
    /// mm or degrees.
    pub position: [f64; 9],
    /// Source line, 0 before the first.
    pub line: u32,
    /// Speed along the path, mm/s.
    pub feed_v: f64,
    /// Programmed speed, mm/s; infinite for rapids, 0 where it is not known.
    pub programmed_v: f64,
    /// Distance from the programmed path, mm.
    pub deviation_mm: f64,
    /// How far it may be, mm.
    pub tolerance_mm: f64,
    /// Path position, mm.
    pub path_mm: f64,
    /// What keeps it from being faster.
    pub limit: LimitKind,
    /// The index of the axis of that limit, 0 if it has none; of a joint's, what [`MotionSample::joint`] gives.
    pub limit_axis: usize,
    /// In a rapid.
    pub is_rapid: bool,
}

/// Axes come first in what a limit is of; then joints by their numbers, and one for those beyond.
const AXES: usize = 9;
const NAMED_JOINTS: usize = 6;

impl MotionSample {
    /// What the limit of a joint is of, as [`limit_axis`](Self::limit_axis) has it. Joints from J6 on have no name there.
    #[must_use]
    pub const fn joint(joint: usize) -> usize {
        if joint < NAMED_JOINTS {
            AXES + joint
        } else {
            AXES + NAMED_JOINTS
        }
    }

    /// Kind of the limit, its axis and whether it is a rapid, in one byte.
    #[allow(
        clippy::cast_possible_truncation,
        reason = "four bits of an index of axes"
    )]
    pub(super) const fn code(&self) -> u8 {
        self.limit as u8 | ((self.limit_axis as u8 & 15) << 3) | ((self.is_rapid as u8) << 7)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_limit_is_of_is_in_its_code() {
        let of = |limit_axis: usize| {
            let sample = MotionSample {
                limit: LimitKind::Jerk,
                limit_axis,
                ..MotionSample::default()
            };
            assert_eq!(sample.code() & 7, LimitKind::Jerk as u8);
            assert_eq!(sample.code() >> 7, 0);
            usize::from(sample.code() >> 3 & 15)
        };
        for index in 0..16 {
            assert_eq!(of(index), index);
        }
        let joints = [0, 5, 6, 8].map(MotionSample::joint);
        assert_eq!(joints, [9, 14, 15, 15], "those from J6 on are one");
    }
}
