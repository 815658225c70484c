//! The run context: the service's side of a job that runs. Long work is done while the service answers,
//! and what was planned is published.

use glidepath_gcode::InForce;
use glidepath_geometry::AxisVector;
use glidepath_planner::{
    Attend, Control, FramePublisher, ItemSource, Notice, Pipeline, RunError, Statistics,
};

use super::stop::{Stop, refusal};
use crate::clock;
use crate::command::failure::Failure;
use crate::command::going_on;
use crate::command::program_note::ProgramNote;
use crate::command::run_supervisor::RunSupervisor;
use crate::config::MachineConfig;

/// The run context: the service's side of a job that runs.
pub(super) struct RunContext<'b, 't, 'c> {
    pub(super) publisher: &'b mut FramePublisher<'t>,
    pub(super) attend: &'b mut dyn Attend,
    pub(super) control: &'b mut Control<'c>,
    pub(super) note: ProgramNote<'b>,
    /// Why the motion ended before the program did, if that may be gone on with.
    pub(super) left_by: Option<RunError>,
}

impl RunContext<'_, '_, '_> {
    /// Has something done that takes long, while the service answers.
    pub(super) fn work<T: Send>(
        &mut self,
        doing: &str,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, Stop> {
        let done = self
            .publisher
            .work(doing, &mut *self.attend, self.control, work);
        done.map_err(|error| Stop::Failed(error.to_string()))
    }

    /// Publishes what a pipeline plans. Returns what is in force at its end, too, if it came there.
    pub(super) fn publish<S: ItemSource + Send>(
        &mut self,
        pipeline: Pipeline<S>,
        (config, supervisor): (&MachineConfig, &RunSupervisor),
        start: AxisVector,
        in_force: impl FnOnce(&S) -> Option<InForce>,
    ) -> (Result<Statistics, Stop>, Option<InForce>) {
        let mut pipeline = pipeline
            .with_joints(config.limited_mechanism())
            .with_clock(clock::elapsed);
        let fingerprint = pipeline.source().fingerprint();
        let begun = supervisor
            .attach(self.publisher, config)
            .and_then(|()| supervisor.begin((fingerprint, config.program.tolerance_ratio), &start));
        if let Err(failure) = begun {
            return (Err(failure.into()), None);
        }
        self.note.leave(fingerprint, config.program.tolerance_ratio);
        let published = {
            let control = &mut *self.control;
            let mut notify = |notice: &Notice<'_>| {
                supervisor.notice(notice, config);
                (control.notify)(notice);
            };
            let mut control = Control {
                stop: control.stop,
                pause: &mut *control.pause,
                notify: &mut notify,
            };
            self.publisher
                .publish_and_attend(&mut pipeline, self.attend, &mut control)
        };
        let kept = supervisor.end(&published, self.publisher, config);
        let left = published
            .is_ok()
            .then(|| in_force(pipeline.source()))
            .flatten();
        let run = published.map_err(|error| match error {
            RunError::Refused(error) => match refusal(&error) {
                // What was found on the way is not taken back.
                Stop::Refused(text) if supervisor.has_started() => Stop::Failed(text),
                stop => stop,
            },
            error => {
                let stop = Stop::Failed(error.to_string());
                let may_go_on = supervisor.has_begun(self.publisher)
                    && going_on::may_go_on(&error, self.publisher);
                self.left_by = may_go_on.then_some(error);
                stop
            }
        });
        // It was executed, and cannot be refused any more.
        let not_kept = |failure: Failure| Stop::Failed(format!("executed, but {failure}"));
        let run = run.and_then(|statistics| kept.map(|()| statistics).map_err(not_kept));
        (run, left)
    }
}
