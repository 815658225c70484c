//! Tremor: motion that the program does not ask for, inside all limits and tolerances.
//!
//! Three rules, judged from positions alone, with the program matched to them:
//!
//! 1. **An axis that the program leaves alone is still** (`still`). Where consecutive moves keep a
//!    coordinate of an axis exactly constant, every sample has that coordinate, to
//!    [`STILL_MM`]. The settling time ([`SETTLING_T`], at least [`SETTLING_PERIODS`]) before and
//!    after moves that do change it is left out: the motion may round the corner to them. Longer
//!    roundings may be as long as they like, if the axis leaves its coordinate but once: before
//!    such a move every sample is further off than the one before, after it nearer. A rest of the
//!    machine at the coordinate ends what came before it.
//! 2. **A cruise has no jerk but that of the path** (`cruise`). On a line or an arc, where the speed
//!    has come to the programmed feed, and the settling time after that and before it is there last,
//!    with no more than a twentieth off in between, third differences are off what the piece asks for
//!    by at most a tenth of that and a hundredth of the limit of the axis, or it is a single step:
//!    √2 times the root of the mean square over the settling time is at most that. What an arc asks
//!    for is v³/R² against its direction, with the radius and the speed at which it is run: it may be
//!    cut within its tolerance. Where it asks for nearly all that an axis can do, speed is not the
//!    feed all the way round, and nothing is judged.
//!
//! What breaks them is told as [`AuditReport::tremors`](crate::AuditReport::tremors), and is no violation as
//! long as [`TREMORS_ARE_VIOLATIONS`] is false.

mod cruise;
mod matched_sample;
mod round;
mod settling;
mod slow_down;
mod still;

pub(crate) use cruise::Cruise;
pub(crate) use matched_sample::MatchedSample;
pub use settling::{SETTLING_PERIODS, SETTLING_T};
pub(crate) use slow_down::SlowDown;
pub use still::STILL_MM;
pub(crate) use still::StillAxes;

/// Whether what breaks the rules of tremor counts as a violation, too.
pub const TREMORS_ARE_VIOLATIONS: bool = false;
