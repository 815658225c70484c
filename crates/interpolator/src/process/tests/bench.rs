//! The test bench: interpolator, servo library and plant, in steps of a millisecond.

use crate::ports::turn::Ports;
use crate::real_time::tick::Interpolator;
use crate::shared::config::Config;
use crate::shared::config::feedback::{FeedbackSettings, JointFeedback};
use crate::shared::message::{Awaited, Inputs, LOG_EVENTS, LogEvent, TickReport};
use crate::testing::{Numbers, Rig, audit, mill, plan, records};
use glidepath_geometry::AxisVector;
use glidepath_link::servo::{Servo, ServoSettings};
use glidepath_link::{
    Client, Command, CommandReply, CommandRequest, Delivery, EventId, FaultCause, Feedback,
    FrameSink, InProcess, JogDemand, MachineState, Power, Publisher, Setpoint, SetpointFrame,
    Status, Subscriber, Transport,
};
use glidepath_plant::{InjectedFault, JointSettings, Plant};
use glidepath_program::{Event, FrameEvents, FrameFlags};
use glidepath_realtime::{CountingAllocator, Events, Wake, event_ring};
use heapless::spsc::Producer;
use std::collections::VecDeque;

pub(super) const PERIOD_NS: u64 = 4_000_000;
/// Far from zero, as a monotonic clock is.
const START_NS: u64 = 9_000_000_000_000;
/// Frames a planner keeps ahead.
const HORIZON: u64 = 150;

pub(super) struct Bench {
    interpolator: Interpolator<'static>,
    inputs: Inputs<'static>,
    reports: Producer<'static, TickReport>,
    ports: Ports<'static>,
    pub(super) servo: Servo,
    pub(super) plant: Plant,
    sink: Box<dyn Publisher<Feedback>>,
    frames: Box<dyn FrameSink>,
    client: Box<dyn Client<CommandRequest, CommandReply>>,
    jogs: Box<dyn Publisher<JogDemand>>,
    statuses: Box<dyn Subscriber<Status>>,
    pub(super) link: InProcess,
    pub(super) setpoints: Vec<Setpoint>,
    pub(super) feed: VecDeque<SetpointFrame>,
    sent: u64,
    epoch: u64,
    status: Option<Status>,
    tick: u64,
    config: Config,
    /// What the last report told to be awaited.
    reported: Option<Awaited>,
    /// What becomes of the plant's feedback on its way.
    pub(super) on_the_way: fn(&mut Feedback, u64),
}

/// What joints of the tests are allowed.
pub(super) const ALLOWED: JointFeedback = JointFeedback {
    min_following_error: 0.1,
    following_error: 2.0,
    max_velocity: 200.0,
    homes: false,
    homing: None,
};

/// A mill with three axes and drives that answer.
pub(super) fn config(homes: bool) -> Config {
    use glidepath_geometry::Axis;
    use glidepath_kinematics::{AxisList, Mechanism, Trivial};
    Config {
        feedback: Some(FeedbackSettings::new(
            PERIOD_NS,
            JointFeedback { homes, ..ALLOWED },
        )),
        mechanism: Mechanism::Trivial(Trivial::new(AxisList::new(&[Axis::X, Axis::Y, Axis::Z]))),
        ..Config::new(mill(), PERIOD_NS)
    }
}

impl Bench {
    pub(super) fn new(config: Config, joints: &[JointSettings]) -> Self {
        let Rig {
            interpolator,
            inputs,
            reports,
            ends,
            ..
        } = Rig::new(config);
        let link = InProcess::default();
        let events = Box::leak(Box::<Events<LogEvent, LOG_EVENTS>>::default());
        let (_writer, reader) = event_ring(events);
        let log = Box::leak(Box::new(|_: &str| {}));
        let transport = Box::new(link.clone());
        let ports = Ports::new(&config, 77, transport, ends, reader, log).unwrap();
        Self {
            interpolator,
            inputs,
            reports,
            ports,
            servo: Servo::new(link.setpoint_source().unwrap(), ServoSettings::default()),
            plant: Plant::new(5, joints),
            sink: link.feedback_sink().unwrap(),
            frames: link.frame_sink().unwrap(),
            client: link.command_client().unwrap(),
            jogs: link.jog_sink().unwrap(),
            statuses: link.status_source().unwrap(),
            link,
            setpoints: Vec::new(),
            feed: VecDeque::new(),
            sent: 0,
            epoch: 0,
            status: None,
            tick: 0,
            config,
            reported: None,
            on_the_way: |_, _| {},
        }
    }

    /// Three joints that start somewhere, exact and with absolute encoders.
    pub(super) fn mill() -> Self {
        let joint = |start| JointSettings {
            start,
            count: start,
            ..JointSettings::default()
        };
        Self::new(config(false), &[joint(12.5), joint(-3.0), joint(40.0)])
    }

    pub(super) fn now_ns(&self) -> u64 {
        START_NS + self.tick * PERIOD_NS
    }

    /// One period: the tick, the turn of the ports, and what the servo stack does until the next.
    pub(super) fn tick(&mut self) -> Setpoint {
        self.publish_frames();
        self.tick += 1;
        let scheduled_ns = self.now_ns();
        let wake = Wake {
            tick: self.tick,
            scheduled_ns,
            woke_ns: scheduled_ns,
            missed: 0,
        };
        let mut report = TickReport::blank();
        // Whatever the drives do: the real-time thread's part of it does not allocate.
        let calls = CountingAllocator::calls_of_this_thread();
        self.interpolator
            .prepare(&wake, &mut self.inputs, &mut report);
        self.interpolator.stamp(&mut report, &wake);
        assert_eq!(CountingAllocator::calls_of_this_thread(), calls);
        self.reports.enqueue(report).unwrap();
        self.ports.turn(&|| scheduled_ns + 200_000);
        while let Some(status) = self.statuses.take().unwrap() {
            self.status = Some(status);
        }
        for ms in 0..PERIOD_NS / 1_000_000 {
            let now_ns = scheduled_ns + 300_000 + ms * 1_000_000;
            while let Some(setpoint) = self.servo.receive(now_ns).unwrap() {
                self.plant.hear(&setpoint);
            }
            let demand = self.servo.demand(now_ns);
            self.plant.step(now_ns, self.servo.last(), demand.as_ref());
            if let Some(mut feedback) = self.plant.feedback() {
                (self.on_the_way)(&mut feedback, now_ns);
                self.sink.publish(&feedback).unwrap();
            }
        }
        self.setpoints.push(report.setpoint);
        self.reported = report.awaited;
        report.setpoint
    }

    fn publish_frames(&mut self) {
        let executed = self
            .setpoints
            .last()
            .filter(|s| s.epoch == self.epoch)
            .map_or(0, |s| s.sequence);
        while self.sent < executed + HORIZON {
            let Some(frame) = self.feed.front() else {
                return;
            };
            if self.frames.offer(frame).unwrap() != Delivery::Delivered {
                return;
            }
            self.feed.pop_front();
            self.sent += 1;
        }
    }

    /// That a position that is set is the position of the axis, while its joint stays.
    #[track_caller]
    pub(super) fn sets_its_position(&mut self) {
        self.enable(MachineState::Idle);
        let before = self.last().joint_position;
        let set = Command::SetPosition {
            joint: 0,
            position: 31.25,
        };
        self.command(set).unwrap();
        self.run(10);
        let last = self.last();
        let [x, joint] = [last.position[0], last.joint_position[0]];
        assert!((x - 31.25).abs() < 1e-9, "{x}");
        assert!((joint - before[0]).abs() < 1e-9);
    }

    pub(super) fn run(&mut self, ticks: usize) {
        for _ in 0..ticks {
            self.tick();
        }
    }

    /// Ticks until a state, at most so many.
    pub(super) fn run_to(&mut self, state: MachineState, most: usize) -> bool {
        (0..most).any(|_| self.tick().state() == Ok(state))
    }

    /// Ticks a few times, so that what a status tells is of now.
    pub(super) fn status(&mut self) -> Status {
        self.run(6);
        self.status.unwrap()
    }

    pub(super) fn last(&self) -> Setpoint {
        *self.setpoints.last().unwrap()
    }

    pub(super) fn state(&self) -> MachineState {
        self.last().state().unwrap()
    }

    /// Gives a command; the text of the refusal, if it is one.
    pub(super) fn command(&mut self, command: Command) -> Result<(), String> {
        self.client
            .ask(&CommandRequest::new(1, 1, command))
            .unwrap();
        self.tick();
        let reply = self.client.reply().unwrap().unwrap();
        match reply.outcome().unwrap() {
            Ok(()) => Ok(()),
            Err(_) => Err(reply.message.as_str().to_owned()),
        }
    }

    /// A client demands a jog.
    pub(super) fn jog(&mut self, demand: &JogDemand) {
        self.jogs.publish(demand).unwrap();
    }

    /// Switches on and waits until a state.
    pub(super) fn enable(&mut self, state: MachineState) {
        self.run(10);
        self.command(Command::Enable).unwrap();
        assert!(self.run_to(state, 200), "{:?}", self.state());
    }

    /// Lines up a program from where the machine stands, which takes about so many ticks.
    pub(super) fn load(&mut self, seed: u64, ticks: usize) {
        let start = AxisVector::from(self.last().position);
        let limits = self.config.limits;
        let frames = plan(seed, 3, ticks, &limits, 0.004, start);
        self.epoch += 1;
        self.feed = records(&frames, self.epoch, PERIOD_NS).into();
        self.sent = 0;
    }

    /// Lines up stretches of motion of about so many ticks, with an M code at rest before each.
    pub(super) fn load_codes(&mut self, seed: u64, ticks: usize, codes: &[u32]) {
        let events: Vec<Event> = codes.iter().map(|code| Event::MCode(*code)).collect();
        self.load_events(seed, ticks, &events);
    }

    /// Lines up motions with events at rest in front of them.
    pub(super) fn load_events(&mut self, seed: u64, ticks: usize, events: &[Event]) {
        let mut at = AxisVector::from(self.last().position);
        let mut frames: Vec<SetpointFrame> = Vec::new();
        self.epoch += 1;
        for (stretch, event) in events.iter().enumerate() {
            let limits = self.config.limits;
            let planned = plan(seed + stretch as u64, 3, ticks, &limits, 0.004, at);
            at = planned[planned.len() - 1].position;
            let mut part = records(&planned, self.epoch, PERIOD_NS);
            let (mut told, line) = (planned[0], stretch as u32 + 1);
            told.events = FrameEvents::one(*event, PERIOD_NS as u32);
            told.line = line;
            let rest = SetpointFrame {
                line,
                block: line,
                ..SetpointFrame::from_frame(&told, self.epoch, PERIOD_NS)
            };
            for frame in &mut part {
                frame.block = line;
            }
            part.insert(1, rest);
            part.insert(1, part[0]);
            frames.extend(part);
        }
        let last = frames.len() - 1;
        for (sequence, frame) in frames.iter_mut().enumerate() {
            frame.sequence = sequence as u64;
            frame.flags = match sequence {
                0 => FrameFlags::FIRST.0,
                n if n == last => FrameFlags::LAST.0,
                _ => 0,
            };
        }
        self.feed = frames.into();
        self.sent = 0;
    }

    /// Lines up frames of one epoch.
    pub(super) fn load_frames(&mut self, mut frames: Vec<SetpointFrame>) {
        self.epoch += 1;
        for frame in &mut frames {
            frame.epoch = self.epoch;
        }
        self.feed = frames.into();
        self.sent = 0;
    }

    /// What is loaded next has this number.
    pub(super) const fn next_epoch(&mut self, number: u64) {
        self.epoch = number - 1;
    }

    /// What is awaited, by the status.
    pub(super) fn awaited(&mut self) -> Option<EventId> {
        let status = self.status();
        (status.awaited_since_ns != 0).then_some(EventId {
            boot_id: status.boot_id,
            epoch: status.epoch,
            sequence: status.awaited_sequence,
        })
    }

    /// What was awaited at the last tick.
    pub(super) fn last_awaited(&self) -> Option<EventId> {
        self.reported.map(|awaited| awaited.id(77))
    }

    /// The sequence of the frame with an M code that is still to be published.
    pub(super) fn feed_of(&self, code: f64) -> u64 {
        let is_it = |frame: &&SetpointFrame| frame.event() == Ok(Some(Event::MCode(code as u32)));
        self.feed.iter().find(is_it).unwrap().sequence
    }

    pub(super) fn inject(&mut self, upset: InjectedFault) {
        self.plant.inject(upset);
    }

    pub(super) fn fault(&mut self) -> Option<FaultCause> {
        self.status().fault().unwrap()
    }

    /// Where the joints are, as the drives count.
    pub(super) fn joints(&self) -> [f64; 9] {
        self.plant.measured().position
    }

    /// The largest ratio to a limit of all positions that continue each other.
    pub(super) fn worst_ratio(&self) -> f64 {
        let mut worst = 0.0_f64;
        let is_on = |s: &Setpoint| s.enable != 0 && s.state() != Ok(MachineState::Off);
        for run in self
            .setpoints
            .chunk_by(|a, b| a.reference == b.reference && a.home == b.home && is_on(a) == is_on(b))
        {
            if is_on(&run[0]) && run[0].home == 0 {
                let first = AxisVector::from(run[0].position);
                let published = run.iter().map(|s| AxisVector::from(s.position));
                let all: Vec<_> = std::iter::repeat_n(first, 3).chain(published).collect();
                let ratios = audit(&all, &self.config.limits, 0.004);
                worst = ratios.into_iter().fold(worst, f64::max);
            }
        }
        worst
    }

    /// Nothing that has power jumps, whatever the reference does.
    pub(super) fn assert_no_joint_jumps(&self) {
        for pair in self.setpoints.windows(2) {
            let has_power = pair.iter().all(|s| s.enable != 0 && s.home == 0);
            for joint in (0..3).filter(|_| has_power) {
                let way = pair[1].joint_position[joint] - pair[0].joint_position[joint];
                assert!(
                    way.abs() < 0.9,
                    "tick {}: J{joint} jumps by {way}",
                    pair[1].tick
                );
            }
        }
    }
}

/// Numbers for random tests.
pub(super) fn numbers(seed: u64) -> Numbers {
    Numbers::new(seed)
}

/// Whether power is on, of a status.
pub(super) fn is_on(status: &Status) -> bool {
    status.power() == Ok(Power::On)
}
