//! Joints in records: by index, or one bit each.

use glidepath_geometry::AXES;

/// Every joint, one bit each, J0 lowest.
pub const ALL_JOINTS: u32 = (1 << AXES) - 1;

/// The highest index of a joint, as a number to compare with.
#[allow(clippy::cast_precision_loss, reason = "a single digit")]
pub(crate) const HIGHEST_JOINT: f64 = (AXES - 1) as f64;
