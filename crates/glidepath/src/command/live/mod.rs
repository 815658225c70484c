//! `glidepath live`: the machine in a browser of this host.
//!
//! ```text
//!   interpolator ── setpoints, status ──► this thread ── Feed ──► every page that is open
//!   note of the planner ── Following: its program, planned beside the machine ──► Shown ──► whoever asks for it
//!   page ── POST /api/command ──► Pages ── the operator's panel ──► interpolator
//! ```
//!
//! The page holds, resumes, steps, aborts and sets overrides if that is allowed, and never jogs,
//! homes or enables: whoever moves axes by hand stands beside the machine.

mod asked;
mod batch;
mod following;
mod lateness;
mod log;
mod pages;
mod planned;
mod shown;

use super::kept_offsets::KeptOffsets;
use super::session;
use crate::cli::LiveArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::interrupt::Interrupt;
use crate::output;
use crate::page::machine_object;
use crate::report::{View, active_object, status_object, view_object};
use asked::Asked;
use batch::Batch;
use following::Following;
use glidepath_link::{
    Auxiliary, Coolant, InterpolatorProcess, Ipc, LinkConfig, Record as _, Setpoint, SpindleState,
    Status, Subscriber, Transport as _,
};
use glidepath_live::{Feed, Message, Server};
use glidepath_realtime::{Clock as _, Monotonic};
use lateness::Histogram;
use log::Log;
use pages::Pages;
use serde_json::{Value, json};
use shown::Shown;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Between two looks for setpoints.
const POLL: Duration = Duration::from_millis(10);
/// Between two batches of setpoints.
const BATCH_EVERY: Duration = Duration::from_millis(50);
/// Between two statuses.
const STATUS_EVERY: Duration = Duration::from_millis(100);
/// Between two looks who receives setpoints, and who died.
const LOOK_EVERY: Duration = Duration::from_secs(1);
/// A status that is older tells nothing of the machine any more, ns.
const OLD_NS: u64 = 1_000_000_000;
/// Kinds of messages to the page.
const STATUS_MESSAGE: u8 = 1;
const SETPOINT_MESSAGE: u8 = 2;

/// Serves the page until the process is asked to end.
///
/// # Errors
/// The port cannot be had, or the link cannot be used; the program cannot be read.
pub(super) fn live(args: &LiveArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let instance = session::instance(&args.operator.instance, config);
    let link = session::link(&instance, config);
    let transport = Ipc::connect(&link)?;
    let shown = Arc::new(Shown::new(machine_object(config, &instance)));
    let given = args.file.as_ref().map(|file| (file.path(), file.name()));
    let following = Following::new((config, &link), Arc::clone(&shown), given)?;
    let (server, feed) = (Server::bind(args.port)?, Feed::default());
    let (url, port) = (server.url(), server.port());
    let pages = Pages::new(Arc::clone(&shown), link.clone(), args.commands);
    let running = server.start(Arc::new(pages), &feed)?;
    tell(args, &instance, &url, port);
    let mut machine = Machine {
        config,
        instance,
        link,
        setpoints: transport.setpoint_source()?,
        statuses: transport.status_source()?,
        auxiliaries: transport.auxiliary_source()?,
        transport,
        shown,
        following,
        asked: Asked::new(config),
        offsets: KeptOffsets::new(config),
        feed,
        commands: args.commands,
        batch: Batch::new(config),
        histogram: Histogram::default(),
        log: Log::default(),
        receivers: Value::Null,
        status: None,
        auxiliary: None,
    };
    machine.follow(&interrupt)?;
    drop(running);
    Ok(interrupt.exit())
}

/// Where the page is.
fn tell(args: &LiveArgs, instance: &str, url: &str, port: u16) {
    if args.operator.basic.json {
        output::object(&json!({
            "instance": instance,
            "url": url,
            "port": port,
            "commands": args.commands,
        }));
        return;
    }
    let may = if args.commands {
        "The page may hold, resume, step, abort and set overrides."
    } else {
        "The page only shows; --commands lets it hold, resume, step, abort and set overrides."
    };
    output::result(&format!(
        "live: open this in a browser of this host, and keep it to yourself:\n  {url}\n{may}\n\
         Ctrl-C ends the page; the machine goes on.\n"
    ));
}

/// What is followed, and what is known of it.
struct Machine<'a> {
    config: &'a MachineConfig,
    instance: String,
    link: LinkConfig,
    setpoints: Box<dyn Subscriber<Setpoint>>,
    statuses: Box<dyn Subscriber<Status>>,
    auxiliaries: Box<dyn Subscriber<Auxiliary>>,
    transport: Ipc,
    shown: Arc<Shown>,
    following: Following,
    asked: Asked,
    offsets: KeptOffsets,
    feed: Feed,
    commands: bool,
    batch: Batch,
    histogram: Histogram,
    log: Log,
    receivers: Value,
    status: Option<Status>,
    auxiliary: Option<Auxiliary>,
}

impl Machine<'_> {
    fn follow(&mut self, interrupt: &Interrupt) -> Result<(), Failure> {
        let long_ago = Instant::now().checked_sub(LOOK_EVERY);
        let mut sent = [long_ago; 3];
        let mut is_due = |which: usize, every: Duration| {
            let due = sent
                .get(which)
                .copied()
                .flatten()
                .is_none_or(|at: Instant| at.elapsed() >= every);
            if due && let Some(sent) = sent.get_mut(which) {
                *sent = Some(Instant::now());
            }
            due
        };
        while !interrupt.is_set() {
            while let Some(setpoint) = self.setpoints.take()? {
                self.take(&setpoint);
            }
            while let Some(status) = self.statuses.take()? {
                if self
                    .status
                    .is_some_and(|last| last.boot_id != status.boot_id)
                {
                    self.histogram = Histogram::default();
                    self.feed.forget();
                    self.batch = Batch::new(self.config);
                }
                self.log.take(&status);
                self.status = Some(status);
            }
            while let Some(told) = self.auxiliaries.take()? {
                // What cannot be understood is not shown.
                self.auxiliary = told.check().is_ok().then_some(told);
                self.asked.take(self.auxiliary.as_ref());
            }
            if is_due(0, LOOK_EVERY) {
                self.transport.clean_up_dead_peers()?;
                self.receivers = receivers(&self.transport.setpoint_receivers()?);
            }
            // A status first: a page needs it to show a batch.
            if is_due(1, STATUS_EVERY)
                && let Some(object) = self.object()?
            {
                let text = object.to_string();
                self.feed
                    .push(Message::new(STATUS_MESSAGE, text.as_bytes()));
            }
            if is_due(2, BATCH_EVERY)
                && let Some(bytes) = self.batch.bytes()
            {
                self.feed.push(Message::new(SETPOINT_MESSAGE, &bytes));
            }
            std::thread::sleep(POLL);
        }
        Ok(())
    }

    fn take(&mut self, setpoint: &Setpoint) {
        self.batch.push(setpoint);
        self.histogram.push(setpoint.lateness_ns);
    }

    /// What the page is told; nothing while nobody knows what the machine does.
    fn object(&mut self) -> Result<Option<Value>, Failure> {
        let now_ns = Monotonic.now_ns();
        let fresh = self
            .status
            .filter(|status| now_ns.saturating_sub(status.updated_ns) < OLD_NS);
        let Some(status) = fresh else {
            let lives = match InterpolatorProcess::find(&self.link)? {
                Some(process) => process.lives()?,
                None => false,
            };
            // One that lives and says nothing is told by the age of what it said last.
            return Ok((!lives).then(|| {
                self.log.ended();
                json!({
                    "state": "none",
                    "commands": self.commands,
                    "version": self.shown.version(),
                    "place": Value::Null,
                    "log": self.log.object(),
                })
            }));
        };
        self.following.look(&status);
        let place = self.following.place(&status);
        let in_plan = place.as_ref().and_then(|place| place.elapsed_t);
        let planned = self.following.frames();
        let view = View {
            instance: &self.instance,
            status: &status,
            auxiliary: self.auxiliary.as_ref(),
            axes: &self.config.axis_names(),
            place,
            offsets: self.offsets.look(),
            events: Vec::new(),
        };
        let period_t = self.config.period_t();
        #[allow(clippy::cast_precision_loss, reason = "counts of frames are exact")]
        let planned_t = planned as f64 * period_t;
        let mut object = status_object(&self.instance, &status);
        if let Value::Object(object) = &mut object {
            object.extend(view_object(&view));
            object.remove("events");
            object.insert("commands".to_owned(), self.commands.into());
            object.insert("version".to_owned(), self.shown.version().into());
            let place = in_plan.map(|elapsed_t| elapsed_t / period_t);
            object.insert("place".to_owned(), place.into());
            object.insert("planned_so_far_s".to_owned(), planned_t.into());
            let spindle = self.auxiliary.as_ref().map(spindle);
            object.insert("spindle".to_owned(), spindle.unwrap_or(Value::Null));
            object.insert("lateness_histogram".to_owned(), self.histogram.object());
            object.insert("receivers".to_owned(), self.receivers.clone());
            object.insert("log".to_owned(), self.log.object());
            let active = active_object(self.following.active());
            object.insert("active_program".to_owned(), active);
            let is_shown = self.following.is_of(&status);
            object.insert("program_is_shown".to_owned(), is_shown.into());
            object.insert("asked".to_owned(), self.asked.object(&status));
        }
        Ok(Some(object))
    }
}

/// What spindle and coolant were told.
fn spindle(told: &Auxiliary) -> Value {
    let turns = match told.spindle() {
        Ok(SpindleState::Clockwise) => "clockwise",
        Ok(SpindleState::Counterclockwise) => "counterclockwise",
        Ok(SpindleState::Oriented) => "oriented",
        Ok(SpindleState::Stopped) | Err(_) => "off",
    };
    let (mist, flood) = (Coolant::MIST, Coolant::FLOOD);
    let coolant = match (
        told.coolant().contains(mist),
        told.coolant().contains(flood),
    ) {
        (false, false) => "",
        (true, false) => "mist",
        (false, true) => "flood",
        (true, true) => "mist and flood",
    };
    json!({ "speed": told.spindle_speed, "turns": turns, "coolant": coolant })
}

/// Who receives setpoints: name and process of each.
fn receivers(processes: &[i32]) -> Value {
    let own = std::process::id();
    let object = |process: &i32| {
        let name = std::fs::read_to_string(format!("/proc/{process}/comm"));
        let command = std::fs::read(format!("/proc/{process}/cmdline")).unwrap_or_default();
        let command = String::from_utf8_lossy(&command);
        let word = command.split('\0').nth(1).unwrap_or_default();
        let is_own = u32::try_from(*process) == Ok(own);
        let role = match word {
            _ if is_own => "this page",
            "servo" => "servo stack that imitates drives",
            "live" => "another page",
            "record" => "recorder",
            _ => "receives every setpoint",
        };
        let name = name.unwrap_or_default().trim().to_owned();
        json!({ "pid": process, "name": name, "role": role })
    };
    processes.iter().map(object).collect()
}
