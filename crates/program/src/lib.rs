//! The vocabulary of the pipeline: what a program says, what a motion is, what bounds both.
//!
//! ```text
//! gcode, link ── Item ──► motion ── Frame ──► link ── Frame ──► interpolator
//!                            ▲                                      ▲
//!                     Settings, Override                         Limits
//! ```
//!
//! The crates above speak to each other in these words and know nothing else of one another: a
//! reader of programs does not compile against a planner, nor does an interpolator. That is why
//! nothing here computes a motion. It holds
//!
//! * [`Item`]: a segment with its rate and [`PathMode`], a dwell, or an [`Event`], in program
//!   order;
//! * [`Frame`]: position, velocity and acceleration of every axis at one instant of program time;
//! * [`Limits`] of the axes, with their [`Travel`], and [`PathBounds`] of the motion along the path;
//! * [`Settings`], all that a plan depends on besides the program, and the operator's [`Override`];
//! * [`tolerance_norm`], the distance that a tolerance bounds, so that all who judge a deviation
//!   measure the same.
//!
//! Everything is in mm, degrees and seconds, in machine coordinates. Values are plain: whoever
//! takes them from outside checks them (the planner its items, the interpolator its frames).
//!
//! ```
//! use glidepath_geometry::{AxisVector, Segment};
//! use glidepath_program::{Item, ItemKind, PathMode, Rate};
//!
//! let (start, mut end) = (AxisVector::zeros(), AxisVector::zeros());
//! end[0] = 10.0;
//! let item = Item {
//!     line: 3,
//!     block: 1,
//!     kind: ItemKind::Move {
//!         segment: Segment::line(start, end),
//!         rate: Rate::Feed(50.0), // mm/s
//!         mode: PathMode::Continuous { tolerance_mm: Some(0.02) },
//!     },
//! };
//! assert!(matches!(item.kind, ItemKind::Move { rate, .. } if rate.feed_v() == Some(50.0)));
//! ```

mod frame;
mod frame_events;
mod item;
mod limits;
mod override_;
mod settings;
mod travel;

pub use frame::{Frame, FrameFlags};
pub use frame_events::{EVENTS_MOST, FrameEvents, TimedEvent};
pub use item::{
    CodeWord, Event, Item, ItemKind, OrientWay, PHASE_STEPS, PathMode, ProgramLine, Rate,
    TAP_DEPTHS_UM, TAP_OVERTRAVEL,
};
pub use limits::{Limits, PathBounds};
pub use override_::Override;
pub use settings::{Corners, DirectionTolerance, Effort, Settings, Smoothing};
pub use travel::Travel;
// Who judges a deviation measures it as everybody else does.
pub use glidepath_geometry::tolerance_norm;
