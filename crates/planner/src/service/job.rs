//! A job: a line, lines, a program, whose executor says how it ended.

use std::path::PathBuf;

use glidepath_geometry::AxisVector;
use glidepath_link::{JobKind, JobRequest};

use crate::exchange::attend::Attend;
use crate::publish::frame_publisher::FramePublisher;
use crate::run::control::Control;
use crate::source::sent::{LineFacts, LineInbox};
use crate::source::start_line::StartLine;

/// A job: something to execute.
#[derive(Debug, Clone, PartialEq)]
pub enum Job {
    /// A line.
    Line(String),
    /// Lines that belong together, with line breaks between them.
    Sequence(String),
    /// A program.
    File {
        /// Where it is.
        path: PathBuf,
        /// The fingerprint of the program that is meant; `None`: whatever is in the file.
        looked_at: Option<u64>,
        /// How many times its tolerance it may use.
        tolerance_ratio: f64,
        /// Where to begin; `None`: at its beginning.
        from: Option<StartLine>,
        /// What was told of that beginning is agreed to.
        confirmed: bool,
        /// It goes on where it was left.
        resumes: bool,
    },
    /// Lines that come one after the other.
    Lines {
        /// Who sends them.
        name: String,
        /// Where they come in.
        inbox: LineInbox,
    },
}

impl Job {
    pub(crate) fn of(request: &JobRequest) -> Option<Self> {
        let text = request.text.as_str();
        Some(match request.kind().ok()? {
            JobKind::Line => Self::Line(text.to_owned()),
            JobKind::Sequence => Self::Sequence(text.to_owned()),
            JobKind::File => Self::File {
                path: text.into(),
                looked_at: Some(request.program).filter(|program| *program != 0),
                tolerance_ratio: request.tolerance_ratio,
                from: (request.from_line > 0).then(|| StartLine {
                    line: request.from_line,
                    pass: request.pass.max(1),
                }),
                confirmed: request.confirmed == 1,
                resumes: request.resumes == 1,
            },
        })
    }

    /// The name of the job, for people.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Line(text) => format!("mdi {text}"),
            Self::Sequence(text) => format!("mdi {} …", telling(text)),
            Self::File { path, .. } => {
                let name = path.file_name().unwrap_or(path.as_os_str());
                name.to_string_lossy().into_owned()
            }
            Self::Lines { name, .. } => name.clone(),
        }
    }
}

/// The first line of a sequence that does more than save modes, or set units and the kind of distance.
fn telling(text: &str) -> &str {
    const SETTING: [&str; 6] = ["M70", "G20", "G21", "G8", "G90", "G91"];
    let sets = |line: &&str| line.split_whitespace().all(|word| SETTING.contains(&word));
    let mut lines = text.lines();
    lines
        .find(|line| !sets(line))
        .or_else(|| text.lines().next())
        .unwrap_or_default()
}

/// The end of a job, with words for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum JobEnd {
    /// It was executed to its end.
    Done(String),
    /// It was refused: nothing has changed, and nothing moved.
    Refused(String),
    /// The motion ended before it did.
    Failed(String),
    /// It begins in a way that has to be agreed to.
    ToConfirm(String),
    /// The file is not the program that was looked at.
    Changed(String),
}

/// The executor of jobs.
pub trait JobRunner {
    /// Executes a job that has the machine, which stands at a position. Whatever takes long is to be
    /// done by [`FramePublisher::work`], so that `attend` is called every few milliseconds.
    fn run(
        &mut self,
        job: &Job,
        start: AxisVector,
        publisher: &mut FramePublisher<'_>,
        attend: &mut dyn Attend,
        control: &mut Control<'_>,
    ) -> JobEnd;

    /// A sender has reset its machine: modes and offsets in force are those of one that was switched on. Nothing moves.
    fn reset(&mut self) {}

    /// How the machine is set up for the next job, if that is known.
    fn facts(&self) -> Option<LineFacts> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::telling;

    #[test]
    fn a_sequence_is_known_by_what_it_does() {
        assert_eq!(telling("M70\nG21\nG38.2 Z-5 F100\nM72"), "G38.2 Z-5 F100");
        assert_eq!(telling("M70\nG21 G8\nG10 L20 P0 X0\nM72"), "G10 L20 P0 X0");
        assert_eq!(telling("G90\nG20"), "G90");
    }
}
