//! The interpolator's part: setpoints, status, answers to commands, and an ear for feedback.

use crate::build::Place;
use bytemuck::Zeroable as _;
use glidepath_link::{
    Command, CommandRefusal, CommandReply, CommandRequest, EventRecord, Feedback, Ipc, JogDemand,
    LinkConfig, LongText, MachineState, Record as _, RequestKind, SegmentRefusal, SegmentReply,
    SegmentRequest, Setpoint, Status, Text, Transport as _, remove_leftovers,
};
use glidepath_program::Event;
use glidepath_realtime::{Clock as _, Monotonic};
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tempfile::TempDir;

const BOOT: u64 = 0x1122_3344_5566_7788;
/// How long the machine may take to listen once: a host may be busy.
const PATIENCE: Duration = Duration::from_secs(30);

fn now_ns() -> u64 {
    Monotonic.now_ns()
}

/// One in which no two fields are the same. The joint goes to and fro within 20 mm, 1 Hz.
#[allow(clippy::cast_precision_loss, reason = "small numbers")]
pub(crate) fn setpoint(number: u64) -> Setpoint {
    let mut setpoint = Setpoint {
        boot_id: BOOT,
        reference: 3,
        number,
        tick: number + 1000,
        scheduled_ns: 5_000_000_000 + number * 4_000_000,
        apply_ns: 5_004_000_000 + number * 4_000_000,
        lateness_ns: 17 * number,
        missed_ticks: 2,
        epoch: 4,
        sequence: 7 * number,
        fraction: 0.25,
        line: 42,
        flags: 1,
        marks: 1,
        state: MachineState::Running.code(),
        event_count: 0,
        block: 5,
        enable: 7,
        home: 0,
        path_s: 0.1 * number as f64,
        feed_v: 33.25,
        effective_override: 1.25,
        ..Setpoint::zeroed()
    };
    let omega = std::f64::consts::TAU;
    let (sin, cos) = (omega * 0.004 * number as f64).sin_cos();
    for (joint, at) in (0_u8..9).map(|joint| (usize::from(joint), f64::from(joint))) {
        setpoint.position[joint] = 10.0 * at + 0.5;
        setpoint.velocity[joint] = -3.0 * at;
        setpoint.acceleration[joint] = 7.0 / (at + 3.0);
        setpoint.joint_position[joint] = 20.0 * sin * (1.0 + 0.01 * at);
        setpoint.joint_velocity[joint] = 20.0 * omega * cos * (1.0 + 0.01 * at);
        setpoint.joint_acceleration[joint] = -20.0 * omega * omega * sin * (1.0 + 0.01 * at);
        setpoint.away[joint] = 0.001 * at;
    }
    for (output, offset_ns) in (0..).zip([0, 1_000_001, 4_000_000]) {
        let event = Event::AnalogOutput {
            number: output,
            value: number as f64,
        };
        assert!(setpoint.tell(EventRecord::new(event, offset_ns)));
    }
    setpoint
}

/// One of a motion that begins at rest: the joints go to and fro within 20 mm, 1 Hz.
#[allow(clippy::cast_precision_loss, reason = "small numbers")]
pub(crate) fn from_rest(number: u64) -> Setpoint {
    let omega = std::f64::consts::TAU;
    let (sin, cos) = (omega * 0.004 * number as f64).sin_cos();
    let mut setpoint = setpoint(number);
    setpoint.joint_position = [20.0 * (1.0 - cos); 9];
    setpoint.joint_velocity = [20.0 * omega * sin; 9];
    // The first is at rest, as a motion is before it begins.
    let begun = f64::from(u8::from(number > 0));
    setpoint.joint_acceleration = [20.0 * omega * omega * cos * begun; 9];
    setpoint
}

enum Order {
    Publish(Setpoint),
}

#[derive(Debug, Default)]
struct Heard {
    /// How often all ports were emptied.
    rounds: u64,
    received: u64,
    last: Option<Feedback>,
    jogs: Vec<JogDemand>,
    stream: Stream,
}

/// Where segments begin.
pub(crate) const STANDS: [f64; 9] = [1.5, -2.0, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// How far the axes of the machine go.
pub(crate) const FARTHEST: f64 = 1000.0;

/// A listening planner that plans nothing: it has no room for the third piece of a stream at first.
#[derive(Debug, Default)]
struct Stream {
    accepted: Vec<SegmentRequest>,
    had_no_room: bool,
}

impl Stream {
    fn answer(&mut self, request: &SegmentRequest) -> SegmentReply {
        if request.kind == RequestKind::Open.code() {
            *self = Self::default();
        }
        let (refusal, message) = if request.number != self.accepted.len() as u64 {
            (Some(SegmentRefusal::OutOfOrder), "another number")
        } else if request.number == 2 && !self.had_no_room {
            self.had_no_room = true;
            (Some(SegmentRefusal::NoCredit), "no room")
        } else if request.end.iter().any(|place| place.abs() > FARTHEST) {
            (Some(SegmentRefusal::SoftLimit), "beyond the soft limit")
        } else {
            self.accepted.push(*request);
            (None, "")
        };
        let moved = self.accepted.iter().rev().find(|piece| piece.mode != 0);
        SegmentReply {
            session: request.session,
            number: request.number,
            accepted: self.accepted.len() as u64,
            credit: 1,
            refusal: refusal.map_or(0, SegmentRefusal::code),
            position: moved.map_or(STANDS, |piece| piece.end),
            message: LongText::new(message),
        }
    }
}

/// An instance of its own, with somebody who plays the interpolator.
#[derive(Debug)]
pub(crate) struct Machine {
    root: TempDir,
    config: LinkConfig,
    orders: Option<Sender<Order>>,
    heard: Arc<Mutex<Heard>>,
    thread: Option<JoinHandle<()>>,
}

impl std::fmt::Debug for Order {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("an order")
    }
}

impl Machine {
    pub(crate) fn start() -> Self {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let root = tempfile::Builder::new()
            .prefix("glidepath-capi")
            .tempdir_in("/dev/shm")
            .unwrap();
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let mut config = LinkConfig::new(&format!("capi-{}-{number}", std::process::id()));
        // Where processes look that have this directory as their runtime directory.
        config.root = root.path().join("glidepath");
        let (orders, given) = channel();
        let heard = Arc::new(Mutex::new(Heard::default()));
        let (ready, is_ready) = channel();
        let thread = {
            let (config, heard) = (config.clone(), Arc::clone(&heard));
            std::thread::spawn(move || play(&config, &given, &heard, &ready))
        };
        is_ready.recv().unwrap();
        Self {
            root,
            config,
            orders: Some(orders),
            heard,
            thread: Some(thread),
        }
    }

    /// Where its consumers work.
    pub(crate) fn place(&self) -> Place<'_> {
        Place {
            directory: self.root.path(),
            instance: &self.config.instance,
        }
    }

    fn give(&self, setpoint: Setpoint) {
        let orders = self.orders.as_ref().unwrap();
        orders.send(Order::Publish(setpoint)).unwrap();
    }

    /// Publishes setpoints as fast as it goes.
    pub(crate) fn publish(&self, numbers: Range<u64>, make: impl Fn(u64) -> Setpoint) {
        for number in numbers {
            self.give(make(number));
        }
    }

    /// Publishes setpoints of [`from_rest`] when they are due.
    pub(crate) fn publish_in_time(&self, count: u64, period: Duration) {
        let (start, period_ns) = (Instant::now(), u64::try_from(period.as_nanos()).unwrap());
        let start_ns = now_ns();
        for number in 0..count {
            let due = start + period * u32::try_from(number).unwrap();
            std::thread::sleep(due.saturating_duration_since(Instant::now()));
            let scheduled_ns = start_ns + number * period_ns;
            self.give(Setpoint {
                scheduled_ns,
                apply_ns: scheduled_ns + period_ns,
                ..from_rest(number)
            });
        }
    }

    /// Publishes setpoints until what this gives is dropped.
    pub(crate) fn keep_publishing(&self) -> Ticking {
        let over = Arc::new(AtomicBool::new(false));
        let (is_over, orders) = (Arc::clone(&over), self.orders.clone().unwrap());
        let thread = std::thread::spawn(move || {
            for number in 0.. {
                if is_over.load(Ordering::Relaxed) {
                    return;
                }
                let now_ns = now_ns();
                let mut standing = setpoint(number);
                (standing.scheduled_ns, standing.apply_ns) = (now_ns, now_ns + 4_000_000);
                standing.joint_position = setpoint(10).joint_position;
                standing.joint_velocity = [0.0; 9];
                standing.joint_acceleration = [0.0; 9];
                orders.send(Order::Publish(standing)).unwrap();
                std::thread::sleep(Duration::from_millis(4));
            }
        });
        Ticking {
            over,
            thread: Some(thread),
        }
    }

    /// A subscriber in Rust, which is there when this returns.
    pub(crate) fn follow(&self, count: u64) -> JoinHandle<Vec<u8>> {
        let config = self.config.clone();
        let (ready, is_ready) = channel();
        let thread = std::thread::spawn(move || {
            let link = Ipc::connect(&config).unwrap();
            let mut source = link.setpoint_source().unwrap();
            ready.send(()).unwrap();
            let (mut bytes, mut received) = (Vec::new(), 0);
            while received < count {
                let Some(setpoint) = source.take().unwrap() else {
                    std::thread::sleep(Duration::from_millis(1));
                    continue;
                };
                setpoint.check().unwrap();
                received += 1;
                bytes.extend_from_slice(bytemuck::bytes_of(&setpoint));
            }
            bytes
        });
        is_ready.recv().unwrap();
        thread
    }

    /// What was sent until now, and has arrived: every port was emptied since.
    fn heard(&self) -> MutexGuard<'_, Heard> {
        let begun = Instant::now();
        let rounds = self.heard.lock().unwrap().rounds;
        loop {
            let heard = self.heard.lock().unwrap();
            // The round under way may have passed a port before.
            if heard.rounds > rounds + 1 {
                return heard;
            }
            drop(heard);
            assert!(begun.elapsed() < PATIENCE, "the machine's thread stands");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// The jogs that arrived.
    pub(crate) fn jogs(&self) -> Vec<JogDemand> {
        self.heard().jogs.clone()
    }

    /// The pieces of the last stream that were accepted.
    pub(crate) fn segments(&self) -> Vec<SegmentRequest> {
        self.heard().stream.accepted.clone()
    }

    /// How much feedback was received, and the last of it.
    pub(crate) fn feedback(&self) -> (u64, Feedback) {
        let heard = self.heard();
        (heard.received, heard.last.unwrap())
    }
}

impl Drop for Machine {
    fn drop(&mut self) {
        drop(self.orders.take());
        let played = self.thread.take().unwrap().join();
        if !std::thread::panicking() {
            played.unwrap();
            // Nothing of an instance is left behind by those who took part in it.
            assert!(matches!(remove_leftovers(&self.config), Ok(true)));
        }
    }
}

/// Publishes until it is dropped.
#[derive(Debug)]
pub(crate) struct Ticking {
    over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Drop for Ticking {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// Owns the ports until no more orders can come.
fn play(config: &LinkConfig, orders: &Receiver<Order>, heard: &Mutex<Heard>, ready: &Sender<()>) {
    let link = Ipc::connect(config).unwrap();
    let mut setpoints = link.setpoint_sink().unwrap();
    let mut status = link.status_sink().unwrap();
    let mut commands = link.command_server().unwrap();
    let mut feedback = link.feedback_source().unwrap();
    let mut jogs = link.jog_source().unwrap();
    let mut segments = link.segment_server().unwrap();
    ready.send(()).unwrap();
    let mut shown = 0;
    loop {
        match orders.recv_timeout(Duration::from_micros(500)) {
            Ok(Order::Publish(setpoint)) => setpoints.publish(&setpoint).unwrap(),
            Err(std::sync::mpsc::RecvTimeoutError::Timeout) => setpoints.refresh().unwrap(),
            Err(std::sync::mpsc::RecvTimeoutError::Disconnected) => return,
        }
        shown += 1;
        status.publish(&status_now(shown)).unwrap();
        while commands.serve(&mut answer).unwrap() {}
        while let Some(jog) = jogs.take().unwrap() {
            jog.check().unwrap();
            heard.lock().unwrap().jogs.push(jog);
        }
        while segments
            .serve(&mut |request| heard.lock().unwrap().stream.answer(request))
            .unwrap()
        {}
        while let Some(record) = feedback.take().unwrap() {
            record.check().unwrap();
            let mut heard = heard.lock().unwrap();
            // This process may not run for long enough to lose some; none comes twice or too late.
            let follows =
                |last: Feedback| last.boot_id == record.boot_id && last.number < record.number;
            assert!(heard.last.is_none_or(follows), "{record:?}");
            heard.received += 1;
            heard.last = Some(record);
        }
        heard.lock().unwrap().rounds += 1;
    }
}

fn status_now(shown: u64) -> Status {
    Status {
        boot_id: BOOT,
        updated_ns: now_ns(),
        period_ns: 4_000_000,
        tick: shown,
        state: MachineState::Held.code(),
        pid: std::process::id(),
        feed_override: 1.5,
        last_event: Text::new("held by the operator"),
        message: Text::new("turn the part over"),
        ..Status::zeroed()
    }
}

/// Accepts everything but to resume.
fn answer(request: &CommandRequest) -> CommandReply {
    let (outcome, message) = match request.command() {
        Ok(Command::Resume) => (Err(CommandRefusal::WrongState), "it is not held"),
        Ok(Command::SetPosition {
            joint: 2,
            position: -12.5,
        }) => (Ok(()), "J2"),
        Ok(Command::SetPosition { .. }) => (Err(CommandRefusal::Malformed), "another joint"),
        Ok(Command::Acknowledge { event, done }) => {
            let is_it = (event.boot_id, event.epoch, event.sequence, done) == (7, 8, 9, true);
            if is_it {
                (Ok(()), "that event")
            } else {
                (Err(CommandRefusal::Malformed), "another event")
            }
        }
        Ok(_) => (Ok(()), ""),
        Err(_) => (Err(CommandRefusal::Malformed), "malformed"),
    };
    CommandReply::new(BOOT, request.number, outcome, MachineState::Held, message)
}
