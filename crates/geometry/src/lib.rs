//! Curves of a toolpath: pure mathematics, no I/O, no clock, and no allocation in evaluation.
//!
//! Everything above this crate speaks of paths in its words, and it knows nothing of any of them:
//! no G-code, no time, no machine.
//!
//! * [`AxisVector`]: a position over all nine axes, X Y Z A B C U V W.
//! * [`Segment`]: a piece of a programmed path, a [`Line`], an [`Arc`] (helices included) or a
//!   [`Quintic`], by *path position*; [`Prepared`] evaluates the same one faster, many times over.
//! * [`Transition`]: a curve that replaces the corner of two segments.
//! * [`Nurbs`] and [`NurbsPath`], the same curve by path position.
//! * [`number`]: formulas over plain numbers, Taylor series, gradients and intervals alike.
//!
//! What always holds: a [`Jet`] is position and exact derivatives, never differences; bounds
//! ([`DerivativeBounds`]) are never below the true maximum; what is out of a curve's range is
//! clamped to its ends, not extrapolated.
//!
//! ```
//! use glidepath_geometry::{AxisVector, Segment, Transition};
//!
//! let (start, mut corner) = (AxisVector::zeros(), AxisVector::zeros());
//! corner[0] = 30.0; // mm
//! let line = Segment::line(start, corner);
//! assert_eq!(line.length(), 30.0);
//! assert_eq!(line.jet(12.0).position[0], 12.0);
//!
//! // Around a right angle, 2 mm of each side are replaced: 0.44 mm off the corner.
//! let (mut along_x, mut along_y) = (AxisVector::zeros(), AxisVector::zeros());
//! (along_x[0], along_y[1]) = (1.0, 1.0);
//! let curve = Transition::sextic(corner, along_x, along_y, 2.0);
//! let middle = curve.jet(curve.length() / 2.0).position;
//! assert!(((middle - corner).norm() - 0.442).abs() < 1e-3);
//! ```
//!
//! Lengths are in mm, rotary axes in degrees, angles inside formulas in radians.
//!
//! | suffix | meaning |
//! |---|---|
//! | `_mm` | a length |
//! | `_s` | position along a path (see [`Segment`]) |
//! | `_u` | a curve's own parameter |
//! | `_k` | curvature, 1/mm |
//! | `_rad` | an angle |

mod arc;
mod axis;
mod bernstein;
mod cubic;
mod jet;
pub mod number;
mod nurbs;
mod prepared;
mod quadrature;
mod quintic;
mod segment;
mod transition;
mod turn;

pub use arc::{Arc, Plane};
pub use axis::{AXES, Axis, AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};
pub use cubic::Cubic;
pub use jet::Jet;
pub use nurbs::{MAX_DEGREE, Nurbs, NurbsError, NurbsJet, NurbsPath, Span, SpanCurvature};
pub use prepared::{Prepared, PreparedArc, PreparedLine};
pub use quintic::Quintic;
pub use segment::{Line, Segment, feed_length};
pub use transition::{
    BezierPair, Blend, DerivativeBounds, Hermite, PairShape, Transition, TransitionError,
};
pub use turn::{Turn, limit_along, tolerance_half_turn, tolerance_norm};
