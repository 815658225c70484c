//! How to go on with a program whose planner died or hangs, as its client can know: nobody has read up to where it was
//! left.

use glidepath_link::{JobStage, LinkConfig, LinkError, Operator, Status};
use std::time::Duration;

/// How long the interpolator may take to answer.
const PATIENCE: Duration = Duration::from_millis(500);

/// What is known of a program without its planner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Known {
    /// No frame of it came.
    NotBegun,
    /// It may have begun; the interpolator knows how far it came.
    MayHaveBegun,
    /// The interpolator is no more, either.
    Nothing,
}

/// What is to be done for the program of this file name when a planner serves again, which the command `resume` goes on
/// with.
pub(super) fn told(link: &LinkConfig, name: &str, resume: &str) -> String {
    let status = Operator::find(link).and_then(|operator| operator.status(PATIENCE));
    text(known(&status, name), resume)
}

fn known(status: &Result<Option<Status>, LinkError>, name: &str) -> Known {
    match status {
        Err(LinkError::NoServer { .. }) => Known::Nothing,
        Ok(Some(status)) if waits(status, name) => Known::NotBegun,
        Ok(_) | Err(_) => Known::MayHaveBegun,
    }
}

/// Whether a job of this name has the machine, or waits for it, and no frame of it came.
fn waits(status: &Status, name: &str) -> bool {
    let stage = status.job_stage();
    let is_to_come = matches!(stage, Ok(JobStage::Waiting | JobStage::Preparing));
    is_to_come && status.job.as_str().starts_with(name)
}

fn text(known: Known, resume: &str) -> String {
    match known {
        Known::NotBegun => "nothing of the program was executed: start it again then".to_owned(),
        Known::MayHaveBegun => {
            format!("then {resume} goes on with the program, or says why that cannot be")
        }
        Known::Nothing => "no interpolator runs either, so nobody knows where the program was left: start \
             `glidepath interpolator`, too, and run the program from its beginning or from a line (--from-line)"
            .to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::Text;

    #[test]
    fn a_resumption_is_told_where_there_may_be_one() {
        let mut status: Status = bytemuck::Zeroable::zeroed();
        (status.job, status.job_stage) =
            (Text::new("part.ngc: checking"), JobStage::Preparing.code());
        assert_eq!(known(&Ok(Some(status)), "part.ngc"), Known::NotBegun);
        assert_eq!(known(&Ok(Some(status)), "other.ngc"), Known::MayHaveBegun);
        status.job_stage = JobStage::Begun.code();
        assert_eq!(known(&Ok(Some(status)), "part.ngc"), Known::MayHaveBegun);
        assert_eq!(known(&Ok(None), "part.ngc"), Known::MayHaveBegun);
        let none = LinkError::NoServer {
            service: "commands",
        };
        assert_eq!(known(&Err(none), "part.ngc"), Known::Nothing);
        for (known, resumes) in [
            (Known::NotBegun, false),
            (Known::MayHaveBegun, true),
            (Known::Nothing, false),
        ] {
            let told = text(known, "`glidepath run-file part.ngc --resume`");
            assert_eq!(told.contains("--resume"), resumes, "{told}");
        }
    }
}
