//! The exit codes of the process.

use std::process::ExitCode;

/// The exit codes scripts rely on. Part of the command line's contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// Everything asked for was done.
    Done = 0,
    /// The program (G-code or streamed segments) was rejected.
    Rejected = 1,
    /// The command line was wrong, or a file named on it cannot be used.
    Usage = 2,
    /// The configuration was refused.
    Configuration = 3,
    /// The host does not grant real time, and `--best-effort` was not given.
    NotRealTime = 4,
    /// Something failed while running; the machine is at rest.
    Fault = 5,
    /// The program could not be checked to its end, and nothing wrong was found before.
    Unchecked = 6,
    /// A jog ended before what was asked for, because the travel or the reach of the machine ends there.
    Short = 7,
    /// A stop was accepted, and has not come to its end yet: the machine still moves, or has power.
    NotYet = 8,
    /// Interrupted from the keyboard or by a signal.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}
