//! The clock by which a deadline is measured.

use rustix::thread::{ClockId, clock_nanosleep_absolute};
use rustix::time::{Timespec, clock_gettime};

/// Source of time for a [`DeadlineTimer`](crate::DeadlineTimer); tests use one of their own.
pub trait Clock {
    /// Nanoseconds since an arbitrary origin; never goes back.
    fn now_ns(&self) -> u64;

    /// Returns once [`now_ns`](Self::now_ns) is `deadline_ns` or later.
    fn sleep_until(&mut self, deadline_ns: u64);

    /// Waits until a time without giving the processor away; returns the time.
    fn spin_until(&mut self, deadline_ns: u64) -> u64 {
        loop {
            let now_ns = self.now_ns();
            if now_ns >= deadline_ns {
                return now_ns;
            }
            core::hint::spin_loop();
        }
    }
}

/// `CLOCK_MONOTONIC`: the same in every process of the host, not set back by anybody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Monotonic;

const NS_PER_S: u64 = 1_000_000_000;

impl Clock for Monotonic {
    fn now_ns(&self) -> u64 {
        let now = clock_gettime(ClockId::Monotonic);
        // The monotonic clock counts up from the start of the host: both parts are non-negative.
        now.tv_sec.unsigned_abs() * NS_PER_S + now.tv_nsec.unsigned_abs()
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        let request = Timespec {
            tv_sec: i64::try_from(deadline_ns / NS_PER_S).unwrap_or(i64::MAX),
            tv_nsec: i64::try_from(deadline_ns % NS_PER_S).unwrap_or(0),
        };
        // A signal ends the sleep early; the deadline is absolute, so sleep again. Every other
        // error would be a fault of the arguments, which are valid by construction.
        while matches!(
            clock_nanosleep_absolute(ClockId::Monotonic, &request),
            Err(rustix::io::Errno::INTR)
        ) {}
    }
}
