//! The errors of a measurement: why the timing of a host cannot be measured.

use super::cyclictest::CyclictestError;
use glidepath_realtime::NotRealTime;
use thiserror::Error;

/// The reason why there is no measurement.
#[derive(Debug, Error)]
pub enum JitterError {
    /// The tool to compare with does not run.
    #[error(transparent)]
    Cyclictest(#[from] CyclictestError),
    /// The real-time thread cannot be started.
    #[error("cannot start or end a process: {0}")]
    Start(std::io::Error),
    /// The host refuses what the thread asks for.
    #[error(transparent)]
    NotRealTime(#[from] NotRealTime),
    /// The real-time thread ended before it said what it was granted.
    #[error("the real-time thread failed")]
    Ended,
}
