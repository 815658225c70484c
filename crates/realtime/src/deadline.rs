//! Waking on an absolute grid.
//!
//! ```text
//! grid     |-------|-------|-------|-------|-------|      origin + k · period, for ever
//! wake-ups  x       x         x             xx            tick 3 was missed, 4 came late
//! ```
//!
//! The next deadline is computed from the grid, never from the time of waking, so lateness does not
//! accumulate. A thread that woke a whole period late or more finds itself on the latest deadline
//! that has passed, and is told how many it missed: it never runs twice in a hurry to catch up.

use crate::Clock;

/// One wake-up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wake {
    /// Index of the deadline on the grid; the first wait returns 1, or later if it is late.
    pub tick: u64,
    /// The deadline.
    pub scheduled_ns: u64,
    /// When the thread woke, ≥ `scheduled_ns`.
    pub woke_ns: u64,
    /// Deadlines that passed unserved since the last wake-up.
    pub missed: u64,
}

impl Wake {
    /// How late the wake-up was, less than a period.
    #[must_use]
    pub const fn lateness_ns(&self) -> u64 {
        self.woke_ns - self.scheduled_ns
    }
}

/// Sleeps until one deadline of a grid after the other.
#[derive(Debug, Clone)]
pub struct DeadlineTimer<C> {
    clock: C,
    origin_ns: u64,
    period_ns: u64,
    tick: u64,
}

impl<C: Clock> DeadlineTimer<C> {
    /// Deadlines at `origin_ns + k · period_ns`, k = 1, 2, … A period of zero is taken as 1 ns.
    ///
    /// Threads that share an origin and differ by a constant share a grid with a fixed phase.
    pub const fn new(clock: C, origin_ns: u64, period_ns: u64) -> Self {
        let period_ns = if period_ns == 0 { 1 } else { period_ns };
        Self {
            clock,
            origin_ns,
            period_ns,
            tick: 0,
        }
    }

    /// Sleeps until the next deadline, and says which of them it woke at.
    pub fn wait(&mut self) -> Wake {
        let next = self.tick + 1;
        let next_ns = self.origin_ns + next * self.period_ns;
        self.clock.sleep_until(next_ns);
        let woke_ns = self.clock.now_ns().max(next_ns);
        let missed = (woke_ns - next_ns) / self.period_ns;
        self.tick = next + missed;
        Wake {
            tick: self.tick,
            scheduled_ns: next_ns + missed * self.period_ns,
            woke_ns,
            missed,
        }
    }

    /// The clock, for measuring work between two deadlines.
    pub const fn clock(&self) -> &C {
        &self.clock
    }

    /// Distance of two deadlines.
    pub const fn period_ns(&self) -> u64 {
        self.period_ns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Monotonic;
    use proptest::prelude::*;

    /// Wakes late by the given delays, one after the other.
    struct Script {
        now_ns: u64,
        delays_ns: std::vec::IntoIter<u64>,
    }

    impl Clock for Script {
        fn now_ns(&self) -> u64 {
            self.now_ns
        }

        fn sleep_until(&mut self, deadline_ns: u64) {
            self.now_ns = self.now_ns.max(deadline_ns) + self.delays_ns.next().unwrap_or(0);
        }
    }

    fn timer(delays_ns: Vec<u64>) -> DeadlineTimer<Script> {
        DeadlineTimer::new(
            Script {
                now_ns: 500,
                delays_ns: delays_ns.into_iter(),
            },
            1_000,
            100,
        )
    }

    #[test]
    fn lateness_does_not_move_the_grid() {
        let mut timer = timer(vec![30, 99, 0]);
        let wakes = [timer.wait(), timer.wait(), timer.wait()];
        assert_eq!(wakes.map(|w| w.scheduled_ns), [1_100, 1_200, 1_300]);
        assert_eq!(wakes.map(|w| w.lateness_ns()), [30, 99, 0]);
        assert_eq!(wakes.map(|w| w.missed), [0, 0, 0]);
    }

    #[test]
    fn missed_periods_are_counted_and_skipped() {
        let mut timer = timer(vec![0, 250, 0]);
        timer.wait();
        let late = timer.wait();
        assert_eq!((late.tick, late.missed, late.scheduled_ns), (4, 2, 1_400));
        assert_eq!(late.lateness_ns(), 50);
        let next = timer.wait();
        assert_eq!((next.tick, next.missed, next.scheduled_ns), (5, 0, 1_500));
    }

    proptest! {
        #[test]
        fn every_deadline_is_served_or_counted(delays in prop::collection::vec(0_u64..1_000, 1..50)) {
            let n = delays.len();
            let mut timer = timer(delays);
            let (mut served, mut missed) = (0, 0);
            for _ in 0..n {
                let wake = timer.wait();
                served += 1;
                missed += wake.missed;
                prop_assert_eq!(wake.tick, served + missed);
                prop_assert_eq!(wake.scheduled_ns, 1_000 + wake.tick * 100);
                prop_assert!(wake.lateness_ns() < 100);
            }
        }
    }

    #[test]
    fn the_monotonic_clock_sleeps_until_the_deadline() {
        let mut clock = Monotonic;
        let deadline_ns = clock.now_ns() + 2_000_000;
        clock.sleep_until(deadline_ns);
        assert!(clock.now_ns() >= deadline_ns);
    }
}
