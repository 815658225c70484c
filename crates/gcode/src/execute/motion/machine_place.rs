//! Places of the machine (G53, SUPA, G28, G30) where the tip of the tool is followed.
//!
//! They are places of the machine's own axes, without the length of the tool. For such a move the
//! coordinates are those of the axes; behind it the tip is followed again.

use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::tip::Tilt;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::{Motion, NonModal};

/// Angles below this are zero, degrees.
const ZERO_DEG: f64 = 1e-9;

impl Interpreter {
    /// True for a block that goes to a place of the machine while the tip is followed.
    fn leaves_tip(&self, block: &Block) -> bool {
        let goes = block.codes.non_modal.is_some_and(|coded| {
            matches!(
                coded.code,
                NonModal::MachineCoordinates | NonModal::GoToReference(_)
            )
        });
        goes && matches!(block.dialect, Dialect::Fanuc | Dialect::Siemens)
            && self.options.five_axis.is_some()
            && self.state.tip.follows()
    }

    /// G53 of a FANUC goes at rapid, in G1, too, which stays in force; a Haas goes as G0 or G1 says.
    pub(crate) fn motion_to_machine_place(&self, block: &Block, motion: Motion) -> Motion {
        let is_fanuc = block.dialect == Dialect::Fanuc && !self.options.fanuc.is_haas();
        match motion {
            Motion::Linear if is_fanuc && block.has_machine_coordinates() => Motion::Rapid,
            motion => motion,
        }
    }

    /// Refuses such a block where the rotary axes are away from zero and no plane is tilted.
    pub(crate) fn check_machine_place(&self, block: &Block) -> Outcome<()> {
        let axes = self.axes_place();
        let turned = (3..6).any(|axis| axes[axis].abs() > ZERO_DEG);
        if !turned || self.state.tilted.is_some() || !self.leaves_tip(block) {
            return Ok(());
        }
        let span = block.codes.non_modal.map(|coded| coded.span);
        let message = "a place of the machine while the tip of the tool is followed";
        let code = DiagnosticCode::MachineCoordinates;
        Err(
            BlockDiagnostic::new(code, span.unwrap_or_default(), message)
                .because(
                    "with the rotary axes away from zero the coordinates are those of the work",
                )
                .help("write G49 or TRAFOOF before it"),
        )
    }

    /// Has the coordinates be those of the machine's axes for such a block; true if they were not.
    pub(crate) fn leave_tip(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<bool> {
        if !self.leaves_tip(block) {
            return Ok(false);
        }
        self.map_moves(block, out)?;
        self.let_tip_follow(false);
        Ok(true)
    }

    /// Follows the tip again, unless the tool has left the normal of the tilted plane.
    pub(crate) fn follow_tip_again(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        self.map_moves(block, out)?;
        if self.state.tilted.is_some() && !self.stands_along(&self.normal_of_plane()) {
            self.state.tilted = Some(Tilt::Waits);
        } else {
            self.let_tip_follow(true);
        }
        Ok(())
    }
}
