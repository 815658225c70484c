//! A sample of a motion, as the auditor sees it at every period.

use glidepath_geometry::AxisVector;
use glidepath_program::Frame;

/// A sample of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Index on the period grid; consecutive.
    pub tick: u64,
    /// Source line, for reports.
    pub line: u32,
    /// Position, mm or degrees.
    pub position: AxisVector,
    /// Velocity and acceleration as reported, if they are to be checked.
    pub reported: Option<[AxisVector; 2]>,
    /// Whether it lies between two frames of the plan, as it does where program time runs slower or
    /// the frames were not played from the grid: there a motion may swing over an end of travel by
    /// what no plan avoids.
    pub is_between_frames: bool,
}

/// A sample where it lies: a frame is not copied to be judged.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen<'a> {
    pub(crate) tick: u64,
    pub(crate) line: u32,
    pub(crate) position: &'a AxisVector,
    pub(crate) reported: Option<[&'a AxisVector; 2]>,
    pub(crate) is_between_frames: bool,
}

impl<'a> From<&'a Sample> for Seen<'a> {
    fn from(sample: &'a Sample) -> Self {
        Self {
            tick: sample.tick,
            line: sample.line,
            position: &sample.position,
            reported: sample.reported.as_ref().map(|[v, a]| [v, a]),
            is_between_frames: sample.is_between_frames,
        }
    }
}

impl<'a> From<&'a Frame> for Seen<'a> {
    fn from(frame: &'a Frame) -> Self {
        Self {
            tick: frame.sequence,
            line: frame.line,
            position: &frame.position,
            reported: Some([&frame.velocity, &frame.acceleration]),
            is_between_frames: false,
        }
    }
}

impl From<&Frame> for Sample {
    fn from(frame: &Frame) -> Self {
        Self {
            tick: frame.sequence,
            line: frame.line,
            position: frame.position,
            reported: Some([frame.velocity, frame.acceleration]),
            is_between_frames: false,
        }
    }
}
