//! The pulse: what a host did not give to a thread that only wants to wake in time.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Between two beats.
const BEAT: Duration = Duration::from_millis(1);

/// A thread beside those under test. Where it was late, they may have been, and nothing that takes a host in
/// time can be judged.
#[derive(Debug)]
pub struct Pulse {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared {
    begun: Instant,
    /// When it beat last, from `begun`, µs.
    last_us: AtomicU64,
    /// The longest time by which a beat was late, µs.
    worst_us: AtomicU64,
    is_over: AtomicBool,
}

impl Shared {
    fn now_us(&self) -> u64 {
        u64::try_from(self.begun.elapsed().as_micros()).unwrap_or(u64::MAX)
    }

    /// By how much the beat is late that follows the last one.
    fn late_us(&self) -> u64 {
        let beat_us = u64::try_from(BEAT.as_micros()).unwrap_or(u64::MAX);
        let due_us = self.last_us.load(Ordering::Relaxed) + beat_us;
        self.now_us().saturating_sub(due_us)
    }

    fn beat(&self) {
        while !self.is_over.load(Ordering::Relaxed) {
            std::thread::sleep(BEAT);
            self.worst_us.fetch_max(self.late_us(), Ordering::Relaxed);
            self.last_us.store(self.now_us(), Ordering::Relaxed);
        }
    }
}

impl Pulse {
    /// It beats from now on.
    #[must_use]
    pub fn start() -> Self {
        let shared = Arc::new(Shared {
            begun: Instant::now(),
            last_us: AtomicU64::new(0),
            worst_us: AtomicU64::new(0),
            is_over: AtomicBool::new(false),
        });
        let beating = Arc::clone(&shared);
        let thread = std::thread::spawn(move || beating.beat());
        Self {
            shared,
            thread: Some(thread),
        }
    }

    /// By how much it was late at most since it was asked the last time, or is now.
    #[must_use]
    pub fn worst(&self) -> Duration {
        let worst_us = self.shared.worst_us.swap(0, Ordering::Relaxed);
        Duration::from_micros(worst_us.max(self.shared.late_us()))
    }
}

impl Drop for Pulse {
    fn drop(&mut self) {
        self.shared.is_over.store(true, Ordering::Relaxed);
        // It panics nowhere.
        let _ended = self.thread.take().map(JoinHandle::join);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pulse_that_is_not_let_beat_is_late() {
        let pulse = Pulse::start();
        pulse.shared.is_over.store(true, Ordering::Relaxed);
        std::thread::sleep(Duration::from_millis(80));
        assert!(pulse.worst() >= Duration::from_millis(60));
    }
}
