//! The trait of whoever attends to clients while a job is prepared and runs.

use std::time::Duration;

use crate::source::sent::Followed;

/// The outcome of attending.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Attended {
    /// The job goes on.
    GoesOn,
    /// There is nothing to execute, and there will not be: nothing begins.
    IsEmpty,
    /// It is to end: nothing begins, or the motion comes to rest on the path. Why, for people.
    End(String),
}

/// Attends to others than the interpolator: to clients that ask, and may want the job to end.
pub trait Attend {
    /// Called every few milliseconds with the time waited since the last call, and with what is being
    /// done for the job.
    fn attend(&mut self, waited: Duration, doing: &str) -> Attended;

    /// Told what whoever wants the job should know of its program, before its first frame, a line for each.
    fn warn(&mut self, warnings: &str) {
        let _nobody = warnings;
    }

    /// Told how far what was given out is executed, right before that.
    fn follow(&mut self, followed: &Followed) {
        let _nobody = followed;
    }

    /// What is being done before the first frame, if that is not planning.
    fn doing(&self) -> Option<&'static str> {
        None
    }

    /// Asked when the first frame is ready, until the answer is yes.
    fn may_begin(&mut self) -> bool {
        true
    }
}

/// Attends to nobody who could end the job.
impl<F: FnMut(Duration)> Attend for F {
    fn attend(&mut self, waited: Duration, _doing: &str) -> Attended {
        self(waited);
        Attended::GoesOn
    }
}
