//! The joints of a mechanism as planning in the tube sees them, where they are not the axes.
//!
//! Where a corner is rounded, the motion goes in directions that no side of the corner has, and how
//! fast joints are in them only the mechanism knows. So whoever knows it implements [`Joints`]: a
//! window keeps their speeds like the feed, as rows of its problem, and no motion is taken that they
//! cannot follow. Where no such window is found, the motion goes straight to the next vertex, at
//! the rates of the items, which have to be such that joints can follow along them.

use core::fmt;
use glidepath_geometry::AxisVector;
use std::sync::Arc;

/// The joints of a mechanism, seen from its axes.
pub trait Joints: fmt::Debug + Send + Sync {
    /// The rows r of a position: a velocity ẋ of the axes (mm/s, °/s) is one that every joint can
    /// have there if |r · ẋ| ≤ 1 for all of them. None where the mechanism cannot be.
    fn velocity_rows(&self, position: &AxisVector) -> Vec<AxisVector>;

    /// True if every joint keeps its limits on the way to the first of four positions that are a
    /// period (s) apart, the newest first.
    fn allow(&self, positions: &[AxisVector; 4], period_t: f64) -> bool;
}

/// The joints that limit a motion, if they do so beside the axes.
pub(crate) type SharedJoints = Option<Arc<dyn Joints>>;
