//! `glidepath planner`: programs, or segments of other processes, to frames.

use super::attention::Waiting;
use super::begins_with::begun_with_ratio;
use super::executor::JobExecutor;
use super::going_on::{self, Obstacle, Resumption};
use super::program_note::ProgramNote;
use super::run_supervisor::{RunSupervisor, tell};
use super::session;
use crate::begun::{Board, Part};
use crate::cli::PlannerArgs;
use crate::clock;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::{Interrupt, end_with};
use crate::joints;
use crate::output;
use crate::persistence::read::{read, set_up};
use crate::position_offsets_note::PositionOffsetsNote;
use crate::program_file::ProgramFile;
use crate::report::{counted, driven, peak_rss_bytes, seconds};
use glidepath_geometry::AxisVector;
use glidepath_link::{Ipc, LinkConfig, Operator, Transport};
use glidepath_planner::{
    Control, FileSource, FramePublisher, ItemSource, Listening, Notice, PipeSource, Pipeline,
    Remainder, RunError, SoftLimits, Statistics, serve as serve_jobs,
};
use serde_json::{Value, json};
use std::time::Duration;

/// Plans and publishes until the motion is executed that was asked for at `asked_ns`, ns of the host's steady clock, or,
/// with `--listen`, until asked to end.
///
/// # Errors
/// The program is rejected, the motion was aborted or stopped by a fault, or the link failed.
pub(super) fn planner(
    args: &PlannerArgs,
    config: &MachineConfig,
    asked_ns: u64,
) -> Result<Exit, Failure> {
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    end_with(args.end_with).map_err(Failure::Signals)?;
    // Where that is not allowed, `glidepath doctor` says so; planning goes on as an ordinary process.
    let _may_not = glidepath_realtime::take_precedence();
    let link = session::link(&session::instance(&args.instance, config), config);
    let transport = Ipc::connect(&link)?;
    let quiet = args.end_with.is_some();
    let board = Board::new(link.directory(), session::configuration(&args.basic)?);
    let Some(file) = &args.file else {
        let mut notify = |notice: &Notice<'_>| tell(notice, quiet);
        let mut control = Control {
            stop: interrupt.flag(),
            pause: &mut std::thread::sleep,
            notify: &mut notify,
        };
        let exit = serve(
            (&transport, &link),
            (config, &board),
            &mut control,
            &interrupt,
        )?;
        if args.basic.json {
            output::object(&json!({ "listened": true, "exit_code": exit as u8 }));
        }
        return Ok(exit);
    };
    if file.is_standard_input() && args.resume {
        return Err(Failure::ResumePipe);
    }
    // A file that does not exist is told at once, not when the machine is ready.
    if !file.is_standard_input() {
        std::fs::File::open(file.path()).map_err(FileError::open(file.path()))?;
    }
    let mut config = config.clone();
    if args.end_with.is_some() {
        only_read(&mut config)?;
    }
    let supervisor = RunSupervisor::new(&mut config, link.directory(), quiet)?;
    let mut notify = |notice: &Notice<'_>| {
        supervisor.notice(notice, &config);
        tell(notice, quiet);
    };
    let watched = (!quiet).then_some((&transport, &config));
    let mut waiting = Waiting::new(watched);
    let mut pause = |time| waiting.pause(time);
    let mut control = Control {
        stop: interrupt.flag(),
        pause: &mut pause,
        notify: &mut notify,
    };
    let mut publisher = FramePublisher::connect(&transport, session::pace(&config))?;
    supervisor.attach(&mut publisher, &config)?;
    let mut job = Job {
        publisher,
        config: &config,
        supervisor: &supervisor,
        board: &board,
        link: &link,
        file,
        asked_ns,
        note: ProgramNote::of_file(&link, file.name()),
    };
    let executed = match (file.is_standard_input(), args.resume) {
        (true, _) => job.pipe(&mut control),
        (false, true) => job.resume(&mut control),
        (false, false) => job.run(&mut control),
    };
    // Also where nothing came of it.
    job.publisher.release(&mut control);
    let statistics = executed?;
    let name = job.name();
    if args.basic.json {
        output::object(&object(&name, &statistics));
    } else {
        output::result(&text(&name, &statistics));
    }
    Ok(Exit::Done)
}

/// For `run`, whose machine is imitated: what is kept of the real one is read, and stays as it is.
fn only_read(config: &mut MachineConfig) -> Result<(), Failure> {
    if let Some(kept) = read(config)? {
        // `run` has told what there is to know of it.
        set_up(config, &kept);
    }
    config.state_directory = None;
    Ok(())
}

/// A program, and what it is run with.
struct Job<'a> {
    publisher: FramePublisher<'a>,
    config: &'a MachineConfig,
    supervisor: &'a RunSupervisor,
    board: &'a Board,
    /// The instance.
    link: &'a LinkConfig,
    file: &'a ProgramFile,
    /// When it was asked for, ns of the host's steady clock.
    asked_ns: u64,
    note: ProgramNote<'a>,
}

impl Job<'_> {
    fn name(&self) -> String {
        self.file.name().display().to_string()
    }

    /// What the job is called at the interpolator.
    fn short_name(&self) -> String {
        if self.file.is_standard_input() {
            return "standard input".to_owned();
        }
        let name = self.file.name();
        let last = name.file_name().unwrap_or(name.as_os_str());
        last.to_string_lossy().into_owned()
    }

    /// Takes the machine; where that stands.
    fn wait_until_ready(&mut self, control: &mut Control<'_>) -> Result<AxisVector, RunError> {
        let name = self.short_name();
        let job = (name.as_str(), self.asked_ns);
        self.publisher.wait_until_ready(job, control)
    }

    /// The configuration for a program whose reading the interpolator can end.
    fn watched(&self) -> MachineConfig {
        let mut config = self.config.clone();
        config.program.watch = Some(self.publisher.watch());
        config
    }

    /// The program as a file, checked from its beginning to its end.
    fn open(
        &mut self,
        start: AxisVector,
        config: &MachineConfig,
        control: &mut Control<'_>,
    ) -> Result<FileSource, Failure> {
        let file = self.file.path();
        let open = || {
            joints::check_plan(file, config, start, &mut |_| {})?;
            FileSource::open(file, config.program_options(start), &config.settings())
        };
        let opened = self.work("checking", control, open)?;
        let source = opened.map_err(|refusal| Failure::refused(&self.name(), refusal, false))?;
        Ok(source.attended(self.supervisor.channels()))
    }

    /// Has something done that takes long, while the job can be ended.
    fn work<T: Send>(
        &mut self,
        doing: &str,
        control: &mut Control<'_>,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, RunError> {
        let nobody = &mut |_: Duration| {};
        self.publisher.work(doing, nobody, control, work)
    }

    /// A program that comes through standard input.
    fn pipe(&mut self, control: &mut Control<'_>) -> Result<Statistics, Failure> {
        if !self.supervisor.is_quiet() {
            output::note(
                "planner: reading standard input; the machine waits on the path where no more has come",
            );
        }
        self.board.clear();
        let start = self.wait_until_ready(control)?;
        let options = self.watched().program_options(start);
        let source = PipeSource::spawn(std::io::stdin(), options, self.supervisor.channels())
            .map_err(|refusal| Failure::refused(&self.name(), refusal, true))?;
        let pipeline = Pipeline::new(source, self.config.settings(), start).of_stream();
        self.publish(pipeline, (self.config, start), true, control)
    }

    /// One program, from where the machine stands.
    fn run(&mut self, control: &mut Control<'_>) -> Result<Statistics, Failure> {
        let start = self.wait_until_ready(control)?;
        let config = self.watched();
        let source = self.open(start, &config, control)?;
        self.tell_begun(&config, source.fingerprint(), Part::Whole);
        let pipeline = Pipeline::new(source, self.config.settings(), start);
        self.publish(pipeline, (&config, start), false, control)
    }

    /// Tells recorders what the program begins with, which is read to its end.
    fn tell_begun(&self, config: &MachineConfig, fingerprint: u64, part: Part) {
        let program = (self.file.path(), fingerprint);
        self.board.tell(config, program, part);
    }

    fn publish<S: ItemSource + Send>(
        &mut self,
        pipeline: Pipeline<S>,
        (config, start): (&MachineConfig, AxisVector),
        is_pipe: bool,
        control: &mut Control<'_>,
    ) -> Result<Statistics, Failure> {
        let mut pipeline = pipeline
            .with_joints(self.config.limited_mechanism())
            .with_clock(clock::elapsed);
        let fingerprint = pipeline.source().fingerprint();
        let ratio = config.program.tolerance_ratio;
        self.supervisor.begin((fingerprint, ratio), &start)?;
        self.note.leave(fingerprint, ratio);
        let published = self.publisher.publish(&mut pipeline, control);
        let kept = self
            .supervisor
            .end(&published, &self.publisher, self.config);
        let statistics = published.map_err(|error| match error {
            RunError::Refused(refusal) => Failure::refused(&self.name(), refusal, is_pipe),
            error => self.ended_early(error, (is_pipe, fingerprint), control),
        })?;
        kept?;
        Ok(statistics)
    }

    /// Why the motion ended before the program, with what goes on with it, if that is a file. Whoever
    /// started this one has a way of its own.
    fn ended_early(
        &self,
        error: RunError,
        (is_pipe, fingerprint): (bool, u64),
        control: &mut Control<'_>,
    ) -> Failure {
        let has_begun = self.supervisor.has_begun(&self.publisher);
        let may_go_on = !is_pipe && !self.supervisor.is_quiet() && has_begun;
        if !may_go_on || !going_on::may_go_on(&error, &self.publisher) {
            return error.into();
        }
        let how = Resumption {
            command: "planner",
            file: self.file.path(),
            lifts: self.config.lifts_after_abort(),
        };
        let tried = if going_on::is_under_way(&self.publisher) {
            Err(Obstacle::Untried)
        } else {
            self.try_to_resume(fingerprint, control)
        };
        Failure::Left {
            left: going_on::told(&error, &self.publisher, how, tried),
            source: error,
        }
    }

    /// Does what a resumption does up to its motion.
    fn try_to_resume(&self, fingerprint: u64, control: &mut Control<'_>) -> Result<(), Obstacle> {
        let mut config = self.config.clone();
        let supervisor = RunSupervisor::new(&mut config, self.link.directory(), true)?;
        let watch = going_on::trial_watch();
        config.program.watch = Some(watch.clone());
        let point = self.publisher.resume_point()?;
        going_on::must_be_the_text(self.file.path(), self.link, fingerprint)?;
        begun_with_ratio(&mut config, self.link, point.program);
        supervisor.resume(point.program, &mut config)?;
        let rest = going_on::rest_of(self.file.path(), fingerprint, &config, point);
        if watch.is_to_end() {
            return Err(Obstacle::Untried);
        }
        let rest = rest?;
        let now = self.publisher.auxiliary(control).map_err(RunError::from)?;
        rest.restoring(&now).map_err(RunError::from)?;
        Ok(())
    }

    /// The rest of a program, from where the machine stands on its path.
    fn resume(&mut self, control: &mut Control<'_>) -> Result<Statistics, Failure> {
        let start = self.wait_until_ready(control)?;
        let point = self.publisher.resume_point()?;
        // What it began with, not what it has made of that meanwhile.
        let mut config = self.watched();
        begun_with_ratio(&mut config, self.link, point.program);
        self.supervisor.resume(point.program, &mut config)?;
        let source = self.open(point.program_start, &config, control)?;
        self.tell_begun(&config, source.fingerprint(), Part::Rest);
        let settings = config.settings();
        let find = || Remainder::find(source, point, settings.tolerance_mm);
        let remainder = self.work("reading up to where it was left", control, find)??;
        // What an abort or a fault has stopped turns before anything moves.
        let now = self.publisher.auxiliary(control)?;
        let restoring = remainder.restoring(&now).map_err(RunError::from)?;
        self.supervisor.begin_here()?;
        let line = remainder.line();
        let pipeline = Pipeline::resuming(remainder, settings).beginning_with(restoring, line);
        self.publish(pipeline, (&config, start), false, control)
    }
}

/// Streams, lines and files, until asked to end.
fn serve(
    (transport, link): (&dyn Transport, &LinkConfig),
    (config, board): (&MachineConfig, &Board),
    control: &mut Control<'_>,
    interrupt: &Interrupt,
) -> Result<Exit, Failure> {
    let (low, high) = config.travel();
    let listening = Listening {
        settings: config.settings(),
        joints: config.limited_mechanism(),
        pace: session::pace(config),
        limits: Some(SoftLimits { low, high }),
    };
    if config.state_directory.is_none() {
        output::note(
            "planner: nothing is kept over a restart, neither work offsets nor tools; name a folder: \
             directory of [state]",
        );
    }
    // What cannot be read is said to whoever wants something moved.
    if let Ok(Some(kept)) = read(config) {
        for note in set_up(&mut config.clone(), &kept) {
            output::note(&format!("planner: {note}"));
        }
    }
    if Operator::find(link).is_err() {
        output::note("planner: no interpolator runs yet; it is waited for");
    }
    // The first job begins without one.
    PositionOffsetsNote::new(link.directory()).clear();
    let mut executor = JobExecutor::new(config, link.clone(), board);
    match serve_jobs(transport, &listening, Some(&mut executor), control) {
        Ok(()) | Err(RunError::Interrupted) => Ok(interrupt.exit()),
        Err(error) => Err(error.into()),
    }
}

fn object(program: &str, statistics: &Statistics) -> Value {
    let plan_wall_s = statistics.planning.as_secs_f64();
    json!({
        "program": program,
        "lines": statistics.lines,
        "segments": statistics.segments,
        "samples": statistics.frames,
        "plan_wall_s": plan_wall_s,
        "peak_rss_bytes": peak_rss_bytes(),
    })
}

fn text(program: &str, statistics: &Statistics) -> String {
    format!(
        "{program}: executed; {}, {}, {}, planned in {}\n",
        counted(statistics.lines, "line"),
        driven(statistics.segments),
        counted(statistics.frames, "frame"),
        seconds(statistics.planning.as_secs_f64())
    )
}
