//! The progress of program time: how far it has come, and how fast it goes.

use crate::real_time::program_time::ProgramTime;

/// Program time, its rate and its slope at one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Progress {
    /// Program time in periods.
    pub(crate) time: ProgramTime,
    /// Periods of program time a tick, 0 to 1.
    pub(crate) rate: f64,
    /// Change of the rate a tick.
    pub(crate) slope: f64,
}
