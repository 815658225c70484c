//! The contract between the processes: the records they exchange, the ports they exchange them
//! through, and two transports for the ports.
//!
//! ```text
//! other programs ─ SegmentRequest ─► planner ─ SetpointFrame ─► interpolator ─ Setpoint ─► servos
//!                ◄ SegmentReply ────    ▲                        │   ▲
//!                                       └──────── Status ────────┤   └─ CommandRequest ─ anybody
//!                                                    anybody ◄───┘   ▲
//!                               servo stacks ─ Feedback ─────────────┤
//!                            operators' panels ─ JogDemand ──────────┘
//! ```
//!
//! Planner, interpolator and servos meet here and nowhere else. Entry points:
//!
//! * [`Transport`] makes the ports of an instance: [`Ipc`] between processes, over shared memory,
//!   and [`InProcess`] between the threads of one, with the same order, back-pressure and loss;
//! * [`Operator`] commands an interpolator by a way that needs no shared memory;
//! * [`ActiveProgram`] is a planner's note of what it has begun;
//! * the ports are [`Publisher`] and [`Subscriber`], [`FrameSink`] (which is told when nobody takes
//!   its frames), [`Client`] and [`Server`];
//! * the records: [`SetpointFrame`], [`Setpoint`], [`Status`], [`CommandRequest`],
//!   [`SegmentRequest`] and their replies;
//! * [`servo`] is what a drive does with setpoints;
//! * [`mirror`] publishes setpoints and status as ordinary services of iceoryx2, for looking on;
//! * what people are told of states, faults and refusals: [`Status::state_text`], [`FaultReport`],
//!   [`UnmetPrecondition`], [`refused`]; [`printable`] makes text of others safe to show.
//!
//! Invariants:
//!
//! * every record is plain old data of fixed size whose name carries its version: what reads
//!   another version does not connect;
//! * what is read from a port has been written by another process, so [`Record::check`] (or a
//!   checked conversion such as [`SetpointFrame::to_frame`]) comes before any use;
//! * frames are never lost and never overwritten: a full queue is reported. Setpoints and status
//!   never wait for a subscriber: a full queue loses its oldest, which the numbers in the records
//!   show.
//!
//! ```
//! use glidepath_link::{Delivery, InProcess, Record, SetpointFrame, Transport};
//!
//! let link = InProcess::default();
//! let (mut sink, mut source) = (link.frame_sink()?, link.frame_source()?);
//! let mut frame: SetpointFrame = bytemuck::Zeroable::zeroed();
//! (frame.epoch, frame.period_ns, frame.planned_override) = (1, 4_000_000, 1.0);
//! assert_eq!(sink.offer(&frame)?, Delivery::Delivered);
//!
//! let taken = source.take()?.expect("it was delivered");
//! taken.check()?;
//! assert_eq!(taken, frame);
//! assert!(source.take()?.is_none());
//! # Ok::<(), glidepath_link::LinkError>(())
//! ```

pub mod mirror;
pub mod servo;

mod error;
mod in_process;
mod ipc;
mod port;
mod record;
mod service;
mod stall;
mod wording;

pub use error::{BoxedError, LinkError};
pub use in_process::InProcess;
pub use ipc::{
    ActiveProgram, DrivesLock, InterpolatorProcess, Ipc, LinkConfig, Operator, remove_leftovers,
};
pub use port::{
    Client, Delivery, FrameSink, MAX_UNANSWERED, Publisher, Server, Subscriber, Transport,
};
pub use record::{
    ALL_JOINTS, ANALOG_OUTPUTS, Auxiliary, COMMAND_KINDS, CodeWords, Command, CommandKind,
    CommandOutcome, CommandRefusal, CommandReply, CommandRequest, ContactKind, Coolant, DriveState,
    EVENTS_MOST, EndOfEpoch, EventId, EventKind, EventRecord, FRAME_REFUSALS, FaultCause, Feedback,
    FrameRefusal, FreezeReason, Grants, JobKind, JobPhase, JobReply, JobRequest, JobStage,
    JobState, JobWish, JogDemand, JogMode, LATCHES, Latch, LatchKind, LinesReply, LinesRequest,
    LinesState, LinesWish, LongText, Loss, MOST_GEARS, MachineState, ModeCode, MotionMode,
    OVERRIDE_MAX, OrientTurn, PERIOD_NS_MAX, PlaneCode, Power, Quantiles, Record, RecordError,
    RequestKind, SegmentOutcome, SegmentRefusal, SegmentReply, SegmentRequest, Setpoint,
    SetpointFrame, SetpointMarks, SpindleFlags, SpindleState, Status, StreamItem,
    SuperpositionState, TOLD_SYSTEMS, TOLERANCE_RATIOS, Text, decode,
};
pub use service::Capacity;
pub use stall::STALL;
pub use wording::{
    AtRest, CALLED_OFF, DISABLED, FaultReport, SWITCHED_OFF, StateChange, TOLD_TO_END,
    UnmetPrecondition, is_printable, printable, refused, tells_end,
};
