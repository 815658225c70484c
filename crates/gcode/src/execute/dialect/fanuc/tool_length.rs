//! The length of a tool as FANUC has it: G43, G44, G49, and G43.4 on a machine with five axes.

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::tip::{Tilt, Tip};
use crate::setup::tool_table::MAX_TOOL;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::modes::ToolLength;
use crate::syntax::word_check::{missing, whole};

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
        if follows && self.options.five_axis.is_none() {
            return Err(keeps_no_tip(coded));
        }
        self.state.fanuc.length_sign = sign;
        self.state.fanuc.tip_by_vector = block.codes.tip_by_vector;
        let Some(sign) = sign else {
            self.set_length_in_force(0.0, false);
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
            length_mm += self.state.offsets.fanuc.wear(number).length_mm;
        }
        if follows && self.state.tilted.is_some() {
            let message = "G43.4 in a tilted plane";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because(
                        "the tip is followed there already, and the tool stands along its normal",
                    )
                    .help(
                        "write G43 H, whose length counts along the tool there, or G69 before it",
                    ),
            );
        }
        self.state.fanuc.length_offset = Some(number);
        self.set_length_in_force(sign * length_mm, follows);
        Ok(())
    }

    /// H in a block without G43: the number that counts from here on; while G43 or G44 is in force, its
    /// length.
    pub(super) fn length_without_code(&mut self, block: &Block) -> Outcome<()> {
        let is_radius = block.codes.cutter_radius.is_some() && block.get(b'D').is_none();
        if block.is_lathe || block.codes.tool_length.is_some() || is_radius {
            return Ok(());
        }
        let Some(number) = whole(block, b'H', MAX_TOOL)? else {
            return Ok(());
        };
        let span = block.span(b'H');
        let Some(sign) = self.state.fanuc.length_sign else {
            self.state.fanuc.length_offset = Some(number);
            return Ok(());
        };
        if self.options.five_axis.is_some() {
            let message = "H without G43 or G43.4";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because(
                        "whether the length counts along Z or along the tool is said by the code",
                    )
                    .help("write the code into the block"),
            );
        }
        let code = if sign < 0.0 {
            ToolLength::Subtract
        } else {
            ToolLength::FromTable
        };
        self.fanuc_tool_length(block, Coded { code, span })
    }

    /// Puts a length in force: along Z, or along the tool where the tip is followed.
    fn set_length_in_force(&mut self, length_mm: f64, follows: bool) {
        self.state.fanuc.length_on_way_mm += length_mm - self.length_in_force_mm();
        self.state.offsets.tool = AxisVector::zeros();
        if self.options.five_axis.is_none() {
            self.state.offsets.tool[2] = length_mm;
            return;
        }
        if follows || self.state.tilted == Some(Tilt::Stands) {
            self.set_tip(Tip::Follows {
                longer_mm: length_mm,
            });
        } else {
            self.state.offsets.tool[2] = length_mm;
            self.set_tip(Tip::Stands);
        }
    }
}

#[cold]
fn keeps_no_tip(coded: Coded<ToolLength>) -> Box<BlockDiagnostic> {
    let message = "tool centre point control is not supported by this machine";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
        .because("its kinematics have no rotary axes that turn the tool or the table")
        .help(
            "configure `kinematics = \"five-axis\"`, or let the CAM system write the positions of \
             the axes",
        )
}
