//! A machine of processes that outlives most of what is done to it, and a record of what it does.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use glidepath_link::{
    Command, CommandRequest, Ipc, LinkConfig, MachineState, Setpoint, Status, Transport,
};
use glidepath_tests::{Instance, Process};
use rustix::process::Signal;

/// Longer than anything here ever takes.
const PATIENCE: Duration = Duration::from_secs(60);
/// The interpolator cleans up after the dead several times a second.
const CLEAN_UP_PATIENCE: Duration = Duration::from_secs(60);
/// Longer than a process takes to join.
const SETTLED: Duration = Duration::from_millis(1500);
const PERIOD: Duration = Duration::from_millis(4);
const POLL: Duration = Duration::from_millis(1);
/// The M code that it waits for, and how long.
const RULE: &str = "[m_codes.M101]\ntimeout_s = 0.3\n";

/// What a check found wrong.
pub(super) type Checked<T> = Result<T, String>;

/// Everything a subscriber got.
#[derive(Debug, Default)]
pub(super) struct Heard {
    pub(super) setpoints: Vec<Setpoint>,
    pub(super) status: Option<Status>,
    /// The longest time between two looks for setpoints.
    pub(super) longest_pause: Duration,
}

impl Heard {
    pub(super) fn latest(&self) -> Option<&Setpoint> {
        self.setpoints.last()
    }

    pub(super) fn is(&self, state: MachineState) -> bool {
        self.status
            .is_some_and(|status| status.state == state.code())
    }

    pub(super) fn is_any_of(&self, states: &[MachineState]) -> bool {
        states.iter().any(|state| self.is(*state))
    }
}

/// Interpolator and servo as processes, and a second subscriber.
pub(super) struct Bench<'a> {
    pub(super) instance: &'a Instance,
    pub(super) transport: Ipc,
    interpolator: Option<Process>,
    servo: Option<Process>,
    heard: Arc<Mutex<Heard>>,
    ending: Arc<AtomicBool>,
    recorder: Option<JoinHandle<()>>,
    commands: u64,
    config: String,
    /// What lies in shared memory when everybody is there and nothing has happened.
    files: Vec<String>,
}

impl<'a> Bench<'a> {
    pub(super) fn start(instance: &'a Instance) -> Self {
        let (heard, ending) = (Arc::default(), Arc::new(AtomicBool::new(false)));
        let recorder = {
            let (link, heard, ending) = (
                instance.config().clone(),
                Arc::clone(&heard),
                Arc::clone(&ending),
            );
            std::thread::spawn(move || record(&link, &heard, &ending))
        };
        let mut bench = Self {
            instance,
            transport: instance.connect(),
            interpolator: None,
            servo: None,
            heard,
            ending,
            recorder: Some(recorder),
            commands: 0,
            config: configured(instance),
            files: Vec::new(),
        };
        bench.start_interpolator();
        let idle = bench.until("the interpolator", |heard| heard.is(MachineState::Idle));
        assert_eq!(idle, Ok(()));
        let without_servo = settled(instance, 0);
        bench.start_servo();
        bench.files = settled(instance, without_servo.len());
        bench
    }

    pub(super) fn start_interpolator(&mut self) {
        let arguments = ["interpolator", "--best-effort", "--config", &self.config];
        self.interpolator = Some(Process::join(self.instance, &arguments));
    }

    pub(super) fn start_servo(&mut self) {
        self.servo = Some(Process::join(self.instance, &["servo", "--json"]));
    }

    pub(super) fn kill_interpolator(&mut self) {
        kill(&mut self.interpolator);
    }

    pub(super) fn kill_servo(&mut self) {
        kill(&mut self.servo);
    }

    /// Ends the servo, and returns its report.
    pub(super) fn end_servo(&mut self) -> Checked<serde_json::Value> {
        let servo = self.servo.take().ok_or("no servo")?;
        Ok(servo.end().expect(0).json())
    }

    pub(super) fn planner(&self, arguments: &[&str]) -> Process {
        let arguments = [&["planner"], arguments, &["--config", &self.config]].concat();
        Process::join(self.instance, &arguments)
    }

    /// Forgets the setpoints heard so far.
    pub(super) fn forget(&self) {
        let mut heard = self.heard.lock().unwrap();
        heard.setpoints.clear();
        heard.longest_pause = Duration::ZERO;
    }

    /// Whether this process was not let run for longer than a subscriber's queue lasts.
    pub(super) fn was_deaf(&self) -> bool {
        let setpoints = u32::try_from(self.instance.config().capacity.setpoints).unwrap();
        self.look(|heard| heard.longest_pause >= setpoints * PERIOD)
    }

    /// Looks at what was heard.
    pub(super) fn look<T>(&self, look: impl FnOnce(&Heard) -> T) -> T {
        look(&self.heard.lock().unwrap())
    }

    /// Waits until what was heard pleases.
    pub(super) fn until(&self, what: &str, pleases: impl Fn(&Heard) -> bool) -> Checked<()> {
        let begun = Instant::now();
        while !self.look(&pleases) {
            if begun.elapsed() > PATIENCE {
                let state = self.look(|heard| heard.status.map(|status| status.state()));
                return Err(format!("waited in vain for {what}; state {state:?}"));
            }
            std::thread::sleep(POLL);
        }
        Ok(())
    }

    /// Forgets the status, so that the next one is new.
    pub(super) fn expect_news(&self) {
        self.heard.lock().unwrap().status = None;
    }

    /// Waits for a state that a status sent after this call tells.
    pub(super) fn until_state(&self, state: MachineState) -> Checked<()> {
        self.expect_news();
        self.until(&format!("{state:?}"), |heard| heard.is(state))
    }

    /// Sends a command, which must be accepted.
    pub(super) fn command(&mut self, command: Command) -> Checked<()> {
        self.commands += 1;
        let request = CommandRequest::new(1, self.commands, command);
        let reply = self
            .transport
            .command_client()
            .and_then(|mut client| client.call(&request, PATIENCE))
            .map_err(|error| format!("{command:?}: {error}"))?
            .ok_or_else(|| format!("{command:?}: no answer"))?;
        match reply.outcome() {
            Ok(Ok(())) => Ok(()),
            refused => Err(format!(
                "{command:?}: {refused:?} {}",
                reply.message.as_str()
            )),
        }
    }

    /// Waits until no more lies in shared memory than these processes need.
    pub(super) fn until_clean(&self) -> Checked<()> {
        let begun = Instant::now();
        loop {
            let mut files = self.instance.shared_memory();
            if files.len() <= self.files.len() {
                return Ok(());
            }
            if begun.elapsed() > CLEAN_UP_PATIENCE {
                files.retain(|name| !self.files.contains(name));
                return Err(format!("left in shared memory, among others: {files:#?}"));
            }
            std::thread::sleep(20 * POLL);
        }
    }

    /// Ends everything.
    pub(super) fn end(mut self) {
        for process in [self.interpolator.take(), self.servo.take()] {
            let _output = process.map(Process::end);
        }
    }
}

impl Drop for Bench<'_> {
    fn drop(&mut self) {
        self.ending.store(true, Ordering::Relaxed);
        // A recorder that failed has said so.
        let _ended = self.recorder.take().map(JoinHandle::join);
    }
}

/// The built-in machine, with an M code of its own.
fn configured(instance: &Instance) -> String {
    let printed = Process::start(instance, &["config", "--default"]).wait();
    let text = printed.expect(0).stdout;
    instance.file("machine.toml", &format!("{text}{RULE}"))
}

fn kill(process: &mut Option<Process>) {
    if let Some(process) = process.take() {
        process.signal(Signal::KILL);
        let _killed = process.wait();
    }
}

/// What lies in shared memory when that is more than so many files, and has not changed for a while.
fn settled(instance: &Instance, more_than: usize) -> Vec<String> {
    let (mut files, mut since) = (Vec::new(), Instant::now());
    while files.len() <= more_than || since.elapsed() < SETTLED {
        std::thread::sleep(20 * POLL);
        let now = instance.shared_memory();
        if now.len() != files.len() {
            (files, since) = (now, Instant::now());
        }
    }
    files
}

fn record(link: &LinkConfig, heard: &Mutex<Heard>, ending: &AtomicBool) {
    let transport = Ipc::connect(link).unwrap();
    let mut setpoints = transport.setpoint_source().unwrap();
    let mut status = transport.status_source().unwrap();
    let mut looked = Instant::now();
    while !ending.load(Ordering::Relaxed) {
        let pause = looked.elapsed();
        looked = Instant::now();
        {
            let mut heard = heard.lock().unwrap();
            heard.longest_pause = heard.longest_pause.max(pause);
        }
        while let Some(setpoint) = setpoints.take().unwrap() {
            heard.lock().unwrap().setpoints.push(setpoint);
        }
        if let Some(status) = status.take().unwrap() {
            heard.lock().unwrap().status = Some(status);
        }
        std::thread::sleep(POLL);
    }
}
