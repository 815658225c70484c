//! The errors of a stream: why it was not executed to its end.

use glidepath_link::{LinkError, SegmentRefusal};
use thiserror::Error;

use crate::run::refusal::Refusal;

/// The reason why a stream was not executed to its end.
#[derive(Debug, Error)]
pub enum FeedError {
    /// The program was refused, here or by the planner's check of an item.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The planner refused a request.
    #[error("stream refused{}: {message}", AtLine(*.line))]
    RefusedByPlanner {
        /// Source line of what was refused, 0 if it has none.
        line: u32,
        /// Why.
        refusal: SegmentRefusal,
        /// The same in words.
        message: String,
    },
    /// The planner did not answer.
    #[error(
        "the planner's service does not answer: it hangs, or has ended; `glidepath planner --listen` starts one"
    )]
    PlannerLost,
    /// No interpolator tells where the machine stands.
    #[error(
        "no interpolator tells where the machine stands: none runs, which `glidepath interpolator` mends, or it hangs"
    )]
    MachineLost,
    /// The caller's stop flag ended it before a stream was open: nothing of it moves.
    #[error("interrupted: nothing was streamed")]
    Interrupted,
    /// The caller's stop flag ended the stream, and the machine rests.
    #[error("interrupted, and the stream has ended: {message}")]
    CalledOff {
        /// How, in the words of the planner.
        message: String,
    },
    /// The caller's stop flag ended the stream, and nobody has said yet that it has ended.
    #[error(
        "interrupted: the stream was told to end, and its planner has not said yet that it has; `glidepath status` tells \
         what the machine does"
    )]
    NotEnded,
    /// A port failed.
    #[error(transparent)]
    Link(#[from] LinkError),
}

struct AtLine(u32);

impl std::fmt::Display for AtLine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.0 > 0 {
            write!(f, " at line {}", self.0)
        } else {
            Ok(())
        }
    }
}
