//! The commit of state: what is in force behind a job.

use std::io;
use std::time::Duration;

use glidepath_gcode::InForce;
use glidepath_planner::{ProgramSource, Refusal, Statistics};

use super::run_context::RunContext;
use super::state::JobExecutor;
use super::stop::Stop;
use crate::command::left_in_force::JobLeft;
use crate::command::run_supervisor::RunSupervisor;
use crate::output;

impl JobExecutor<'_> {
    /// Takes what is in force from now on: all that the job left, or, where its motion ended before
    /// it did, what it left at the block that was executed.
    pub(super) fn commit_state<R: io::BufRead>(
        &mut self,
        run: &mut Result<Statistics, Stop>,
        left: Option<InForce>,
        context: &mut RunContext<'_, '_, '_>,
        supervisor: &RunSupervisor,
        again: impl FnOnce() -> Result<Option<ProgramSource<R>>, Refusal> + Send,
    ) {
        if left.is_some() {
            self.in_force = left;
            return;
        }
        if run.is_ok() || !supervisor.has_begun(context.publisher) {
            return;
        }
        let ended = JobLeft::of(context.publisher, context.control);
        let read = || again()?.map(|source| ended.read(source)).transpose();
        // Whoever wanted the job may not want it any more; what is in force is for the next one.
        let attend = &mut *context.attend;
        let mut attend = |waited: Duration| {
            let _ended = attend.attend(waited, "");
        };
        let known = context
            .publisher
            .work("", &mut attend, context.control, read);
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
