//! `glidepath live`: the machine in a browser of this host.
//!
//! ```text
//!   interpolator ── setpoints, status ──► this thread ── Feed ──► every page that is open
//!   note of the planner ── Following: its program, planned beside the machine ──► Shown ──► whoever asks for it
//!   page ── POST /api/command ──► Pages ── the operator's panel ──► interpolator
//! ```
//!
//! Paired devices are served the same over TLS ([`devices`]), and operate nothing.
//!
//! A page does what its token allows: it looks, holds, or operates. What it orders goes the ways of the
//! command line: commands to the panel, lines and programs to the planner's service, jogs as demands.

mod addresses;
mod answers;
mod asked;
mod batch;
mod certificates;
mod course;
mod day;
mod devices;
mod documents;
mod folder;
mod following;
mod gesture;
mod given;
mod job_submitter;
pub(super) mod jogger;
mod judge;
mod lateness;
mod log;
mod machines;
mod order;
mod pages;
mod planned;
mod preview;
mod query;
mod queue;
mod receivers;
mod section_names;
mod set_up;
mod shortcut;
mod shown;
mod shuttle;
mod status;
mod step;
mod steps;
mod what_if;
mod witness;

use super::persistent_offsets::PersistentOffsets;
use super::session;
use crate::cli::{LiveAction, LiveArgs};
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::page::machine_object;
use asked::Asked;
use batch::Batch;
use certificates::Certificates;
use day::Day;
use devices::PairedDevices;
use folder::Folder;
use following::Following;
use glidepath_link::{
    Auxiliary, Ipc, LinkConfig, Record as _, Setpoint, Status, Subscriber, Transport as _,
};
use glidepath_live::{DeviceServer, Feed, Message, Role, Running, Seat, Server, ServerError, Site};
use job_submitter::JobSubmitter;
use jogger::Jogger;
use judge::Judge;
use lateness::Histogram;
use log::Log;
use machines::Listing;
use pages::Pages;
use preview::Preview;
use queue::Queue;
use receivers::receivers;
use serde_json::Value;
use set_up::SetUp;
use shortcut::Shortcut;
use shown::Shown;
use shuttle::Shuttle;
use std::io;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use steps::Steps;
use what_if::WhatIf;
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
    match &args.action {
        Some(LiveAction::Devices(args)) => devices::listing::devices(args, config),
        None => serve(args, config),
    }
}

fn serve(args: &LiveArgs, config: &MachineConfig) -> Result<Exit, Failure> {
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
    let (device_server, devices) = bind_devices(args, &instance, config)?;
    let operates = role == Role::Operate;
    let jobs = started(operates, || JobSubmitter::start(&link))?.map(Arc::new);
    let jogger = started(operates, || Jogger::start(config, &link))?;
    let moves = started(operates, || Shuttle::start(&link))?.map(Arc::new);
    let queue = Arc::<Queue>::default();
    let steps = jogger.as_ref().map(Jogger::steps);
    let pages = Pages {
        config: config.clone(),
        link: link.clone(),
        shown: Arc::clone(&shown),
        set_up: Arc::new(SetUp::new(config)),
        judge: Arc::new(Judge::new(config, &link)),
        seat: Arc::default(),
        folder: folder(args)?,
        preview: Preview::new(config),
        what_if: WhatIf::new(config),
        jogger,
        moves: moves.clone(),
        queue: Arc::clone(&queue),
        jobs: jobs.clone(),
        certificates: Arc::default(),
        devices: devices.clone(),
        number: AtomicU64::new(0),
    };
    let (set_up, seat) = (Arc::clone(&pages.set_up), Arc::clone(&pages.seat));
    let (certificates, judge) = (Arc::clone(&pages.certificates), Arc::clone(&pages.judge));
    let pages = Arc::new(pages);
    let running = server.start(Arc::clone(&pages) as Arc<dyn Site>, &feed)?;
    let served = start_devices(device_server, devices.clone(), pages, (&feed, role))?;
    let (listing, shortcut) = ways_in(args, &link, &urls)?;
    addresses::tell(args, &instance, (&urls, port), devices.as_deref());
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
        judge,
        seat,
        jobs,
        steps,
        moves,
        queue,
        day: Day::default(),
        certificates,
        devices,
        listing,
        witness: Witness::new(config),
        batch: Batch::new(config),
        histogram: Histogram::default(),
        log: Log::default(),
        receivers: Value::Null,
        status: None,
        auxiliary: None,
    };
    machine.follow(&interrupt)?;
    drop((shortcut, served, running));
    Ok(interrupt.exit())
}

/// What has a thread of its own, where pages may operate.
fn started<T>(
    operates: bool,
    start: impl FnOnce() -> io::Result<T>,
) -> Result<Option<T>, ServerError> {
    let started = operates.then(start).transpose();
    started.map_err(ServerError::Thread)
}

/// The machine among those of this host, where it is to be listed, and the file that opens the page with all that it may,
/// where one is wanted.
fn ways_in(
    args: &LiveArgs,
    link: &LinkConfig,
    urls: &[(Role, String)],
) -> Result<(Option<Listing>, Option<Shortcut>), FileError> {
    let listing = args.listed.then(|| Listing::begin(link, urls));
    let listing = listing.transpose().map_err(FileError::open(&link.root))?;
    let wanted = args.shortcut.as_deref().zip(urls.last());
    let shortcut = wanted.map(|(file, (_, url))| Shortcut::begin(file, url));
    Ok((listing, shortcut.transpose()?))
}

/// The folder of programs, if there is one.
fn folder(args: &LiveArgs) -> Result<Option<Folder>, FileError> {
    let path = args.programs.as_deref();
    path.map(|path| Folder::at(path).map_err(FileError::open(path)))
        .transpose()
}

/// The server of devices and those that are paired, where they are to be served.
fn bind_devices(
    args: &LiveArgs,
    instance: &str,
    config: &MachineConfig,
) -> Result<(Option<DeviceServer>, Option<Arc<PairedDevices>>), Failure> {
    let bind = |address| PairedDevices::bind(address, instance, config);
    let (server, devices) = args.devices.map(bind).transpose()?.unzip();
    Ok((server, devices.map(Arc::new)))
}

/// Answers devices from now on.
fn start_devices(
    server: Option<DeviceServer>,
    devices: Option<Arc<PairedDevices>>,
    pages: Arc<dyn Site>,
    (feed, most): (&Feed, Role),
) -> Result<Option<Running>, ServerError> {
    let served = server.zip(devices);
    let start = |(server, devices): (DeviceServer, Arc<PairedDevices>)| {
        server.start(pages, feed, devices, most)
    };
    served.map(start).transpose()
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
    judge: Arc<Judge>,
    seat: Arc<Mutex<Seat>>,
    jobs: Option<Arc<JobSubmitter>>,
    steps: Option<Arc<Steps>>,
    moves: Option<Arc<Shuttle>>,
    queue: Arc<Queue>,
    day: Day,
    certificates: Arc<Certificates>,
    devices: Option<Arc<PairedDevices>>,
    /// The machine among those of this host, where it is listed.
    listing: Option<Listing>,
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
        let mut sent = [long_ago; 4];
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
                self.judge.hear(&status, self.auxiliary.as_ref());
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
                self.hear_of_devices();
            }
            // A status first: a page needs it to show a batch.
            if is_due(1, STATUS_EVERY)
                && let Some(object) = self.object()?
            {
                let text = object.to_string();
                self.feed
                    .push(Message::new(STATUS_MESSAGE, text.as_bytes()));
                if is_due(3, LOOK_EVERY) {
                    self.listing.iter_mut().for_each(|own| own.tell(&object));
                }
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
}
