//! Tools: T, M6, M61, length offsets (G43, G43.1, G43.2, G49) and the tool table of G10.

use std::sync::Arc;

use glidepath_geometry::AxisVector;
use glidepath_program::{Event, Item, ItemKind};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::state::offsets::overlay;
use crate::setup::tool_table::{MAX_TOOL, Tool};
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::dialect::Dialect;
use crate::syntax::letters::AXIS_WORDS;
use crate::syntax::modes::ToolLength;
use crate::syntax::word_check::{missing, whole};

/// Index of G59.3 among the coordinate systems.
const FIXTURE: usize = 8;

impl Interpreter {
    /// T, M6 and M61.
    pub(crate) fn select_tool(&mut self, block: &Block, out: &mut Vec<Item>) -> Outcome<()> {
        if block.dialect == Dialect::Marlin {
            self.check_one_extruder(block)?;
        }
        if block.is_lathe {
            return self.turret(block, out);
        }
        if let Some(tool) = whole(block, b'T', MAX_TOOL)? {
            if tool != 0 && self.state.tools.is_some() {
                self.tool_of(tool, block.span(b'T'))?;
            }
            self.state.selected_tool = tool;
            self.push(out, ItemKind::Event(Event::SelectTool(tool)));
        }
        let Some(Coded { code, span }) = block.codes.tool_change else {
            if block.get(b'T').is_some() && self.changes_tool_by_t(block) {
                self.change_tool(self.state.selected_tool, self.state.offsets.tool, out);
            }
            return Ok(());
        };
        if code == 61 {
            self.state.tool = whole(block, b'Q', MAX_TOOL)?
                .ok_or_else(|| missing(span, "M61", "Q", "the tool in the spindle"))?;
            // Nothing is changed: there is no change to take back.
            let offset = self.state.offsets.tool;
            self.state.tool_before = (self.state.tool, offset, self.state.edge);
            self.push(out, ItemKind::Event(Event::MCode(code)));
        } else {
            self.state.spindle.turning = None;
            self.change_tool(self.state.selected_tool, self.state.offsets.tool, out);
        }
        Ok(())
    }

    /// M6 with a tool, where an offset is in force for the tool before.
    pub(crate) fn change_tool(&mut self, tool: u32, offset: AxisVector, out: &mut Vec<Item>) {
        self.state.tool_before = (self.state.tool, offset, self.state.edge);
        self.state.tool = tool;
        self.push(out, ItemKind::Event(Event::MCode(6)));
    }

    /// A tool of the table; tool 0 is no tool: without length, diameter or offset.
    pub(crate) fn tool_of(&self, number: u32, span: SourceSpan) -> Outcome<Tool> {
        if number == 0 {
            return Ok(Tool::default());
        }
        let Some(tools) = &self.state.tools else {
            let message = format!("there is no tool table to look tool {number} up in");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NoToolTable, span, message)
                    .because("lengths and diameters of tools come from a tool table")
                    .help("give the tool table: --tool-table FILE, or `tool_table` of [program]"),
            );
        };
        tools.get(number).copied().ok_or_else(|| {
            BlockDiagnostic::new(
                DiagnosticCode::UnknownTool,
                span,
                format!("tool {number} is not in the tool table"),
            )
            .because("its length and diameter are not known")
            .help("add a line with its T number to the tool table")
        })
    }

    /// The tool a block names by `letter`, or else the one in the spindle.
    pub(crate) fn named_tool(&self, block: &Block, letter: u8, span: SourceSpan) -> Outcome<Tool> {
        match whole(block, letter, MAX_TOOL)? {
            Some(number) => self.tool_of(number, block.span(letter)),
            None => self.tool_of(self.state.tool, span),
        }
    }

    /// G43, G43.1, G43.2, G49.
    pub(crate) fn tool_length(&mut self, block: &Block, coded: Coded<ToolLength>) -> Outcome<()> {
        let span = coded.span;
        if block.dialect == Dialect::Fanuc {
            return self.fanuc_tool_length(block, coded);
        }
        self.state.offsets.tool = match coded.code {
            ToolLength::Cancel => AxisVector::zeros(),
            ToolLength::FromTable | ToolLength::Subtract => {
                self.named_tool(block, b'H', span)?.offset
            }
            ToolLength::FromWords => overlay(self.state.offsets.tool, &self.axis_values(block)?),
            ToolLength::Add if block.get(b'H').is_some() => {
                self.state.offsets.tool + self.named_tool(block, b'H', span)?.offset
            }
            ToolLength::Add => {
                if !block.has_any(AXIS_WORDS) {
                    let meaning = "the tool, or the axes to add to";
                    return Err(missing(span, "G43.2", "H or an axis", meaning));
                }
                let zero = AxisVector::zeros();
                self.state.offsets.tool + overlay(zero, &self.axis_values(block)?)
            }
        };
        Ok(())
    }

    /// G10 L1, L10 and L11: changes the tool table, until the program ends.
    pub(crate) fn set_tool(&mut self, block: &Block, kind: u32, span: SourceSpan) -> Outcome<()> {
        let number = whole(block, b'P', MAX_TOOL)?
            .ok_or_else(|| missing(span, "G10", "P", "the tool's number"))?;
        let mut tool = self.tool_of(number, block.span(b'P'))?;
        if number == 0 {
            return Err(missing(span, "G10", "P", "the tool's number, 1 or more"));
        }
        let values = self.axis_values(block)?;
        // In which coordinates the present place gets its new name.
        let program = match kind {
            10 => Some(self.state.offsets.to_program(self.state.position)),
            11 => Some(self.state.offsets.in_fixture(FIXTURE, self.state.position)),
            _ => None,
        };
        for (axis, value) in values.into_iter().enumerate() {
            let Some(value) = value else { continue };
            tool.offset[axis] = match program {
                None => value,
                Some(program) => self.state.offsets.tool[axis] + program[axis] - value,
            };
        }
        if let Some(radius) = block.get(b'R') {
            tool.diameter_mm = 2.0 * radius * self.state.modal.units.mm();
        }
        if let Some(orientation) = whole(block, b'Q', 9)? {
            tool.orientation = u8::try_from(orientation).unwrap_or_default();
        }
        if let Some(tools) = &mut self.state.tools {
            Arc::make_mut(tools).set(number, tool);
        }
        Ok(())
    }
}
