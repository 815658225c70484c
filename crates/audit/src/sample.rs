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
}

/// A sample where it lies: a frame is not copied to be judged.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Seen<'a> {
    pub(crate) tick: u64,
    pub(crate) line: u32,
    pub(crate) position: &'a AxisVector,
    pub(crate) reported: Option<[&'a AxisVector; 2]>,
}

impl<'a> From<&'a Sample> for Seen<'a> {
    fn from(sample: &'a Sample) -> Self {
        Self {
            tick: sample.tick,
            line: sample.line,
            position: &sample.position,
            reported: sample.reported.as_ref().map(|[v, a]| [v, a]),
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
        }
    }
}
