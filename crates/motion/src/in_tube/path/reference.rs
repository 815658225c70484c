//! The path as the planner of a stretch is given it.

use glidepath_geometry::AxisVector;

/// One straight piece of the path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reference {
    /// Where it ends; it starts where the piece before it ended.
    pub(crate) end: AxisVector,
    /// Largest path speed, in mm/s of [`glidepath_geometry::feed_length`], > 0 and finite. For a
    /// rapid: the speed at which some axis is at its limit.
    pub(crate) top_v: f64,
    /// How far the motion may be from the path, and each vertex from the motion, in XYZ and in UVW,
    /// mm, > 0. At a vertex the smaller tolerance of both sides holds.
    pub(crate) tolerance_mm: f64,
    /// The same for each rotary axis, degrees, > 0.
    pub(crate) tolerance_deg: f64,
    /// From the middle of the piece to the program it stands for, which is taken to be a parabola
    /// over it: where the motion is drawn to. Within what the tolerance is smaller by.
    pub(crate) sagitta_vector: AxisVector,
    /// How far the motion may be beside it in its middle half, mm; none where the tolerance is for all of it.
    pub(crate) straight_mm: Option<f64>,
    /// It has no feed.
    pub(crate) is_rapid: bool,
    /// Given back with each period, and asked for when rates change.
    pub(crate) tag: u64,
}
