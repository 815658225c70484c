//! D: the edge of the tool, whose length and radius are in force at once.
//!
//! A tool has the edges that the tool table has of it, D1 and further ones. With flat D numbers D is the
//! offset of that number, which is a line of the table, whatever tool is in the spindle. D0 takes the
//! length back. A block that changes the tool and names no edge puts D1 in force, unless the machine data
//! say otherwise. T itself changes the tool on lathes.

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::tip::Tip;
use crate::setup::siemens::ToolChangeBy;
use crate::setup::tool_table::{MAX_EDGE, Tool};
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::word_check::{missing, whole};

impl Interpreter {
    /// D of a block, behind its T and M6.
    pub(crate) fn choose_edge(&mut self, block: &Block) -> Outcome<()> {
        let (edge, span) = match whole(block, b'D', MAX_EDGE)? {
            Some(edge) => (edge, block.span(b'D')),
            // Without a table no length is known.
            None if self.changes_tool(block) && self.state.tools.is_none() => {
                self.state.offsets.tool = AxisVector::zeros();
                self.state.edge = None;
                return Ok(());
            }
            None if self.changes_tool(block) => (self.edge_after_change(), block.span(b'T')),
            None => return Ok(()),
        };
        self.state.offsets.tool = self.edge_numbered(edge, span)?.offset;
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

    /// The edge behind a tool change that names none.
    fn edge_after_change(&self) -> u32 {
        u32::from(self.options.siemens.edge_after_change)
    }

    /// What D of that number puts in force.
    fn edge_numbered(&self, edge: u32, span: SourceSpan) -> Outcome<Tool> {
        if edge == 0 {
            return Ok(Tool::default());
        }
        let (number, is_flat) = (self.state.tool, self.options.siemens.flat_d_numbers);
        if is_flat && self.state.tools.is_some() {
            return self.known_edge(edge).ok_or_else(|| no_offset(edge, span));
        }
        let first = self.tool_of(if is_flat { edge } else { number }, span)?;
        if edge == 1 || number == 0 {
            return Ok(first);
        }
        self.known_edge(edge)
            .ok_or_else(|| no_edge(number, edge, span))
    }

    /// The same, if the tool table has it.
    fn known_edge(&self, edge: u32) -> Option<Tool> {
        let tools = self.state.tools.as_ref()?;
        let found = if self.options.siemens.flat_d_numbers {
            tools.get(edge)
        } else {
            tools.edge(self.state.tool, edge)
        };
        found.copied()
    }

    /// The edge in force; `None`: it is none, or the table does not have it. Where nothing was said of edges it is the
    /// first one of the tool in the spindle, but with flat D numbers none.
    pub(super) fn edge_in_force(&self) -> Option<Tool> {
        let unsaid = u32::from(!self.options.siemens.flat_d_numbers);
        let edge = self.state.edge.unwrap_or(unsaid);
        self.known_edge(edge).filter(|_| edge != 0)
    }

    /// The edge whose radius G41 and G42 take.
    pub(crate) fn tool_of_edge(&self, block: &Block, span: SourceSpan) -> Outcome<Tool> {
        let chosen = match whole(block, b'D', MAX_EDGE)? {
            Some(edge) => Some(edge),
            None if self.changes_tool(block) => Some(self.edge_after_change()),
            None => self.state.edge,
        };
        match chosen {
            Some(edge) => self.edge_numbered(edge, span),
            None if self.options.siemens.flat_d_numbers => {
                Err(missing(span, "G41 or G42", "D", "whose radius"))
            }
            None => self.tool_of(self.state.tool, span),
        }
    }

    /// Where a block names another edge than the one whose radius is in force.
    pub(crate) fn other_edge(&self, block: &Block) -> Option<SourceSpan> {
        let edge = block
            .get(b'D')
            .filter(|_| block.dialect == Dialect::Siemens)?;
        let in_force = f64::from(self.state.edge.unwrap_or(1));
        ((edge - in_force).abs() > 1e-4).then(|| block.span(b'D'))
    }
}

#[cold]
fn no_edge(tool: u32, edge: u32, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("tool {tool} has no edge D{edge}");
    BlockDiagnostic::new(DiagnosticCode::UnknownTool, span, message)
        .because("the tool table has no length and no diameter of it")
        .help(format!(
            "add a line `T{tool} E{edge}` to the tool table; where D numbers the offsets of all tools, set \
             d_numbers = \"flat\" of [program]"
        ))
}

#[cold]
fn no_offset(edge: u32, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("there is no offset D{edge}");
    BlockDiagnostic::new(DiagnosticCode::UnknownTool, span, message)
        .because("with flat D numbers D takes the line of that T from the tool table, whatever the tool, and there is none")
        .help(format!(
            "add a line `T{edge}` to the tool table; where a tool change puts no offset in force, set \
             edge_after_change = \"none\" of [program]"
        ))
}
