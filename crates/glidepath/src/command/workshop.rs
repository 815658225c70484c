//! The executor of the planner's service: lines and files of operators, with modal state kept
//! between.

use super::attendant::{Attendant, recalling};
use super::differences::{agreement, approach};
use super::failure::Failure;
use super::going_on;
use super::left_in_force::JobLeft;
use super::program_diagnostics::refusal_text;
use super::program_note::ProgramNote;
use super::reading::for_program;
use crate::begun::{Board, Part};
use crate::clock;
use crate::config::MachineConfig;
use crate::joints;
use crate::kept::read::{read, set_up};
use crate::output;
use crate::program_file::ProgramFile;
use crate::report::counted;
use glidepath_gcode::{Dialect, InForce, Program};
use glidepath_geometry::AxisVector;
use glidepath_link::{LinkConfig, refused};
use glidepath_planner::{
    Attend, Control, FileSource, ItemSource, Job, JobEnd, JobRunner, LineFacts, LineInbox,
    LineStart, Notice, Pipeline, ProgramSource, Publisher, Refusal, Remainder, ResumePoint,
    RunError, SentLines, StartLine, Statistics,
};
use std::io::{self, Cursor};
use std::path::Path;
use std::time::Duration;

/// The line of an operator as a program.
type LineSource = ProgramSource<Cursor<Vec<u8>>>;

/// Executes jobs one after the other.
#[derive(Debug)]
pub(super) struct Workshop<'c> {
    config: &'c MachineConfig,
    link: LinkConfig,
    board: &'c Board,
    /// What the job before has left in force.
    in_force: Option<InForce>,
    /// The program begun last.
    begun: Option<Begun>,
    /// Lines were executed since that program.
    has_lines: bool,
    /// Where it was left, if it ended early and lines were executed since.
    left: Option<ResumePoint>,
}

/// A program, and what it began with.
#[derive(Debug)]
struct Begun {
    program: u64,
    start: AxisVector,
    in_force: Option<InForce>,
}

/// The side of the service while a job runs.
struct Bench<'b, 't, 'c> {
    publisher: &'b mut Publisher<'t>,
    attend: &'b mut dyn Attend,
    control: &'b mut Control<'c>,
    note: ProgramNote<'b>,
    /// The program, if the job is one.
    file: Option<&'b Path>,
}

impl Bench<'_, '_, '_> {
    /// Has something done that takes long, while the service answers.
    fn work<T: Send>(&mut self, doing: &str, work: impl FnOnce() -> T + Send) -> Result<T, Stop> {
        let done = self
            .publisher
            .work(doing, &mut *self.attend, self.control, work);
        done.map_err(|error| Stop::Failed(error.to_string()))
    }
}

impl<'c> Workshop<'c> {
    pub(super) const fn new(config: &'c MachineConfig, link: LinkConfig, board: &'c Board) -> Self {
        Self {
            config,
            link,
            board,
            in_force: None,
            begun: None,
            has_lines: false,
            left: None,
        }
    }

    /// The configuration and the attendant of the next job.
    fn set_up(&self, publisher: &Publisher<'_>) -> Result<(MachineConfig, Attendant), Failure> {
        let mut config = self.config.clone();
        let attendant = Attendant::new(&mut config, self.link.directory(), true)?;
        if let Some(in_force) = self.in_force.as_ref().filter(|_| !attendant.keeps()) {
            config.program.offsets = in_force.work_offsets();
            config.program.tools = in_force.tools().cloned().or(config.program.tools);
        }
        config.program.in_force = self.in_force.clone();
        config.program.watch = Some(publisher.watch());
        Ok((config, attendant))
    }

    /// Lines, as they come: what was read is executed, and what it left is in force.
    fn lines(
        &mut self,
        inbox: &LineInbox,
        start: AxisVector,
        bench: &mut Bench<'_, '_, '_>,
    ) -> End {
        let (config, attendant) = self.set_up(bench.publisher)?;
        let config = of_sender(config);
        self.board.clear();
        let options = config.program_options(start);
        let source = SentLines::new(inbox.clone(), options, attendant.attending());
        let pipeline = Pipeline::new(source, config.settings(), start).of_stream();
        let (run, in_force) = Self::publish(pipeline, (&config, &attendant), start, bench, |s| {
            Some(s.in_force())
        });
        // Where the motion ended before the lines did, what its executed part has left.
        let left = in_force.or_else(|| {
            if !attendant.has_begun(bench.publisher) {
                return None;
            }
            let ended = JobLeft::of(bench.publisher, bench.control);
            let in_force = inbox.in_force_at(bench.publisher.block())?;
            let began = self.in_force.as_ref().map_or(0, InForce::tool);
            Some(ended.with_its_tool(in_force, began))
        });
        self.in_force = left.or_else(|| self.in_force.take());
        let statistics = run?;
        Ok(format!(
            "executed; {}, {}",
            counted(statistics.lines, "line"),
            counted(statistics.segments, "segment")
        ))
    }

    /// A line: refused as a whole, or executed, and then what it left is in force.
    fn line(&mut self, text: &str, start: AxisVector, bench: &mut Bench<'_, '_, '_>) -> End {
        if text.contains(['\n', '\r']) {
            return Err(Stop::Refused("give one line at a time".to_owned()));
        }
        let (config, attendant) = self.set_up(bench.publisher)?;
        let text = format!("{text}\n").into_bytes();
        let options = || config.program_options(start);
        let judge = || Program::new(text.as_slice(), options()).find_map(Result::err);
        if let Some(diagnostic) = bench.work("checking", judge)? {
            return Err(refusal(&Refusal::Program {
                diagnostics: vec![diagnostic],
                unlisted: 0,
            }));
        }
        self.board.clear();
        let source = |options| LineSource::new(Cursor::new(text.clone()), options);
        let attended = source(options()).attended(attendant.attending());
        self.keep_resume_point(bench.publisher);
        let pipeline = Pipeline::new(attended, config.settings(), start);
        let (mut run, in_force) =
            Self::publish(pipeline, (&config, &attendant), start, bench, |p| {
                Some(p.in_force())
            });
        self.settle(&mut run, in_force, bench, &attendant, || {
            let options = unwatched(&config).program_options(start);
            Ok(Some(source(options).attended(recalling(&config, 0))))
        });
        let statistics = run?;
        Ok(format!(
            "executed; {}{}",
            counted(statistics.segments, "segment"),
            self.lost_later(&config)
        ))
    }

    /// What is to be known of a line that has set the machine up, where nothing is kept over a restart.
    fn lost_later(&self, before: &MachineConfig) -> &'static str {
        let now = self
            .in_force
            .as_ref()
            .filter(|_| before.state_directory.is_none());
        let has_set_up = now.is_some_and(|now| {
            let (was, is) = (&before.program.offsets, now.work_offsets());
            let offsets = (&is.systems, &is.reference, &is.saved_shift);
            offsets != (&was.systems, &was.reference, &was.saved_shift)
                || now.tools() != before.program.tools.as_ref()
        });
        if has_set_up {
            "; what it has set up is lost when the planner ends, because [state] names no directory"
        } else {
            ""
        }
    }

    /// A file, from its beginning, from a line, or from where it was left.
    fn file(
        &mut self,
        file: &FileJob<'_>,
        start: AxisVector,
        bench: &mut Bench<'_, '_, '_>,
    ) -> End {
        must_be_a_file(file.path)?;
        let (config, attendant) = self.set_up(bench.publisher)?;
        let mut config = for_program(&ProgramFile::named(file.path), &config);
        let begins = self.begins(file, start, &mut config, (&attendant, &*bench))?;
        let config = config;
        let source = bench.work("checking", || open(file.path, &config, begins.start))?;
        let source = source.map_err(|e| refusal(&e))?;
        let source = source.attended(attendant.attending());
        let fingerprint = source.fingerprint();
        let is_whole = begins.point.is_none() && file.from.is_none();
        let part = if is_whole { Part::Whole } else { Part::Rest };
        self.board.tell(&config, (file.path, fingerprint), part);
        let settings = config.settings();
        let run = match (begins.point, file.from) {
            (Some(point), _) => {
                let find = || Remainder::find(source, point, settings.tolerance_mm);
                let rest = bench.work("reading up to where it was left", find)?;
                let rest = rest.map_err(|error| Stop::Refused(error.to_string()))?;
                // What an abort or a fault has stopped turns before anything moves.
                let now = bench.publisher.auxiliary(bench.control);
                let now = now.map_err(|error| Stop::Failed(error.to_string()))?;
                let restoring = rest.restoring(&now);
                let restoring = restoring.map_err(|error| Stop::Refused(error.to_string()))?;
                attendant.begin_here()?;
                let line = rest.line();
                let pipeline = Pipeline::resuming(rest, settings).beginning_with(restoring, line);
                let run = Self::publish(pipeline, (&config, &attendant), start, bench, |rest| {
                    rest.source().in_force()
                });
                // Until then it can be resumed as before.
                if attendant.has_begun(bench.publisher) {
                    (self.has_lines, self.left) = (false, None);
                }
                run
            }
            (None, None) => {
                let pipeline = Pipeline::new(source, settings, start);
                let run = Self::publish(pipeline, (&config, &attendant), start, bench, |source| {
                    source.in_force()
                });
                if attendant.has_begun(bench.publisher) {
                    self.begin(fingerprint, start, &config);
                }
                run
            }
            (None, Some(from)) => {
                let approach = approach(&config, start, bench.publisher, bench.control)?;
                attendant.recall(fingerprint)?;
                let find = || LineStart::find(source, from, &approach);
                let found = bench.work("reading up to its line", find)?;
                let mut found = found.map_err(|error| Stop::Refused(error.to_string()))?;
                if !file.confirmed {
                    let text = agreement(from, &mut found, &approach, &config);
                    return Err(Stop::ToConfirm(text));
                }
                attendant.begin_with(found.block())?;
                let rest = found.approached(&approach);
                let pipeline = Pipeline::resuming(rest, settings);
                let run = Self::publish(pipeline, (&config, &attendant), start, bench, |rest| {
                    rest.source().in_force()
                });
                if attendant.has_begun(bench.publisher) {
                    self.begin(fingerprint, start, &config);
                }
                run
            }
        };
        let (mut run, in_force) = run;
        self.settle(&mut run, in_force, bench, &attendant, || {
            let options = unwatched(&config).program_options(begins.start);
            let source = FileSource::unchecked(file.path, options, &settings)?;
            Ok(match source.attended(recalling(&config, fingerprint)) {
                FileSource::Program(source) => Some(*source),
                FileSource::Curve(_) | FileSource::Nurbs(_) => None,
            })
        });
        let statistics = run?;
        Ok(format!(
            "{}: executed; {}, {}",
            file.path.display(),
            counted(statistics.lines, "line"),
            counted(statistics.segments, "segment")
        ))
    }

    /// A program has begun: no other one is resumed from now on.
    fn begin(&mut self, program: u64, start: AxisVector, config: &MachineConfig) {
        let in_force = config.program.in_force.clone();
        self.begun = Some(Begun {
            program,
            start,
            in_force,
        });
        (self.has_lines, self.left) = (false, None);
    }

    /// A line is about to take the place, at the interpolator, of a program that may have been left.
    fn keep_resume_point(&mut self, publisher: &Publisher<'_>) {
        if !self.has_lines {
            self.left = publisher.resume_point().ok();
        }
        self.has_lines = true;
    }

    /// Where the program was left that ended early, for a machine that stands at `start`: lines that were executed since
    /// do not count.
    fn resume_point(
        &self,
        publisher: &Publisher<'_>,
        start: AxisVector,
    ) -> Result<ResumePoint, RunError> {
        match self.left {
            Some(left) => Ok(ResumePoint {
                position: start,
                ..left
            }),
            None => publisher.resume_point(),
        }
    }

    /// Where a program is read from. One that is resumed is read with what it began with.
    fn begins(
        &self,
        file: &FileJob<'_>,
        start: AxisVector,
        config: &mut MachineConfig,
        (attendant, bench): (&Attendant, &Bench<'_, '_, '_>),
    ) -> Result<Begins, Stop> {
        if !file.resumes {
            return Ok(Begins { start, point: None });
        }
        let point = self.resume_point(bench.publisher, start);
        let mut point = point.map_err(|error| Stop::Refused(error.to_string()))?;
        let known = self.begun.as_ref();
        let known = known.filter(|begun| begun.program == point.program);
        if let Some(begun) = known {
            point.program_start = begun.start;
        }
        let in_force = known.and_then(|begun| begun.in_force.clone());
        if let Some(in_force) = in_force.as_ref().filter(|_| !attendant.keeps()) {
            config.program.offsets = in_force.work_offsets();
            config.program.tools = in_force.tools().cloned().or(config.program.tools.take());
        }
        config.program.in_force = in_force;
        attendant.resume(point.program, config)?;
        Ok(Begins {
            start: point.program_start,
            point: Some(point),
        })
    }

    /// Publishes what a pipeline plans. Returns what is in force at its end, too, if it came there.
    fn publish<S: ItemSource + Send>(
        pipeline: Pipeline<S>,
        (config, attendant): (&MachineConfig, &Attendant),
        start: AxisVector,
        bench: &mut Bench<'_, '_, '_>,
        in_force: impl FnOnce(&S) -> Option<InForce>,
    ) -> (Result<Statistics, Stop>, Option<InForce>) {
        let mut pipeline = pipeline
            .with_joints(config.path_caps())
            .with_clock(clock::elapsed);
        let fingerprint = pipeline.source().fingerprint();
        let begun = attendant
            .engage(bench.publisher, config)
            .and_then(|()| attendant.begin(fingerprint, &start));
        if let Err(failure) = begun {
            return (Err(failure.into()), None);
        }
        bench.note.leave(fingerprint);
        let published = {
            let control = &mut *bench.control;
            let mut notify = |notice: &Notice<'_>| {
                attendant.notice(notice, config);
                (control.notify)(notice);
            };
            let mut control = Control {
                stop: control.stop,
                pause: &mut *control.pause,
                notify: &mut notify,
            };
            bench
                .publisher
                .publish_and_attend(&mut pipeline, bench.attend, &mut control)
        };
        let kept = attendant.end(&published, bench.publisher, config);
        let left = published
            .is_ok()
            .then(|| in_force(pipeline.source()))
            .flatten();
        let run = published.map_err(|error| match error {
            RunError::Refused(error) => match refusal(&error) {
                // What was found on the way is not taken back.
                Stop::Refused(text) if attendant.has_started() => Stop::Failed(text),
                stop => stop,
            },
            error => {
                let file = bench.file.filter(|_| attendant.has_begun(bench.publisher));
                let left = file
                    .and_then(|file| going_on::told(&error, bench.publisher, ("run-file", file)));
                Stop::Failed(match left {
                    Some(left) => format!("{error}; {left}"),
                    None => error.to_string(),
                })
            }
        });
        // It was executed, and cannot be refused any more.
        let not_kept = |failure: Failure| Stop::Failed(format!("executed, but {failure}"));
        let run = run.and_then(|statistics| kept.map(|()| statistics).map_err(not_kept));
        (run, left)
    }

    /// Takes what is in force from now on: all that the job left, or, where its motion ended before
    /// it did, what it left at the block that was executed.
    fn settle<R: io::BufRead>(
        &mut self,
        run: &mut Result<Statistics, Stop>,
        left: Option<InForce>,
        bench: &mut Bench<'_, '_, '_>,
        attendant: &Attendant,
        again: impl FnOnce() -> Result<Option<ProgramSource<R>>, Refusal> + Send,
    ) {
        if left.is_some() {
            self.in_force = left;
            return;
        }
        if run.is_ok() || !attendant.has_begun(bench.publisher) {
            return;
        }
        let ended = JobLeft::of(bench.publisher, bench.control);
        let read = || again()?.map(|source| ended.read(source)).transpose();
        // Whoever wanted the job may not want it any more; what is in force is for the next one.
        let attend = &mut *bench.attend;
        let mut attend = |waited: Duration| {
            let _ended = attend.attend(waited, "");
        };
        let known = bench.publisher.work("", &mut attend, bench.control, read);
        match known {
            Ok(Ok(Some(in_force))) => self.in_force = Some(in_force),
            Ok(Ok(None)) | Err(_) => {}
            Ok(Err(error)) => {
                // Whoever goes on has to know: the next job begins with what was so before this one.
                let unknown = format!("modes and offsets are those from before it: {error}");
                match run {
                    Err(Stop::Failed(text)) => *text = format!("{text}; {unknown}"),
                    _ => output::note(&format!("planner: {unknown}")),
                }
            }
        }
    }
}

impl JobRunner for Workshop<'_> {
    fn facts(&self) -> Option<LineFacts> {
        let mut config = self.config.clone();
        // What is kept, or the job before has left.
        if let Ok(Some(kept)) = read(&config) {
            set_up(&mut config, &kept);
        } else if let Some(in_force) = &self.in_force {
            config.program.offsets = in_force.work_offsets();
        }
        config.program.in_force = self.in_force.clone();
        let home = config.home();
        let program = Program::new(io::empty(), of_sender(config).program_options(home));
        Some(LineFacts::of(&program))
    }

    fn run(
        &mut self,
        job: &Job,
        start: AxisVector,
        publisher: &mut Publisher<'_>,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> JobEnd {
        let link = self.link.clone();
        let mut bench = Bench {
            publisher,
            attend,
            control,
            note: ProgramNote::of_job(&link, job),
            file: match job {
                Job::File { path, .. } => Some(path),
                Job::Line(_) | Job::Lines { .. } => None,
            },
        };
        let end = match job {
            Job::Line(text) => self.line(text, start, &mut bench),
            Job::Lines { inbox, .. } => self.lines(inbox, start, &mut bench),
            Job::File {
                path,
                from,
                confirmed,
                resumes,
            } => {
                let (from, confirmed, resumes) = (*from, *confirmed, *resumes);
                let file = FileJob {
                    path,
                    from,
                    confirmed,
                    resumes,
                };
                self.file(&file, start, &mut bench)
            }
        };
        let (told, end) = match end {
            Ok(text) => (text.clone(), JobEnd::Done(text)),
            Err(Stop::Refused(text)) => (refused("job", &text), JobEnd::Refused(text)),
            Err(Stop::Failed(text)) => (text.clone(), JobEnd::Failed(text)),
            Err(Stop::ToConfirm(text)) => (
                "job waits to be agreed to".to_owned(),
                JobEnd::ToConfirm(text),
            ),
        };
        output::note(&format!("planner: {told}"));
        end
    }
}

/// A file, and how it is to begin.
struct FileJob<'j> {
    path: &'j Path,
    from: Option<StartLine>,
    confirmed: bool,
    resumes: bool,
}

/// What a program is read from.
struct Begins {
    /// Where the machine stands, or stood when the program began.
    start: AxisVector,
    /// Where it was left, if it is to go on there.
    point: Option<ResumePoint>,
}

/// A program as a file, checked from its beginning to its end.
fn open(path: &Path, config: &MachineConfig, start: AxisVector) -> Result<FileSource, Refusal> {
    joints::check_plan(path, config, start, &mut |_| {})?;
    FileSource::open(path, config.program_options(start), &config.settings())
}

/// For the lines of senders, whose language is nearest to that of `LinuxCNC`.
fn of_sender(mut config: MachineConfig) -> MachineConfig {
    config.program.dialect = Some(Dialect::LinuxCnc);
    config
}

/// For reading that goes on when the job is over.
fn unwatched(config: &MachineConfig) -> MachineConfig {
    let mut config = config.clone();
    config.program.watch = None;
    config
}

/// Why a job was not executed to its end.
pub(super) enum Stop {
    Refused(String),
    Failed(String),
    ToConfirm(String),
}

type End = Result<String, Stop>;

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        Self::Refused(failure.to_string())
    }
}

/// A device gives bytes without end, and a pipe none until somebody else writes: nobody else would be
/// served meanwhile.
fn must_be_a_file(path: &Path) -> Result<(), Stop> {
    let why = match path.metadata() {
        Ok(there) if there.is_file() => return Ok(()),
        Ok(_) => "it is no ordinary file".to_owned(),
        Err(error) => error.to_string(),
    };
    Err(Stop::Refused(format!("{}: {why}", path.display())))
}

/// A refusal in a few lines.
fn refusal(refusal: &Refusal) -> Stop {
    Stop::Refused(refusal_text(refusal))
}
