//! The statistics of the ticks: counts for every report, and events for the log.

use crate::real_time::counters::Counters;
use crate::shared::config::Config;
use crate::shared::message::{LogEvent, TickReport, Timing};
use glidepath_link::MachineState;
use glidepath_realtime::{EventWriter, Wake};

/// Counts, and tells of, what happens from the start of the process to its end.
pub(crate) struct TickStatistics<'a> {
    counters: Counters,
    state: MachineState,
    log_events: EventWriter<'a, LogEvent>,
}

impl<'a> TickStatistics<'a> {
    pub(crate) fn new(config: &Config, log_events: EventWriter<'a, LogEvent>) -> Self {
        Self {
            counters: Counters::new(config),
            state: MachineState::Idle,
            log_events,
        }
    }

    /// Writes into a report when it was, and counts the wake-up. Returns how many ticks
    /// were missed in the present second, and how many may be, where those are too many.
    pub(crate) fn stamp(&mut self, report: &mut TickReport, wake: &Wake) -> Option<(u64, u64)> {
        if wake.missed > 0 {
            self.log_events.write(LogEvent::Missed {
                tick: wake.tick,
                count: wake.missed,
            });
        }
        let too_many = self.counters.count(wake);
        self.counters.stamp(report, wake);
        too_many
    }

    /// Keeps how long the tick took, for the next report.
    pub(crate) const fn keep_timing(&mut self, timing: Timing) {
        self.counters.keep_timing(timing);
    }

    /// A report found no room in its ring.
    pub(crate) const fn lose_report(&mut self) {
        self.counters.count_lost_report();
    }

    /// The stop in reserve was begun.
    pub(crate) fn begin_reserve_stop(&mut self, tick: u64) {
        self.counters.count_reserve_stop();
        self.log_events.write(LogEvent::ReserveStop { tick });
    }

    /// There is no way back beyond where the motion stands.
    pub(crate) fn end_way_back(&mut self, line: u32) {
        self.log_events.write(LogEvent::WayBackEnds { line });
    }

    /// A setpoint exceeds a limit by this share of it.
    pub(crate) fn exceed(&mut self, tick: u64, part: f64) {
        self.log_events.write(LogEvent::Excess { tick, part });
    }

    /// The state of the machine after this tick. Motion that has begun, and slows or stands for
    /// want of frames, is counted.
    pub(crate) fn enter(&mut self, to: MachineState, tick: u64, line: u32, has_begun: bool) {
        if to != self.state {
            let from = core::mem::replace(&mut self.state, to);
            self.log_events.write(LogEvent::State {
                tick,
                from,
                to,
                line,
            });
        }
        if has_begun && matches!(to, MachineState::Starving | MachineState::Starved) {
            self.counters.count_starved_tick();
        }
    }

    /// The state of the machine after the last tick.
    pub(crate) const fn state(&self) -> MachineState {
        self.state
    }

    /// Writes into a report the state after the tick, and what was counted of the motion.
    pub(crate) const fn fill(&self, report: &mut TickReport) {
        report.setpoint.state = self.state.code();
        report.state = self.state;
        report.reserve_stops = self.counters.reserve_stops();
        report.starved_ticks = self.counters.starved_ticks();
    }

    #[cfg(test)]
    pub(crate) const fn counters(&self) -> &Counters {
        &self.counters
    }
}
