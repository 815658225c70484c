//! The clocks of wall time and processor time, for reports alone.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Processor time of the calling thread.
#[must_use]
pub fn processor() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(time).unwrap_or_default()
}

/// Time since this was first asked.
#[must_use]
pub fn elapsed() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}
