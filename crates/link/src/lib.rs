//! The contract between the processes: the records they exchange, the ports they exchange them
//! through, and two transports for the ports.
//!
//! Every record is plain old data of fixed size whose name carries its version. What is read from a
//! port has been written by another process: [`Record::check`] (or a checked conversion such as
//! [`SetpointFrame::to_frame`]) comes before any use.

pub mod servo;

mod error;
mod in_process;
mod ipc;
mod port;
mod record;
mod recording;
mod service;

pub use error::{BoxedError, LinkError};
pub use in_process::InProcess;
pub use ipc::{Ipc, LinkConfig, remove_leftovers};
pub use port::{
    Client, Delivery, FrameSink, MAX_UNANSWERED, Publisher, Server, Subscriber, Transport,
};
pub use record::{
    COMMAND_KINDS, Command, CommandKind, CommandOutcome, CommandRefusal, CommandReply,
    CommandRequest, EndOfEpoch, EventKind, FRAME_REFUSALS, FaultCause, FrameRefusal, Grants,
    MachineState, ModeCode, OVERRIDE_MAX, PERIOD_NS_MAX, PlaneCode, Quantiles, Record, RecordError,
    RequestKind, SegmentOutcome, SegmentRefusal, SegmentReply, SegmentRequest, Setpoint,
    SetpointFrame, SetpointMarks, Status, StreamItem, Text, decode,
};
pub use recording::{Recorder, Recording, RecordingError, Replay};
pub use service::Capacity;
