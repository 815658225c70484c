//! The planner's product: the state of the machine at one instant of program time.

use crate::{FrameEvents, ProgramLine};
use glidepath_geometry::AxisVector;

/// Properties of a frame, one bit each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FrameFlags(pub u32);

impl FrameFlags {
    /// First frame of an epoch: at rest where the machine stands.
    pub const FIRST: Self = Self(1);
    /// Last frame of the program: at rest at its end.
    pub const LAST: Self = Self(1 << 1);
    /// A rapid move.
    pub const RAPID: Self = Self(1 << 2);
    /// At rest at an exact stop or a program stop.
    pub const EXACT_STOP: Self = Self(1 << 3);
    /// In a dwell.
    pub const DWELL: Self = Self(1 << 4);
    /// The machine rests here until the operator resumes (M0, M1, M60).
    pub const PROGRAM_STOP: Self = Self(1 << 5);
    /// A move that follows the spindle: program time goes on with its angle.
    pub const SYNC: Self = Self(1 << 6);
    /// A move at a feed per revolution: program time goes on with the speed of the spindle, where
    /// that is measured.
    pub const PER_REV: Self = Self(1 << 7);

    /// These flags and others.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// True if all of `other` are set.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }
}

/// The state of the machine at program time `sequence · period`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Index on the period grid, from 0, without gaps.
    pub sequence: u64,
    /// Source line of the motion, 0 before the first.
    pub line: u32,
    /// The block of the motion, as [`Item::block`](crate::Item::block); 0 before the first, and
    /// where nobody counts them.
    pub block: u32,
    /// Properties.
    pub flags: FrameFlags,
    /// The events of the period that ends here.
    pub events: FrameEvents,
    /// The override this was planned with: of the feed, or of rapids on a rapid.
    pub planned_override: f64,
    /// Rate of path position, mm/s.
    pub path_v: f64,
    /// Path position since the start of the program, mm.
    pub path_s: f64,
    /// The feed that the program asks for, mm/s; 0 at rest and in rapids.
    pub programmed_v: f64,
    /// Position, mm or degrees.
    pub position: AxisVector,
    /// Velocity, mm/s or °/s.
    pub velocity: AxisVector,
    /// Acceleration, mm/s² or °/s².
    pub acceleration: AxisVector,
}

impl Frame {
    /// The line of the program it is on, at the time that it was executed.
    #[must_use]
    pub const fn program_line(&self) -> ProgramLine {
        ProgramLine {
            number: self.line,
            block: self.block,
        }
    }

    /// A place for a frame to be written to: at rest somewhere.
    #[must_use]
    pub fn blank(position: AxisVector) -> Self {
        let zero = AxisVector::zeros();
        Self {
            sequence: 0,
            line: 0,
            block: 0,
            flags: FrameFlags::default(),
            events: FrameEvents::NONE,
            planned_override: 1.0,
            path_v: 0.0,
            path_s: 0.0,
            programmed_v: 0.0,
            position,
            velocity: zero,
            acceleration: zero,
        }
    }
}
