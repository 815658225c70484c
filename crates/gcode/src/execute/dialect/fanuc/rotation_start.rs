//! The first move behind G68: where the coordinate is that it does not name.
//!
//! ```text
//!   G0 X10 Y10, G68 X0 Y0 R45, Y14.142:
//!   X is 10 as before the rotation (AX1 = 0)       (10, 14.142) turned by 45°:     (-2.929, 17.071)
//!   X is where the tool is in it (AX1 = 1)         (14.142, 14.142) turned by 45°: (0, 20)
//! ```

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::setup::fanuc::RotationStart;
use crate::syntax::block::Block;
use glidepath_geometry::AXES;

/// Coordinates nearer than this are the same, mm.
const SAME_MM: f64 = 1e-6;

impl Interpreter {
    /// Adds to the coordinates of a block in G90 the one of the rotated plane that it does not name, if it is the first move
    /// there and that decides where it leads.
    pub(crate) fn add_coordinate_before_turn(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let offsets = &self.state.offsets;
        let Some(before) = offsets.fanuc.before_turn else {
            return Ok(());
        };
        let (first, second) = before.plane.axes();
        let axes = [first.index(), second.index()];
        let has_moved = axes
            .iter()
            .any(|&axis| (self.state.position[axis] - before.machine[axis]).abs() > SAME_MM);
        let (named, left_out) = match axes.map(|axis| values[axis].is_some()) {
            [true, false] => (axes[0], axes[1]),
            [false, true] => (axes[1], axes[0]),
            _ => return Ok(()),
        };
        let here = offsets.to_program(self.state.position)[left_out];
        let as_before = before.program[left_out];
        if has_moved || (as_before - here).abs() <= SAME_MM {
            return Ok(());
        }
        match self.options.fanuc.rotation_start {
            RotationStart::AsRotated => Ok(()),
            RotationStart::AsBefore => {
                values[left_out] = Some(as_before);
                Ok(())
            }
            RotationStart::Unsaid => Err(names_one_axis(block, [named, left_out])),
        }
    }
}

#[cold]
fn names_one_axis(block: &Block, axes: [usize; 2]) -> Box<BlockDiagnostic> {
    let [named, left_out] = axes.map(|axis| [b'X', b'Y', b'Z'][axis]);
    let [letter, other] = [named, left_out].map(char::from);
    let message = format!("{letter} without {other} in the first move behind G68");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.span(named), message)
        .because(format!(
            "{other} is what it was before the rotation, or where the tool is in the rotated coordinates, as a parameter of \
             the control says (11600#5)"
        ))
        .help(format!("write {other}, too, or say rotation_start = \"as-before\" or \"as-rotated\" in [program]"))
}
