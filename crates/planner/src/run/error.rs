//! The errors of a run: why it ended before its end.

use glidepath_geometry::Axis;
use glidepath_link::{CommandKind, FaultCause, LinkError, Status, refused};
use thiserror::Error;

use crate::run::refusal::Refusal;
use crate::run::resume_error::ResumeError;

/// The reason why a run ended before its end. In every case the machine comes to rest on the path.
#[derive(Debug, Error)]
pub enum RunError {
    /// The program was refused, before any motion or from some point on.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The caller's stop flag ended it.
    #[error("interrupted")]
    Interrupted,
    /// Somebody aborted it at the interpolator.
    #[error("aborted by an operator")]
    Aborted,
    /// The interpolator did not begin it.
    #[error("nothing moved: {why}")]
    NotBegun {
        /// Why.
        why: String,
    },
    /// Whoever wanted it does not want it any more.
    #[error("{why}")]
    Ended {
        /// Why.
        why: String,
    },
    /// The interpolator stopped by a fault and latched its cause.
    #[error(
        "the machine stopped by a fault: {0}; {remedy}", remedy = .0.cause.remedy()
    )]
    Fault(LatchedFault),
    /// The interpolator stopped by a fault, and somebody has reset it before its cause was read.
    #[error("the machine stopped by a fault that was reset meanwhile{}", after_colon(.message))]
    FaultReset {
        /// What the interpolator said last.
        message: String,
    },
    /// The interpolator gave no sign of life, or was started anew.
    #[error("the interpolator is gone; start it again: `glidepath interpolator`")]
    InterpolatorLost,
    /// The interpolator gives no sign of life, and its process lives.
    #[error(
        "the interpolator (process {process}) lives and does not answer; `glidepath abort --signal` has it bring \
         the machine to rest and end; then start it again: `glidepath interpolator`"
    )]
    InterpolatorSilent {
        /// The process.
        process: i32,
    },
    /// Planner and interpolator are configured differently.
    #[error(
        "the interpolator runs with a period of {} µs, the planner was configured for {} µs; give both \
         the same configuration", micro(*.interpolator_ns), micro(*.planner_ns)
    )]
    PeriodMismatch {
        /// The planner's, ns.
        planner_ns: u64,
        /// The interpolator's, ns.
        interpolator_ns: u64,
    },
    /// The interpolator would not do what the planner needs.
    #[error("{}", refused(.command.name(), .why))]
    CommandRefused {
        /// The command.
        command: CommandKind,
        /// Why.
        why: String,
    },
    /// The interpolator did not answer.
    #[error("the interpolator did not answer the command {}", .command.name())]
    CommandUnanswered {
        /// The command.
        command: CommandKind,
    },
    /// The program cannot be taken up again.
    #[error(transparent)]
    Resume(#[from] ResumeError),
    /// The thread that plans cannot be started.
    #[error("the thread that plans cannot be started: {0}; let this user have more threads")]
    NoThread(#[source] std::io::Error),
    /// A port failed.
    #[error(transparent)]
    Link(#[from] LinkError),
}

/// A fault the interpolator has latched.
#[derive(Debug, Clone, PartialEq)]
pub struct LatchedFault {
    /// What kind.
    pub cause: FaultCause,
    /// Source line, 0 if it has none.
    pub line: u32,
    /// Axis, if the fault has one.
    pub axis: Option<Axis>,
    /// What is known of it, as everybody tells it.
    pub text: String,
}

impl std::fmt::Display for LatchedFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// Nanoseconds as microseconds, which are whole but for odd periods.
#[allow(clippy::cast_precision_loss, reason = "a period is far below 2^53 ns")]
fn micro(time_ns: u64) -> f64 {
    time_ns as f64 / 1e3
}

/// A message that may be missing.
fn after_colon(message: &str) -> String {
    if message.is_empty() {
        return String::new();
    }
    format!(": {message}")
}

impl RunError {
    /// The fault a status tells of.
    pub(crate) fn fault(status: &Status) -> Self {
        match status.fault() {
            Ok(Some(cause)) => Self::Fault(LatchedFault {
                cause,
                line: status.fault_line,
                axis: status.fault_axis(),
                text: status.fault_text().unwrap_or_default(),
            }),
            Ok(None) => Self::FaultReset {
                message: status.last_error.as_str().to_owned(),
            },
            Err(error) => Self::Link(error.into()),
        }
    }
}
