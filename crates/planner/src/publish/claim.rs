//! The planner's claim on the machine: the job that the interpolator was told of.
//!
//! ```text
//!  claim ──► waits for the machine ──► has it: read, checked, planned ──► first frame ──► over
//!            └──────── told again and again; the interpolator may end it ────────┘
//! ```
//!
//! A job is a thing at the interpolator from the moment it is accepted, because that is where an abort,
//! a hold, and everything that makes the machine unfit are settled without a race (the module
//! `ports::job` there). This side only looks, every few milliseconds, whether the claim still stands, and ends what
//! it is at when it does not.

use std::hash::{BuildHasher as _, Hasher as _, RandomState};
use std::time::Duration;

use glidepath_gcode::ReadingWatch;
use glidepath_link::{Command, JobPhase, JobStage, LinkError, Status};

use crate::run::error::RunError;
use crate::run::interval::Interval;

/// Between two reports of a job.
const REPORT_INTERVAL: Duration = Duration::from_millis(100);

/// What a planner has told the interpolator of its job.
#[derive(Debug)]
pub(crate) struct Claim {
    pub(crate) number: u64,
    /// When somebody asked for it, ns of the host's steady clock; 0 if that is not known.
    asked_ns: u64,
    is_stream: bool,
    name: String,
    pub(crate) doing: String,
    pub(crate) phase: JobPhase,
    /// The number of its first epoch, and the life of the interpolator that gave it.
    pub(crate) epoch: Option<(u64, u64)>,
    /// Since the interpolator was told of it.
    pub(crate) since_told: Interval,
    pub(crate) watch: ReadingWatch,
}

impl Claim {
    pub(crate) fn new(name: &str, asked_ns: u64) -> Self {
        Self {
            asked_ns,
            is_stream: false,
            number: RandomState::new().build_hasher().finish().max(1),
            name: name.to_owned(),
            doing: "waits for the machine".to_owned(),
            phase: JobPhase::Waiting,
            epoch: None,
            since_told: Interval::new(REPORT_INTERVAL),
            watch: ReadingWatch::default(),
        }
    }

    /// The claim of a stream of segments.
    pub(crate) fn of_stream(asked_ns: u64) -> Self {
        Self {
            is_stream: true,
            ..Self::new("a stream of segments", asked_ns)
        }
    }

    pub(crate) const fn command(&self, phase: JobPhase) -> Command {
        Command::Job {
            number: self.number,
            phase,
            asked_ns: self.asked_ns,
            is_stream: self.is_stream,
        }
    }

    /// What is being done, for people.
    pub(crate) fn text(&self) -> String {
        let (name, doing) = (&self.name, &self.doing);
        match (doing.as_str(), self.watch.line()) {
            ("", _) => name.clone(),
            (_, 0) => format!("{name}: {doing}"),
            (_, line) => format!("{name}: {doing}, line {line}"),
        }
    }

    /// Why the job does not begin, if the interpolator has ended it.
    pub(crate) fn stands(&self, status: &Status) -> Result<(), RunError> {
        if status.job_number != self.number {
            return Ok(());
        }
        match status.job_stage().map_err(LinkError::from)? {
            JobStage::Aborted => Err(RunError::Aborted),
            JobStage::Refused => Err(RunError::NotBegun {
                why: status.job_end.as_str().to_owned(),
            }),
            JobStage::None
            | JobStage::Waiting
            | JobStage::Preparing
            | JobStage::Begun
            | JobStage::Over => Ok(()),
        }
    }
}
