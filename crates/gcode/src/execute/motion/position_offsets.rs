//! The offsets in force beside the coordinate system, for whoever shows positions.

use glidepath_geometry::AxisVector;
use glidepath_kinematics::FiveAxis;
use serde::{Deserialize, Serialize};

use crate::execute::motion::tip_map::TipMap;
use crate::execute::state::tip::Tip;

/// The offsets in force that positions of the part are without, beside the coordinate system: the tip is
/// shown, not the spindle, and what G92 or G52 has shifted.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PositionOffsets {
    /// The length of the tool (G43), along the axes of the machine, mm or degrees.
    pub tool: AxisVector,
    /// The shift of G92 or G52, along the axes of the coordinate system, mm or degrees.
    #[serde(default)]
    pub shift: AxisVector,
    /// What X, Y and Z are of, on a machine with five axes.
    pub tip: Tip,
}

impl PositionOffsets {
    /// The place of the axes without the tool: what is left is to be counted from the zero of a coordinate
    /// system. `machine`: the five axes, where the machine has them.
    #[must_use]
    pub fn without_tool(&self, axes: &AxisVector, machine: Option<FiveAxis>) -> AxisVector {
        let map = TipMap::new(machine, self.tip);
        map.map_or(*axes, |map| map.place(axes)) - self.tool
    }
}
