//! The length of the tool in force, for who shows positions.

use glidepath_geometry::AxisVector;
use glidepath_kinematics::FiveAxis;
use serde::{Deserialize, Serialize};

use crate::execute::motion::tip_map::TipMap;
use crate::execute::state::tip::Tip;

/// The length of the tool in force, which positions of the work are without: the tip is shown, not the spindle.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ToolLength {
    /// The offset (G43), along the axes of the machine, mm or degrees.
    pub offset: AxisVector,
    /// What X, Y and Z are of, on a machine with five axes.
    pub tip: Tip,
}

impl ToolLength {
    /// The place of the axes without the tool: what is left is to be counted from the zero of a coordinate
    /// system. `machine`: the five axes, where the machine has them.
    #[must_use]
    pub fn without_it(&self, axes: &AxisVector, machine: Option<FiveAxis>) -> AxisVector {
        let map = TipMap::new(machine, self.tip);
        map.map_or(*axes, |map| map.place(axes)) - self.offset
    }
}
