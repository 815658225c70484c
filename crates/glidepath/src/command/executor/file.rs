//! Files: a program from its beginning, from a line, or from where it was left.

use std::path::Path;

use glidepath_gcode::{InForce, Lacking};
use glidepath_geometry::AxisVector;
use glidepath_planner::{
    FileSource, ItemSource as _, LineStart, Pipeline, Refusal, Remainder, ResumePoint, StartLine,
    Statistics,
};

use super::file_job::FileJob;
use super::run_context::RunContext;
use super::state::{JobExecutor, unwatched};
use super::stop::{End, Stop, refusal};
use crate::begun::Part;
use crate::command::differences::{agreement, approach};
use crate::command::reading::for_program;
use crate::command::run_supervisor::{RunSupervisor, recalling};
use crate::config::MachineConfig;
use crate::joints;
use crate::output;
use crate::program_file::ProgramFile;
use crate::report::{WARNING, counted, driven, warnings};

/// A file with the configuration for it, and what is kept beside it.
type FileWork<'f> = (&'f FileJob<'f>, &'f MachineConfig, &'f RunSupervisor);
/// How a motion ended, and what is in force then.
type Published = (Result<Statistics, Stop>, Option<InForce>);

impl JobExecutor<'_> {
    /// A file, from its beginning, from a line, or from where it was left.
    pub(super) fn file(
        &mut self,
        file: &FileJob<'_>,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> End {
        must_be_a_file(file.path)?;
        let ratio = file.tolerance_ratio;
        let (config, supervisor) = self.set_up(ratio, context.publisher, context.control)?;
        let mut config = for_program(&ProgramFile::named(file.path), &config);
        let begins = self.begins(file, start, &mut config, (&supervisor, &*context))?;
        let config = config;
        let source = context.work("checking", || open(file.path, &config, begins.start))?;
        let (source, lacks) = source.map_err(|e| refusal(&e))?;
        warn(lacks, file, context);
        let source = source.attended(supervisor.channels());
        let fingerprint = source.fingerprint();
        must_be_the_program(file, fingerprint)?;
        let is_whole = begins.point.is_none() && file.from.is_none();
        let part = if is_whole { Part::Whole } else { Part::Rest };
        self.board.tell(&config, (file.path, fingerprint), part);
        let settings = config.settings();
        let job = (file, &config, &supervisor);
        let run = match (begins.point, file.from) {
            (Some(point), _) => self.rest(source, point, job, start, context)?,
            (None, None) => self.whole(source, job, start, context),
            (None, Some(from)) => self.behind_line(source, from, job, start, context)?,
        };
        let (mut run, in_force) = run;
        self.commit_state(&mut run, in_force, context, &supervisor, || {
            let options = unwatched(&config).program_options(begins.start);
            let source = FileSource::unchecked(file.path, options, &settings)?;
            Ok(match source.attended(recalling(&config, fingerprint)) {
                FileSource::Program(source) => Some(*source),
                FileSource::Curve(_) | FileSource::Nurbs(_) => None,
            })
        });
        self.tell_going_on(&mut run, (file.path, fingerprint), context);
        let statistics = run?;
        Ok(format!(
            "{}: executed; {}, {}",
            file.path.display(),
            counted(statistics.lines, "line"),
            driven(statistics.segments)
        ))
    }

    /// All of a program.
    fn whole(
        &mut self,
        source: FileSource,
        (_, config, supervisor): FileWork<'_>,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> Published {
        let fingerprint = source.fingerprint();
        let pipeline = Pipeline::new(source, config.settings(), start);
        let run = context.publish(pipeline, (config, supervisor), start, FileSource::in_force);
        if supervisor.has_begun(context.publisher) {
            self.begin(fingerprint, start, config);
        } else if supervisor.is_lost() {
            self.forget();
        }
        run
    }

    /// A program from where it was left on.
    fn rest(
        &mut self,
        source: FileSource,
        point: ResumePoint,
        (_, config, supervisor): FileWork<'_>,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> Result<Published, Stop> {
        let settings = config.settings();
        let find = || Remainder::find(source, point, settings.tolerance_mm);
        let rest = context.work("reading up to where it was left", find)?;
        let rest = rest.map_err(|error| Stop::Refused(error.to_string()))?;
        // What an abort or a fault has stopped turns before anything moves.
        let now = context.publisher.auxiliary(context.control);
        let now = now.map_err(|error| Stop::Failed(error.to_string()))?;
        let restoring = rest.restoring(&now);
        let restoring = restoring.map_err(|error| Stop::Refused(error.to_string()))?;
        supervisor.begin_here()?;
        let line = rest.line();
        let pipeline = Pipeline::resuming(rest, settings).beginning_with(restoring, line);
        let run = context.publish(pipeline, (config, supervisor), start, |rest| {
            rest.source().in_force()
        });
        // Until then it can be resumed as before.
        if supervisor.has_begun(context.publisher) {
            (self.has_lines, self.left) = (false, None);
        } else if supervisor.is_lost() {
            self.forget();
        }
        Ok(run)
    }

    /// A program from a line on.
    fn behind_line(
        &mut self,
        source: FileSource,
        from: StartLine,
        (file, config, supervisor): FileWork<'_>,
        start: AxisVector,
        context: &mut RunContext<'_, '_, '_>,
    ) -> Result<Published, Stop> {
        let fingerprint = source.fingerprint();
        let approach = approach(config, start, context.publisher, context.control)?;
        supervisor.recall(fingerprint)?;
        let find = || LineStart::find(source, from, &approach);
        let found = context.work("reading up to its line", find)?;
        let mut found = found.map_err(|error| Stop::Refused(error.to_string()))?;
        if !file.confirmed {
            let text = agreement(from, &mut found, &approach, config);
            return Err(Stop::ToConfirm(text));
        }
        supervisor.begin_with(found.block())?;
        let rest = found.approached(&approach);
        let pipeline = Pipeline::resuming(rest, config.settings());
        let run = context.publish(pipeline, (config, supervisor), start, |rest| {
            rest.source().in_force()
        });
        if supervisor.has_begun(context.publisher) {
            self.begin(fingerprint, start, config);
        } else if supervisor.is_lost() {
            self.forget();
        }
        Ok(run)
    }
}

/// A program as a file, checked from its beginning to its end.
fn open(
    path: &Path,
    config: &MachineConfig,
    start: AxisVector,
) -> Result<(FileSource, Lacking), Refusal> {
    joints::check_plan(path, config, start, &mut |_| {})?;
    let looked = FileSource::look(path, config.program_options(start), &config.settings())?;
    Ok((looked.source?, looked.lacks))
}

/// Tells whoever wants the job, and whoever looks at the service, what the program should say and does not.
fn warn(lacks: Lacking, file: &FileJob<'_>, context: &mut RunContext<'_, '_, '_>) {
    let lines: Vec<String> = warnings(lacks)
        .map(|words| format!("{WARNING}{words}"))
        .collect();
    for line in &lines {
        output::note(&format!("planner: {}: {line}", file.path.display()));
    }
    context.attend.warn(&lines.join("\n"));
}

/// Whoever wanted the job has looked at a program, and agreed to that one.
fn must_be_the_program(file: &FileJob<'_>, fingerprint: u64) -> Result<(), Stop> {
    if file.looked_at.is_none_or(|program| program == fingerprint) {
        return Ok(());
    }
    Err(Stop::Changed(format!(
        "{}: it, or a subroutine that it calls, is not the text any more that was looked at; look at it again",
        file.path.display()
    )))
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
