//! The answer to a streamed item, from a listening planner to the program that streams.

use super::check::{Fields, RecordError};
use super::code::coded;
use super::{LongText, Record};
use glidepath_geometry::AXES;
use iceoryx2::prelude::ZeroCopySend;

coded! {
    /// The reason why a request was refused.
    pub enum SegmentRefusal {
        /// Another client's stream is open.
        Busy = 1,
        /// No stream of this session is open.
        NotOpen = 2,
        /// Not the next number; send again from the accepted one.
        OutOfOrder = 3,
        /// No room; wait, then send the same request again.
        NoCredit = 4,
        /// Unknown codes or numbers out of range.
        Malformed = 5,
        /// Does not start where the one before ended.
        Discontinuous = 6,
        /// Leaves the soft limits.
        SoftLimit = 7,
        /// The planner cannot plan it.
        Unplannable = 8,
        /// The machine has a fault, or the program was aborted.
        Stopped = 9,
        /// The planner is ending.
        ShuttingDown = 10,
        /// The machine was stopped after the stream was asked for.
        Aborted = 11,
    }
}

/// The answer to a request.
pub type SegmentOutcome = Result<(), SegmentRefusal>;

/// The answer on its way back.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
#[type_name("glidepath.SegmentReply.v2")]
pub struct SegmentReply {
    /// The session of the request.
    pub session: u64,
    /// The number of the request.
    pub number: u64,
    /// Requests of the stream accepted so far: the number of the next one expected.
    pub accepted: u64,
    /// How many more would be accepted now.
    pub credit: u32,
    /// Code of a [`SegmentRefusal`], 0 if the request was accepted.
    pub refusal: u32,
    /// Where the next segment must start.
    pub position: [f64; AXES],
    /// More about a refusal, for people.
    pub message: LongText,
}

impl SegmentReply {
    /// The answer.
    ///
    /// # Errors
    ///
    /// An unknown code.
    pub fn outcome(&self) -> Result<SegmentOutcome, RecordError> {
        match self.refusal {
            0 => Ok(Ok(())),
            code => Fields(Self::NAME).code("refusal", code).map(Err),
        }
    }
}

impl Record for SegmentReply {
    const NAME: &'static str = "glidepath.SegmentReply.v2";

    fn check(&self) -> Result<(), RecordError> {
        Fields(Self::NAME).all_finite("position", &self.position)?;
        self.outcome()?.ok();
        self.message.check(Self::NAME, "message")
    }
}
