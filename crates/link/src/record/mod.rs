//! The records that cross processes.
//!
//! Each is `#[repr(C)]`, of fixed size, without padding (`bytemuck::Pod` proves that when it is
//! compiled), and means the same in every process, whatever language it is written in: numbers,
//! arrays of numbers, and codes of 32 bits. A code is never read as a Rust enum before it has been
//! compared with the codes known here. The name of a record ends in its version; a change of layout
//! or meaning gets a new version, and ports of different versions refuse to connect.
//!
//! Axes are in the order X Y Z A B C U V W, mm or degrees; joints are J0…J8; times are nanoseconds
//! of `CLOCK_MONOTONIC`; overrides are ratios, 1 is 100 %.
#![allow(
    unsafe_code,
    reason = "the derives of `Pod` and `ZeroCopySend` expand to `unsafe impl`; both check the fields"
)]

mod auxiliary;
mod check;
mod code;
mod code_words;
mod command;
mod command_reply;
mod event;
mod event_id;
mod feedback;
mod frame;
mod grants;
mod job;
mod jog;
mod joint;
mod lines;
mod quantiles;
mod segment;
mod segment_reply;
mod setpoint;
mod state;
mod status;
mod superposition;
mod text;

pub use auxiliary::{ANALOG_OUTPUTS, Auxiliary, Coolant, OrientTurn, SpindleState};
pub use check::{RecordError, decode};
pub use code_words::CodeWords;
pub use command::{COMMAND_KINDS, Command, CommandKind, CommandRequest};
pub use command_reply::{CommandOutcome, CommandRefusal, CommandReply};
pub use event::{EventKind, EventRecord, MOST_GEARS};
pub use event_id::EventId;
pub use feedback::{DriveState, Feedback, LATCHES, Latch, LatchKind, Loss, SpindleFlags};
pub use frame::{PERIOD_NS_MAX, SetpointFrame};
pub use glidepath_program::EVENTS_MOST;
pub use grants::Grants;
pub use job::{
    JobKind, JobPhase, JobReply, JobRequest, JobStage, JobState, JobWish, TOLERANCE_RATIOS,
};
pub use jog::{JogDemand, JogMode};
pub use joint::ALL_JOINTS;
pub use lines::{LinesReply, LinesRequest, LinesState, LinesWish, TOLD_SYSTEMS};
pub use quantiles::Quantiles;
pub use segment::{ModeCode, PlaneCode, RequestKind, SegmentRequest, StreamItem};
pub use segment_reply::{SegmentOutcome, SegmentRefusal, SegmentReply};
pub use setpoint::{Setpoint, SetpointMarks};
pub use state::{
    ContactKind, EndOfEpoch, FRAME_REFUSALS, FaultCause, FrameRefusal, MachineState, MotionMode,
    Power,
};
pub use status::Status;
pub use superposition::{FreezeReason, SuperpositionState};
pub use text::{LongText, Text};

use iceoryx2::prelude::ZeroCopySend;
use joint::HIGHEST_JOINT;

/// Largest feed or rapid override, as a ratio.
pub const OVERRIDE_MAX: f64 = 2.0;

/// Plain old data that may cross to another process.
pub trait Record: bytemuck::Pod + ZeroCopySend + core::fmt::Debug + PartialEq {
    /// Name with version, the same in every language.
    const NAME: &'static str;

    /// Whether every number is finite and in range and every code and flag is known.
    ///
    /// # Errors
    ///
    /// The first field that is not.
    fn check(&self) -> Result<(), RecordError>;
}
