//! Motion planning: from programmed segments to the state of every axis at every period.
//!
//! ```text
//!   glidepath-gcode, -curve ──▶ Item ──▶ Planner (this crate) ──▶ Frame ──▶ glidepath-link
//!        what the program asks for       push · finish · make_frame      one setpoint a period
//! ```
//!
//! **Entry points.** [`Planner`] takes the items of a program one by one and gives frames as soon
//! as the motion is settled that far. [`preview`] reads a NURBS ahead: where on it the feedrate is
//! too fast. [`scurve`] has the closed forms of jerk-limited speed changes, which others need as
//! well.
//!
//! **Invariants.** Pure computation: no I/O, no clock, no shared memory. The same items give the
//! same frames, whatever the timing or the chunking of the input, in memory that does not grow with
//! the length of the program. Every frame keeps the limits of every axis and the tolerance of the
//! path; where no such frame is found, none is given out, and [`PlanError::NoMotion`] says so.
//!
//! **Two engines**, each a principle, chosen by [`glidepath_program::Effort`]:
//!
//! | engine | what is given | what is planned |
//! |---|---|---|
//! | `on_path` | the path, from program and tolerance alone | the time along it |
//! | `in_tube` | the program and its tolerance, as a tube | geometry and time together |
//!
//! Beside them stands what both use: `intake` (the checks of items), `programmed_rate` and
//! `feed_axes`, `rest`, `grid` (the frames of one period each), [`scurve`]; and above them
//! `stretches`, which plans from rest to rest with the engine that is faster, and `planner`, with
//! `guard`, the last look at a frame; `engine_kind` says which of the two plans at least. `on_path` knows
//! nothing of `in_tube`. [`parts`] plans a program in parts that begin and end at rest, for whoever
//! has several cores.
//!
//! Two moves planned, and their frames counted:
//!
//! ```
//! use glidepath_geometry::{AxisVector, Segment};
//! use glidepath_motion::{PlanError, Planner};
//! use glidepath_program::{Effort, Item, ItemKind, Limits, PathMode, Rate, Settings, Smoothing};
//!
//! let settings = Settings {
//!     limits: Limits::uniform(200.0, 2000.0, 40_000.0),
//!     tolerance_mm: 0.02,
//!     direction: glidepath_program::DirectionTolerance::default(),
//!     smoothing: Smoothing::Auto,
//!     corners: glidepath_program::Corners::default(),
//!     period_t: 0.004,
//!     effort: Effort::Fast,
//! };
//! let point = |x, y| {
//!     let mut point = AxisVector::zeros();
//!     (point[0], point[1]) = (x, y);
//!     point
//! };
//! let corners = [point(0.0, 0.0), point(10.0, 0.0), point(10.0, 5.0)];
//! let mut planner = Planner::new(settings, corners[0]);
//! for (line, ends) in (1..).zip(corners.windows(2)) {
//!     let kind = ItemKind::Move {
//!         segment: Segment::line(ends[0], ends[1]),
//!         rate: Rate::Feed(100.0),
//!         mode: PathMode::Continuous { tolerance_mm: None },
//!     };
//!     planner.push(&Item { block: line, line, kind })?;
//! }
//! planner.finish();
//! let mut frames = 0;
//! while planner.make_frame()? {
//!     frames += 1;
//! }
//! // 0.36 s: 15 mm at 100 mm/s would take 0.15 s; starting, the corner and stopping take the rest.
//! assert_eq!(frames, 91);
//! assert_eq!(planner.frame().position, corners[2]);
//! # Ok::<(), PlanError>(())
//! ```
//!
//! Suffixes of local names, declared once for the crate:
//!
//! | suffix | meaning |
//! |---|---|
//! | `_mm` | length; degrees where the axis is rotary |
//! | `_v` `_a` `_j` | velocity, acceleration, jerk: mm/s, mm/s², mm/s³ (degrees for rotary axes) |
//! | `_s` | position along the path |
//! | `_t` | time in seconds |
//! | `_ns` | integer nanoseconds |
//! | `_u` | a curve's own parameter, 0…1 |
//! | `_k` | curvature, 1/mm |

mod due_event;
mod engine_kind;
mod error;
mod event_pace;
mod feed_axes;
mod grid;
mod guard;
mod in_tube;
mod intake;
mod joints;
mod on_path;
pub mod parts;
mod planner;
pub mod preview;
mod programmed_rate;
mod rest;
mod ruled;
pub mod scurve;
mod step;
mod stretches;

pub use error::PlanError;
pub use joints::{Joints, JointsOnCurve};
pub use planner::Planner;
pub use stretches::MOST_MOVES_AT_ONCE;
