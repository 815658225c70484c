//! The real loop of the real-time thread does not allocate.
#![allow(clippy::unwrap_used, reason = "a test")]

use super::*;
use crate::message::Order;
use crate::testing::{Rig, lines, mill, records};
use glidepath_link::MachineState;
use glidepath_realtime::{CountingAllocator, Monotonic};

const TICKS: u64 = 12_000;

#[test]
fn the_loop_never_allocates() {
    let Rig {
        mut interpolator,
        mut inputs,
        mut reports,
        mut ends,
        mut feed,
        ..
    } = Rig::mill();
    feed.extend(records(&lines(3, 3, 4_000, &mill(), 0.004), 1, 4_000_000));
    let stop = AtomicBool::new(false);
    let calls = std::thread::scope(|scope| {
        let stop = &stop;
        let thread = scope.spawn(move || {
            // Program time does not care how fast the clock runs.
            let mut timer = DeadlineTimer::new(Monotonic, Monotonic.now_ns(), 50_000);
            let before = CountingAllocator::calls_of_this_thread();
            real_time(
                &mut interpolator,
                &mut inputs,
                &mut reports,
                &mut timer,
                stop,
            );
            CountingAllocator::calls_of_this_thread() - before
        });
        // Start, motion, hold, resume, override, starvation, motion again, abort.
        let orders = [
            (2_000, Order::Hold),
            (2_400, Order::Resume),
            (3_000, Order::FeedOverride(0.3)),
            (3_500, Order::FeedOverride(1.0)),
            (10_000, Order::Abort),
        ];
        let mut orders = orders.into_iter().peekable();
        let mut states = Vec::new();
        let mut number = 0;
        while number < TICKS {
            while let Some(report) = ends.reports.dequeue() {
                number = report.setpoint.number;
                if states.last() != Some(&report.state) {
                    states.push(report.state);
                }
            }
            if let Some((_, order)) = orders.next_if(|(due, _)| number >= *due) {
                ends.orders.enqueue(order).unwrap();
            }
            let starves = (5_000..6_000).contains(&number);
            while !starves && ends.frames.ready() {
                let Some(frame) = feed.pop_front() else { break };
                ends.frames.enqueue(frame).unwrap();
            }
            std::thread::yield_now();
        }
        stop.store(true, Ordering::Relaxed);
        for state in [
            MachineState::Running,
            MachineState::Held,
            MachineState::Starved,
        ] {
            assert!(
                states.contains(&state),
                "{state:?} was not reached: {states:?}"
            );
        }
        thread.join().unwrap()
    });
    assert_eq!(calls, 0);
}
