//! The executor as the service sees it: one job after the other.

use std::io;

use glidepath_gcode::Program;
use glidepath_geometry::AxisVector;
use glidepath_link::refused;
use glidepath_planner::{Attend, Control, FramePublisher, Job, JobEnd, JobRunner, LineFacts};

use super::file_job::FileJob;
use super::run_context::RunContext;
use super::state::{JobExecutor, of_sender};
use super::stop::Stop;
use crate::command::program_note::ProgramNote;
use crate::output;
use crate::persistence::read::{read, set_up};

impl JobRunner for JobExecutor<'_> {
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

    fn reset(&mut self) {
        self.begin_anew();
    }

    fn run(
        &mut self,
        job: &Job,
        start: AxisVector,
        publisher: &mut FramePublisher<'_>,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> JobEnd {
        let link = self.link.clone();
        let mut context = RunContext {
            publisher,
            attend,
            control,
            note: ProgramNote::of_job(&link, job),
            left_by: None,
        };
        let before = self.in_force.clone();
        let end = match job {
            Job::Line(text) => self.line(text, start, &mut context),
            Job::Sequence(text) => self.sequence(text, start, &mut context),
            Job::Lines { inbox, .. } => self.lines(inbox, start, &mut context),
            Job::File {
                path,
                looked_at,
                tolerance_ratio,
                from,
                confirmed,
                resumes,
            } => {
                let (from, confirmed, resumes) = (*from, *confirmed, *resumes);
                let file = FileJob {
                    path,
                    looked_at: *looked_at,
                    tolerance_ratio: *tolerance_ratio,
                    from,
                    confirmed,
                    resumes,
                };
                self.file(&file, start, &mut context)
            }
        };
        let (told, end) = match end {
            Ok(text) => (text.clone(), JobEnd::Done(text)),
            Err(Stop::Refused(text)) => (refused("job", &text), JobEnd::Refused(text)),
            Err(Stop::Failed(text)) => (text.clone(), JobEnd::Failed(text)),
            Err(Stop::Changed(text)) => (refused("job", &text), JobEnd::Changed(text)),
            Err(Stop::ToConfirm(text)) => (
                "job waits to be agreed to".to_owned(),
                JobEnd::ToConfirm(text),
            ),
        };
        output::note(&format!("planner: {told}"));
        if let Some(in_force) = self
            .in_force
            .as_ref()
            .filter(|it| Some(*it) != before.as_ref())
            && let Err(error) = self.note.leave(in_force)
        {
            output::note(&format!(
                "planner: whoever reads a program beside it does not know what is in force: {error}"
            ));
        }
        end
    }
}
