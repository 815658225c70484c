//! The auditor: judges a motion against its program and the machine's limits.
//!
//! It stands beside the planner, not behind it: Cargo itself keeps it from using anything of the
//! planner, for it depends on the vocabulary and on the evaluation of programmed segments alone. It
//! trusts nothing but positions. Fed with the program and the samples, each in order, an [`Audit`]
//! checks
//!
//! * every axis' velocity, acceleration and jerk by finite differences (`limits`), with the machine
//!   at rest before the first and after the last sample;
//! * every joint's velocity, acceleration and jerk likewise, and its range, where joints are not axes and it
//!   is told where they are (`joints`);
//! * the reported velocity and acceleration against those differences, and the sequence for gaps;
//! * the deviation, both ways and in order (`matching`): each sample and the straight line between
//!   two samples is within tolerance of the programmed path, each programmed point within tolerance
//!   of the motion, and both are passed in the same order;
//! * exact stops, dwells, the programmed feed, and that the path was run to its end.
//!
//! Memory is bounded by how far the program is fed ahead of the samples; work is linear in both.
//! Of events that do not stop the motion it tells how far from their places they happen. Beside violations it tells of *tremors* ([`tremor`]): motion inside all limits that the program
//! does not ask for. What keeps a motion from being faster is told by [`diagnosis`], fed in the same way, and how
//! smooth it is by [`smoothness`], how true its shape by [`shape`].
//!
//! ```
//! use glidepath_audit::{Audit, AuditSettings, Sample, ViolationKind};
//! use glidepath_geometry::AxisVector;
//! use glidepath_program::Limits;
//!
//! let mut audit = Audit::new(&AuditSettings {
//!     limits: Limits::uniform(200.0, 2000.0, 40_000.0), // mm/s, mm/s², mm/s³
//!     period_t: 0.004,
//!     tolerance_mm: 0.02,
//!     direction: glidepath_program::DirectionTolerance::default(),
//!     corners: glidepath_program::Corners::default(),
//! });
//! for (tick, x_mm) in [0.0, 0.0, 1.0, 1.0].into_iter().enumerate() {
//!     let mut position = AxisVector::zeros();
//!     position[0] = x_mm; // 1 mm in 4 ms: 250 mm/s
//!     audit.sample(&Sample {
//!         tick: tick as u64,
//!         line: 1,
//!         position,
//!         reported: None,
//!         is_between_frames: false,
//!     });
//! }
//! let report = audit.finish();
//! assert!(report.violations.iter().any(|found| matches!(found.kind, ViolationKind::Velocity { .. })));
//! ```

mod along;
mod amount;
mod audit;
mod column;
pub mod diagnosis;
mod end;
mod event_places;
mod exact_end;
mod feed;
mod flatten;
mod follow;
mod free_space;
mod joints;
mod judge;
mod limits;
mod matching;
mod out_of_tolerance;
mod passed;
mod passed_points;
mod piece;
mod program;
mod report;
mod sample;
mod settings;
pub mod shape;
pub mod smoothness;
mod tool_axis;
mod travel;
pub mod tremor;
mod turn_tolerance;
mod violation;
mod widen;

pub use audit::Audit;
pub use joints::{JointBounds, WorstJoint};
pub use passed::Passed;
pub use report::AuditReport;
pub use sample::Sample;
pub use settings::AuditSettings;
pub use tool_axis::{AxisTurn, ToolAxis};
pub use violation::{Inconsistency, JointRate, Violation, ViolationKind, Worst};
