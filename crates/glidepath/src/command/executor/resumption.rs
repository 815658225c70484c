//! The program that can be resumed: what it began with, and where it was left.

use std::path::Path;
use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_planner::{FramePublisher, ResumePoint, RunError, Statistics};

use super::file_job::FileJob;
use super::run_context::RunContext;
use super::state::{Begun, JobExecutor};
use super::stop::Stop;
use crate::command::begins_with::begun_with_ratio;
use crate::command::going_on::{self, Obstacle, Resumption};
use crate::command::reading::for_program;
use crate::command::run_supervisor::RunSupervisor;
use crate::config::MachineConfig;
use crate::program_file::ProgramFile;

/// What a program is read from.
pub(super) struct Begins {
    /// Where the machine stands, or stood when the program began.
    pub(super) start: AxisVector,
    /// Where it was left, if it is to go on there.
    pub(super) point: Option<ResumePoint>,
}

impl JobExecutor<'_> {
    /// A program has begun: no other one is resumed from now on.
    pub(super) fn begin(&mut self, program: u64, start: AxisVector, config: &MachineConfig) {
        let in_force = config.program.in_force.clone();
        self.begun = Some(Begun {
            program,
            start,
            tolerance_ratio: config.program.tolerance_ratio,
            in_force,
        });
        (self.has_lines, self.left) = (false, None);
    }

    /// A program has begun of which nobody knows how far it came: no other one is resumed either, which would go on
    /// where an older run was left.
    pub(super) fn forget(&mut self) {
        (self.begun, self.has_lines, self.left) = (None, false, None);
    }

    /// A line is about to take the place, at the interpolator, of a program that may have been left.
    pub(super) fn keep_resume_point(&mut self, publisher: &FramePublisher<'_>) {
        if !self.has_lines {
            self.left = publisher.resume_point().ok();
        }
        self.has_lines = true;
    }

    /// Where the program was left that ended early, for a machine that stands at `start`: lines that were executed since
    /// do not count.
    fn resume_point(
        &self,
        publisher: &FramePublisher<'_>,
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
    pub(super) fn begins(
        &self,
        file: &FileJob<'_>,
        start: AxisVector,
        config: &mut MachineConfig,
        (supervisor, context): (&RunSupervisor, &RunContext<'_, '_, '_>),
    ) -> Result<Begins, Stop> {
        if !file.resumes {
            return Ok(Begins { start, point: None });
        }
        let point = self.resume_point(context.publisher, start);
        let mut point = point.map_err(|error| Stop::Refused(error.to_string()))?;
        begun_with_ratio(config, &self.link, point.program);
        let known = self.begun.as_ref();
        let known = known.filter(|begun| begun.program == point.program);
        if let Some(begun) = known {
            point.program_start = begun.start;
            config.use_tolerance_ratio(begun.tolerance_ratio);
        }
        let in_force = known.and_then(|begun| begun.in_force.clone());
        if let Some(in_force) = in_force.as_ref().filter(|_| !supervisor.keeps()) {
            config.program.offsets = in_force.work_offsets();
            config.program.tools = in_force.tools().cloned().or(config.program.tools.take());
        }
        config.program.in_force = in_force;
        supervisor.resume(point.program, config)?;
        Ok(Begins {
            start: point.program_start,
            point: Some(point),
        })
    }

    /// Adds to why a program was not executed to its end how to go on with it.
    pub(super) fn tell_going_on(
        &self,
        run: &mut Result<Statistics, Stop>,
        (file, fingerprint): (&Path, u64),
        context: &mut RunContext<'_, '_, '_>,
    ) {
        let Some(error) = context.left_by.take() else {
            return;
        };
        let is_untried = going_on::is_under_way(context.publisher) || context.control.is_stopped();
        let tried = if is_untried {
            Err(Obstacle::Untried)
        } else {
            self.try_to_resume((file, fingerprint), context)
        };
        if let Err(Stop::Failed(text)) = run {
            let how = Resumption {
                command: "run-file",
                file,
                lifts: self.config.lifts_after_abort(),
            };
            let left = going_on::told(&error, context.publisher, how, tried);
            *text = format!("{text}; {left}");
        }
    }

    /// Does what a resumption does up to its motion.
    fn try_to_resume(
        &self,
        (file, fingerprint): (&Path, u64),
        context: &mut RunContext<'_, '_, '_>,
    ) -> Result<(), Obstacle> {
        let (config, supervisor) = self.set_up(1.0, context.publisher, context.control)?;
        let mut config = for_program(&ProgramFile::named(file), &config);
        let watch = going_on::trial_watch();
        config.program.watch = Some(watch.clone());
        going_on::must_be_the_text(file, &self.link, fingerprint)?;
        let job = FileJob {
            path: file,
            looked_at: None,
            tolerance_ratio: 1.0,
            from: None,
            confirmed: false,
            resumes: true,
        };
        let start = context.publisher.position().ok_or(Obstacle::Untried)?;
        let begins = self.begins(&job, start, &mut config, (&supervisor, &*context));
        let begins = begins.map_err(|stop| Obstacle::Other(stop.text()))?;
        let point = begins.point.ok_or(Obstacle::Untried)?;
        let find = || going_on::rest_of(file, fingerprint, &config, point);
        // Whoever wanted the job may not want it any more, and is told all the same.
        let attend = &mut *context.attend;
        let mut attend = |waited: Duration| {
            let _ended = attend.attend(waited, "");
        };
        let publisher = &mut *context.publisher;
        let found = publisher.work("", &mut attend, context.control, find);
        let found = found.map_err(|_| Obstacle::Untried)?;
        if watch.is_to_end() {
            return Err(Obstacle::Untried);
        }
        let rest = found?;
        let now = publisher.auxiliary(context.control);
        rest.restoring(&now.map_err(RunError::from)?)
            .map_err(RunError::from)?;
        Ok(())
    }
}
