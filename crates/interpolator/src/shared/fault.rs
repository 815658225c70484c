//! A fault: why the motion was stopped, as both threads tell each other and people.

use core::fmt;
use glidepath_geometry::Axis;
use glidepath_link::{FaultCause, FaultReport};

/// Why the motion was stopped, with what is known of where that was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Fault {
    pub(crate) cause: FaultCause,
    pub(crate) line: u32,
    pub(crate) sequence: u64,
    pub(crate) axis: Option<Axis>,
    /// The joint, by its index, and what its drive says about it.
    pub(crate) joint: Option<usize>,
    pub(crate) drive_fault: u32,
    /// What was found, and what is allowed, in the unit of the limit.
    pub(crate) value: f64,
    pub(crate) limit: f64,
}

impl Fault {
    pub(crate) const fn new(cause: FaultCause, line: u32, sequence: u64) -> Self {
        Self {
            cause,
            line,
            sequence,
            axis: None,
            joint: None,
            drive_fault: 0,
            value: 0.0,
            limit: 0.0,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let report = FaultReport {
            cause: self.cause,
            axis: self.axis,
            joint: self.joint,
            drive_fault: self.drive_fault,
            value: self.value,
            limit: self.limit,
            line: self.line,
        };
        report.fmt(f)
    }
}
