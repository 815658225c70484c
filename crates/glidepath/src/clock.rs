//! Wall time, for reports alone.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Time since this was first asked.
#[must_use]
pub fn elapsed() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}
