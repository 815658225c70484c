//! Why a command did not do what was asked.

use crate::bench::CatalogueError;
use crate::config::ConfigError;
use crate::curve_file::CurveError;
use crate::exit::Exit;
use crate::jitter::CyclictestError;
use crate::program_text::UnknownEvent;
use glidepath_gcode::Diagnostic;
use glidepath_interpolator as interpolator;
use glidepath_link::{LinkError, RecordingError};
use glidepath_planner::{self as planner, FeedError, Refusal};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A command's failure, with its exit code.
#[derive(Debug, Error)]
pub enum Failure {
    /// The configuration was refused.
    #[error(transparent)]
    Configuration(#[from] ConfigError),
    /// The benchmark programs cannot be found.
    #[error(transparent)]
    Catalogue(#[from] CatalogueError),
    /// A file of the command line cannot be opened.
    #[error("cannot open {path}: {source}", path = path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file cannot be read further or written.
    #[error("cannot {action} {path}: {source}", path = path.display())]
    File {
        /// What was tried: "read", "write".
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A program has findings.
    #[error("{program} is rejected; {}", if *moved { "the motion stopped at the last good block" } else { "nothing moved" })]
    Rejected {
        /// The program.
        program: String,
        /// What was found.
        findings: Vec<Diagnostic>,
        /// Findings that are not listed.
        more: u32,
        /// Whether the part before the finding was run.
        moved: bool,
    },
    /// A curve file has a finding.
    #[error("the curve is rejected: {0}")]
    Curve(#[from] Box<CurveError>),
    /// A curve file holds one curve.
    #[error("{runs} runs cannot be written as one curve; write a program: --output FILE.ngc")]
    NotOneCurve {
        /// How many there are.
        runs: usize,
    },
    /// An event that cannot be written into a program.
    #[error(
        "line {line}: the words of this M code are not known any more, so it cannot be written; take \
         it out, or write curve files",
        line = .0.line
    )]
    UnknownEvent(UnknownEvent),
    /// No feedrate is known.
    #[error("no feedrate: give --feed, or `feed` in the curve file")]
    NoFeed,
    /// A program that passed the check was refused later.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The system refuses to have Ctrl-C handled.
    #[error("cannot handle signals: {0}")]
    Signals(std::io::Error),
    /// Nobody answers for an instance.
    #[error(
        "no interpolator runs in the instance \"{instance}\"; start `glidepath interpolator`, or name \
         another with --instance"
    )]
    NoInterpolator {
        /// The instance.
        instance: String,
    },
    /// The interpolator refused a command.
    #[error("{command}: refused, the machine is {state}: {reason}")]
    CommandRefused {
        /// The command.
        command: &'static str,
        /// What the machine does.
        state: &'static str,
        /// Why.
        reason: String,
    },
    /// The interpolator could not start or failed.
    #[error(transparent)]
    Interpolator(#[from] interpolator::RunError),
    /// The planner ended before the end of the motion.
    #[error(transparent)]
    Planner(#[from] planner::RunError),
    /// A program was not streamed to its end.
    #[error(transparent)]
    Feed(#[from] FeedError),
    /// Standard input was to be resumed.
    #[error("standard input cannot be read from its beginning again: resume from a file")]
    ResumePipe,
    /// The shared memory cannot be used.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// What a process sent cannot be read.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// A process cannot be started or ended.
    #[error("cannot start or end a process: {0}")]
    Process(std::io::Error),
    /// A process ended before its time.
    #[error("the {name} ended: {reason}")]
    ProcessEnded {
        /// Its subcommand.
        name: &'static str,
        /// What it said.
        reason: String,
        /// What its end means.
        exit: Exit,
    },
    /// The tool to compare with does not run.
    #[error(transparent)]
    Cyclictest(#[from] CyclictestError),
    /// A part of this process does not work.
    #[error("{0} failed")]
    Thread(&'static str),
    /// The command was interrupted.
    #[error("interrupted")]
    Interrupted,
}

impl From<UnknownEvent> for Failure {
    fn from(event: UnknownEvent) -> Self {
        Self::UnknownEvent(event)
    }
}

impl Failure {
    /// For `map_err` of opening a file.
    pub fn open(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        |source| Self::Open {
            path: path.to_owned(),
            source,
        }
    }

    /// For `map_err` of reading or writing a file.
    pub fn file(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| Self::File {
            action,
            path: path.to_owned(),
            source,
        }
    }

    /// A refusal of a program, as the failure to run it.
    #[must_use]
    pub fn refused(program: &str, refusal: Refusal, moved: bool) -> Self {
        match refusal {
            Refusal::Program { findings, unlisted } => Self::Rejected {
                program: program.to_owned(),
                findings,
                more: unlisted,
                moved,
            },
            refusal => Self::Refused(refusal),
        }
    }

    /// The exit code.
    #[must_use]
    pub const fn exit(&self) -> Exit {
        match self {
            Self::Configuration(_) => Exit::Configuration,
            Self::ResumePipe
            | Self::Open { .. }
            | Self::Catalogue(_)
            | Self::NoFeed
            | Self::NotOneCurve { .. }
            | Self::UnknownEvent(_)
            | Self::Cyclictest(CyclictestError::Absent) => Exit::Usage,
            Self::Rejected { .. }
            | Self::Curve(_)
            | Self::Refused(_)
            | Self::Planner(planner::RunError::Refused(_) | planner::RunError::Resume(_))
            | Self::Feed(FeedError::Refused(_) | FeedError::RefusedByPlanner { .. }) => {
                Exit::Rejected
            }
            Self::Interpolator(interpolator::RunError::NotRealTime(_)) => Exit::NotRealTime,
            Self::Planner(planner::RunError::Interrupted)
            | Self::Feed(FeedError::Interrupted)
            | Self::Interrupted => Exit::Interrupted,
            Self::File { .. }
            | Self::Signals(_)
            | Self::NoInterpolator { .. }
            | Self::CommandRefused { .. }
            | Self::Interpolator(_)
            | Self::Planner(_)
            | Self::Feed(_)
            | Self::Link(_)
            | Self::Recording(_)
            | Self::Process(_)
            | Self::Cyclictest(_)
            | Self::Thread(_) => Exit::Fault,
            Self::ProcessEnded { exit, .. } => *exit,
        }
    }
}
