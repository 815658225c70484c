//! What the planner's service executes for operators: lines and files, with modal state kept between.

use super::attendant::{Attendant, recalling};
use super::differences::{agreement, approach};
use super::failure::Failure;
use super::reading::for_program;
use crate::clock;
use crate::config::MachineConfig;
use crate::joints;
use crate::output;
use crate::program_file::ProgramFile;
use crate::report::counted;
use glidepath_gcode::{InForce, Program};
use glidepath_geometry::AxisVector;
use glidepath_link::refused;
use glidepath_planner::{
    Control, FileSource, ItemSource, Job, JobEnd, JobRunner, LineStart, Notice, Pipeline,
    ProgramSource, Publisher, Refusal, RunError, StartLine, Statistics, Supply,
};
use std::io::Cursor;
use std::path::Path;
use std::time::Duration;

/// The line of an operator as a program.
type LineSource = ProgramSource<Cursor<Vec<u8>>>;

/// Executes jobs one after the other.
#[derive(Debug)]
pub(super) struct Workshop<'c> {
    config: &'c MachineConfig,
    /// What the job before has left in force.
    in_force: Option<InForce>,
}

/// The side of the service while a job runs.
struct Bench<'b, 't, 'c> {
    publisher: &'b mut Publisher<'t>,
    attend: &'b mut dyn FnMut(Duration),
    control: &'b mut Control<'c>,
}

impl<'c> Workshop<'c> {
    pub(super) const fn new(config: &'c MachineConfig) -> Self {
        Self {
            config,
            in_force: None,
        }
    }

    /// The configuration and the attendant of the next job.
    fn set_up(&self) -> Result<(MachineConfig, Attendant), Failure> {
        let mut config = self.config.clone();
        let attendant = Attendant::new(&mut config, true)?;
        if let Some(in_force) = self.in_force.as_ref().filter(|_| !attendant.keeps()) {
            config.program.offsets = in_force.work_offsets();
            config.program.tools = in_force.tools().cloned().or(config.program.tools);
        }
        config.program.in_force = self.in_force.clone();
        Ok((config, attendant))
    }

    /// A line: refused as a whole, or executed, and then what it left is in force.
    fn line(&mut self, text: &str, start: AxisVector, bench: &mut Bench<'_, '_, '_>) -> End {
        if text.contains(['\n', '\r']) {
            return Err(Stop::Refused("give one line at a time".to_owned()));
        }
        let (config, attendant) = self.set_up()?;
        let text = format!("{text}\n").into_bytes();
        let options = || config.program_options(start);
        for item in Program::new(text.as_slice(), options()) {
            item.map_err(|diagnostic| {
                refusal(&Refusal::Program {
                    diagnostics: vec![diagnostic],
                    unlisted: 0,
                })
            })?;
        }
        let source = || LineSource::new(Cursor::new(text.clone()), options());
        let attended = source().attended(attendant.attending());
        let pipeline = Pipeline::new(attended, config.settings(), start);
        let (run, in_force) = Self::publish(pipeline, (&config, &attendant), start, bench, |p| {
            Some(p.in_force())
        });
        self.settle(&run, in_force, bench, &attendant, || {
            Ok(Some(source().attended(recalling(&config, 0))))
        });
        let statistics = run?;
        Ok(format!(
            "executed; {}",
            counted(statistics.segments, "segment")
        ))
    }

    /// A file, from its beginning or from a line.
    fn file(
        &mut self,
        path: &Path,
        from: Option<StartLine>,
        confirmed: bool,
        start: AxisVector,
        bench: &mut Bench<'_, '_, '_>,
    ) -> End {
        must_be_a_file(path)?;
        let (config, attendant) = self.set_up()?;
        let config = for_program(&ProgramFile::named(path), &config);
        joints::check_plan(path, &config, start, &mut |_| {}).map_err(|e| refusal(&e))?;
        let open = || FileSource::open(path, config.program_options(start), &config.settings());
        let source = open().map_err(|e| refusal(&e))?;
        let source = source.attended(attendant.attending());
        let (run, in_force) = match from {
            None => {
                let pipeline = Pipeline::new(source, config.settings(), start);
                Self::publish(pipeline, (&config, &attendant), start, bench, |source| {
                    source.in_force()
                })
            }
            Some(from) => {
                let approach = approach(&config, start, bench.publisher, bench.control)?;
                attendant.recall(source.fingerprint())?;
                let found = LineStart::find(source, from, &approach)
                    .map_err(|error| Stop::Refused(error.to_string()))?;
                if !confirmed {
                    return Err(Stop::ToConfirm(agreement(from, &found, &approach, &config)));
                }
                attendant.begin_with(found.block())?;
                let rest = found.approached(&approach);
                let pipeline = Pipeline::resuming(rest, config.settings());
                Self::publish(pipeline, (&config, &attendant), start, bench, |rest| {
                    rest.source().in_force()
                })
            }
        };
        self.settle(&run, in_force, bench, &attendant, || {
            let source = open()?;
            let recalling = recalling(&config, source.fingerprint());
            Ok(match source.attended(recalling) {
                FileSource::Program(source) => Some(*source),
                FileSource::Curve(_) | FileSource::Nurbs(_) => None,
            })
        });
        let statistics = run?;
        Ok(format!(
            "{}: executed; {}, {}",
            path.display(),
            counted(statistics.lines, "line"),
            counted(statistics.segments, "segment")
        ))
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
        let begun = attendant
            .engage(bench.publisher, config)
            .and_then(|()| attendant.begin(pipeline.source().fingerprint(), &start));
        if let Err(failure) = begun {
            return (Err(failure.into()), None);
        }
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
            error => Stop::Failed(error.to_string()),
        });
        let run = run.and_then(|statistics| kept.map(|()| statistics).map_err(Stop::from));
        (run, left)
    }

    /// Takes what is in force from now on: all that the job left, or, where its motion ended before
    /// it did, what it left at the block that was executed.
    fn settle<R: std::io::BufRead>(
        &mut self,
        run: &Result<Statistics, Stop>,
        left: Option<InForce>,
        bench: &Bench<'_, '_, '_>,
        attendant: &Attendant,
        again: impl FnOnce() -> Result<Option<ProgramSource<R>>, Refusal>,
    ) {
        if left.is_some() {
            self.in_force = left;
        }
        if run.is_ok() || !attendant.has_started() {
            return;
        }
        let block = bench.publisher.block();
        let Ok(Some(mut source)) = again() else {
            return;
        };
        for _ in 0..block {
            match source.next_item() {
                Supply::Item(_) => {}
                Supply::Refused(error) => {
                    output::note(&format!("planner: what was in force is not known: {error}"));
                    return;
                }
                Supply::Pending | Supply::Probe | Supply::End => break,
            }
        }
        self.in_force = Some(source.in_force());
    }
}

impl JobRunner for Workshop<'_> {
    fn run(
        &mut self,
        job: &Job,
        start: AxisVector,
        publisher: &mut Publisher<'_>,
        attend: &mut dyn FnMut(Duration),
        control: &mut Control<'_>,
    ) -> JobEnd {
        let mut bench = Bench {
            publisher,
            attend,
            control,
        };
        let end = match job {
            Job::Line(text) => self.line(text, start, &mut bench),
            Job::File {
                path,
                from,
                confirmed,
            } => self.file(path, *from, *confirmed, start, &mut bench),
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
    const MOST: usize = 5;
    let Refusal::Program {
        diagnostics,
        unlisted,
    } = refusal
    else {
        return Stop::Refused(refusal.to_string());
    };
    let mut lines: Vec<String> = diagnostics
        .iter()
        .take(MOST)
        .map(|found| {
            let help = &found.help;
            format!(
                "line {}, column {}: {}; {help}",
                found.line, found.column, found.message
            )
        })
        .collect();
    let more = diagnostics.len().saturating_sub(MOST) as u64 + u64::from(*unlisted);
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    Stop::Refused(lines.join("\n"))
}
