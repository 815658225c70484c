//! A rest of the machine: where it is, why, and for how long.

use glidepath_program::{Event, ProgramLine};

/// Why the machine rests, and for how long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RestKind {
    /// The motion goes on in the same period.
    Corner,
    /// One setpoint is exactly there.
    ExactStop,
    /// For a time, s.
    Dwell(f64),
    /// For an event.
    Event(Event),
    /// End of the program.
    End,
}

/// A rest and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rest {
    pub kind: RestKind,
    pub line: ProgramLine,
}
