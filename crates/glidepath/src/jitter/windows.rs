//! The windows of a measurement: its beats, gathered second by second.

use super::beat::LoopBeat;
use glidepath_realtime::Histogram;

/// The windows of a measurement, and what they held.
#[derive(Debug)]
pub struct Windows {
    /// Latency of waking in all windows.
    pub all: Histogram,
    /// Latency of waking in windows without steal.
    pub clean: Histogram,
    /// Lateness of the ticks in all windows.
    pub lateness: Histogram,
    /// Work of the periods in all windows.
    pub work: Histogram,
    /// Missed ticks in all windows.
    pub missed: u64,
    /// Missed ticks in windows without steal.
    pub clean_missed: u64,
    /// Periods in which the machine moved.
    pub moving: u64,
    /// Number of windows.
    pub count: u64,
    /// Number of windows in which the count of steal moved.
    pub with_steal: u64,
    /// Ticks of 10 ms that were stolen; `None` if the host does not tell.
    pub steal: Option<u64>,
    /// The count of steal at the end of the last window.
    before: Option<u64>,
    open: Histogram,
    open_missed: u64,
}

impl Windows {
    /// None yet; `steal` is the count at the beginning of the first.
    #[must_use]
    pub fn new(steal: Option<u64>) -> Self {
        Self {
            all: Histogram::new(),
            clean: Histogram::new(),
            lateness: Histogram::new(),
            work: Histogram::new(),
            missed: 0,
            clean_missed: 0,
            moving: 0,
            count: 0,
            with_steal: 0,
            steal: steal.map(|_| 0),
            before: steal,
            open: Histogram::new(),
            open_missed: 0,
        }
    }

    /// Counts a beat in the open window.
    pub fn record(&mut self, beat: &LoopBeat) {
        self.open.record(beat.latency_ns);
        self.lateness.record(beat.lateness_ns);
        self.open_missed += beat.missed;
        self.work.record(beat.work_ns);
        self.moving += u64::from(beat.is_moving);
    }

    /// Begins after a pause; `steal` is the count now.
    pub const fn resume(&mut self, steal: Option<u64>) {
        self.before = steal;
    }

    /// Closes the open window; `steal` is the count now. Where the host does not tell, every window
    /// is taken as one without.
    pub fn close(&mut self, steal: Option<u64>) {
        let stolen = match (self.before, steal) {
            (Some(before), Some(now)) => now.saturating_sub(before),
            _ => 0,
        };
        self.before = steal;
        self.steal = self
            .steal
            .and(steal)
            .and(self.steal.map(|sum| sum + stolen));
        self.count += 1;
        self.all.merge(&self.open);
        self.missed += self.open_missed;
        if stolen > 0 {
            self.with_steal += 1;
        } else {
            self.clean.merge(&self.open);
            self.clean_missed += self.open_missed;
        }
        self.open.clear();
        self.open_missed = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn beat(latency_ns: u64, missed: u64) -> LoopBeat {
        LoopBeat {
            latency_ns,
            lateness_ns: latency_ns / 2,
            missed,
            work_ns: 1_000,
            is_moving: missed == 0,
        }
    }

    #[test]
    fn a_window_with_steal_counts_in_one_set_only() {
        let mut windows = Windows::new(Some(40));
        windows.record(&beat(20_000, 0));
        windows.close(Some(40));
        windows.record(&beat(9_000_000, 2));
        windows.close(Some(43));
        windows.record(&beat(5_000_000, 1));
        windows.close(Some(43));
        assert_eq!((windows.count, windows.with_steal), (3, 1));
        assert_eq!((windows.missed, windows.clean_missed), (3, 1));
        assert_eq!((windows.steal, windows.moving), (Some(3), 1));
        assert_eq!(windows.all.quantiles().max_ns, 9_000_000);
        assert_eq!(windows.clean.quantiles().max_ns, 5_000_000);
        assert_eq!(windows.all.quantiles().count, 3);
        assert_eq!(windows.work.quantiles().count, 3);
        assert_eq!(windows.lateness.quantiles().max_ns, 4_500_000);
    }

    #[test]
    fn what_is_stolen_in_a_pause_counts_nowhere() {
        let mut windows = Windows::new(Some(40));
        windows.resume(Some(45));
        windows.record(&beat(20_000, 0));
        windows.close(Some(45));
        assert_eq!((windows.with_steal, windows.steal), (0, Some(0)));
    }

    #[test]
    fn without_a_count_of_steal_all_windows_are_clean() {
        let mut windows = Windows::new(None);
        windows.record(&beat(20_000, 0));
        windows.close(None);
        assert_eq!((windows.with_steal, windows.steal), (0, None));
        assert_eq!(windows.clean.quantiles().count, 1);
    }
}
