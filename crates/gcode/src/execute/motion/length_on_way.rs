//! A change of the tool's length (FANUC's G43, G44, G49 and H) that Z has not made yet.
//!
//! The codes themselves move nothing. In G90 the next Z leads to its place with the length in force. In
//! G91 the change is added to the next increment of Z, which ends at the same place:
//!
//! ```text
//!   G90  Z5   H1 is 10 mm long: the machine is at 15
//!   G91  G49 Z-2                             at 3
//!   G91  G43 H1 Z1                           at 14
//! ```

use glidepath_geometry::{AXES, Axis, AxisVector};
use nalgebra::Vector3;

use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::modes::{Motion, NonModal};

impl Interpreter {
    /// The way that the change is, in program coordinates, mm.
    pub(crate) fn length_on_way(&self) -> AxisVector {
        let length_mm = self.state.fanuc.length_on_way_mm;
        if length_mm == 0.0 {
            return AxisVector::zeros();
        }
        let place = self.state.position;
        let along = match self.options.five_axis {
            Some(machine) if self.state.tip.follows() => {
                let [tilt, rotary] = [machine.tilt_axis(), Axis::C].map(|axis| place[axis.index()]);
                machine.tool_axis(tilt, rotary)
            }
            _ => Vector3::z(),
        };
        let mut far = place;
        for i in 0..3 {
            far[i] += length_mm * along[i];
        }
        self.state.offsets.to_program(far) - self.state.offsets.to_program(place)
    }

    /// Adds the change to the increments of a block that moves Z. The way to a reference position begins
    /// where the tool is.
    pub(crate) fn add_length_on_way(&self, block: &Block, values: &mut [Option<f64>; AXES]) {
        if values[2].is_none() || goes_to_reference(block) {
            return;
        }
        let way = self.length_on_way();
        for (value, way) in values.iter_mut().zip(way.iter()) {
            *value = value.map(|value| value + way);
        }
    }

    /// The change is made where a block has moved Z, or has given its place a new coordinate.
    pub(crate) fn end_length_on_way(&mut self, block: &Block, motion: Option<Motion>) {
        if self.state.fanuc.length_on_way_mm == 0.0 {
            return;
        }
        let has_z = block.get(b'Z').is_some();
        let names = block
            .codes
            .non_modal
            .is_some_and(|coded| matches!(coded.code, NonModal::SetOffset));
        let made = has_z && (names || motion.is_some())
            || matches!(motion, Some(Motion::Cycle(_)))
            || goes_to_reference(block) && (has_z || !block.has_axes());
        if made {
            self.state.fanuc.length_on_way_mm = 0.0;
        }
    }
}

fn goes_to_reference(block: &Block) -> bool {
    block
        .codes
        .non_modal
        .is_some_and(|coded| matches!(coded.code, NonModal::GoToReference(_)))
}
