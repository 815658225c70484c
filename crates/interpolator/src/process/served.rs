//! An interpolator with its ports, without threads and clock, that is driven by hand.

use crate::ports::turn::Ports;
use crate::real_time::tick::Interpolator;
use crate::shared::config::Config;
use crate::shared::message::{Inputs, LOG_EVENTS, LogEvent, Rings, TickReport};
use glidepath_link::{LinkError, Setpoint, Transport};
use glidepath_realtime::{Events, Wake, event_ring};
use heapless::spsc::Producer;

/// From a tick to the turn of the ports after it, ns.
const PHASE_NS: u64 = 200_000;

/// The work of both threads without a thread and without a clock: for tests of what is at the other
/// end of the ports. Frames are judged, commands answered and feedback taken as ever.
pub struct Served<'a> {
    interpolator: Interpolator<'a>,
    inputs: Inputs<'a>,
    reports: Producer<'a, TickReport>,
    ports: Ports<'a>,
    period_ns: u64,
    tick: u64,
}

impl core::fmt::Debug for Served<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Served")
            .field("tick", &self.tick)
            .finish_non_exhaustive()
    }
}

/// Calls `drive` with an interpolator at rest, whose ports are those of `transport`. `boot_id` is the
/// number of its life.
///
/// # Errors
/// A port cannot be made.
pub fn served<R>(
    config: &Config,
    boot_id: u64,
    transport: Box<dyn Transport>,
    drive: impl FnOnce(&mut Served<'_>) -> R,
) -> Result<R, LinkError> {
    let mut rings = Rings::default();
    let mut events = Box::<Events<LogEvent, LOG_EVENTS>>::default();
    let ((inputs, reports), ends) = rings.split();
    let (writer, reader) = event_ring(&mut events);
    let interpolator = Interpolator::new(config, boot_id, writer);
    let mut log = |_: &str| {};
    let ports = Ports::new(config, boot_id, transport, ends, reader, &mut log)?;
    Ok(drive(&mut Served {
        interpolator,
        inputs,
        reports,
        ports,
        period_ns: config.period_ns,
        tick: 0,
    }))
}

impl Served<'_> {
    /// One period: the tick that is due at `scheduled_ns`, on time, and the turn of the ports. Returns
    /// the setpoint that was sent.
    pub fn tick(&mut self, scheduled_ns: u64) -> Setpoint {
        self.tick += 1;
        let wake = Wake {
            tick: self.tick,
            scheduled_ns,
            woke_ns: scheduled_ns,
            missed: 0,
        };
        let mut report = TickReport::blank();
        self.interpolator
            .prepare(&wake, &mut self.inputs, &mut report);
        self.interpolator.stamp(&mut report, &wake);
        // The ports take every report before the next one.
        let _ = self.reports.enqueue(report);
        let phase_ns = PHASE_NS.min(self.period_ns / 2);
        self.ports.turn(&|| scheduled_ns + phase_ns);
        report.setpoint
    }
}
