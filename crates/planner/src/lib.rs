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
//! Inside there are six rooms, and an arrow is what a room may know (a test holds them to it, see the map of the code):
//!
//! ```text
//!  service ─▶ publish ─▶ exchange ─┐
//!                │                 ▼
//!                └─────▶ plan ─▶ source ─▶ run
//! ```
//!
//! Items come out of `source`, frames out of `plan`, and `publish` hands them to the interpolator, which `exchange` speaks
//! to, as it does to clients. `service` says what is executed when. `run` is a run as its caller sees it. Whoever knows a
//! room may know those behind it, too.
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
//!     direction: glidepath_program::DirectionTolerance::default(),
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

mod exchange;
mod plan;
mod publish;
mod run;
mod service;
mod source;

pub use exchange::attend::{Attend, Attended};
pub use exchange::client_watch::CLIENT_SILENCE;
pub use exchange::feed::{Fed, FeedError, Feeding, feed};
pub use exchange::stream::{STREAM_QUEUE, SoftLimits};
pub use plan::parallel::ParallelPipeline;
pub use plan::pipeline::Pipeline;
pub use plan::step::{Output, Step};
pub use publish::epoch::Pace;
pub use publish::frame_publisher::FramePublisher;
pub use run::control::{Control, Notice, Progress};
pub use run::error::{LatchedFault, RunError};
pub use run::refusal::Refusal;
pub use run::resume_error::ResumeError;
pub use run::statistics::Statistics;
pub use service::job::{Job, JobEnd, JobRunner};
pub use service::listen::{Listening, listen, serve};
pub use source::changes::{BlockLog, ChangeLog, PositionOffsetsLog, SetUp};
pub use source::curve::CurveSource;
pub use source::file::{FileSource, LookedAt, check_file, find_in_file};
pub use source::input_arbiter::{AnsweredInput, InputArbiter, InputJournal, InputResult};
pub use source::item_source::{ItemSource, SILENCE, Settled, Supply};
pub use source::nurbs::NurbsSource;
pub use source::pipe::PipeSource;
pub use source::program::ProgramSource;
pub use source::remarks::RemarkLog;
pub use source::resume::{Remainder, ResumePoint};
pub use source::run_channels::RunChannels;
pub use source::sent::{Followed, LineFacts, LineInbox, SentLines};
pub use source::start_line::{Approach, LineStart, StartLine, StartLineError};
pub use source::unchanged_file::UnchangedFile;
