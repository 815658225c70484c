//! Bacterial foraging, the published method, kept for comparison.
//!
//! *On the control points*, as Gu, Zhou, Lin et al. published it: what least squares solves
//! exactly, so it can only come near to that (`control_points`). *On the knots*: the same search
//! where no exact solution is known (`knots`). The search itself is `colony`.

mod colony;
mod control_points;
mod hull;
mod knots;
mod random;
mod report;

pub(crate) use control_points::on_control_points;
pub(crate) use knots::on_knots;
pub use report::Foraging;
