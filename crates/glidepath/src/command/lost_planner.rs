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

/// A program whose planner is no more, or does not answer.
#[derive(Debug, Clone)]
pub(super) struct LostProgram {
    /// The name of its file.
    pub(super) name: String,
    /// The command that goes on with it.
    pub(super) resume: String,
    /// The job was to go on with it: it was begun before.
    pub(super) is_resumed: bool,
}

impl LostProgram {
    /// What is to be done for it when a planner serves again.
    pub(super) fn told(&self, link: &LinkConfig) -> String {
        let status = Operator::find(link).and_then(|operator| operator.status(PATIENCE));
        text(known(&status, &self.name), self)
    }
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
    // What is being done stands behind the name.
    let rest = status.job.as_str().strip_prefix(name);
    is_to_come && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(": "))
}

fn text(known: Known, program: &LostProgram) -> String {
    let resume = &program.resume;
    match known {
        Known::NotBegun if program.is_resumed => format!(
            "nothing more of the program was executed; then {resume} goes on with it, or says why that cannot be"
        ),
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
        for other in ["other.ngc", "part", "part.ng"] {
            assert_eq!(known(&Ok(Some(status)), other), Known::MayHaveBegun);
        }
        status.job_stage = JobStage::Begun.code();
        assert_eq!(known(&Ok(Some(status)), "part.ngc"), Known::MayHaveBegun);
        assert_eq!(known(&Ok(None), "part.ngc"), Known::MayHaveBegun);
        let none = LinkError::NoServer {
            service: "commands",
        };
        assert_eq!(known(&Err(none), "part.ngc"), Known::Nothing);
        for (known, is_resumed, resumes) in [
            (Known::NotBegun, false, false),
            (Known::NotBegun, true, true),
            (Known::MayHaveBegun, false, true),
            (Known::Nothing, false, false),
            (Known::Nothing, true, false),
        ] {
            let program = LostProgram {
                name: "part.ngc".to_owned(),
                resume: "`glidepath run-file part.ngc --resume`".to_owned(),
                is_resumed,
            };
            let told = text(known, &program);
            assert_eq!(told.contains("--resume"), resumes, "{told}");
        }
    }
}
