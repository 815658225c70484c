//! T of a lathe: `T0204` is tool 2 with offset 4, `T0200` takes the offset back.
//!
//! The last two digits are the offset, its X and Z those of the table. It moves nothing until the
//! next axis word.

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::word_check::whole;

/// Largest T word: two digits for the tool, two for the offset.
const MOST: u32 = 9999;

impl Interpreter {
    /// T, and M6, which some lathes have beside it.
    pub(crate) fn turret(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if let Some(coded) = block.codes.tool_change.filter(|coded| coded.code != 6) {
            let message = format!("M{} on a lathe", coded.code);
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, coded.span, message)
                    .because("T alone changes the tool of a turret")
                    .help("write T0101"),
            );
        }
        let Some(word) = whole(block, b'T', MOST)? else {
            return Ok(());
        };
        let (tool, offset) = (word / 100, word % 100);
        let length = self.tool_of(offset, block.span(b'T'))?;
        if self.state.on_contour {
            let message = "another tool or offset with compensation of the radius on";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CutterRadius,
                block.span(b'T'),
                message,
            )
            .because("where the tool is would not be clear")
            .help("write G40 and a move before it"));
        }
        let before = self.state.offsets.tool;
        self.state.offsets.tool = AxisVector::zeros();
        if offset > 0 {
            let wear = self.state.offsets.fanuc.wear(offset);
            self.state.offsets.tool[0] = length.offset[0] + wear.x_mm;
            self.state.offsets.tool[2] = length.offset[2] + wear.length_mm;
        }
        self.state.fanuc.length_offset = Some(offset);
        self.state.fanuc.radius_offset = offset;
        if tool != 0 && tool != self.state.tool {
            self.state.selected_tool = tool;
            self.push(out, ItemKind::Event(Event::SelectTool(tool)));
            self.change_tool(tool, before, out);
        }
        Ok(())
    }
}
