//! What is in force behind a job.

use std::io;
use std::time::Duration;

use glidepath_gcode::InForce;
use glidepath_planner::{ProgramSource, Refusal, Statistics};

use super::bench::Bench;
use super::state::Workshop;
use super::stop::Stop;
use crate::command::attendant::Attendant;
use crate::command::left_in_force::JobLeft;
use crate::output;

impl Workshop<'_> {
    /// Takes what is in force from now on: all that the job left, or, where its motion ended before
    /// it did, what it left at the block that was executed.
    pub(super) fn settle<R: io::BufRead>(
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
