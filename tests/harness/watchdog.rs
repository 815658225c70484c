//! The watchdog, which ends a test that hangs.

use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::time::Duration;

/// While it lives, the clock runs; if it is not dropped in time, the test binary aborts.
#[derive(Debug)]
pub struct Watchdog(#[allow(dead_code, reason = "dropping it stops the clock")] Sender<()>);

impl Watchdog {
    /// Starts the clock. The time is generous: it is there for tests that would never end.
    #[must_use]
    pub fn new(patience: Duration) -> Self {
        let (alive, watched) = channel();
        let name = std::thread::current().name().unwrap_or("a test").to_owned();
        std::thread::spawn(move || {
            if watched.recv_timeout(patience) == Err(RecvTimeoutError::Timeout) {
                eprintln!("{name} hangs: no end after {patience:?}");
                std::process::abort();
            }
        });
        Self(alive)
    }
}
