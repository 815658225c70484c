//! The executor of the planner's service: lines and files of operators, with modal state kept
//! between.

mod bench;
mod file;
mod lines;
mod resumption;
mod settle;
mod stop;

use std::io;

use glidepath_gcode::{Dialect, InForce, Program};
use glidepath_geometry::AxisVector;
use glidepath_link::{LinkConfig, refused};
use glidepath_planner::{
    Attend, Control, Job, JobEnd, JobRunner, LineFacts, Publisher, ResumePoint,
};

use super::attendant::Attendant;
use super::failure::Failure;
use super::program_note::ProgramNote;
use crate::begun::Board;
use crate::config::MachineConfig;
use crate::kept::read::{read, set_up};
use crate::output;
use bench::Bench;
use file::FileJob;
use resumption::Begun;
pub(super) use stop::Stop;

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
