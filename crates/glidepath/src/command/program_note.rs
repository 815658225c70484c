//! The note that a planner leaves, so that others know which program the machine executes.

use crate::output;
use glidepath_link::{ActiveProgram, LinkConfig};
use glidepath_planner::Job;
use std::path::Path;

/// The note of a job; of a line or a pipe there is none.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProgramNote<'a> {
    link: &'a LinkConfig,
    file: Option<&'a Path>,
}

impl<'a> ProgramNote<'a> {
    /// The note of a program in a file.
    pub(super) const fn of_file(link: &'a LinkConfig, file: &'a Path) -> Self {
        let file = Some(file);
        Self { link, file }
    }

    /// The note of a job of the service.
    pub(super) fn of_job(link: &'a LinkConfig, job: &'a Job) -> Self {
        let file = match job {
            Job::File { path, .. } => Some(path.as_path()),
            Job::Line(_) | Job::Sequence(_) | Job::Lines { .. } => None,
        };
        Self { link, file }
    }

    /// Leaves it, before the first frame of the program, which may use so many times its tolerance. Where that fails the
    /// program runs all the same: whoever shows the machine does not know its text.
    pub(super) fn leave(&self, fingerprint: u64, tolerance_ratio: f64) {
        let Some(file) = self.file.filter(|_| fingerprint != 0) else {
            return;
        };
        let Ok(file) = file.canonicalize() else {
            return;
        };
        let bytes = file.metadata().map_or(0, |about| about.len());
        let active = ActiveProgram {
            fingerprint,
            bytes,
            tolerance_ratio,
            file,
        };
        if let Err(error) = active.leave(self.link) {
            output::note(&format!(
                "planner: pages will not know the program: {error}"
            ));
        }
    }
}
