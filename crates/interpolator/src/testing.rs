//! The fixtures of unit tests: frames, items, and the real-time thread with a grid instead of a
//! clock.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    clippy::float_cmp,
    clippy::unwrap_used,
    unreachable_pub,
    reason = "a test: numbers are small, bits are compared on purpose, failures are panics"
)]

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

use glidepath_geometry::AXES;
use glidepath_link::SetpointFrame;
pub(crate) use synthetic::*;

/// How many random cases a test runs, unless the environment says otherwise.
pub(crate) fn random_cases(usual: u32) -> u32 {
    let wanted = std::env::var("PROPTEST_CASES").ok();
    wanted.map_or(usual, |text| text.parse().unwrap())
}

/// A frame with the given values on the first axes and zero on the others.
pub(crate) fn frame_of<const N: usize>(
    sequence: u64,
    position: [f64; N],
    velocity: [f64; N],
    acceleration: [f64; N],
) -> SetpointFrame {
    let all = |values: [f64; N]| {
        let mut all = [0.0; AXES];
        all[..N].copy_from_slice(&values);
        all
    };
    SetpointFrame {
        epoch: 1,
        sequence,
        period_ns: 4_000_000,
        planned_override: 1.0,
        position: all(position),
        velocity: all(velocity),
        acceleration: all(acceleration),
        ..<SetpointFrame as bytemuck::Zeroable>::zeroed()
    }
}

/// Items of which each is a block, numbered from 1.
pub(crate) fn blocks(kinds: impl IntoIterator<Item = ItemKind>) -> Vec<Item> {
    let item = |(kind, block)| Item {
        line: block,
        block,
        kind,
    };
    kinds.into_iter().zip(1..).map(item).collect()
}

/// Frames of items as the planner makes them, from rest at `start`, at 4 ms within 0.02 mm.
pub(crate) fn planned(
    items: &[Item],
    limits: Limits,
    start: AxisVector,
    effort: Effort,
) -> Vec<SetpointFrame> {
    let settings = Settings {
        limits,
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort,
    };
    let mut planner = Planner::new(settings, start);
    for item in items {
        planner.push(item).unwrap();
    }
    planner.finish();
    let frames: Vec<_> = std::iter::from_fn(|| planner.pop_frame().unwrap()).collect();
    records(&frames, 1, 4_000_000)
}

use crate::ports::demand_reader::DemandReader;
use crate::real_time::tick::Interpolator;
use crate::shared::config::Config;
use crate::shared::message::{Inputs, LOG_EVENTS, LogEvent, Order, PortsEnds, Rings, TickReport};
use glidepath_geometry::AxisVector;
use glidepath_link::{Command, EventRecord, JogDemand, MachineState, Setpoint};
use glidepath_motion::Planner;
use glidepath_program::{Effort, Event, Item, ItemKind, Limits, Settings, Smoothing};
use glidepath_realtime::{EventReader, Events, Wake, event_ring};
use heapless::spsc::Producer;
use std::collections::VecDeque;

/// Lets an event happen at a frame, and nothing else.
pub(crate) fn happens(frame: &mut SetpointFrame, event: Event) {
    frame.silence();
    let offset_ns = frame.period_ns.try_into().unwrap();
    frame.events[0] = EventRecord::new(event, offset_ns);
    frame.event_count = 1;
}

/// The real-time thread's state with a grid of its own instead of a clock.
pub(crate) struct Rig {
    pub(crate) interpolator: Interpolator<'static>,
    pub(crate) inputs: Inputs<'static>,
    pub(crate) ends: PortsEnds<'static>,
    pub(crate) reports: Producer<'static, TickReport>,
    pub(crate) config: Config,
    /// Frames that have not yet been published.
    pub(crate) feed: VecDeque<SetpointFrame>,
    pub(crate) setpoints: Vec<Setpoint>,
    pub(crate) last: Option<TickReport>,
    pub(crate) log: EventReader<'static, LogEvent>,
    tick: u64,
    /// Frames published.
    sent: u64,
}

impl Rig {
    pub(crate) fn new(config: Config) -> Self {
        let rings = Box::leak(Box::<Rings>::default());
        let events = Box::leak(Box::<Events<LogEvent, LOG_EVENTS>>::default());
        let ((inputs, reports), ends) = rings.split();
        let (writer, log) = event_ring(events);
        let interpolator = Interpolator::new(&config, 77, writer);
        let (feed, setpoints) = (VecDeque::new(), Vec::new());
        Self {
            interpolator,
            inputs,
            ends,
            reports,
            config,
            feed,
            setpoints,
            last: None,
            log,
            tick: 0,
            sent: 0,
        }
    }

    /// The default machine at 4 ms.
    pub(crate) fn mill() -> Self {
        Self::new(Config::new(mill(), 4_000_000))
    }

    /// The default machine, with frames still to be published.
    pub(crate) fn playing(frames: &[SetpointFrame]) -> Self {
        let mut rig = Self::mill();
        rig.feed.extend(frames);
        rig
    }

    pub(crate) fn command(&mut self, command: Command) {
        assert!(self.ends.order(Order::Command(command)));
    }

    /// When the last tick was due.
    pub(crate) const fn now_ns(&self) -> u64 {
        self.tick * self.config.period_ns
    }

    /// Demands a jog, as a client does at the present time.
    pub(crate) fn jog(&mut self, record: &JogDemand) {
        let demand = DemandReader::new(&self.config).read(record).unwrap();
        assert!(self.ends.demand(demand));
    }

    /// Moves up to `count` frames into the ring.
    pub(crate) fn publish(&mut self, count: usize) {
        for _ in 0..count {
            if !self.ends.frames.ready() {
                return;
            }
            let Some(frame) = self.feed.pop_front() else {
                return;
            };
            self.ends.frames.enqueue(frame).unwrap();
            self.sent += 1;
        }
    }

    /// Publishes as a planner does: half a second ahead of what was executed.
    pub(crate) fn publish_horizon(&mut self) {
        let executed = self.setpoints.last().map_or(0, |s| s.sequence);
        while self.sent < executed + self.config.horizon_frames && !self.feed.is_empty() {
            self.publish(1);
        }
    }

    /// Ticks from one frame to another, both of which were published as they are.
    pub(crate) fn ticks_from(&self, one: u64, other: u64) -> usize {
        let at = |sequence| {
            let is_it = |s: &Setpoint| s.sequence == sequence;
            self.setpoints.iter().position(is_it).unwrap()
        };
        at(other) - at(one)
    }

    /// One period, without new frames.
    pub(crate) fn tick(&mut self) -> Setpoint {
        self.tick_late(0, 0)
    }

    /// A tick that comes late, after missed ones.
    pub(crate) fn tick_late(&mut self, missed: u64, lateness_ns: u64) -> Setpoint {
        self.tick += 1 + missed;
        let scheduled_ns = self.tick * self.config.period_ns;
        let woke_ns = scheduled_ns + lateness_ns;
        let wake = Wake {
            tick: self.tick,
            scheduled_ns,
            woke_ns,
            missed,
        };
        let mut report = TickReport::blank();
        self.interpolator
            .prepare(&wake, &mut self.inputs, &mut report);
        self.interpolator.stamp(&mut report, &wake);
        self.setpoints.push(report.setpoint);
        self.last = Some(report);
        report.setpoint
    }

    /// Ticks with the planner keeping up, until a condition or `most` ticks.
    pub(crate) fn run_until(
        &mut self,
        most: usize,
        mut done: impl FnMut(&Setpoint) -> bool,
    ) -> bool {
        for _ in 0..most {
            self.publish(4);
            let setpoint = self.tick();
            if done(&setpoint) {
                return true;
            }
        }
        false
    }

    pub(crate) fn run(&mut self, ticks: usize) {
        self.run_until(ticks, |_| false);
    }

    pub(crate) fn state(&self) -> MachineState {
        self.last.map_or(MachineState::Idle, |report| report.state)
    }

    /// Everything that was published, with the rest before it.
    pub(crate) fn positions(&self) -> Vec<AxisVector> {
        let first = self.config.start_position;
        let published = self.setpoints.iter().map(|s| AxisVector::from(s.position));
        std::iter::repeat_n(first, 3).chain(published).collect()
    }

    /// The largest ratio to any limit, by finite differences of everything published.
    pub(crate) fn worst_ratio(&self) -> f64 {
        let ratios = audit(
            &self.positions(),
            &self.config.limits,
            self.config.period_t(),
        );
        ratios.into_iter().fold(0.0, f64::max)
    }
}
