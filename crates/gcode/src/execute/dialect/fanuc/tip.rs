//! TRAORI and TRAFOOF of SINUMERIK.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::codes::Coded;

impl Interpreter {
    /// TRAORI and TRAFOOF.
    pub(crate) fn follow_tip(&mut self, coded: Coded<bool>) -> Outcome<()> {
        if coded.code && self.options.five_axis.is_none() {
            let message = "TRAORI (tool orientation) is not supported by this machine";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
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
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
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
        let tool = &self.state.offsets.tool;
        if tool[0] == 0.0 && tool[1] == 0.0 {
            return Ok(());
        }
        let message = "a tool with an offset in X or Y where the tip is followed";
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                .because("the tip is followed along the axis of the spindle")
                .help("write the length alone into the tool table"),
        )
    }
}
