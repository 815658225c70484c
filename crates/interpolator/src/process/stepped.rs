//! An interpolator without threads, clock and ports that is driven by hand, tick by tick.

use crate::ports::demand_reader::DemandReader;
use crate::real_time::tick::Interpolator;
use crate::shared::config::Config;
use crate::shared::message::{Inputs, LOG_EVENTS, LogEvent, Order, PortsEnds, Rings, TickReport};
use glidepath_link::{Command, JogDemand, Setpoint, SetpointFrame};
use glidepath_realtime::{Events, Wake, event_ring};

/// The work of the real-time thread without a thread, a clock or ports: for measurements and
/// simulation. Frames are not judged: they must be those of a planner.
pub struct Stepped<'a> {
    interpolator: Interpolator<'a>,
    inputs: Inputs<'a>,
    ends: PortsEnds<'a>,
    reader: DemandReader,
    report: TickReport,
    period_ns: u64,
    tick: u64,
}

impl core::fmt::Debug for Stepped<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Stepped")
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

/// Calls `drive` with an interpolator at rest.
pub fn stepped<R>(config: &Config, drive: impl FnOnce(&mut Stepped<'_>) -> R) -> R {
    let mut rings = Rings::default();
    let mut events = Box::<Events<LogEvent, LOG_EVENTS>>::default();
    let ((inputs, _reports), ends) = rings.split();
    let (writer, _happenings) = event_ring(&mut events);
    let interpolator = Interpolator::new(config, 1, writer);
    let period_ns = config.period_ns;
    drive(&mut Stepped {
        interpolator,
        inputs,
        ends,
        reader: DemandReader::new(config),
        report: TickReport::blank(),
        period_ns,
        tick: 0,
    })
}

impl Stepped<'_> {
    /// Gives it a frame; false if its ring is full.
    pub fn offer(&mut self, frame: &SetpointFrame) -> bool {
        self.ends.frames.enqueue(*frame).is_ok()
    }

    /// Gives it a command; false if there are too many, or it is not one of the motion.
    pub fn command(&mut self, command: Command) -> bool {
        command != Command::Ping && self.ends.order(Order::Command(command))
    }

    /// Gives it a demand for a jog; false if there are too many, or it is none of this machine.
    pub fn jog(&mut self, demand: &JogDemand) -> bool {
        let Ok(demand) = self.reader.read(demand) else {
            return false;
        };
        self.ends.demand(demand)
    }

    /// One period, on time.
    pub fn tick(&mut self) -> Setpoint {
        self.tick += 1;
        let scheduled_ns = self.tick * self.period_ns;
        let wake = Wake {
            tick: self.tick,
            scheduled_ns,
            woke_ns: scheduled_ns,
            missed: 0,
        };
        let report = &mut self.report;
        self.interpolator.prepare(&wake, &mut self.inputs, report);
        self.interpolator.stamp(report, &wake);
        report.setpoint
    }
}
