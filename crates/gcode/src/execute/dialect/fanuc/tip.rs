//! Where the axes of a machine with five axes follow the tip of the tool, and where other controls
//! would not.
//!
//! The kinematics of such a machine keep the tip where the program says, always. FANUC's programs
//! expect that from G43.4 to G49, SINUMERIK's from TRAORI to TRAFOOF; elsewhere their X, Y and Z are
//! the machine's own axes. Both are the same as long as the rotary axes stand at zero.

use glidepath_geometry::{Axis, AxisVector};

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;

/// Angles below this are zero, degrees.
const ZERO_DEG: f64 = 1e-9;

impl Interpreter {
    /// Whether rotary axes away from zero make another motion than the program's control would.
    pub(crate) fn is_tip_in_doubt(&self) -> bool {
        self.options.keeps_tip
            && !self.state.tip_follows
            && matches!(self.options.dialect, Dialect::Fanuc | Dialect::Siemens)
    }

    /// TRAORI and TRAFOOF.
    pub(crate) fn follow_tip(&mut self, coded: Coded<bool>) -> Outcome<()> {
        if coded.code && !self.options.keeps_tip {
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
        let is_longer = self.offsets.tool.iter().any(|length| *length != 0.0);
        if coded.code && is_longer {
            let message = "TRAORI with a tool that has a length";
            return Err(
                Fault::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because(
                        "the kinematics know the length of one tool: what is added to it would not \
                         count along the tool",
                    )
                    .help("write D0 before it, with the whole length in `tool` of [machine.five-axis]"),
            );
        }
        self.state.tip_follows = coded.code;
        Ok(())
    }

    /// Refuses a move with the rotary axes away from zero, where the tip of the tool would follow
    /// them and the program does not say so.
    pub(crate) fn check_tip(
        &self,
        block: &Block,
        low: &AxisVector,
        high: &AxisVector,
    ) -> Outcome<()> {
        if !self.is_tip_in_doubt() {
            return Ok(());
        }
        let start = &self.state.path_end;
        let turned = Axis::ALL.into_iter().find(|axis| {
            let i = axis.index();
            let angles = [low[i], high[i], start[i]];
            axis.is_rotary() && angles.iter().any(|angle| angle.abs() > ZERO_DEG)
        });
        let Some(axis) = turned else {
            return Ok(());
        };
        let on = match self.options.dialect {
            Dialect::Siemens => "TRAORI",
            _ => "G43.4",
        };
        let span = Some(block.axis_span(axis)).filter(|span| span.length > 0);
        let message = format!("{axis} is not at zero, and {on} is not in force");
        Err(Fault::new(
            DiagnosticCode::NotSupported,
            span.unwrap_or_else(|| block.motion_span()),
            message,
        )
        .because(
            "the axes of this machine follow the tip of the tool at all times; on that control they \
             would not, and X, Y and Z would go elsewhere",
        )
        .help(format!("write {on} before it, if that is what is meant")))
    }
}
