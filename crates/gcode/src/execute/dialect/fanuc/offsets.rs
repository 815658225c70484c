//! G10 of FANUC and Haas, and G54.1.
//!
//! | | |
//! |---|---|
//! | G10 L2 P0, P1 to P6 | the external offset, G54 to G59; in G91 the words are added |
//! | G10 L20 P1 and on | G54.1 P1 and on; no other system changes, and nothing moves |
//! | G10 L10, L11 P R | length of a tool, its wear; in G91 R is added |
//! | G10 L12, L13 P R | radius of a tool, its wear; of a Haas refused: setting 40 may have it a diameter |

use std::sync::Arc;

use glidepath_geometry::{AXES, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::block_words::{require_axes, takes_number};
use crate::execute::dialect::fanuc::tool_variables::OF_SETTING_40;
use crate::execute::interpreter::Interpreter;
use crate::setup::tool_table::{MAX_TOOL, Tool, ToolTable};
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::letters::AXIS_WORDS;
use crate::syntax::modes::Distance;
use crate::syntax::word_check::{missing, unused, whole};

/// Most systems of G54.1.
const MOST_EXTENDED: u32 = 300;

/// `base` with the words written over it, or added to it.
fn with_words(base: AxisVector, words: &[Option<f64>; AXES], adds: bool) -> AxisVector {
    AxisVector::from_fn(|axis, _| match words[axis] {
        None => base[axis],
        Some(value) if adds => base[axis] + value,
        Some(value) => value,
    })
}

impl Interpreter {
    /// G10.
    pub(crate) fn set_fanuc_data(&mut self, block: &Block, span: SourceSpan) -> Outcome<()> {
        if block.is_lathe && block.get(b'L').is_none() {
            return self.set_lathe_offset(block, span);
        }
        let kind = whole(block, b'L', 99)?.ok_or_else(|| {
            let meaning = "2 or 20 for a work offset, 10 to 13 for a tool";
            missing(span, "G10", "L", meaning)
        })?;
        match kind {
            2 | 20 => self.set_fanuc_system(block, kind, span),
            10..=13 => self.set_fanuc_tool(block, kind, span),
            _ => {
                let message = format!("G10 L{kind} is not supported");
                Err(
                    BlockDiagnostic::new(DiagnosticCode::NotSupported, block.span(b'L'), message)
                        .because(
                            "work offsets (L2, L20) and tools (L10 to L13) can be set; what others \
                             set differs from control to control",
                        )
                        .help("write one of these, or set it at the control"),
                )
            }
        }
    }

    fn set_fanuc_system(&mut self, block: &Block, kind: u32, span: SourceSpan) -> Outcome<()> {
        if block.get(b'R').is_some() {
            return Err(unused('R', block.span(b'R')));
        }
        require_axes(block, span, "G10")?;
        let words = self.axis_values(block)?;
        let adds = self.state.modal.distance == Distance::Incremental;
        let least = u32::from(kind == 20);
        let most = if kind == 20 { MOST_EXTENDED } else { 6 };
        let number = whole(block, b'P', most)?
            .filter(|number| *number >= least)
            .ok_or_else(|| missing(span, "G10", "P", "which work offset, 1 for the first"))?;
        let fanuc = &mut self.state.offsets.fanuc;
        if kind == 20 {
            let system = fanuc.extended.entry(number).or_default();
            system.origin = with_words(system.origin, &words, adds);
            return Ok(());
        }
        let index = usize::try_from(number).unwrap_or_default();
        match index.checked_sub(1) {
            None => fanuc.external = with_words(fanuc.external, &words, adds),
            Some(index) => {
                if let Some(system) = self.state.offsets.systems.get_mut(index) {
                    system.origin = with_words(system.origin, &words, adds);
                }
            }
        }
        Ok(())
    }

    fn set_fanuc_tool(&mut self, block: &Block, kind: u32, span: SourceSpan) -> Outcome<()> {
        if let Some((axis, _)) = block.axes().next() {
            return Err(unused(axis.letter(), block.axis_span(axis)));
        }
        debug_assert!(
            !block.has_any(AXIS_WORDS),
            "an axis word would have been refused"
        );
        if matches!(kind, 12 | 13) && self.options.fanuc.is_haas() {
            let message = format!("G10 L{kind} of a Haas is a radius or a diameter");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::NotSupported,
                block.span(b'L'),
                message,
            )
            .because(OF_SETTING_40)
            .help("write the diameter into the tool table"));
        }
        let number = whole(block, b'P', MAX_TOOL)?
            .filter(|number| *number > 0)
            .ok_or_else(|| missing(span, "G10", "P", "the number of the offset"))?;
        let value = block
            .get(b'R')
            .ok_or_else(|| missing(span, "G10", "R", "the offset"))?
            * self.state.modal.units.mm();
        let adds = self.state.modal.distance == Distance::Incremental;
        let set = |slot: &mut f64| *slot = if adds { *slot + value } else { value };
        match kind {
            10 => self.set_tool_value(number, |tool| set(&mut tool.offset[2])),
            12 => self.set_tool_value(number, |tool| {
                let mut radius_mm = 0.5 * tool.diameter_mm;
                set(&mut radius_mm);
                tool.diameter_mm = 2.0 * radius_mm;
            }),
            11 => set(&mut self
                .state
                .offsets
                .fanuc
                .wear
                .entry(number)
                .or_default()
                .length_mm),
            _ => set(&mut self
                .state
                .offsets
                .fanuc
                .wear
                .entry(number)
                .or_default()
                .radius_mm),
        }
        Ok(())
    }

    /// Changes an offset in the tool table, which gets the tool if it has none of that number.
    pub(crate) fn set_tool_value(&mut self, number: u32, change: impl Fn(&mut Tool)) {
        let tools = self
            .state
            .tools
            .get_or_insert_with(|| Arc::new(ToolTable::new()));
        let tools = Arc::make_mut(tools);
        let mut tool = tools.get(number).copied().unwrap_or_default();
        change(&mut tool);
        tools.set(number, tool);
    }

    /// G54.1 P, and G54 to G59, which end it.
    pub(super) fn extended_system(&mut self, block: &Block) -> Outcome<()> {
        let Coded { code, span } = match (block.codes.extended_system, block.codes.system) {
            (Some(coded), _) => coded,
            // G54 P is G54.1 P.
            (None, Some(Coded { code: 0, span })) if takes_number(block) => {
                Coded { code: None, span }
            }
            (None, system) => {
                if system.is_some() {
                    self.state.offsets.fanuc.active = None;
                }
                return Ok(());
            }
        };
        let written = match code {
            Some(number) => Some(number),
            None => whole(block, b'P', MOST_EXTENDED)?.filter(|number| *number > 0),
        };
        let number =
            written.ok_or_else(|| missing(span, "G54.1", "P", "the number of the work offset"))?;
        if !self.state.offsets.fanuc.extended.contains_key(&number) {
            let message = format!("the work offset of G54.1 P{number} was not set");
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because(
                    "the machine keeps G54 to G59, and a program has those of G54.1 that it sets",
                )
                .help(format!(
                    "write G10 L20 P{number} with its coordinates before it"
                )));
        }
        self.state.offsets.fanuc.active = Some(number);
        Ok(())
    }
}
