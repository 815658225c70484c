//! U, V, W and H of a lathe: increments of X, Y, Z and C, in any block beside absolute words.

use glidepath_geometry::{AXES, Axis};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::axis_words::axis_value;
use crate::syntax::block::Block;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::modes::{Distance, NonModal};

/// Letters of increments, and the axis of each.
const INCREMENTS: [(u8, Axis); 4] = [
    (b'U', Axis::X),
    (b'V', Axis::Y),
    (b'W', Axis::Z),
    (b'H', Axis::C),
];

impl Interpreter {
    /// True if the machine has every axis that the block of a lathe moves.
    pub(crate) fn has_lathe_axes(&self, block: &Block) -> bool {
        let has = |axis| self.options.machine.has(axis);
        let of_increments = INCREMENTS
            .iter()
            .all(|(letter, axis)| block.get(*letter).is_none() || has(*axis));
        let is_data = block
            .codes
            .non_modal
            .is_some_and(|code| code.code == NonModal::Dwell);
        let of_others = block
            .axes()
            .all(|(axis, _)| matches!(axis, Axis::U | Axis::V | Axis::W) || has(axis) || is_data);
        (of_increments || is_data) && of_others
    }

    /// Where X and Z of a lathe's cycle are, program coordinates: in G91 of systems B and C they are increments.
    pub(crate) fn ends_of_cycle(&self, block: &Block) -> Outcome<[Option<f64>; AXES]> {
        let mut values = self.axis_values(block)?;
        if !block.has_increments() && self.state.modal.distance == Distance::Incremental {
            let program = self.state.offsets.to_program(self.state.position);
            for axis in [Axis::X, Axis::Z].map(Axis::index) {
                values[axis] = values[axis].map(|by| program[axis] + by);
            }
        }
        Ok(values)
    }

    /// Puts the ends that increments lead to into the places of their axes, program coordinates.
    pub(crate) fn resolve_increments(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let program = self.state.offsets.to_program(self.state.position);
        let scale = self.state.modal.units.mm();
        for (letter, axis) in INCREMENTS {
            let own = match letter {
                b'U' => Some(Axis::U),
                b'V' => Some(Axis::V),
                b'W' => Some(Axis::W),
                _ => None,
            };
            if let Some(own) = own {
                values[own.index()] = None;
            }
            let Some(word) = block.get(letter) else {
                continue;
            };
            let i = axis.index();
            if values[i].is_some() {
                let [name, other] = [letter, AXIS_LETTERS[i]].map(char::from);
                let message = format!("{name} beside {other}");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::AmbiguousWord,
                    block.span(letter),
                    message,
                )
                .because(format!("{name} is the increment of {other}"))
                .help("write one of them"));
            }
            let is_diameter = axis == Axis::X && self.state.modal.diameter;
            let share = if is_diameter { 0.5 } else { 1.0 };
            values[i] = Some(program[i] + share * axis_value(axis, word, scale));
        }
        Ok(())
    }
}
