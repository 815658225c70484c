//! Curves of a toolpath: pure mathematics, no I/O, no clock, and no allocation in evaluation.
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
pub use turn::{Turn, limit_along, tolerance_half_turn};
