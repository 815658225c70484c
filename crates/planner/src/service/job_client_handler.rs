//! The handler of the client of a job that is executed.

use std::time::Duration;

use glidepath_link::LinkError;

use crate::exchange::attend::{Attend, Attended};
use crate::service::job_queue::JobQueue;
use crate::source::sent::Followed;

/// The handler of the client of a job, which tells others that the planner is busy.
pub(crate) struct JobClientHandler<'a> {
    pub(crate) jobs: &'a mut JobQueue,
    /// Serves whoever wants to stream segments.
    pub(crate) refuse: &'a mut dyn FnMut(&str) -> Result<(), LinkError>,
    pub(crate) failed: Result<(), LinkError>,
}

impl Attend for JobClientHandler<'_> {
    fn attend(&mut self, waited: Duration, doing: &str) -> Attended {
        let busy = self.jobs.busy();
        let served = (self.refuse)(&busy).and_then(|()| self.jobs.serve_busy(waited, doing));
        match served {
            Ok(Some(why)) => Attended::End(why.to_owned()),
            Ok(None) => Attended::GoesOn,
            Err(error) => {
                if self.failed.is_ok() {
                    self.failed = Err(error);
                }
                Attended::GoesOn
            }
        }
    }

    fn warn(&mut self, warnings: &str) {
        self.jobs.warn(warnings);
    }

    fn follow(&mut self, followed: &Followed) {
        self.jobs.follow(followed);
    }

    fn may_begin(&mut self) -> bool {
        self.jobs.may_begin()
    }
}
