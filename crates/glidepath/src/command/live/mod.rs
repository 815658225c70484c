//! `glidepath live`: the machine in a browser of this host.
//!
//! ```text
//!   interpolator ── setpoints, status ──► this thread ── Feed ──► every page that is open
//!   note of the planner ── Following: its program, planned beside the machine ──► Shown ──► whoever asks for it
//!   page ── POST /api/command ──► Pages ── the operator's panel ──► interpolator
//! ```
//!
//! A page does what its token allows: it looks, holds, or operates. What it orders goes the ways of the
//! command line: commands to the panel, lines and programs to the planner's service, jogs as demands.

mod asked;
mod batch;
mod certificates;
mod day;
mod folder;
mod following;
mod gesture;
mod job_submitter;
pub(super) mod jogger;
mod lateness;
mod log;
mod order;
mod pages;
mod planned;
mod preview;
mod query;
mod receivers;
mod set_up;
mod shown;
mod witness;

use super::persistent_offsets::PersistentOffsets;
use super::session;
use crate::cli::LiveArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::page::machine_object;
use crate::report::{AwaitedEvent, View, active_object, status_object, view_object};
use asked::Asked;
use batch::Batch;
use certificates::Certificates;
use day::{Day, now_ms};
use folder::Folder;
use following::Following;
use glidepath_link::{
    ActiveProgram, Auxiliary, Coolant, InterpolatorProcess, Ipc, LinkConfig, Record as _, Setpoint,
    SpindleState, Status, Subscriber, Transport as _,
};
use glidepath_live::{Feed, Message, Role, Seat, Server, ServerError};
use glidepath_realtime::{Clock as _, Monotonic};
use job_submitter::JobSubmitter;
use jogger::Jogger;
use lateness::Histogram;
use log::Log;
use pages::{Pages, clock_ms};
use preview::Preview;
use receivers::receivers;
use serde_json::{Map, Value, json};
use set_up::SetUp;
use shown::Shown;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use witness::Witness;

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
    let role = args.may.role();
    let (server, feed) = (Server::bind(args.port, role)?, Feed::default());
    let urls: Vec<(Role, String)> = server.urls().collect();
    let port = server.port();
    let folder = args
        .programs
        .as_deref()
        .map(|path| Folder::at(path).map_err(FileError::open(path)));
    let operates = role == Role::Operate;
    let jobs = operates.then(|| JobSubmitter::start(&link)).transpose();
    let jobs = jobs.map_err(ServerError::Thread)?.map(Arc::new);
    let jogger = operates.then(|| Jogger::start(&link)).transpose();
    let pages = Pages {
        config: config.clone(),
        link: link.clone(),
        shown: Arc::clone(&shown),
        set_up: Arc::new(SetUp::new(config)),
        seat: Arc::default(),
        folder: folder.transpose()?,
        preview: Preview::new(config),
        jogger: jogger.map_err(ServerError::Thread)?,
        jobs: jobs.clone(),
        certificates: Arc::default(),
        number: AtomicU64::new(0),
    };
    let (set_up, seat) = (Arc::clone(&pages.set_up), Arc::clone(&pages.seat));
    let certificates = Arc::clone(&pages.certificates);
    let running = server.start(Arc::new(pages), &feed)?;
    tell(args, &instance, &urls, port);
    let offsets = PersistentOffsets::new(config, &link);
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
        offsets,
        feed,
        set_up,
        seat,
        jobs,
        day: Day::default(),
        certificates,
        witness: Witness::new(config),
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
fn tell(args: &LiveArgs, instance: &str, urls: &[(Role, String)], port: u16) {
    let own = urls.last().map_or("", |(_, url)| url);
    if args.operator.basic.json {
        let urls: Map<String, Value> = urls
            .iter()
            .map(|(role, url)| (role.name().to_owned(), url.as_str().into()))
            .collect();
        output::object(&json!({
            "instance": instance,
            "url": own,
            "urls": urls,
            "port": port,
            "may": args.may.role().name(),
        }));
        return;
    }
    let may = match args.may.role() {
        Role::Look => {
            "The page only shows; --may hold lets it bring the machine to rest, --may operate do all."
        }
        Role::Hold => "The page may hold and abort.",
        Role::Operate => "The page operates the machine: whoever has this address moves it.",
    };
    let less: String = urls
        .iter()
        .rev()
        .skip(1)
        .map(|(role, url)| format!("For a page that may only {}:\n  {url}\n", role.name()))
        .collect();
    output::result(&format!(
        "live: open this in a browser of this host, and keep it to yourself:\n  {own}\n{may}\n{less}\
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
    offsets: PersistentOffsets,
    feed: Feed,
    set_up: Arc<SetUp>,
    seat: Arc<Mutex<Seat>>,
    jobs: Option<Arc<JobSubmitter>>,
    day: Day,
    certificates: Arc<Certificates>,
    witness: Witness,
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
                self.transport.stands()?;
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
        self.witness.take(setpoint);
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
                    "clock_ms": clock_ms(),
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
            asked: AwaitedEvent::default(),
            axes: &self.config.axis_names(),
            not_homed: &self.config.axes_not_homed(&status),
            place,
            offsets: self.offsets.look(),
            events: Vec::new(),
        };
        let period_t = self.config.period_t();
        #[allow(clippy::cast_precision_loss, reason = "counts of frames are exact")]
        let planned_t = planned as f64 * period_t;
        let mut object = status_object(&self.instance, &status, &view.asked);
        if let Value::Object(object) = &mut object {
            object.extend(view_object(&view));
            object.remove("events");
            let boot = format!("{:016x}", status.boot_id);
            object.insert("boot".to_owned(), boot.into());
            object.insert("clock_ms".to_owned(), clock_ms().into());
            object.insert("seat".to_owned(), self.seat_object());
            object.insert("set_up".to_owned(), self.set_up.version().into());
            let jobs = self.jobs.as_ref().map(|jobs| jobs.object());
            object.insert("page_jobs".to_owned(), jobs.unwrap_or_default());
            let name = self.following.active().map(ActiveProgram::name);
            if let Some(ended) = self.day.take(&status, name.as_deref(), now_ms()) {
                let seen = self.witness.object(&ended.epochs);
                self.certificates
                    .certify(ended, seen, self.following.plan(&status));
            }
            object.insert("day".to_owned(), self.day.object());
            object.insert("version".to_owned(), self.shown.version().into());
            object.insert("generation".to_owned(), self.shown.generation().into());
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

impl Machine<'_> {
    /// Whether a page operates, and whether another one wants to. Which ones is nobody else's business.
    fn seat_object(&self) -> Value {
        let mut seat = self.seat.lock().unwrap_or_else(PoisonError::into_inner);
        let [holder, asking] = seat.who(Instant::now());
        json!({ "is_taken": holder.is_some(), "is_asked_for": asking.is_some() })
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
