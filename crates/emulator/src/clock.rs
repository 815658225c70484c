//! The distributed clock of a device.
//!
//! The system time of a device is a straight line over the time of the host, until a correction
//! bends it:
//!
//! ```text
//! system = base + (1 + drift + trim) · (host − host₀)
//! ```
//!
//! `drift` is that of its quartz. Whenever the time of the reference clock comes by, a loop moves the
//! time a part of the way there and trims the rate, as the time control loop of an ESC does.

/// Share of a difference that is made good at once.
const STEP: f64 = 0.1;
/// Share of a difference by which the rate is trimmed, for each time that it comes by.
const TRIM: f64 = 0.002;
/// How fast a clock is moved, and trimmed, at most: 1.
const RATE_MOST: f64 = 1e-3;

/// What a device has of a distributed clock.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ClockKind {
    /// Nothing, and it says so.
    None,
    /// It notes when frames come by its ports and has no system time, although its features say that
    /// it has: an EL1004 or an EK1914.
    ReceiveTimes,
    /// A clock of 32 bits, whose registers have zeros above; an AKD has one.
    Bits32,
    /// A clock of 64 bits.
    #[default]
    Bits64,
}

/// The clock of one device.
#[derive(Debug, Clone)]
pub(crate) struct DeviceClock {
    host_ns: u64,
    /// Local time then, ns since the device was switched on.
    local_ns: f64,
    /// Deviation of the quartz, 1.
    drift: f64,
    /// Correction by the control loop, 1.
    trim: f64,
    /// What was moved by the control loop, ns.
    moved_ns: f64,
}

impl DeviceClock {
    /// A clock that begins with `local_ns` at the host's time `host_ns`.
    pub(crate) fn new(host_ns: u64, local_ns: f64, drift_ppm: f64) -> Self {
        Self {
            host_ns,
            local_ns,
            drift: drift_ppm * 1e-6,
            trim: 0.0,
            moved_ns: 0.0,
        }
    }

    fn rate(&self) -> f64 {
        1.0 + self.drift + self.trim
    }

    /// Local time at a time of the host, ns, with what the control loop made of it.
    #[allow(
        clippy::cast_precision_loss,
        reason = "exact for months of nanoseconds"
    )]
    pub(crate) fn local_ns(&self, host_ns: u64) -> f64 {
        self.local_ns + self.rate() * (host_ns as f64 - self.host_ns as f64) + self.moved_ns
    }

    /// The time of the host at which the local time will be `local_ns`.
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "times since the start of a host"
    )]
    pub(crate) fn host_at(&self, local_ns: f64) -> u64 {
        let since = (local_ns - self.moved_ns - self.local_ns) / self.rate();
        (self.host_ns as f64 + since).round().max(0.0) as u64
    }

    /// The control loop forgets what it has learnt of another reference.
    pub(crate) fn forget(&mut self, host_ns: u64) {
        self.local_ns = self.local_ns(host_ns);
        (self.host_ns, self.moved_ns, self.trim) = (host_ns, 0.0, 0.0);
    }

    /// The reference clock is ahead of this one by `ahead_ns`; it was so `since_t` seconds before,
    /// too.
    pub(crate) fn follow(&mut self, host_ns: u64, ahead_ns: f64, since_t: f64) {
        self.local_ns = self.local_ns(host_ns) - self.moved_ns;
        self.host_ns = host_ns;
        // No faster than the loop of an ESC goes.
        let most_ns = RATE_MOST * since_t * 1e9;
        self.moved_ns += (STEP * ahead_ns).clamp(-most_ns, most_ns);
        let trim = self.trim + TRIM * ahead_ns.clamp(-most_ns, most_ns) / (since_t * 1e9).max(1.0);
        self.trim = trim.clamp(-RATE_MOST, RATE_MOST);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_that_runs_wrong_is_brought_to_the_reference_and_kept_there() {
        let mut clock = DeviceClock::new(0, 0.0, 100.0);
        for ms in 1..20_000_u64 {
            let host_ns = ms * 1_000_000;
            #[allow(clippy::cast_precision_loss, reason = "a test of seconds")]
            let ahead_ns = host_ns as f64 - clock.local_ns(host_ns);
            clock.follow(host_ns, ahead_ns, 0.001);
            assert!(
                ms < 10_000 || ahead_ns.abs() < 30.0,
                "{ms} ms: {ahead_ns} ns"
            );
        }
    }

    #[test]
    fn times_are_told_both_ways() {
        let clock = DeviceClock::new(1_000, 5e6, -80.0);
        for host_ns in [1_000, 1_000_000, 86_400_000_000_000] {
            assert_eq!(clock.host_at(clock.local_ns(host_ns)), host_ns);
        }
    }
}
