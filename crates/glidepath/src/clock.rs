//! The clocks of wall time and processor time, for reports alone, and when a command was typed.

use glidepath_realtime::{Clock as _, Monotonic};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Processor time of the calling thread.
#[must_use]
pub fn processor() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(time).unwrap_or_default()
}

/// Time since this was first asked.
#[must_use]
pub fn elapsed() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    START.get_or_init(Instant::now).elapsed()
}

/// When this process was started, of the host's steady clock, ns: whoever typed its command wanted it then, however
/// long a busy host took to load the program, or the program to read its configuration.
#[must_use]
pub fn started_ns() -> u64 {
    static STARTED: OnceLock<u64> = OnceLock::new();
    *STARTED.get_or_init(|| Monotonic.now_ns().saturating_sub(age_ns().unwrap_or(0)))
}

/// Linux tells the start of a process in hundredths of a second.
const TICK_NS: u64 = 10_000_000;

/// How old this process is at least; `None` where the system does not tell.
fn age_ns() -> Option<u64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name, in brackets, may have any characters; 19 fields further on stands the start, since the host's.
    let fields = stat.get(stat.rfind(')')? + 1..)?;
    let start_ticks: u64 = fields.split_whitespace().nth(19)?.parse().ok()?;
    let now = rustix::time::clock_gettime(rustix::time::ClockId::Boottime);
    let now_ns = u64::try_from(Duration::try_from(now).ok()?.as_nanos()).ok()?;
    // It was started within the tick, at its end at the latest: what was stopped before is not taken for later.
    now_ns.checked_sub(start_ticks.checked_add(1)?.checked_mul(TICK_NS)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_process_was_started_before_it_asks() {
        let (started_ns, now_ns) = (started_ns(), Monotonic.now_ns());
        assert!(age_ns().is_some() || now_ns - started_ns < 2 * TICK_NS);
        // Tests run for less than a day.
        assert!(started_ns <= now_ns && now_ns - started_ns < 86_400_000_000_000);
    }
}
