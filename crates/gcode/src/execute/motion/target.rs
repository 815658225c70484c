//! Where the axis words of a block lead to.

use glidepath_geometry::{AXES, AxisVector};

use crate::diagnostic::fault::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::offsets::overlay;
use crate::syntax::block::Block;
use crate::syntax::modes::{Distance, NonModal};

impl Interpreter {
    /// Machine coordinates the axis words of a block lead to.
    pub(crate) fn target(&self, block: &Block) -> Outcome<AxisVector> {
        let mut values = self.axis_values(block)?;
        let machine = block
            .codes
            .non_modal
            .is_some_and(|o| o.code == NonModal::MachineCoordinates);
        if machine {
            return Ok(overlay(self.state.position, &values));
        }
        if self.state.modal.distance == Distance::Absolute {
            return Ok(self.absolute_target(&values));
        }
        if self.offsets.is_rotated() && (values[0].is_some() || values[1].is_some()) {
            let mut by = AxisVector::zeros();
            (by[0], by[1]) = (values[0].unwrap_or(0.0), values[1].unwrap_or(0.0));
            let turned = self.offsets.system().rotate(by, 1.0);
            (values[0], values[1]) = (Some(turned[0]), Some(turned[1]));
        }
        let mut target = self.state.position;
        for (axis, value) in values.into_iter().enumerate() {
            target[axis] += value.unwrap_or(0.0);
        }
        Ok(target)
    }

    /// Machine coordinates of program coordinates; an axis without a value stays where it is.
    pub(crate) fn absolute_target(&self, values: &[Option<f64>; AXES]) -> AxisVector {
        let mut target = self.state.position;
        let offsets = &self.offsets;
        for axis in 0..AXES {
            if let Some(value) = values[axis] {
                target[axis] = value + offsets.origin(axis);
            }
        }
        if offsets.is_rotated() && (values[0].is_some() || values[1].is_some()) {
            let program = overlay(offsets.to_program(self.state.position), values);
            let turned = offsets.to_machine(program);
            (target[0], target[1]) = (turned[0], turned[1]);
        }
        target
    }
}
