//! The measured loop, and the beat that it writes every period.

use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_realtime::{Clock, DeadlineTimer, EventWriter};

/// A beat: the record of one period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LoopBeat {
    /// From the time the thread was to wake at, a lead before the deadline, to its waking.
    pub latency_ns: u64,
    /// From the deadline to the tick.
    pub lateness_ns: u64,
    /// Deadlines that passed meanwhile.
    pub missed: u64,
    /// How long the work took.
    pub work_ns: u64,
    /// Whether the work moved the machine.
    pub is_moving: bool,
}

/// The load of the loop in a period.
pub(super) trait Load {
    /// The work of the real-time thread; true if it moved the machine.
    fn work(&mut self) -> bool;

    /// What other threads do for it meanwhile; its time does not count.
    fn supply(&mut self);
}

/// Nothing to do.
#[derive(Debug)]
pub(super) struct Idle;

impl Load for Idle {
    fn work(&mut self) -> bool {
        false
    }

    fn supply(&mut self) {}
}

/// Waits, works and writes a beat, until `stop` is set. Makes no system call but the sleep.
pub(super) fn beat<C: Clock>(
    timer: &mut DeadlineTimer<C>,
    beats: &mut EventWriter<'_, LoopBeat>,
    stop: &AtomicBool,
    load: &mut dyn Load,
) {
    load.supply();
    while !stop.load(Ordering::Relaxed) {
        let rise = timer.rise();
        let is_moving = load.work();
        let work_ns = timer.clock().now_ns().saturating_sub(rise.woke_ns);
        let wake = timer.wait();
        beats.write(LoopBeat {
            latency_ns: rise.latency_ns(),
            lateness_ns: wake.lateness_ns() + wake.missed * timer.period_ns(),
            missed: wake.missed,
            work_ns,
            is_moving,
        });
        load.supply();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_realtime::{Events, event_ring};

    /// Moves until there is nothing left, and then stops the loop.
    struct Steps<'a> {
        left: u32,
        stop: &'a AtomicBool,
    }

    impl Load for Steps<'_> {
        fn work(&mut self) -> bool {
            self.left -= 1;
            self.stop.store(self.left == 0, Ordering::Relaxed);
            true
        }

        fn supply(&mut self) {}
    }

    /// Wakes late by 30, 250, 0, 0, … ns.
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

    #[test]
    fn times_count_from_the_deadline_that_was_waited_for() {
        let clock = Script {
            now_ns: 0,
            delays_ns: vec![30, 250, 0].into_iter(),
        };
        let mut timer = DeadlineTimer::new(clock, 1_000, 100).with_lead(20);
        let mut events = Events::<LoopBeat, 8>::default();
        let (mut writer, mut reader) = event_ring(&mut events);
        let stop = AtomicBool::new(false);
        let mut steps = Steps {
            left: 3,
            stop: &stop,
        };
        beat(&mut timer, &mut writer, &stop, &mut steps);
        let beats: Vec<_> = std::iter::from_fn(|| reader.read()).collect();
        let seen: Vec<_> = beats
            .iter()
            .map(|b| (b.latency_ns, b.lateness_ns, b.missed))
            .collect();
        assert_eq!(seen, [(30, 10, 0), (250, 230, 2), (0, 0, 0)]);
        assert!(beats.iter().all(|b| b.is_moving && b.work_ns == 0));
    }
}
