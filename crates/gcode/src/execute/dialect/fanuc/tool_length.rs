//! The length of a tool as FANUC has it: G43, G44, G49, and G43.4 on a machine with five axes.

use glidepath_geometry::AxisVector;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::execute::interpreter::Interpreter;
use crate::setup::tool_table::MAX_TOOL;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::modes::ToolLength;
use crate::syntax::word_check::{missing, whole};

/// Lengths below this are none, mm.
const NO_LENGTH_MM: f64 = 1e-9;

impl Interpreter {
    /// G43, G44, G49: the length of H along Z. H counts until another one is written.
    pub(crate) fn fanuc_tool_length(
        &mut self,
        block: &Block,
        coded: Coded<ToolLength>,
    ) -> Outcome<()> {
        let follows = block.codes.tip.is_some();
        let sign = match coded.code {
            ToolLength::Cancel => None,
            ToolLength::Subtract => Some(-1.0),
            _ => Some(1.0),
        };
        if follows && !self.options.keeps_tip {
            return Err(keeps_no_tip(coded));
        }
        self.state.fanuc.length_sign = sign;
        let Some(sign) = sign else {
            self.offsets.tool = AxisVector::zeros();
            self.state.tip_follows = false;
            return Ok(());
        };
        let number = whole(block, b'H', MAX_TOOL)?
            .or(self.state.fanuc.length_offset)
            .ok_or_else(|| missing(coded.span, "the length of a tool", "H", "whose length"))?;
        let span = if block.get(b'H').is_some() {
            block.span(b'H')
        } else {
            coded.span
        };
        let mut length_mm = 0.0;
        if number > 0 {
            length_mm = self.tool_of(number, span)?.offset[2];
            length_mm += self.offsets.fanuc.wear(number).length_mm;
        }
        if follows {
            self.check_tip_length(coded, length_mm)?;
        }
        self.state.tip_follows = follows;
        self.state.fanuc.length_offset = Some(number);
        self.offsets.tool = AxisVector::zeros();
        self.offsets.tool[2] = sign * length_mm;
        Ok(())
    }

    /// Refuses tool centre point control with a length that the kinematics do not know.
    fn check_tip_length(&self, coded: Coded<ToolLength>, length_mm: f64) -> Outcome<()> {
        if length_mm.abs() > NO_LENGTH_MM {
            let message = format!("tool centre point control with a tool {length_mm} mm longer");
            return Err(
                Fault::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because(
                        "the kinematics know the length of one tool, and what is added to it would \
                         count along Z and not along the tool",
                    )
                    .help("write H0, with the whole length in `tool` of [machine.five-axis]"),
            );
        }
        Ok(())
    }
}

#[cold]
fn keeps_no_tip(coded: Coded<ToolLength>) -> Box<Fault> {
    let message = "tool centre point control is not supported by this machine";
    Fault::new(DiagnosticCode::NotSupported, coded.span, message)
        .because("its kinematics have no rotary axes that turn the tool or the table")
        .help(
            "configure `kinematics = \"five-axis\"`, or let the CAM system write the positions of \
             the axes",
        )
}
