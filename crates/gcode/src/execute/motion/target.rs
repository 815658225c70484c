//! The target of a block: where its axis words lead.

use glidepath_geometry::{AXES, AxisVector};

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::offsets::overlay;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::Distance;

impl Interpreter {
    /// Machine coordinates the axis words of a block lead to.
    pub(crate) fn target(&self, block: &Block) -> Outcome<AxisVector> {
        let mut values = self.axis_values(block)?;
        if block.has_machine_coordinates() {
            // On a SINUMERIK the length of the tool stays in force: D0 takes it back.
            if block.dialect == Dialect::Siemens {
                for (axis, value) in values.iter_mut().enumerate() {
                    *value = value.map(|value| value + self.state.offsets.tool[axis]);
                }
            }
            let target = overlay(self.state.position, &values);
            return Ok(self.rolled_over(block, target));
        }
        if self.state.modal.distance == Distance::Absolute {
            self.add_coordinate_before_turn(block, &mut values)?;
            return Ok(self.rolled_over(block, self.absolute_target(&values)));
        }
        self.add_length_on_way(block, &mut values);
        if self.state.untraversed.is_any() {
            self.add_untraversed(block, &mut values)?;
        }
        let axes = self.state.offsets.turned_with(&values);
        if !axes.is_empty() {
            let mut by = AxisVector::zeros();
            for axis in 0..3 {
                by[axis] = values[axis].unwrap_or(0.0);
            }
            let turned = self.state.offsets.turn(by);
            for &axis in axes {
                values[axis] = Some(turned[axis]);
            }
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
        let offsets = &self.state.offsets;
        for axis in 0..AXES {
            if let Some(value) = values[axis] {
                target[axis] = value + offsets.origin(axis);
            }
        }
        let axes = offsets.turned_with(values);
        if !axes.is_empty() {
            let program = overlay(offsets.to_program(self.state.position), values);
            let turned = offsets.to_machine(program);
            for &axis in axes {
                target[axis] = turned[axis];
            }
        }
        target
    }
}
