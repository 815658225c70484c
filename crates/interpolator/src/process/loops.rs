//! The loops of the two threads.
//!
//! ```text
//! grid            |─────────────|─────────────|
//! real-time     ▓▓█           ▓▓█              prepares the setpoint, spins, hands it over in time
//! ports            ▐  ▐███░      ▐  ▐███░      50 µs later: setpoints out; 200 µs: commands, frames in
//! ```
//!
//! Both keep the same grid. The real-time thread rises a little before it, so that neither the
//! host's latency nor cold caches delay a setpoint. The ports thread looks for the setpoint a little
//! after it, and again until it is there, so that whoever subscribes has it early in the period; all
//! else it does a fixed phase after the tick, when the setpoint should be there on a host that is late,
//! and drives have said where they are.

use crate::real_time::tick::Interpolator;
use crate::shared::config::Config;
use crate::shared::message::{Inputs, TickReport, Timing};
use core::sync::atomic::{AtomicBool, Ordering};
use glidepath_link::LinkError;
use glidepath_realtime::{
    Clock, DeadlineTimer, Mode, NotRealTime, Request, SentinelError, Wake, enter,
    forbid_system_calls,
};
use heapless::spsc::Producer;

/// Time from a tick to the work of the ports thread, as long as it fits into the period.
const PHASE_NS: u64 = 200_000;

/// Looks for the setpoint in that time, the last at its end.
const LOOKS: u64 = 4;

/// Time from rising to the tick, as long as it is a small part of the period.
const LEAD_NS: u64 = 100_000;

/// By how much the priority of the ports thread is lower.
const LOWER: i32 = 10;

/// The reason why an interpolator could not run.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The host or the user does not give what real time needs.
    #[error(transparent)]
    NotRealTime(#[from] NotRealTime),
    /// A port could not be made or used.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// The diagnostic against system calls could not be installed.
    #[error(transparent)]
    Sentinel(#[from] SentinelError),
    /// A value of the configuration cannot be used.
    #[error("{what} is {value}: {allowed}")]
    Config {
        /// Which value.
        what: &'static str,
        /// What it is.
        value: u64,
        /// What it may be.
        allowed: &'static str,
    },
    /// What the planner publishes ahead is too little to stop on: the machine would never move.
    #[error(
        "the horizon is {horizon_frames} frames, and this machine needs at least {least_frames}: \
         three stops from full speed of the slowest axis; give a longer horizon"
    )]
    Horizon {
        /// As configured.
        horizon_frames: u64,
        /// The least that would do.
        least_frames: u64,
    },
    /// A thread could not be started, or panicked.
    #[error("the {0} thread failed")]
    Thread(&'static str),
}

/// By how much the real-time thread rises before a tick, ns: more than a quiet host is late, and a
/// small part of the period.
#[must_use]
pub fn lead_ns(period_ns: u64) -> u64 {
    LEAD_NS.min(period_ns / 10)
}

/// When the ports thread wakes after a tick.
pub(crate) fn phase_ns(period_ns: u64) -> u64 {
    PHASE_NS.min(period_ns / 4)
}

/// When the ports thread looks for the setpoint first after a tick.
pub(crate) fn first_look_ns(period_ns: u64) -> u64 {
    phase_ns(period_ns) / LOOKS
}

/// Looks for the setpoint of a tick from the first look on, which is now, until it is handed over, and
/// returns when the phase has passed.
pub(crate) fn hand_over(
    clock: &mut impl Clock,
    first_look: &Wake,
    period_ns: u64,
    mut hand_over: impl FnMut() -> bool,
) {
    let between_ns = first_look_ns(period_ns);
    for look in 1..LOOKS {
        if hand_over() {
            break;
        }
        clock.sleep_until(first_look.scheduled_ns + look * between_ns);
    }
    clock.sleep_until(first_look.scheduled_ns + phase_ns(period_ns) - between_ns);
}

/// What the ports thread asks for: less than the real-time thread, on any processor. The memory is
/// locked already.
pub(crate) fn ports_request(request: &Request) -> Request {
    Request {
        priority: request.priority.map(|p| (p - LOWER).max(1)),
        ..Request::default()
    }
}

/// The real-time thread's work, until `stop` is set.
pub(crate) fn real_time<C: Clock>(
    interpolator: &mut Interpolator<'_>,
    inputs: &mut Inputs<'_>,
    reports: &mut Producer<'_, TickReport>,
    timer: &mut DeadlineTimer<C>,
    stop: &AtomicBool,
) {
    let mut report = TickReport::blank();
    while !stop.load(Ordering::Relaxed) {
        let rise = timer.rise();
        interpolator.prepare(&timer.next(), inputs, &mut report);
        let prepared_ns = timer.clock().now_ns();
        let wake = timer.wait();
        interpolator.stamp(&mut report, &wake);
        if reports.enqueue(report).is_err() {
            // Nobody has taken a report for a second: the drives get nothing either.
            interpolator.lose_report();
        }
        let done_ns = timer.clock().now_ns();
        interpolator.keep_timing(Timing {
            latency_ns: rise.latency_ns(),
            work_ns: (prepared_ns - rise.woke_ns) + (done_ns - wake.woke_ns),
        });
    }
}

/// Sets up the real-time thread. The guard must live as long as the thread works.
pub(crate) fn enter_real_time(config: &Config) -> Result<glidepath_realtime::Entered, NotRealTime> {
    enter(&config.real_time.request, config.real_time.mode)
}

/// Sets up the ports thread: what it is not granted is no reason not to run.
pub(crate) fn enter_ports(config: &Config) {
    let request = ports_request(&config.real_time.request);
    // In best effort mode this never fails; in strict mode the real-time thread was granted more.
    enter(&request, Mode::BestEffort).ok();
}

/// Forbids system calls to the calling thread if the configuration says so.
pub(crate) fn guard(config: &Config) -> Result<(), SentinelError> {
    if config.forbid_system_calls {
        forbid_system_calls()
    } else {
        Ok(())
    }
}

#[cfg(test)]
mod tests;
