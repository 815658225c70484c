//! The checks of whether a host is fit for real time.
//!
//! Each [`Check`] looks at one thing and says what it found and, where that is not good, how to
//! mend it. What [`enter`](crate::enter) would be refused is *missing*; what only makes the thread
//! late is a *warning*. Nothing is changed and nothing is tried out: the checks read files of a
//! [`Host`].

mod check;
mod kernel;
mod network;
mod privileges;
mod processor;
#[cfg(test)]
mod tests;

pub use check::{Check, CheckVerdict};

use crate::Host;

/// The demand of the real-time thread: what it is going to ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RealTimeDemand {
    /// The processor it is pinned to.
    pub cpu: Option<usize>,
    /// `SCHED_FIFO` priority, 1 to 99.
    pub priority: i32,
}

/// Makes every check of a network interface that drives hang on.
#[must_use]
pub fn examine_interface(host: &Host, name: &str) -> Vec<Check> {
    let exists = network::exists(host, name);
    if exists.verdict == CheckVerdict::Missing {
        return vec![exists];
    }
    vec![
        exists,
        network::link(host, name),
        network::raw_frames(host),
        network::sole_use(host, name),
        network::coalescing(name),
    ]
}

/// Makes every check. Privileges are those of the calling process.
#[must_use]
pub fn examine(host: &Host, demand: RealTimeDemand) -> Vec<Check> {
    let mut checks = vec![
        kernel::preemption(host),
        privileges::scheduling(host, demand.priority),
        privileges::precedence(host),
        privileges::memory_lock(host),
        privileges::group_budget(host),
        privileges::idle_latency(host),
        kernel::throttling(host),
        kernel::clock_source(host),
    ];
    if let Some(cpu) = demand.cpu {
        checks.extend([
            processor::available(host, cpu),
            processor::isolation(host, cpu),
            processor::tickless(host, cpu),
            processor::interrupts(host, cpu),
            processor::siblings(host, cpu),
            processor::governor(host, cpu),
            processor::overheating(host, cpu),
        ]);
    } else {
        checks.push(processor::not_chosen());
    }
    checks.push(kernel::steal(host));
    checks
}
