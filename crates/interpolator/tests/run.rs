//! A whole interpolator over the in-process transport.
#![allow(
    clippy::unwrap_used,
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    clippy::cast_possible_wrap,
    clippy::float_cmp,
    clippy::panic,
    unreachable_pub,
    reason = "a test: numbers are small, bits are compared on purpose, failures are panics"
)]

mod synthetic;

use glidepath_geometry::AxisVector;
use glidepath_interpolator::{Config, RunError, run};
use glidepath_link::{
    Client, Command, CommandRefusal, CommandReply, CommandRequest, Delivery, EndOfEpoch,
    FaultCause, FrameRefusal, FrameSink, InProcess, MachineState, Setpoint, SetpointFrame, Status,
    Subscriber, Transport,
};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use synthetic::{audit, hexapod, lines, mill, records};

/// Generous: the machine may be busy with other things.
const PATIENCE: Duration = Duration::from_secs(60);
const PERIOD_NS: u64 = 1_000_000;
/// The stack of the thread that runs the interpolator: a quarter of what a thread has by default.
const STACK_BYTES: usize = 512 << 10;

fn config() -> Config {
    // The frames are made for 4 ms; the clock may run faster, which does not matter to the motion
    // as long as limits scale with it.
    let limits = glidepath_program::Limits::uniform(200.0 * 4.0, 2_000.0 * 16.0, 40_000.0 * 64.0);
    Config::new(limits, PERIOD_NS)
}

/// A trajectory for a period of 1 ms: that of 4 ms, four times as fast.
fn trajectory(seed: u64, ticks: usize, epoch: u64, start: AxisVector) -> Vec<SetpointFrame> {
    let mut frames = records(&lines(seed, 3, ticks, &mill(), 0.004), epoch, PERIOD_NS);
    for frame in &mut frames {
        for i in 0..frame.position.len() {
            frame.position[i] += start[i];
            frame.velocity[i] *= 4.0;
            frame.acceleration[i] *= 16.0;
        }
        frame.path_v *= 4.0;
    }
    frames
}

/// The other side of the ports.
struct Peer {
    frames: Box<dyn FrameSink>,
    setpoints: Box<dyn Subscriber<Setpoint>>,
    status: Box<dyn Subscriber<Status>>,
    commands: Box<dyn Client<CommandRequest, CommandReply>>,
    received: Vec<Setpoint>,
    last: Option<Status>,
    asked: u64,
}

impl Peer {
    fn new(link: &InProcess) -> Self {
        Self {
            frames: link.frame_sink().unwrap(),
            setpoints: link.setpoint_source().unwrap(),
            status: link.status_source().unwrap(),
            commands: link.command_client().unwrap(),
            received: Vec::new(),
            last: None,
            asked: 0,
        }
    }

    fn take(&mut self) {
        while let Some(setpoint) = self.setpoints.take().unwrap() {
            self.received.push(setpoint);
        }
        if let Some(status) = self.status.take().unwrap() {
            self.last = Some(status);
        }
    }

    /// Sends frames as there is room, until a condition on the status holds.
    fn until(&mut self, feed: &mut Vec<SetpointFrame>, what: &str, done: impl Fn(&Status) -> bool) {
        let started = Instant::now();
        feed.reverse();
        loop {
            while let Some(frame) = feed.last() {
                if self.frames.offer(frame).unwrap() != Delivery::Delivered {
                    break;
                }
                feed.pop();
            }
            self.take();
            if self.last.is_some_and(|status| done(&status)) {
                feed.reverse();
                return;
            }
            assert!(started.elapsed() < PATIENCE, "{what}: {:?}", self.last);
            std::thread::sleep(Duration::from_micros(300));
        }
    }

    fn command(&mut self, command: Command) -> Result<(), CommandRefusal> {
        self.asked += 1;
        let request = CommandRequest::new(1, self.asked, command);
        let reply = self.commands.call(&request, PATIENCE).unwrap().unwrap();
        reply.outcome().unwrap()
    }
}

/// Runs an interpolator while `script` talks to it.
fn with_interpolator(config: &Config, script: impl FnOnce(&mut Peer)) -> (Status, Vec<Setpoint>) {
    let link = InProcess::default();
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let transport = link.clone();
        let stop = &stop;
        let thread = std::thread::Builder::new()
            .stack_size(STACK_BYTES)
            .spawn_scoped(scope, move || {
                run(config, || Ok(Box::new(transport)), stop, &mut |_| {}).unwrap()
            })
            .unwrap();
        let mut peer = Peer::new(&link);
        // Also when the script panics: the scope waits for the thread.
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| script(&mut peer)));
        stop.store(true, Ordering::Relaxed);
        let status = thread.join().unwrap();
        peer.take();
        if let Err(panic) = result {
            std::panic::resume_unwind(panic);
        }
        (status, peer.received)
    })
}

fn is(state: MachineState) -> impl Fn(&Status) -> bool {
    move |status| status.state() == Ok(state)
}

fn has_ended(epoch: u64, how: EndOfEpoch) -> impl Fn(&Status) -> bool {
    move |status| status.epoch == epoch && status.end_of_epoch() == Ok(how)
}

#[test]
fn a_trajectory_is_published_bit_for_bit_and_nothing_is_lost() {
    let frames = trajectory(1, 600, 1, AxisVector::zeros());
    let (status, setpoints) = with_interpolator(&config(), |peer| {
        peer.until(
            &mut frames.clone(),
            "end",
            has_ended(1, EndOfEpoch::Completed),
        );
    });
    for pair in setpoints.windows(2) {
        assert_eq!(pair[1].number, pair[0].number + 1);
    }
    for frame in &frames {
        let setpoint = setpoints
            .iter()
            .find(|s| s.epoch == 1 && s.sequence == frame.sequence);
        let setpoint = setpoint.unwrap();
        assert_eq!(setpoint.position, frame.position);
        assert_eq!(setpoint.velocity, frame.velocity);
        assert_eq!(setpoint.joint_position, frame.position);
    }
    assert_eq!(status.frames_executed, frames.len() as u64);
    assert_eq!((status.fault, status.setpoints_lost), (0, 0));
    assert_eq!(status.position, frames.last().unwrap().position);
    assert!(status.work.p50_ns > 0 && status.ticks > 600);
}

#[test]
fn hold_resume_override_and_abort_by_command() {
    let frames = trajectory(2, 3_000, 1, AxisVector::zeros());
    let config = config();
    let (status, setpoints) = with_interpolator(&config, |peer| {
        let mut feed = frames.clone();
        peer.until(&mut Vec::new(), "idle", is(MachineState::Idle));
        // What it is to bring about is so already.
        assert_eq!(peer.command(Command::Hold), Ok(()));
        assert_eq!(peer.command(Command::Step), Err(CommandRefusal::WrongState));
        assert_eq!(peer.command(Command::Ping), Ok(()));
        peer.until(&mut feed, "motion", |s| s.frames_executed > 100);
        assert_eq!(peer.command(Command::Hold), Ok(()));
        peer.until(&mut feed, "held", is(MachineState::Held));
        assert_eq!(peer.command(Command::FeedOverride(0.5)), Ok(()));
        assert_eq!(peer.command(Command::Resume), Ok(()));
        peer.until(&mut feed, "half", |s| {
            (s.effective_override - 0.5).abs() < 1e-9
        });
        assert_eq!(peer.command(Command::Abort), Ok(()));
        peer.until(&mut feed, "aborted", has_ended(1, EndOfEpoch::Aborted));
        // From here with a new epoch; what is left of the first one is refused and harmless.
        let here = AxisVector::from(peer.last.unwrap().position);
        let mut again = trajectory(3, 300, 2, here);
        peer.until(&mut again, "second", has_ended(2, EndOfEpoch::Completed));
    });
    assert_eq!(status.commands_refused, 1);
    assert_eq!(status.feed_override, 0.5);
    let positions: Vec<_> = setpoints
        .iter()
        .map(|s| AxisVector::from(s.position))
        .collect();
    let ratios = audit(&positions, &config.limits, config.period_t());
    assert!(ratios.iter().all(|r| *r <= 1.0 + 1e-6), "{ratios:?}");
}

#[test]
fn a_bad_frame_stops_the_motion_with_the_cause_until_reset() {
    let frames = trajectory(4, 900, 1, AxisVector::zeros());
    let config = config();
    let (_, setpoints) = with_interpolator(&config, |peer| {
        let mut feed = frames.clone();
        feed[400].position[1] += 0.5;
        peer.until(&mut feed, "faulted", is(MachineState::Faulted));
        let status = peer.last.unwrap();
        let FaultCause::Frame(refusal) = status.fault().unwrap().unwrap() else {
            panic!("{status:?}")
        };
        assert!(matches!(
            refusal,
            FrameRefusal::Velocity | FrameRefusal::Acceleration | FrameRefusal::Jerk
        ));
        assert_eq!(status.fault_axis(), Some(glidepath_geometry::Axis::Y));
        assert_eq!(
            (status.fault_sequence, status.fault_line),
            (400, frames[400].line)
        );
        assert!(
            status.last_error.as_str().contains("axis Y"),
            "{}",
            status.last_error.as_str()
        );
        assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Faulted));
        assert_eq!(peer.command(Command::Reset), Ok(()));
        peer.until(&mut Vec::new(), "idle", is(MachineState::Idle));
    });
    let last = setpoints
        .iter()
        .filter(|s| s.epoch == 1)
        .map(|s| s.sequence)
        .max();
    assert!(last.unwrap() < 400);
    let positions: Vec<_> = setpoints
        .iter()
        .map(|s| AxisVector::from(s.position))
        .collect();
    let ratios = audit(&positions, &config.limits, config.period_t());
    assert!(ratios.iter().all(|r| *r <= 1.0 + 1e-6), "{ratios:?}");
}

#[test]
fn strict_mode_refuses_to_run_without_what_it_asks_for() {
    let mut config = config();
    config.real_time.mode = glidepath_realtime::Mode::Strict;
    config.real_time.request.priority = Some(1_000);
    let stop = AtomicBool::new(true);
    let link = InProcess::default();
    let error = run(&config, || Ok(Box::new(link)), &stop, &mut |_| {}).unwrap_err();
    assert!(
        matches!(&error, RunError::NotRealTime(why) if why.refusals.len() == 1),
        "{error}"
    );
}

#[test]
fn the_end_comes_at_rest_on_the_path() {
    let frames = trajectory(5, 3_000, 1, AxisVector::zeros());
    let config = config();
    let (status, setpoints) = with_interpolator(&config, |peer| {
        peer.until(&mut frames.clone(), "motion", |s| s.frames_executed > 200);
    });
    assert_eq!(status.state(), Ok(MachineState::Idle));
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
    let positions: Vec<_> = setpoints
        .iter()
        .map(|s| AxisVector::from(s.position))
        .collect();
    let ratios = audit(&positions, &config.limits, config.period_t());
    assert!(ratios.iter().all(|r| *r <= 1.0 + 1e-6), "{ratios:?}");
    assert_eq!(setpoints.last().unwrap().velocity, [0.0; 9]);
}

/// In a process of its own: the sentinel ends the process at the first system call.
#[test]
fn the_real_time_thread_makes_no_system_call() {
    const ROLE: &str = "GLIDEPATH_SILENCE";
    if std::env::var_os(ROLE).is_none() {
        let output = std::process::Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                "the_real_time_thread_makes_no_system_call",
                "--nocapture",
            ])
            .env(ROLE, "1")
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(42), "{output:?}");
        return;
    }
    let frames = trajectory(6, 4_000, 1, AxisVector::zeros());
    let config = Config {
        forbid_system_calls: true,
        mechanism: hexapod(),
        ..config()
    };
    let link = InProcess::default();
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let (transport, config, stop) = (link.clone(), &config, &stop);
        scope.spawn(move || run(config, || Ok(Box::new(transport)), stop, &mut |_| {}));
        let mut peer = Peer::new(&link);
        let mut feed = frames.clone();
        let mut rest = feed.split_off(1_200);
        peer.until(&mut feed, "motion", |s| s.frames_executed > 100);
        peer.command(Command::Hold).unwrap();
        peer.until(&mut feed, "held", is(MachineState::Held));
        peer.command(Command::FeedOverride(0.6)).unwrap();
        peer.command(Command::Resume).unwrap();
        peer.until(&mut feed, "slow motion", |s| {
            (s.effective_override - 0.6).abs() < 1e-9
        });
        peer.command(Command::FeedOverride(1.0)).unwrap();
        peer.until(&mut feed, "starved", is(MachineState::Starved));
        peer.until(&mut rest, "motion again", |s| s.frames_executed > 1_500);
        peer.command(Command::StopAtEndOfBlock).unwrap();
        peer.until(&mut rest, "block end", is(MachineState::ProgramStop));
        peer.command(Command::SingleBlock(true)).unwrap();
        peer.command(Command::Step).unwrap();
        peer.until(&mut rest, "step", is(MachineState::Running));
        peer.until(&mut rest, "next end", is(MachineState::ProgramStop));
        peer.command(Command::SingleBlock(false)).unwrap();
        peer.command(Command::Resume).unwrap();
        rest[0].position[0] += 1.0;
        peer.until(&mut rest, "faulted", is(MachineState::Faulted));
        peer.command(Command::Reset).unwrap();
        peer.until(&mut Vec::new(), "idle", is(MachineState::Idle));
        let here = AxisVector::from(peer.last.unwrap().position);
        let mut again = trajectory(7, 900, 2, here);
        peer.until(&mut again, "second epoch", |s| {
            s.epoch == 2 && s.frames_executed > 100
        });
        peer.command(Command::Abort).unwrap();
        peer.until(&mut again, "aborted", has_ended(2, EndOfEpoch::Aborted));
        assert!(peer.last.unwrap().ticks > 1_000);
        // The guarded thread sleeps on, so `run` would not return.
        std::process::exit(42);
    });
}

#[test]
fn a_ports_thread_that_panics_ends_the_interpolator() {
    let link = InProcess::default();
    let mut frames = link.frame_sink().unwrap();
    let thread = std::thread::spawn(move || {
        // The log is called by the ports thread, in its turn.
        let mut log = |line: &str| panic!("meant to fail: {line}");
        run(
            &config(),
            || Ok(Box::new(link)),
            &AtomicBool::new(false),
            &mut log,
        )
    });
    let first = trajectory(3, 300, 1, AxisVector::zeros())[0];
    let started = Instant::now();
    while !thread.is_finished() {
        let _taken = frames.offer(&first);
        assert!(started.elapsed() < PATIENCE, "it lives on for nothing");
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(thread.join().is_err());
}
