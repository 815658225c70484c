//! The planner process as a library: a program, from a file, a pipe or another process, to setpoint
//! frames in the interpolator's queue.
//!
//! ```text
//!  file ─┐
//!  pipe ─┼─ ItemSource ─▶ Pipeline ─▶ queue ─▶ FramePublisher ─▶ FrameSink
//!  feed ─┘   (items)      (frames,             (pace)  ◀─ Status
//!                          a thread)
//! ```
//!
//! This crate stands between the readers of programs (`glidepath-gcode`, `glidepath-curve`) and the
//! planner of motion (`glidepath-motion`) on one side, and the interpolator's queue
//! (`glidepath-link`) on the other.
//!
//! * [`ItemSource`] is whatever gives items: [`FileSource`] a file that was checked before,
//!   [`PipeSource`] a pipe, [`ProgramSource`] any text, [`CurveSource`] and [`NurbsSource`] curve files.
//! * [`Pipeline`] turns a source into frames, one after the other; [`LimitedMechanism`] keep the joints of
//!   a mechanism inside their limits on the way.
//! * [`ParallelPipeline`] does the same ahead of time, on all cores.
//! * [`FramePublisher`] hands frames on, no further ahead of the machine than its [`Pace`] says. They are
//!   planned further ahead than that, in a thread of their own.
//! * [`SentLines`] are the lines that a sender gives to the planner's service as they come.
//! * [`listen()`] and [`feed()`] are the two ends of a stream of segments from another process.
//! * [`Remainder`] is what is left of a program whose planner died, or that was aborted.
//!
//! What always holds:
//!
//! * Frames depend on the items and the settings alone: the same input gives the same frames to the
//!   bit, whatever the timing of reads and threads.
//! * No clock is read here; a caller lends a way to wait ([`Control::pause`]).
//! * Memory is bounded, however long a program is.
//! * Whatever a [`Refusal`] or a [`RunError`] is about, the machine comes to rest on the path.
//!
//! [`LimitedMechanism`]: glidepath_kinematics::LimitedMechanism
//!
//! ```
//! use glidepath_gcode::Options;
//! use glidepath_geometry::AxisVector;
//! use glidepath_planner::{Output, Pipeline, ProgramSource};
//! use glidepath_program::{Effort, Limits, Settings, Smoothing};
//!
//! let settings = Settings {
//!     limits: Limits::uniform(200.0, 2000.0, 40_000.0), // mm/s, mm/s², mm/s³
//!     tolerance_mm: 0.02,
//!     smoothing: Smoothing::Auto,
//!     corners: glidepath_program::Corners::default(),
//!     period_t: 0.004,
//!     effort: Effort::Fast,
//! };
//! let start = AxisVector::zeros();
//! let program = "G21 G90\nG1 X10 F3000\nM2\n";
//! let source = ProgramSource::new(program.as_bytes(), Options::default());
//! let mut pipeline = Pipeline::new(source, settings, start);
//! let mut position = start;
//! loop {
//!     match pipeline.advance()? {
//!         Output::Frame(frame) => position = frame.position,
//!         Output::End => break,
//!         Output::Item(_) | Output::Pending => {}
//!     }
//! }
//! assert!((position[0] - 10.0).abs() < 1e-9);
//! # Ok::<(), glidepath_planner::Refusal>(())
//! ```

mod ahead;
mod attend;
mod blocks;
mod changes;
mod claim;
mod claiming;
mod client_watch;
mod control;
mod curve;
mod epoch;
mod epochs;
mod error;
mod feed;
mod file;
mod file_moves;
mod fingerprint;
mod history;
mod input_arbiter;
mod inputs;
mod interval;
mod job;
mod job_client_handler;
mod job_queue;
mod joint_bounds;
mod listen;
mod machine;
mod nurbs;
mod parallel;
mod pipe;
mod pipeline;
mod planning;
mod program;
mod publish;
mod readiness;
mod refusal;
mod remarks;
mod restoring;
mod resume;
mod run_channels;
mod sent;
mod source;
mod start_line;
mod step;
mod stream;
mod unchanged_file;

pub use attend::{Attend, Attended};
pub use changes::{BlockLog, ChangeLog, PositionOffsetsLog, SetUp};
pub use client_watch::CLIENT_SILENCE;
pub use control::{Control, Notice, Progress};
pub use curve::CurveSource;
pub use epoch::Pace;
pub use error::{LatchedFault, RunError};
pub use feed::{Fed, FeedError, Feeding, feed};
pub use file::{FileSource, LookedAt, check_file, find_in_file};
pub use input_arbiter::{AnsweredInput, InputArbiter, InputJournal, InputResult};
pub use job::{Job, JobEnd, JobRunner};
pub use listen::{Listening, listen, serve};
pub use nurbs::NurbsSource;
pub use parallel::ParallelPipeline;
pub use pipe::PipeSource;
pub use pipeline::Pipeline;
pub use program::ProgramSource;
pub use publish::FramePublisher;
pub use refusal::Refusal;
pub use remarks::RemarkLog;
pub use resume::{Remainder, ResumeError, ResumePoint};
pub use run_channels::RunChannels;
pub use sent::{Followed, LineFacts, LineInbox, SentLines};
pub use source::{ItemSource, SILENCE, Settled, Supply};
pub use start_line::{Approach, LineStart, StartLine, StartLineError};
pub use step::{Output, Statistics, Step};
use stream::Stream;
pub use stream::{STREAM_QUEUE, SoftLimits};
pub use unchanged_file::UnchangedFile;
