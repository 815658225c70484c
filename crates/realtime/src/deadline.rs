//! The deadline timer, which wakes a thread on an absolute grid.
//!
//! ```text
//! grid     |-------|-------|-------|-------|-------|      origin + k · period, for ever
//! wake-ups  x       x         x             xx            tick 3 was missed, 4 came late
//! ```
//!
//! The next deadline is computed from the grid, never from the time of waking, so lateness does not
//! accumulate. A thread that woke a whole period late or more finds itself on the latest deadline
//! that has passed, and is told how many it missed: it never runs twice in a hurry to catch up.
//!
//! A thread that was asleep wakes some ten microseconds late even on a quiet host, and finds its
//! caches cold. A timer with a *lead* hides both: it rises that much before the deadline, leaves
//! the time to the thread for what can be done beforehand, and spins for the rest of it.
//!
//! ```text
//!          lead
//!        ┌───────┐
//! ───────│▒▓▓▓▓··│█──────────    ▒ latency of waking   ▓ prepared   · spinning   █ on time
//!                deadline
//! ```
//!
//! A latency longer than the lead makes the thread late as it would have been without.

use crate::Clock;

/// A wake-up.
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

/// Waking before a deadline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rise {
    /// When the thread was to wake: a lead before the deadline.
    pub scheduled_ns: u64,
    /// When it woke.
    pub woke_ns: u64,
}

impl Rise {
    /// From the time asked for to the thread running: what the host takes. Not bounded by a period.
    #[must_use]
    pub const fn latency_ns(&self) -> u64 {
        self.woke_ns - self.scheduled_ns
    }
}

/// Sleeps until one deadline of a grid after the other.
#[derive(Debug, Clone)]
pub struct DeadlineTimer<C> {
    clock: C,
    origin_ns: u64,
    period_ns: u64,
    lead_ns: u64,
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
            lead_ns: 0,
            tick: 0,
        }
    }

    /// Wakes a lead before each deadline and spins until it. Not longer than a period.
    #[must_use]
    pub const fn with_lead(mut self, lead_ns: u64) -> Self {
        self.lead_ns = if lead_ns < self.period_ns {
            lead_ns
        } else {
            self.period_ns
        };
        self
    }

    const fn next_ns(&self) -> u64 {
        self.origin_ns + (self.tick + 1) * self.period_ns
    }

    /// The next deadline, as if it was met.
    #[must_use]
    pub const fn next(&self) -> Wake {
        Wake {
            tick: self.tick + 1,
            scheduled_ns: self.next_ns(),
            woke_ns: self.next_ns(),
            missed: 0,
        }
    }

    /// Sleeps until a lead before the next deadline. What is done before [`wait`](Self::wait) is
    /// done in time.
    pub fn rise(&mut self) -> Rise {
        let scheduled_ns = self.next_ns().saturating_sub(self.lead_ns);
        self.clock.sleep_until(scheduled_ns);
        Rise {
            scheduled_ns,
            woke_ns: self.clock.now_ns().max(scheduled_ns),
        }
    }

    /// Returns at the next deadline, and says which of them it was. Sleeps for what is more than
    /// the lead, and spins for the rest.
    pub fn wait(&mut self) -> Wake {
        let (next, next_ns) = (self.tick + 1, self.next_ns());
        if self.clock.now_ns() + self.lead_ns < next_ns || self.lead_ns == 0 {
            self.clock.sleep_until(next_ns.saturating_sub(self.lead_ns));
        }
        let woke_ns = self.clock.spin_until(next_ns);
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

        fn spin_until(&mut self, deadline_ns: u64) -> u64 {
            self.now_ns = self.now_ns.max(deadline_ns);
            self.now_ns
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

    #[test]
    fn a_lead_hides_a_latency_up_to_it() {
        let mut timer = timer(vec![10, 20, 30, 150]).with_lead(20);
        let mut turn = || {
            let rise = timer.rise();
            (rise.scheduled_ns, rise.latency_ns(), timer.wait())
        };
        let turns = [turn(), turn(), turn(), turn()];
        assert_eq!(turns.map(|t| t.0), [1_080, 1_180, 1_280, 1_380]);
        assert_eq!(turns.map(|t| t.1), [10, 20, 30, 150]);
        assert_eq!(turns.map(|t| t.2.lateness_ns()), [0, 0, 10, 30]);
        assert_eq!(turns.map(|t| t.2.missed), [0, 0, 0, 1]);
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
    fn the_monotonic_clock_spins_until_the_deadline() {
        let now_ns = Monotonic.now_ns();
        let mut timer = DeadlineTimer::new(Monotonic, now_ns, 1_000_000).with_lead(200_000);
        let rise = timer.rise();
        assert!(rise.woke_ns >= now_ns + 800_000);
        assert!(timer.wait().woke_ns >= now_ns + 1_000_000);
    }

    #[test]
    fn the_monotonic_clock_sleeps_until_the_deadline() {
        let mut clock = Monotonic;
        let deadline_ns = clock.now_ns() + 2_000_000;
        clock.sleep_until(deadline_ns);
        assert!(clock.now_ns() >= deadline_ns);
    }
}
