//! The seven-phase S-curve: speed changes along a path with bounded acceleration and jerk.
//!
//! ```text
//!      v                 _______
//!                       /       \
//!                     /           \___ v1          jerk  +J  0 −J  0 −J  0 +J
//!             v0 ___/                              phase  1  2  3  4  5  6  7
//! ```
//!
//! Acceleration is zero at both ends, so a speed change ("ramp") from `v0` to `v1` is symmetric in
//! time: with d = |v1 − v0| it takes 2·t_j + t_a, where t_j = A/J, t_a = d/A − A/J if d ≥ A²/J and
//! t_j = √(d/J), t_a = 0 otherwise, and it covers exactly ½(v0 + v1)(2·t_j + t_a).
//!
//! Two traps, both with numbers in the tests. The speed reachable over a length is *not* monotone
//! in the speed one starts from, and a full stop can need *less* room than slowing down partly. So
//! no search here runs over the lower speed of a ramp; and whoever looks ahead for a stop must look
//! [`slowing_horizon`] ahead, not the stopping distance.
//!
//! Formulas: the phase table of Gu, Zhou, Lin et al. (seven-phase feed along NURBS), the rest
//! derived.

mod phase;
mod profile;
mod ramp;
mod speed_change;
mod whole_ticks;

pub use phase::PathState;
pub use profile::Profile;
pub(crate) use profile::{Extremes, Outline};
pub use ramp::{PathLimits, ramp_fits, ramp_length, reachable_speed, slowing_horizon};
pub use speed_change::SpeedChange;
pub use whole_ticks::{WholeTicks, speed_up_in_whole_ticks};
