//! `glidepath record`: writes every setpoint and status to a file that others can open, or keeps
//! them in memory until a fault makes them worth a file.

mod beginnings;

use super::session;
use crate::cli::RecordArgs;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::output_file::{OutputFile, OutputKind};
use crate::report::grouped;
use crate::text_file;
use beginnings::Beginnings;
use glidepath_link::{
    Ipc, MachineState, Record as _, Setpoint, Status, Subscriber, Transport as _,
};
use glidepath_realtime::{Clock as _, Monotonic};
use glidepath_recording::{Begun, MOST_PROGRAM_BYTES, Origin, Recorder};
use serde_json::json;
use std::collections::VecDeque;
use std::ffi::OsString;
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

/// Between two looks: a small part of the queue of setpoints.
const POLL: Duration = Duration::from_millis(10);
/// Half of what a killed recorder may lose, so that a busy host leaves the other half.
const FLUSH_EVERY: Duration = Duration::from_millis(500);
/// Between two looks for processes that died.
const CLEAN_EVERY: Duration = Duration::from_secs(1);
/// How long a black box goes on behind a fault.
const BEHIND: Duration = Duration::from_secs(2);

/// Records until asked to end.
///
/// # Errors
/// The link cannot be used, or a file cannot be read or written.
pub(super) fn record(args: &RecordArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let basic = &args.operator.basic;
    if let Some(program) = &args.program {
        program.open()?;
    }
    let guard = session::guard(args.program.as_ref(), basic, config, args.overwrite);
    // Begun and dropped: whether it may be written is told now.
    drop(OutputFile::create(
        &args.file,
        OutputKind::Recording,
        &guard,
    )?);
    let instance = session::instance(&args.operator.instance, config);
    let origin = origin(args, config, &instance)?;
    let mut source = Source::join(args, config)?;
    output::note("record: ready; it records what the interpolator gives until it is ended");
    match args.ring {
        Some(length) => black_box(args, &origin, &mut source, length, &interrupt)?,
        None => to_file(args, &origin, &mut source, &interrupt)?,
    }
    Ok(interrupt.exit())
}

/// What is recorded, and what is known of the gaps in it.
struct Source {
    setpoints: Box<dyn Subscriber<Setpoint>>,
    statuses: Box<dyn Subscriber<Status>>,
    transport: Ipc,
    cleaned: Instant,
    last: Option<(u64, u64)>,
    lost: u64,
    beginnings: Beginnings,
}

impl Source {
    fn join(args: &RecordArgs, config: &MachineConfig) -> Result<Self, Failure> {
        let transport = session::join(&args.operator.instance, config)?;
        let instance = session::instance(&args.operator.instance, config);
        Ok(Self {
            beginnings: Beginnings::new(session::link(&instance, config).directory()),
            setpoints: transport.setpoint_source()?,
            statuses: transport.status_source()?,
            transport,
            cleaned: Instant::now(),
            last: None,
            lost: 0,
        })
    }

    /// The next setpoint, and what its program began with if it is the first of it.
    fn setpoint(&mut self) -> Result<Option<(Setpoint, Option<Begun>)>, Failure> {
        let Some(setpoint) = self.setpoints.take()? else {
            return Ok(None);
        };
        if let Some((boot_id, number)) = self.last
            && boot_id == setpoint.boot_id
        {
            self.lost += setpoint.number.saturating_sub(number + 1);
        }
        self.last = Some((setpoint.boot_id, setpoint.number));
        let begun = self.beginnings.at(&setpoint);
        Ok(Some((setpoint, begun)))
    }

    fn rest(&mut self) -> Result<(), Failure> {
        if self.cleaned.elapsed() >= CLEAN_EVERY {
            self.cleaned = Instant::now();
            self.transport.clean_up_dead_peers()?;
        }
        std::thread::sleep(POLL);
        Ok(())
    }
}

/// What the recording is of.
fn origin(args: &RecordArgs, config: &MachineConfig, instance: &str) -> Result<Origin, Failure> {
    let configuration = session::configuration(&args.operator.basic)?;
    let program = args.program.as_ref().map(|program| {
        let bytes = text_file::bytes(program.path(), MOST_PROGRAM_BYTES);
        bytes.map_err(FileError::open(program.name()))
    });
    let program = program.transpose()?;
    let mut origin = Origin {
        configuration,
        program,
        ..Origin::default()
    };
    #[expect(
        clippy::disallowed_methods,
        reason = "what joins the steady clock to the calendar"
    )]
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let realtime_ns = now.map_or(0, |now| u64::try_from(now.as_nanos()).unwrap_or(0));
    origin.tell_clocks(realtime_ns, Monotonic.now_ns());
    origin.tell("glidepath_version", env!("CARGO_PKG_VERSION"));
    origin.tell("setpoint_record", Setpoint::NAME);
    origin.tell("status_record", Status::NAME);
    origin.tell("instance", instance);
    origin.tell("period_ns", config.period_ns());
    let axes: Vec<String> = config
        .axis_names()
        .iter()
        .map(ToString::to_string)
        .collect();
    origin.tell("axes", axes.join(" "));
    origin.tell("tolerance_mm", config.path.tolerance_mm);
    origin.tell("effort", config.path.effort.name());
    if let Some(program) = &args.program {
        origin.tell("program", program.name().display());
    }
    Ok(origin)
}

/// A file under another name until it is whole.
struct Growing {
    recorder: Recorder<BufWriter<File>>,
    part: PathBuf,
    place: PathBuf,
}

impl Growing {
    fn begin(place: &Path, origin: &Origin) -> Result<Self, Failure> {
        let mut part = OsString::from(place);
        part.push(".part");
        let part = PathBuf::from(part);
        // One that is there is what a recorder left that was killed.
        let file = File::create_new(&part).map_err(|error| {
            if error.kind() == io::ErrorKind::AlreadyExists {
                let reason = "a recorder that was killed left it, or one works on it; it can be \
                              read as it is: move it away, or delete it";
                FileError::guarded(&part, reason.to_owned())
            } else {
                FileError::open(&part)(error)
            }
        })?;
        let recorder = Recorder::new(BufWriter::with_capacity(1 << 18, file), origin);
        Ok(Self {
            recorder: recorder.map_err(FileError::file("write", &part))?,
            part,
            place: place.to_owned(),
        })
    }

    fn put(
        &mut self,
        write: impl FnOnce(&mut Recorder<BufWriter<File>>) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let written = write(&mut self.recorder);
        Ok(written.map_err(FileError::file("write", &self.part))?)
    }

    fn finish(self) -> Result<(), Failure> {
        let failed = FileError::file("write", &self.part);
        let whole = || {
            let buffered = self.recorder.finish()?;
            let file = buffered
                .into_inner()
                .map_err(io::IntoInnerError::into_error)?;
            file.sync_all()?;
            std::fs::rename(&self.part, &self.place)
        };
        Ok(whole().map_err(failed)?)
    }
}

fn to_file(
    args: &RecordArgs,
    origin: &Origin,
    source: &mut Source,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let mut file = Growing::begin(&args.file, origin)?;
    let (started, mut flushed) = (Instant::now(), Instant::now());
    let mut count = 0_u64;
    let is_over = || {
        let elapsed = started.elapsed().as_secs_f64();
        interrupt.is_set() || args.seconds.is_some_and(|seconds| elapsed >= seconds)
    };
    while !is_over() {
        while let Some((setpoint, begun)) = source.setpoint()? {
            if let Some(begun) = begun {
                file.put(|recorder| recorder.begun(&begun))?;
            }
            file.put(|recorder| recorder.setpoint(&setpoint))?;
            count += 1;
        }
        while let Some(status) = source.statuses.take()? {
            file.put(|recorder| recorder.status(&status))?;
        }
        if flushed.elapsed() >= FLUSH_EVERY {
            flushed = Instant::now();
            file.put(Recorder::flush)?;
        }
        source.rest()?;
    }
    file.finish()?;
    if args.operator.basic.json {
        output::object(&json!({
            "recording": args.file,
            "setpoints": count,
            "lost_setpoints": source.lost,
        }));
    } else {
        output::result(&format!(
            "record: {} setpoints, {} lost\n  recording     {}\n",
            grouped(count),
            grouped(source.lost),
            args.file.display()
        ));
    }
    Ok(())
}

/// The last minutes.
#[derive(Default)]
struct Ring {
    setpoints: VecDeque<Setpoint>,
    statuses: VecDeque<Status>,
    /// What the program began with that was begun last.
    begun: Option<Begun>,
}

impl Ring {
    fn forget_before(&mut self, then_ns: u64) {
        while self
            .setpoints
            .front()
            .is_some_and(|oldest| oldest.scheduled_ns < then_ns)
        {
            self.setpoints.pop_front();
        }
        while self
            .statuses
            .front()
            .is_some_and(|oldest| oldest.updated_ns < then_ns)
        {
            self.statuses.pop_front();
        }
    }

    /// Writes all of it, in the order of time.
    fn save(&self, place: &Path, origin: &Origin) -> Result<(), Failure> {
        let mut file = Growing::begin(place, origin)?;
        let mut statuses = self.statuses.iter().peekable();
        let mut begun = self.begun.as_ref();
        for setpoint in &self.setpoints {
            if let Some(begun) = begun.take_if(|begun| begun.epoch == setpoint.epoch) {
                file.put(|recorder| recorder.begun(begun))?;
            }
            while let Some(status) =
                statuses.next_if(|status| status.updated_ns <= setpoint.scheduled_ns)
            {
                file.put(|recorder| recorder.status(status))?;
            }
            file.put(|recorder| recorder.setpoint(setpoint))?;
        }
        for status in statuses {
            file.put(|recorder| recorder.status(status))?;
        }
        file.finish()
    }
}

fn black_box(
    args: &RecordArgs,
    origin: &Origin,
    source: &mut Source,
    length: Duration,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let length_ns = u64::try_from(length.as_nanos()).unwrap_or(u64::MAX);
    let mut ring = Ring::default();
    let (mut was_faulted, mut fault) = (false, None);
    let mut saved = Vec::new();
    while !interrupt.is_set() {
        while let Some((setpoint, begun)) = source.setpoint()? {
            ring.begun = begun.or_else(|| ring.begun.take());
            ring.forget_before(setpoint.scheduled_ns.saturating_sub(length_ns));
            ring.setpoints.push_back(setpoint);
        }
        while let Some(status) = source.statuses.take()? {
            let is_faulted = status.state() == Ok(MachineState::Faulted);
            if is_faulted && !was_faulted {
                let words = status.fault_text().unwrap_or_else(|| "a fault".to_owned());
                fault = Some((Instant::now(), words));
            }
            was_faulted = is_faulted;
            ring.statuses.push_back(status);
        }
        if let Some((_, words)) = fault.take_if(|(at, _)| at.elapsed() >= BEHIND) {
            let place = timed(&args.file);
            ring.save(&place, origin)?;
            if !args.operator.basic.json {
                output::result(&format!(
                    "record: {words}\n  recording     {}\n",
                    place.display()
                ));
            }
            saved.push(place);
        }
        source.rest()?;
    }
    // A fault of the last moment counts, too.
    if fault.is_some() {
        let place = timed(&args.file);
        ring.save(&place, origin)?;
        saved.push(place);
    }
    if args.operator.basic.json {
        output::object(&json!({ "recordings": saved, "lost_setpoints": source.lost }));
    } else {
        output::result(&format!("record: {} recordings of faults\n", saved.len()));
    }
    Ok(())
}

/// The name of a file with the time in it, as `box-1732345678901.mcap`: ms since 1970.
#[expect(clippy::disallowed_methods, reason = "a name for people")]
fn timed(file: &Path) -> PathBuf {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let mut name = file.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{}", now.map_or(0, |now| now.as_millis())));
    if let Some(ending) = file.extension() {
        name.push(".");
        name.push(ending);
    }
    file.with_file_name(name)
}
