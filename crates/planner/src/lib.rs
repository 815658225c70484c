//! The planner process as a library: a program, from a file, a pipe or another process, to setpoint
//! frames in the interpolator's queue.
//!
//! ```text
//!  file ─┐
//!  pipe ─┼─ ItemSource ─▶ Pipeline ─▶ Publisher ─▶ FrameSink
//!  feed ─┘   (items)      (frames)     (pace)  ◀─ Status
//! ```
//!
//! Frames depend on the items and the settings alone. No clock is read here; a caller lends a way to
//! wait ([`Control::pause`]).

mod blocks;
mod control;
mod curve;
mod epoch;
mod error;
mod feed;
mod file;
mod file_moves;
mod fingerprint;
mod joint_speed;
mod listen;
mod machine;
mod nurbs;
mod pipeline;
mod program;
mod publish;
mod refusal;
mod resume;
mod source;
mod stream;

pub use control::{Control, Notice, Progress};
pub use curve::CurveSource;
pub use epoch::Pace;
pub use error::{Fault, RunError};
pub use feed::{Fed, FeedError, feed};
pub use file::{FileSource, check_file, find_in_file};
pub use listen::{CLIENT_SILENCE, Listening, listen};
pub use nurbs::NurbsSource;
pub use pipeline::{Output, Pipeline, Statistics, Step};
pub use program::{PipeSource, ProgramSource};
pub use publish::Publisher;
pub use refusal::Refusal;
pub use resume::{Remainder, ResumeError, ResumePoint};
pub use source::{ItemSource, Supply};
use stream::Stream;
pub use stream::{STREAM_QUEUE, SoftLimits};
