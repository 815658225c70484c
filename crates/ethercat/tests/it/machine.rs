//! A whole machine without a thread or a clock: planner, interpolator, bridge, drives.

use crate::wire::{Fate, MemoryWire, World};
use core::cell::{Cell, RefCell};
use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use glidepath_emulator::{DriveSettings as Emulated, HomeSwitch, Segment, SyncRecord};
use glidepath_ethercat::{
    BusSettings, Counts, DriveSettings, Ends, Event, HomingSettings, Mapping, Settings,
    TerminalSettings, drive_bus,
};
use glidepath_gcode::{Connections, Options};
use glidepath_geometry::{AXES, Axis, AxisVector};
use glidepath_interpolator::{
    Config, FeedbackSettings, JointFeedback, JointHoming, MCodeWait, MCodeWaits, ProbeInput,
    Served, served,
};
use glidepath_kinematics::{AxisList, Mechanism, Trivial};
use glidepath_link::servo::{JumpLimits, ServoSettings, StopLimits};
use glidepath_link::{
    Auxiliary, Client, Command, CommandReply, CommandRequest, Feedback, FrameSink, InProcess,
    LinkError, MachineState, Publisher, Setpoint, SetpointFrame, Status, Subscriber, Transport,
};
use glidepath_planner::{Output, Pipeline, ProgramSource};
use glidepath_program::{Effort, Limits, Settings as PlanSettings, Smoothing};
use rtrb::RingBuffer;
use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::mpsc::channel;

pub(crate) const PERIOD_NS: u64 = 4_000_000;
pub(crate) const START_NS: u64 = 9_000_000_000_000;
/// A 23 bit encoder on a spindle of 5 mm.
pub(crate) const COUNTS: f64 = 8_388_608.0 / 5.0;
const HORIZON: u64 = 150;

pub(crate) fn limits() -> Limits {
    Limits::uniform(200.0, 2000.0, 40_000.0)
}

/// The drive of a joint.
pub(crate) fn drive(joint: usize) -> DriveSettings {
    DriveSettings {
        joint,
        position: joint,
        axis: 0,
        map_step: 0x10,
        vendor: 0xe1e,
        product: 0x402,
        alias: 0,
        process_at: None,
        mapping: Mapping::Written,
        counts_per_unit: COUNTS,
        is_inverted: joint == 1,
        home_offset: 0.0,
        homing: None,
        following_error: 2.0,
        following_ms: 10,
        enable_window: 0.05,
        quick_stop_a: 4000.0,
        max_v: 200.0,
    }
}

/// The same with a switch 5 mm below where it stands.
pub(crate) fn homing_drive(joint: usize) -> DriveSettings {
    DriveSettings {
        homing: Some(HomingSettings {
            method: 17,
            fast_v: 20.0,
            slow_v: 2.0,
            acceleration_a: 500.0,
            sequence: u32::from(joint != 2),
        }),
        ..drive(joint)
    }
}

pub(crate) fn servo() -> ServoSettings {
    ServoSettings {
        patience_ns: 3 * PERIOD_NS,
        stop: [StopLimits {
            acceleration: 2000.0,
            jerk: 40_000.0,
        }; AXES],
        jump: [JumpLimits::above(200.0, 2000.0); AXES],
    }
}

/// What a case is made of.
#[derive(Debug, Clone)]
pub(crate) struct Setup {
    /// From the grid of the bus to that of the interpolator, ns.
    pub(crate) phase_ns: u64,
    pub(crate) bus: BusSettings,
    pub(crate) drives: Vec<DriveSettings>,
    pub(crate) emulated: Vec<Emulated>,
    pub(crate) terminals: Vec<TerminalSettings>,
    /// The first joint is brought home by the controller.
    pub(crate) homing: Option<JointHoming>,
    pub(crate) probe: Option<ProbeInput>,
    /// M codes that are waited for.
    pub(crate) waits: Vec<MCodeWait>,
}

impl Setup {
    /// Three axes with absolute encoders.
    pub(crate) fn absolute(period_ns: u64) -> Self {
        Self {
            phase_ns: 1_300_000,
            bus: BusSettings {
                period_ns,
                shift_ns: period_ns / 2,
                delay_ns: period_ns / 2 + 2_000_000,
                watchdog_ns: (4 * period_ns).max(10_000_000),
                ..BusSettings::default()
            },
            drives: (0..3).map(drive).collect(),
            emulated: vec![Emulated::default(); 3],
            terminals: Vec::new(),
            homing: None,
            probe: None,
            waits: Vec::new(),
        }
    }

    /// Three axes that have to find their home.
    pub(crate) fn homing(period_ns: u64) -> Self {
        let home = |joint: i32| Emulated {
            start_counts: vec![1000 * (joint + 1)],
            home: Some(HomeSwitch {
                at_counts: -5 * COUNTS as i64,
            }),
            ..Emulated::default()
        };
        Self {
            drives: (0..3).map(homing_drive).collect(),
            emulated: (0..3).map(home).collect(),
            ..Self::absolute(period_ns)
        }
    }
}

fn config(setup: &Setup) -> Config {
    let (homes, bus) = (
        setup.drives.iter().any(|drive| drive.homing.is_some()),
        &setup.bus,
    );
    let joint = JointFeedback {
        min_following_error: 0.2,
        following_error: 2.0,
        max_velocity: 200.0,
        homes,
        homing: None,
    };
    let mut feedback = FeedbackSettings::new(PERIOD_NS, joint);
    feedback.joints[0].homing = setup.homing;
    Config {
        feedback: Some(FeedbackSettings {
            probe: setup.probe,
            // As the manual has it: frames that are lost are not yet feedback that is.
            stale_after: Duration::from_nanos(
                3 * PERIOD_NS + u64::from(bus.lost_frames) * bus.period_ns + bus.delay_ns,
            ),
            ..feedback
        }),
        m_code_waits: MCodeWaits::new(&setup.waits).unwrap(),
        mechanism: Mechanism::Trivial(Trivial {
            axes: AxisList::new(&[Axis::X, Axis::Y, Axis::Z]),
        }),
        ..Config::new(limits(), PERIOD_NS)
    }
}

/// A program's frames for a machine that stands at `start`.
pub(crate) fn plan(text: &str, start: AxisVector, epoch: u64) -> Vec<SetpointFrame> {
    let options = Options {
        start,
        connections: Connections::Real,
        probing_v: Some(20.0),
        ..Options::default()
    };
    let settings = PlanSettings {
        limits: limits(),
        tolerance_mm: 0.02,
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Optimal,
    };
    let source = ProgramSource::new(text.as_bytes(), options);
    let mut pipeline = Pipeline::new(source, settings, start);
    let mut frames = Vec::new();
    loop {
        match pipeline.advance().unwrap() {
            Output::Frame(frame) => {
                frames.push(SetpointFrame::from_frame(&frame, epoch, PERIOD_NS));
            }
            Output::End => return frames,
            Output::Item(_) | Output::Pending => {}
        }
    }
}

/// What setpoints go through to the bridge.
type Queue = Rc<RefCell<VecDeque<Setpoint>>>;

struct Source(Queue);

impl Subscriber<Setpoint> for Source {
    fn take(&mut self) -> Result<Option<Setpoint>, LinkError> {
        Ok(self.0.borrow_mut().pop_front())
    }
}

/// One life of an interpolator, and its ports.
struct Life<'s> {
    tick: Box<dyn FnMut(u64) -> Setpoint + 's>,
    setpoints: Box<dyn Subscriber<Setpoint>>,
    auxiliary: Box<dyn Subscriber<Auxiliary>>,
    feedback: Box<dyn Publisher<Feedback>>,
    frames: Box<dyn FrameSink>,
    client: Box<dyn Client<CommandRequest, CommandReply>>,
    statuses: Box<dyn Subscriber<Status>>,
}

impl<'s> Life<'s> {
    fn new(link: &InProcess, served: &'s mut Served<'_>) -> Self {
        Self {
            tick: Box::new(|now_ns| served.tick(now_ns)),
            setpoints: link.setpoint_source().unwrap(),
            auxiliary: link.auxiliary_source().unwrap(),
            feedback: link.feedback_sink().unwrap(),
            frames: link.frame_sink().unwrap(),
            client: link.command_client().unwrap(),
            statuses: link.status_source().unwrap(),
        }
    }
}

/// The operator and the machine's surroundings, as a case has them: called at every tick.
pub(crate) trait Case {
    /// Looks at the machine and does something, once a period, before the tick.
    fn tick(&mut self, machine: &mut Hands<'_>, segment: &mut Segment);

    /// What becomes of a frame.
    fn fate(&mut self, _now_ns: u64) -> Fate {
        Fate::Whole
    }

    /// Whether allocations of the bus thread are counted now.
    fn counts(&self) -> bool {
        false
    }
}

/// What a case can see and do.
pub(crate) struct Hands<'m> {
    pub(crate) now_ns: u64,
    pub(crate) tick: u64,
    pub(crate) last: Option<Setpoint>,
    pub(crate) status: Option<Status>,
    pub(crate) events: &'m [Event],
    /// What the bridge said of the joints last.
    pub(crate) feedback: Option<Feedback>,
    /// What the interpolator says that spindle and outputs are to be.
    pub(crate) auxiliary: Option<Auxiliary>,
    pub(crate) wants: Wants,
}

/// What a case wants of the machine.
#[derive(Debug, Default)]
pub(crate) struct Wants {
    pub(crate) command: Option<Command>,
    /// A program is to run.
    pub(crate) program: Option<&'static str>,
    /// The interpolator is killed, or started anew.
    pub(crate) interpolator: Option<bool>,
    /// The host does not let it run for so many ticks.
    pub(crate) pause: Option<u64>,
    /// The bridge is to end in good order.
    pub(crate) end: bool,
    /// Its process is killed: it does nothing any more.
    pub(crate) killed: bool,
}

impl Hands<'_> {
    pub(crate) fn state(&self) -> Option<MachineState> {
        self.last.and_then(|setpoint| setpoint.state().ok())
    }
}

struct Reality<'c, 's> {
    lives: [Option<Life<'s>>; 2],
    lives_now: bool,
    case: &'c mut dyn Case,
    queue: Queue,
    auxiliary: rtrb::Producer<Auxiliary>,
    records: rtrb::Consumer<Feedback>,
    happened: rtrb::Consumer<Event>,
    events: Rc<RefCell<Vec<Event>>>,
    stop: Rc<AtomicBool>,
    killed: Rc<Cell<bool>>,
    start_ns: u64,
    feed: VecDeque<SetpointFrame>,
    epoch: u64,
    sent: u64,
    tick: u64,
    last: Option<Setpoint>,
    status: Option<Status>,
    feedback: Option<Feedback>,
    said: Option<Auxiliary>,
    paused: u64,
    setpoints: Rc<RefCell<Vec<Setpoint>>>,
}

impl World for Reality<'_, '_> {
    fn pass(&mut self, now_ns: u64, segment: &mut Segment) -> u64 {
        self.tick += 1;
        while let Ok(event) = self.happened.pop() {
            self.events.borrow_mut().push(event);
        }
        let current = if self.lives_now {
            self.lives[0].as_mut()
        } else {
            None
        };
        let mut newest = None;
        while let Ok(feedback) = self.records.pop() {
            newest = Some(feedback);
        }
        if let (Some(life), Some(feedback)) = (current, newest) {
            life.feedback.publish(&feedback).unwrap();
        }
        self.feedback = newest.or(self.feedback);
        let events = self.events.borrow().clone();
        let mut hands = Hands {
            now_ns,
            tick: self.tick,
            last: self.last,
            status: self.status,
            events: &events,
            feedback: self.feedback,
            auxiliary: self.said,
            wants: Wants::default(),
        };
        self.case.tick(&mut hands, segment);
        let wants = hands.wants;
        self.obey(wants);
        if self.paused > 0 {
            self.paused -= 1;
        } else {
            self.interpolate(now_ns);
        }
        self.start_ns + self.tick * PERIOD_NS
    }

    fn fate(&mut self, now_ns: u64) -> Fate {
        if self.killed.get() {
            return Fate::LostOnTheWay;
        }
        self.case.fate(now_ns)
    }

    fn counts(&self) -> bool {
        // Cycles run, and not the bringing up of the bus.
        self.feedback.is_some() && self.case.counts()
    }
}

impl Reality<'_, '_> {
    fn obey(&mut self, wants: Wants) {
        if wants.end {
            self.stop.store(true, Ordering::Relaxed);
        }
        if wants.killed {
            self.killed.set(true);
            self.stop.store(true, Ordering::Relaxed);
        }
        self.paused += wants.pause.unwrap_or(0);
        match wants.interpolator {
            Some(false) => self.lives_now = false,
            Some(true) => {
                // The one before is dead; another one takes its place.
                self.lives.swap(0, 1);
                self.lives_now = true;
                self.feed.clear();
                self.last = None;
                self.epoch = 0;
            }
            None => {}
        }
        if let Some(text) = wants.program {
            let start = self
                .last
                .map_or_else(AxisVector::zeros, |s| s.position.into());
            self.epoch += 1;
            self.feed = plan(text, start, self.epoch).into();
            self.sent = 0;
        }
        if let (Some(command), Some(life)) = (wants.command, &mut self.lives[0]) {
            life.client
                .ask(&CommandRequest::new(1, 1, command))
                .unwrap();
        }
    }

    fn interpolate(&mut self, now_ns: u64) {
        let Some(life) = self.lives[0].as_mut().filter(|_| self.lives_now) else {
            return;
        };
        let executed = self
            .last
            .filter(|s| s.epoch == self.epoch)
            .map_or(0, |s| s.sequence);
        while self.sent < executed + HORIZON
            && let Some(frame) = self.feed.front()
        {
            life.frames.offer(frame).unwrap();
            self.feed.pop_front();
            self.sent += 1;
        }
        let setpoint = (life.tick)(now_ns);
        while life.client.reply().unwrap().is_some() {}
        while let Some(status) = life.statuses.take().unwrap() {
            self.status = Some(status);
        }
        while let Some(record) = life.auxiliary.take().unwrap() {
            // Who has no terminals does not listen.
            let _ = self.auxiliary.push(record);
            self.said = Some(record);
        }
        while let Some(setpoint) = life.setpoints.take().unwrap() {
            self.queue.borrow_mut().push_back(setpoint);
        }
        self.last = Some(setpoint);
        self.setpoints.borrow_mut().push(setpoint);
    }
}

/// What a case came to.
pub(crate) struct Outcome {
    pub(crate) counts: Counts,
    pub(crate) events: Vec<Event>,
    pub(crate) setpoints: Vec<Setpoint>,
    /// What each drive did at each SYNC0.
    pub(crate) records: Vec<Vec<SyncRecord>>,
    /// Allocations of the bus thread while it was counted.
    pub(crate) allocations: u64,
    /// The drives as they are at the end, and when that was.
    pub(crate) left: (Segment, u64),
}

/// Runs a machine until its case ends it.
pub(crate) fn run(setup: &Setup, case: &mut dyn Case) -> Outcome {
    let mut segment = Segment::new_at(&setup.emulated, START_NS - 3_000_000_000);
    segment.keep_records();
    run_on(setup, case, segment, START_NS)
}

/// The same with drives that have a past, which ends before `start_ns`.
pub(crate) fn run_on(
    setup: &Setup,
    case: &mut dyn Case,
    segment: Segment,
    start_ns: u64,
) -> Outcome {
    let (config, links) = (config(setup), [InProcess::default(), InProcess::default()]);
    let [first, second] = &links;
    served(&config, 11, Box::new(first.clone()), |a| {
        served(&config, 22, Box::new(second.clone()), |b| {
            let lives = [Some(Life::new(first, a)), Some(Life::new(second, b))];
            with_bridge(setup, case, (segment, start_ns), lives)
        })
    })
    .unwrap()
    .unwrap()
}

fn with_bridge(
    setup: &Setup,
    case: &mut dyn Case,
    (segment, start_ns): (Segment, u64),
    lives: [Option<Life<'_>>; 2],
) -> Outcome {
    let settings = Settings {
        bus: setup.bus,
        drives: setup.drives.clone(),
        terminals: setup.terminals.clone(),
        servo: servo(),
    };
    let queue = Queue::default();
    let (auxiliary, heard) = RingBuffer::new(1024);
    let (feedback, records) = RingBuffer::new(256);
    let (events, happened) = RingBuffer::new(256);
    let (log, _said) = channel();
    let mut ends = Ends {
        feedback,
        events,
        log,
        demands: None,
        auxiliary: (!setup.terminals.is_empty()).then_some(heard),
    };
    let stop = Rc::new(AtomicBool::new(false));
    let (told, setpoints) = (Rc::default(), Rc::default());
    let reality = Reality {
        lives,
        lives_now: true,
        case,
        queue: Rc::clone(&queue),
        auxiliary,
        records,
        happened,
        events: Rc::clone(&told),
        stop: Rc::clone(&stop),
        killed: Rc::default(),
        start_ns: start_ns + setup.phase_ns,
        feed: VecDeque::new(),
        epoch: 0,
        sent: 0,
        tick: 0,
        last: None,
        status: None,
        feedback: None,
        said: None,
        paused: 0,
        setpoints: Rc::clone(&setpoints),
    };
    let mut wire = MemoryWire::new(segment, reality, start_ns);
    let mut lives = 0;
    let boot_id = &mut || {
        lives += 1;
        lives
    };
    let counts = drive_bus(
        &mut wire,
        &settings,
        Source(queue),
        &mut ends,
        &stop,
        boot_id,
    )
    .unwrap();
    while let Ok(event) = wire.world.happened.pop() {
        told.borrow_mut().push(event);
    }
    let end_ns = glidepath_ethercat::Wire::now_ns(&wire);
    let mut segment = wire.segment;
    let records = setup
        .drives
        .iter()
        .map(|drive| segment.take_axis_records(drive.position, drive.axis.into()))
        .collect();
    Outcome {
        counts,
        events: told.take(),
        setpoints: setpoints.take(),
        records,
        allocations: wire.counted,
        left: (segment, end_ns),
    }
}
