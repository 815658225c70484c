//! A machine made of threads: the libraries of the processes, over the transport of the processes.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glidepath_audit::{Audit, AuditReport, AuditSettings, Sample};
use glidepath_gcode::Options;
use glidepath_geometry::AxisVector;
use glidepath_interpolator::Config;
use glidepath_link::{
    Command, CommandRequest, Ipc, LinkConfig, MachineState, Setpoint, Status, Subscriber, Transport,
};
use glidepath_planner::{
    Control, FramePublisher, ItemSource, Pace, Pipeline, ProgramSource, RunError, Statistics,
};
use glidepath_program::{Effort, Frame, Item, Limits, Settings, Smoothing};

const PERIOD_NS: u64 = 4_000_000;
const POLL: Duration = Duration::from_millis(1);

/// The machine of the built-in configuration.
#[must_use]
pub fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Sextic,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::default(),
    }
}

/// A source for a text.
#[must_use]
pub fn program(text: &str) -> ProgramSource<&[u8]> {
    program_from(text, AxisVector::zeros())
}

/// A source for a text and a machine at rest at `start`.
#[must_use]
pub fn program_from(text: &str, start: AxisVector) -> ProgramSource<&[u8]> {
    ProgramSource::new(
        text.as_bytes(),
        Options {
            start,
            ..Options::default()
        },
    )
}

/// The frames and the items of a text, for a machine at rest at `start`.
#[must_use]
pub fn plan(text: &str, start: AxisVector) -> (Vec<Frame>, Vec<Item>) {
    let mut pipeline = Pipeline::new(program_from(text, start), settings(), start);
    let (mut frames, mut items) = (Vec::new(), Vec::new());
    loop {
        match pipeline.advance().unwrap() {
            glidepath_planner::Output::Frame(frame) => frames.push(frame),
            glidepath_planner::Output::Item(item) => items.push(item),
            glidepath_planner::Output::Pending => {}
            glidepath_planner::Output::End => return (frames, items),
        }
    }
}

/// What the servo would have seen.
#[derive(Debug, Default)]
pub struct Recording {
    /// Every setpoint, from the first tick.
    pub setpoints: Vec<Setpoint>,
}

impl Recording {
    /// The setpoints of an epoch.
    pub fn epoch(&self, epoch: u64) -> impl Iterator<Item = &Setpoint> {
        self.setpoints
            .iter()
            .filter(move |setpoint| setpoint.epoch == epoch)
    }

    /// Whether every setpoint arrived.
    #[must_use]
    pub fn is_gapless(&self) -> bool {
        self.setpoints
            .windows(2)
            .all(|pair| pair[1].number == pair[0].number + 1)
    }

    /// What the auditor says about an epoch. Missed ticks are no gaps: the path goes on where it
    /// was.
    #[must_use]
    pub fn audit(&self, epoch: u64, items: &[Item]) -> AuditReport {
        let place = |setpoint: &Setpoint| AxisVector::from(setpoint.position);
        audit(items, self.epoch(epoch).map(place))
    }
}

/// What the auditor says about a motion.
pub fn audit(items: &[Item], positions: impl Iterator<Item = AxisVector>) -> AuditReport {
    let settings = settings();
    let mut audit = Audit::new(&AuditSettings::from(&settings));
    for item in items {
        audit.program(item);
    }
    for (tick, position) in (0..).zip(positions) {
        audit.sample(&Sample {
            tick,
            line: 0,
            position,
            reported: None,
            is_between_frames: false,
        });
    }
    audit.finish()
}

/// An interpolator and a recorder at work.
#[derive(Debug)]
pub struct Machine<'a> {
    link: &'a LinkConfig,
    stop: &'a AtomicBool,
}

impl Machine<'_> {
    /// Runs `test` while an interpolator and a recorder work; returns what was recorded.
    pub fn run(
        link: &LinkConfig,
        adjust: impl FnOnce(&mut Config),
        test: impl FnOnce(&Machine<'_>),
    ) -> Recording {
        let mut config = Config::new(settings().limits, PERIOD_NS);
        adjust(&mut config);
        let (stop, stop_recorder) = (AtomicBool::new(false), AtomicBool::new(false));
        let connect = || Ipc::connect(link).map(|ipc| Box::new(ipc) as Box<dyn Transport>);
        std::thread::scope(|scope| {
            let recorder = scope.spawn(|| record(link, &stop_recorder));
            let interpolator = scope.spawn(|| {
                let log = &mut |line: &str| eprintln!("interpolator: {line}");
                glidepath_interpolator::run(&config, connect, &stop, log).unwrap()
            });
            let end = StopOnDrop(&stop);
            let end_recorder = StopOnDrop(&stop_recorder);
            test(&Machine { link, stop: &stop });
            drop(end);
            interpolator.join().unwrap();
            drop(end_recorder);
            recorder.join().unwrap()
        })
    }

    /// Runs a planner over a source made for the machine's position, as `glidepath planner` does.
    /// `world` is called every few milliseconds.
    ///
    /// # Errors
    /// The planner's.
    pub fn publish<S: ItemSource + Send>(
        &self,
        stop: &AtomicBool,
        make_source: impl FnOnce(AxisVector) -> S,
        mut world: impl FnMut(),
    ) -> Result<Statistics, RunError> {
        let transport = Ipc::connect(self.link)?;
        let mut pause = |time| {
            std::thread::sleep(time);
            world();
        };
        let mut control = Control {
            stop,
            pause: &mut pause,
            notify: &mut |_| {},
        };
        let mut publisher = FramePublisher::connect(&transport, Pace::new(PERIOD_NS, 0.5))?;
        let start = publisher.wait_until_ready(("part", 0), &mut control)?;
        let mut pipeline = Pipeline::new(make_source(start), settings(), start);
        publisher.publish(&mut pipeline, &mut control)
    }

    /// Sends a command and waits until it is accepted.
    pub fn command(&self, command: Command) {
        let transport = Ipc::connect(self.link).unwrap();
        let mut client = transport.command_client().unwrap();
        let request = CommandRequest::new(1, 1, command);
        let reply = client
            .call(&request, Duration::from_secs(10))
            .unwrap()
            .unwrap();
        assert_eq!(
            reply.outcome(),
            Ok(Ok(())),
            "{command:?}: {}",
            reply.message.as_str()
        );
    }

    /// A look at the status for this thread.
    #[must_use]
    pub fn watch(&self) -> Watch {
        let transport = Ipc::connect(self.link).unwrap();
        Watch {
            source: transport.status_source().unwrap(),
            latest: None,
        }
    }

    /// Waits for a status that pleases.
    #[must_use]
    pub fn wait_for(&self, what: &str, wanted: impl Fn(&Status) -> bool) -> Status {
        let mut watch = self.watch();
        loop {
            if let Some(status) = watch.look().filter(&wanted) {
                return status;
            }
            assert!(
                !self.stop.load(Ordering::Relaxed),
                "ended while waiting for {what}"
            );
            std::thread::sleep(POLL);
        }
    }

    /// Waits for a state.
    #[must_use]
    pub fn wait_for_state(&self, state: MachineState) -> Status {
        self.wait_for("a state", |status| status.state == state.code())
    }
}

/// The status as it comes.
pub struct Watch {
    source: Box<dyn Subscriber<Status>>,
    latest: Option<Status>,
}

impl std::fmt::Debug for Watch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch")
            .field("latest", &self.latest)
            .finish_non_exhaustive()
    }
}

impl Watch {
    /// The newest status, if there was any.
    pub fn look(&mut self) -> Option<Status> {
        if let Some(status) = self.source.take().unwrap() {
            self.latest = Some(status);
        }
        self.latest
    }
}

struct StopOnDrop<'a>(&'a AtomicBool);

impl Drop for StopOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

fn record(link: &LinkConfig, stop: &AtomicBool) -> Recording {
    let transport = Ipc::connect(link).unwrap();
    let mut source = transport.setpoint_source().unwrap();
    let mut recording = Recording::default();
    loop {
        // Asked first, so that nothing published before the stop is missed.
        let ending = stop.load(Ordering::Relaxed);
        while let Some(setpoint) = source.take().unwrap() {
            recording.setpoints.push(setpoint);
        }
        if ending {
            return recording;
        }
        std::thread::sleep(POLL);
    }
}
