//! D: the edge of the tool, whose length and radius are in force at once.
//!
//! The tool table has one edge for each tool, which is D1. D0 takes the length back. A block that
//! changes the tool and names no edge puts D1 in force, unless the machine data say otherwise. T
//! itself changes the tool on lathes.

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::tip::Tip;
use crate::setup::siemens::ToolChangeBy;
use crate::setup::tool_table::Tool;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::word_check::whole;

impl Interpreter {
    /// D of a block, behind its T and M6.
    pub(crate) fn choose_edge(&mut self, block: &Block) -> Outcome<()> {
        let (edge, span) = match whole(block, b'D', 9)? {
            Some(edge) => (edge, block.span(b'D')),
            // Without a table no length is known.
            None if self.changes_tool(block) && self.state.tools.is_none() => {
                self.state.offsets.tool = AxisVector::zeros();
                self.state.edge = None;
                return Ok(());
            }
            None if self.changes_tool(block) => {
                let edge = u32::from(self.options.siemens.edge_after_change);
                (edge, block.span(b'T'))
            }
            None => return Ok(()),
        };
        if edge > 1 {
            let tool = self.state.tool;
            let message = format!("tool {tool} has no edge D{edge}");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                    .because("a tool of the table has one edge, which is D1; D does not number the offsets of all tools")
                    .help("write D1 where the offset of this tool is meant, or give the edge a tool number of its own"),
            );
        }
        let tool = if edge == 0 {
            Tool::default()
        } else {
            self.tool_of(self.state.tool, span)?
        };
        self.state.offsets.tool = if edge == 0 {
            AxisVector::zeros()
        } else {
            tool.offset
        };
        if self.options.five_axis.is_some() && self.state.tip.follows() {
            self.check_straight_tool(Coded { code: (), span })?;
            let longer_mm = core::mem::take(&mut self.state.offsets.tool[2]);
            self.set_tip(Tip::Follows { longer_mm });
        }
        self.state.edge = Some(edge);
        Ok(())
    }

    /// True for a block whose T changes the tool by itself.
    pub(crate) fn changes_tool_by_t(&self, block: &Block) -> bool {
        let by_t = match self.options.siemens.tool_change {
            None => self.options.is_lathe(),
            Some(by) => by == ToolChangeBy::T,
        };
        by_t && block.dialect == Dialect::Siemens
    }

    /// True for a block that changes the tool.
    fn changes_tool(&self, block: &Block) -> bool {
        block.codes.tool_change.is_some()
            || block.get(b'T').is_some() && self.changes_tool_by_t(block)
    }

    /// The tool whose radius G41 and G42 take: the one in the spindle, unless D0 is in force.
    pub(crate) fn tool_of_edge(&self, block: &Block, span: SourceSpan) -> Outcome<Tool> {
        let edge = whole(block, b'D', 9)?.or(self.state.edge);
        match edge {
            Some(0) => Ok(Tool::default()),
            _ => self.tool_of(self.state.tool, span),
        }
    }
}
