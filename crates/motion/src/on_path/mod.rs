//! The on-path engine: it plans the time along a path that is given.
//!
//! The geometry is settled first, from the program and the tolerance alone: dense chords become a
//! smooth spline in the tube around them, corners become transitions or stops. Then the motion
//! along that path is planned: S-curves between junctions of speeds found by look-ahead, made
//! faster where the limits of the axes leave room, and on curves a time parametrisation that is
//! optimal as a whole.
//!
//! ```text
//!   item ──▶ front ──▶ pieces, rests ──▶ look_ahead ──▶ settled motion ──▶ refining ──▶ sampler ──▶ frames
//!            │                           │                                 │
//!            ├ spline_tube               └ speed                           └ topp
//!            └ junction
//! ```
//!
//! | folder | what it settles |
//! |---|---|
//! | `pieces` | what the path is made of, and how fast each piece may be driven |
//! | `spline_tube` | the smooth curve in place of dense chords |
//! | `junction` | where two segments meet: straight on, a transition, or a stop |
//! | `front` | items in, pieces and rests out |
//! | `speed` | S-curves through runs of pieces |
//! | `topp` | time parametrisation along a given path |
//! | `look_ahead` | the speeds between runs, and what of the motion is settled |
//! | `refining` | where a time parametrisation takes the place of S-curves |

mod engine;
mod front;
mod junction;
mod look_ahead;
mod pieces;
mod refining;
mod sampler;
mod slowing;
mod speed;
mod spline_tube;
mod topp;

pub(crate) use engine::OnPathEngine;
pub(crate) use front::chord_speed;
pub(crate) use junction::is_exact_corner;
pub(crate) use look_ahead::Settled;
pub(crate) use pieces::{JointRule, SpeedLimit};
