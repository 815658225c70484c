//! The program that can be resumed: what it began with, and where it was left.

use glidepath_geometry::AxisVector;
use glidepath_planner::{FramePublisher, ResumePoint, RunError};

use super::file_job::FileJob;
use super::run_context::RunContext;
use super::state::{Begun, JobExecutor};
use super::stop::Stop;
use crate::command::run_supervisor::RunSupervisor;
use crate::config::MachineConfig;

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
}
