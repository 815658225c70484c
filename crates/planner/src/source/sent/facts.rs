//! The facts of the machine's set-up that senders are told.

use std::io::BufRead;

use glidepath_gcode::{Probed, Program, WorkOffsets};
use glidepath_geometry::AxisVector;

/// The set-up of the machine behind a line.
#[derive(Debug, Clone, PartialEq)]
pub struct LineFacts {
    /// The codes and words in force, as a line would say them.
    pub words: String,
    /// Where the zero of programs is, machine coordinates.
    pub zero: AxisVector,
    /// Coordinate systems, reference positions, the offset of G92.
    pub offsets: WorkOffsets,
    /// The offset of the tool.
    pub tool: AxisVector,
}

impl Default for LineFacts {
    fn default() -> Self {
        Self {
            words: String::new(),
            zero: AxisVector::zeros(),
            offsets: WorkOffsets::default(),
            tool: AxisVector::zeros(),
        }
    }
}

impl LineFacts {
    /// The state in force behind the line that a program has read last.
    pub fn of<R: BufRead>(program: &Program<R>) -> Self {
        Self {
            words: program.words_in_force(),
            zero: program.zero(),
            offsets: program.work_offsets(),
            tool: *program.tool_offset(),
        }
    }
}

/// The last finding of the probe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Found {
    pub(crate) at: AxisVector,
    pub(crate) is_made: bool,
    /// How often it has looked.
    pub(crate) count: u32,
}

impl Default for Found {
    fn default() -> Self {
        Self {
            at: AxisVector::zeros(),
            is_made: false,
            count: 0,
        }
    }
}

impl Found {
    /// It has looked once more.
    pub(crate) fn look(&mut self, probed: &Probed) {
        self.at = probed.contact.unwrap_or(probed.stands);
        self.is_made = probed.contact.is_some();
        self.count = self.count.saturating_add(1);
    }
}
