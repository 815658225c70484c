//! Recordings of a machine: every setpoint and every status, in a file that others can open.
//!
//! A recording is an [MCAP](https://mcap.dev) file: messages in Protocol Buffers, whose description
//! is in the file, on two topics.
//!
//! | topic | message | |
//! |---|---|---|
//! | `/setpoint` | `glidepath.Setpoint` | every setpoint, to the bit |
//! | `/status` | `glidepath.Status` | every status, several a second |
//!
//! In front of the first message are, as attachments, the configuration and the program, and, as the
//! metadata record `glidepath`, what else belongs to it ([`Origin`]). Where a program begins, the metadata record
//! `begun` says what it began with, and attachments have its texts ([`Begun`]). What is in memory is written as
//! a chunk whenever [`Recorder::flush`] is called: of a recorder that was killed all is there up to
//! then, and [`Reader`] reads it.
//!
//! `log_time` is when a tick was due, `publish_time` when its setpoint applies, both in ns since
//! 1970 by the host's clock at the beginning of the recording; the times in the messages are those of
//! the monotonic clock, as they were.

mod begun;
mod origin;
mod proto;
mod protobuf;
mod reader;
mod recorder;
mod records;
mod table;

pub use begun::Begun;
pub use origin::Origin;
pub use proto::proto;
pub use protobuf::Malformed;
pub use reader::{Entry, MOST_PROGRAM_BYTES, ReadError, Reader};
pub use recorder::Recorder;

/// The bytes that a file begins with.
pub const MAGIC: [u8; 8] = *b"\x89MCAP0\r\n";
