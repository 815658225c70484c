//! The counters of the real-time thread: how well the host kept time, and what that cost.

use crate::shared::config::Config;
use crate::shared::message::{TickReport, Timing};
use glidepath_link::SetpointMarks;
use glidepath_realtime::Wake;

/// What is counted from the start of the process to its end, and the timing of the last tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counters {
    missed_ticks: u64,
    late_ticks: u64,
    reports_lost: u64,
    reserve_stops: u64,
    starved_ticks: u64,
    /// The timing of the tick before.
    timing: Timing,
    period_ns: u64,
    late_from_ns: u64,
    ticks_per_s: u64,
    missed_allowed: u64,
    second: u64,
    missed_in_second: u64,
}

impl Counters {
    pub(crate) fn new(config: &Config) -> Self {
        Self {
            missed_ticks: 0,
            late_ticks: 0,
            reports_lost: 0,
            reserve_stops: 0,
            starved_ticks: 0,
            timing: Timing::default(),
            period_ns: config.period_ns,
            // A wake-up is never quite on time: late is what eats a quarter of the period.
            late_from_ns: config.period_ns / 4,
            ticks_per_s: (1_000_000_000 / config.period_ns.max(1)).max(1),
            missed_allowed: config.missed_ticks_allowed.unwrap_or(u64::MAX),
            second: 0,
            missed_in_second: 0,
        }
    }

    /// Counts a wake-up. Returns how many ticks were missed in the present second, and how many may be, where those are
    /// too many.
    pub(crate) fn count(&mut self, wake: &Wake) -> Option<(u64, u64)> {
        let second = wake.tick / self.ticks_per_s;
        if second != self.second {
            self.second = second;
            self.missed_in_second = 0;
        }
        self.missed_ticks += wake.missed;
        self.missed_in_second += wake.missed;
        if self.is_late(wake) {
            self.late_ticks += 1;
        }
        let are_too_many = wake.missed > 0 && self.missed_in_second > self.missed_allowed;
        are_too_many.then_some((self.missed_in_second, self.missed_allowed))
    }

    /// Writes into a report when it was, and how the host kept time so far.
    pub(crate) const fn stamp(&self, report: &mut TickReport, wake: &Wake) {
        let setpoint = &mut report.setpoint;
        setpoint.tick = wake.tick;
        setpoint.scheduled_ns = wake.scheduled_ns;
        setpoint.apply_ns = wake.scheduled_ns + self.period_ns;
        setpoint.lateness_ns = wake.lateness_ns();
        setpoint.missed_ticks = self.missed_ticks;
        setpoint.marks = 0;
        if self.is_late(wake) {
            setpoint.marks |= SetpointMarks::LATE.0;
        }
        if wake.missed > 0 {
            setpoint.marks |= SetpointMarks::AFTER_MISSED.0;
        }
        report.timing = self.timing;
        report.late_ticks = self.late_ticks;
        report.reports_lost = self.reports_lost;
    }

    const fn is_late(&self, wake: &Wake) -> bool {
        wake.lateness_ns() >= self.late_from_ns
    }

    /// The stop in reserve was begun.
    pub(crate) const fn count_reserve_stop(&mut self) {
        self.reserve_stops += 1;
    }

    /// How often the stop in reserve was begun.
    pub(crate) const fn reserve_stops(&self) -> u64 {
        self.reserve_stops
    }

    /// A motion that had begun slows or stands for want of frames.
    pub(crate) const fn count_starved_tick(&mut self) {
        self.starved_ticks += 1;
    }

    /// In how many ticks that was so.
    pub(crate) const fn starved_ticks(&self) -> u64 {
        self.starved_ticks
    }

    /// A report found no room in its ring.
    pub(crate) const fn count_lost_report(&mut self) {
        self.reports_lost += 1;
    }

    /// Keeps how long the tick took, for the next report.
    pub(crate) const fn keep_timing(&mut self, timing: Timing) {
        self.timing = timing;
    }
}
