//! Space curves given by formulas, stepped in equal chords with proven error.
//!
//! ```text
//!   x(t), y(t), z(t)       ParametricCurve ─┐
//!                                           ├─ stepper ─▶ chord after chord ─▶ line segments
//!   f(x,y,z) = 0 = g       ImplicitCurve ───┘              each with a bound on its error
//! ```
//!
//! A chord of length L leads from a point of the curve to the *first* point at distance L. With L
//! = v·T for every tick, the tool moves at exactly constant speed from setpoint to setpoint. Every
//! end point is computed from the curve itself, not from the point before, so errors do not
//! accumulate over any number of laps.
//!
//! The formulas are read by [`Expression`], which evaluates over any
//! [`Number`](glidepath_geometry::number::Number): with derivatives for the solvers, over intervals
//! for the proofs. This is a crate of its own, not part of `geometry`, because curves of text
//! belong to the reading of programs; the real-time side, which depends on `geometry`, has no use
//! for them.
//!
//! In the pipeline this crate stands beside `glidepath-gcode`: the planner reads a curve file
//! ([`CurveFile`], or [`NurbsFile`] for control points) and turns its [`Chords`] into items.
//!
//! What always holds: a chord's error is bounded by interval arithmetic over the whole arc, not by
//! samples; no chord crosses a point at which the curve stands still or is not defined; all
//! diagnostics of a file have their place in the text and a remedy.
//!
//! ```
//! use glidepath_curve::ParametricCurve;
//! use glidepath_curve::parametric::{Method, ParametricStepper};
//!
//! let circle = ParametricCurve::parse(["20*cos(t)", "20*sin(t)", "0"]).expect("formulas in t");
//! let mut stepper = ParametricStepper::new(&circle, 0.0, Method::Newton);
//! for _ in 0..5 {
//!     let step = stepper.look(1.5, core::f64::consts::TAU)?;
//!     assert!((step.chord_mm - 1.5).abs() < 1e-9);
//!     stepper.advance(&step);
//! }
//! // 1.5 mm from point to point is an angle of 2 asin(0.75 / 20).
//! assert!((stepper.t() - 10.0 * f64::asin(0.0375)).abs() < 1e-9);
//! # Ok::<(), glidepath_curve::CurveError>(())
//! ```
//!
//! Source of the equal chords: Lu, Zhao, Wang, Jiang, *Research on space curve interpolation of
//! equal chord length for parallel machine tool*, Machinery Design & Manufacture 2010 no. 3. Its
//! methods are here for comparison ([`published`], [`parametric::Method::Bisection`]); what is
//! used by default differs where they fail: a bracket that proves the first crossing, a corrector
//! that puts implicit points on the curve, and an error bound that holds over the whole arc.

mod expression;
mod file;
pub mod implicit;
mod laps;
mod nurbs_file;
pub mod parametric;
pub mod published;
mod range;
mod rule;
mod sagitta;
mod serde_words;

pub use expression::{Expression, ExpressionError};
pub use file::{CurveFile, FileDiagnostic, Shape, ShapeKey};
pub use implicit::ImplicitCurve;
pub use laps::Chords;
pub use nurbs_file::NurbsFile;
pub use parametric::ParametricCurve;
pub use rule::{Chord, ChordRule, CurveError};
pub use sagitta::{arc_over_chord, chord_mm, sagitta_mm};
