//! The statuses, which tell others of the machine now and then, and once more at the end.

use super::Ports;
use crate::shared::config::stops::StopCause;
use glidepath_link::LinkError;

/// Between two statuses.
const STATUS_NS: u64 = 20_000_000;

impl Ports<'_> {
    pub(super) fn publish_status(&mut self, now_ns: u64) -> Result<(), LinkError> {
        if now_ns < self.status_due_ns {
            return Ok(());
        }
        self.status_due_ns = now_ns + STATUS_NS;
        let Some(report) = self.report else {
            return Ok(());
        };
        let waiting = self.ends.frames.len() as u64;
        self.book
            .write(&report, &self.frame_validator, waiting, now_ns);
        self.book.status.awaited_words = self.auxiliary.awaited_words();
        self.auxiliary
            .watch_program(self.book.status.program, report.end_of_epoch);
        self.book.status.spindle_override = self.auxiliary.spindle_override();
        self.book.status.state = self.jobs.state(&report).code();
        self.jobs.write(&mut self.book.status);
        if let Some(drives) = &self.drives {
            drives.write(&mut self.book.status, now_ns);
        }
        self.links.setpoints.refresh()?;
        self.links.auxiliary.refresh()?;
        self.links.status.publish(&self.book.status)?;
        if !core::mem::replace(&mut self.has_told_ready, true) {
            (self.log)("ready: it gives setpoints and takes commands");
        }
        Ok(())
    }

    /// Publishes a status at once: the last of this life.
    pub(crate) fn farewell(&mut self, now_ns: u64) {
        self.status_due_ns = 0;
        self.auxiliary.stop(StopCause::Abort);
        let told = self.publish_auxiliary();
        if let Err(error) = told.and(self.publish_status(now_ns)) {
            (self.log)(&error.to_string());
        }
    }
}
