//! TRAORI and TRAFOOF of SINUMERIK, and what is not possible while the tip of the tool is followed.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::modes::NonModal;

/// Angles below this are zero, degrees.
const ZERO_DEG: f64 = 1e-9;

impl Interpreter {
    /// TRAORI and TRAFOOF.
    pub(crate) fn follow_tip(&mut self, coded: Coded<bool>) -> Outcome<()> {
        if coded.code && self.options.five_axis.is_none() {
            let message = "TRAORI (tool orientation) is not supported by this machine";
            return Err(
                Fault::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because("its kinematics have no rotary axes that turn the tool or the table")
                    .help(
                        "configure `kinematics = \"five-axis\"`, or let the CAM system write the \
                         positions of the axes",
                    ),
            );
        }
        if self.state.tilted.is_some() {
            let message = "TRAORI or TRAFOOF in a swivelled plane";
            return Err(
                Fault::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because("the tip is followed there until the plane ends")
                    .help("write CYCLE800() before it"),
            );
        }
        if coded.code {
            self.check_straight_tool(coded)?;
        }
        self.let_tip_follow(coded.code);
        Ok(())
    }

    /// Refuses a tool that is beside the spindle's axis where the tip is followed.
    pub(crate) fn check_straight_tool<T>(&self, coded: Coded<T>) -> Outcome<()> {
        let tool = &self.offsets.tool;
        if tool[0] == 0.0 && tool[1] == 0.0 {
            return Ok(());
        }
        let message = "a tool with an offset in X or Y where the tip is followed";
        Err(
            Fault::new(DiagnosticCode::NotSupported, coded.span, message)
                .because("the tip is followed along the axis of the spindle")
                .help("write the length alone into the tool table"),
        )
    }

    /// Refuses to go to places of the machine while the tip of the tool is followed: with the rotary
    /// axes away from zero X, Y and Z are not the machine's.
    pub(crate) fn check_machine_place(&self, block: &Block) -> Outcome<()> {
        let Some(non_modal) = block.codes.non_modal else {
            return Ok(());
        };
        let goes = matches!(
            non_modal.code,
            NonModal::MachineCoordinates | NonModal::GoToReference(_)
        );
        let is_other = matches!(block.dialect, Dialect::Fanuc | Dialect::Siemens)
            && self.options.five_axis.is_some()
            && self.state.tip.follows();
        let axes = self.axes_place();
        let turned = (3..6).any(|axis| axes[axis].abs() > ZERO_DEG);
        if !goes || !is_other || !turned {
            return Ok(());
        }
        let message = "a place of the machine while the tip of the tool is followed";
        Err(
            Fault::new(DiagnosticCode::MachineCoordinates, non_modal.span, message)
                .because(
                    "with the rotary axes away from zero the coordinates are those of the work",
                )
                .help("write G49, G69, TRAFOOF or CYCLE800() before it"),
        )
    }
}
