//! The summary of the last frame passed: where in the program the motion is.

use glidepath_link::SetpointFrame;
use glidepath_program::FrameFlags;

/// The part of the last frame passed that setpoints at rest repeat.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameSummary {
    pub(crate) sequence: u64,
    pub(crate) path_s: f64,
    pub(crate) planned_override: f64,
    pub(crate) line: u32,
    pub(crate) block: u32,
    pub(crate) flags: u32,
}

impl FrameSummary {
    /// Before the first frame.
    pub(crate) const NONE: Self = Self {
        sequence: 0,
        path_s: 0.0,
        planned_override: 0.0,
        line: 0,
        block: 0,
        flags: 0,
    };

    pub(crate) const fn of(frame: &SetpointFrame) -> Self {
        Self {
            sequence: frame.sequence,
            path_s: frame.path_s,
            planned_override: frame.planned_override,
            line: frame.line,
            block: frame.block,
            flags: frame.flags,
        }
    }

    /// Whether all of `flags` are set.
    pub(crate) const fn has(&self, flags: FrameFlags) -> bool {
        FrameFlags(self.flags).contains(flags)
    }
}
