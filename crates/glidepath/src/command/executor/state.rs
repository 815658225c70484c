//! The state of the executor between jobs, and what every job begins with.

use glidepath_gcode::{Dialect, InForce};
use glidepath_geometry::AxisVector;
use glidepath_link::LinkConfig;
use glidepath_planner::{Control, FramePublisher, ResumePoint};

use crate::begun::Board;
use crate::command::failure::Failure;
use crate::command::left_in_force::as_machine_tells;
use crate::command::run_supervisor::RunSupervisor;
use crate::config::MachineConfig;
use crate::in_force_note::InForceNote;

/// Executes jobs one after the other.
#[derive(Debug)]
pub(in crate::command) struct JobExecutor<'c> {
    pub(super) config: &'c MachineConfig,
    pub(super) link: LinkConfig,
    pub(super) board: &'c Board,
    /// What the job before has left in force.
    pub(super) in_force: Option<InForce>,
    /// Where that is noted for others.
    pub(super) note: InForceNote,
    /// The program begun last.
    pub(super) begun: Option<Begun>,
    /// Lines were executed since that program.
    pub(super) has_lines: bool,
    /// Where it was left, if it ended early and lines were executed since.
    pub(super) left: Option<ResumePoint>,
}

impl<'c> JobExecutor<'c> {
    pub(in crate::command) fn new(
        config: &'c MachineConfig,
        link: LinkConfig,
        board: &'c Board,
    ) -> Self {
        Self {
            config,
            note: InForceNote::begin(&link, config),
            link,
            board,
            in_force: None,
            begun: None,
            has_lines: false,
            left: None,
        }
    }

    /// The configuration and the supervisor of the next job, which may use so many times its tolerance.
    pub(super) fn set_up(
        &self,
        tolerance_ratio: f64,
        publisher: &FramePublisher<'_>,
        control: &mut Control<'_>,
    ) -> Result<(MachineConfig, RunSupervisor), Failure> {
        let mut config = self.config.clone();
        config.use_tolerance_ratio(tolerance_ratio);
        let supervisor = RunSupervisor::new(&mut config, self.link.directory(), true)?;
        if let Some(in_force) = self.in_force.as_ref().filter(|_| !supervisor.keeps()) {
            config.program.offsets = in_force.work_offsets();
            config.program.tools = in_force.tools().cloned().or(config.program.tools);
        }
        // A machine that does not tell is taken for what was left.
        let told = publisher.auxiliary(control).ok();
        config.program.in_force = self.in_force.as_ref().map(|in_force| match &told {
            Some(told) => as_machine_tells(in_force, told),
            None => in_force.clone(),
        });
        config.program.watch = Some(publisher.watch());
        Ok((config, supervisor))
    }
}

/// A program, and what it began with.
#[derive(Debug)]
pub(super) struct Begun {
    pub(super) program: u64,
    pub(super) start: AxisVector,
    pub(super) tolerance_ratio: f64,
    pub(super) in_force: Option<InForce>,
}

/// For the lines of senders and pages, whose language is that of `LinuxCNC`, or nearest to it.
pub(super) fn of_sender(mut config: MachineConfig) -> MachineConfig {
    config.program.dialect = Some(Dialect::LinuxCnc);
    config
}

/// For reading that goes on when the job is over.
pub(super) fn unwatched(config: &MachineConfig) -> MachineConfig {
    let mut config = config.clone();
    config.program.watch = None;
    config
}
