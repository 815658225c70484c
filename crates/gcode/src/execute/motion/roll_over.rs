//! Rotary axes of a FANUC that roll over (parameter 1008: ROAx 1, RABx 0): their angles are those of one turn.
//!
//! ```text
//! G90 A0
//! G90 A-150.      turns by -150, to 210
//! G90 A540.       turns by  -30, to 180
//! G91 A380.       turns by  380, to 200
//! ```
//!
//! An absolute angle is gone to by the shorter way, one that is half a turn away with rising angles; increments are
//! what they say. The machine's axis counts its turns, and the program sees the angle within one.

use glidepath_geometry::{Axis, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;

const TURN_DEG: f64 = 360.0;
/// Angles as near to each other as this are one, degrees.
const SAME_DEG: f64 = 1e-9;

impl Interpreter {
    /// True for an axis that rolls over in the program's language.
    pub(crate) fn rolls_over(&self, axis: Axis) -> bool {
        self.options.fanuc.rolls_over
            && self.options.dialect == Dialect::Fanuc
            && matches!(axis, Axis::A | Axis::B | Axis::C)
    }

    /// A target to which absolute words of a block lead, with the angles that are written gone to by the shorter way.
    pub(crate) fn rolled_over(&self, block: &Block, mut target: AxisVector) -> AxisVector {
        for (axis, _) in block.axes().filter(|(axis, _)| self.rolls_over(*axis)) {
            let here = self.state.position[axis.index()];
            target[axis.index()] = here + shorter_way(target[axis.index()] - here);
        }
        target
    }

    /// An angle as the program sees it.
    pub(crate) fn within_a_turn(&self, axis: Axis, value: f64) -> f64 {
        if self.rolls_over(axis) {
            (value + SAME_DEG).rem_euclid(TURN_DEG) - SAME_DEG
        } else {
            value
        }
    }

    /// Where G28 and G30 take an axis that rolls over and is at the angle of the reference position: nowhere.
    ///
    /// # Errors
    ///
    /// It is at another angle: the way that it turns is a parameter's.
    pub(super) fn reference_within_a_turn(
        &self,
        block: &Block,
        axis: Axis,
        reference: f64,
    ) -> Outcome<f64> {
        let here = self.state.position[axis.index()];
        if !self.rolls_over(axis) {
            return Ok(reference);
        }
        if shorter_way(reference - here).abs() <= 1e-6 {
            return Ok(here);
        }
        let message = format!("the way to the reference position of {axis}, which rolls over");
        Err(
            BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, block.first_span(), message)
                .because("which way the axis turns there is a parameter of the control")
                .help(format!(
                    "write G90 G53 G0 {axis}0 before it, which goes the shorter way"
                )),
        )
    }
}

/// The shorter of the ways to an angle that is so far away, above -180 and up to 180 degrees.
fn shorter_way(degrees: f64) -> f64 {
    degrees - TURN_DEG * ((degrees - 0.5 * TURN_DEG - SAME_DEG) / TURN_DEG).ceil()
}
