//! G10 P of a lathe: the offsets of the tools of a turret.
//!
//! | | |
//! |---|---|
//! | G10 P1 to P99, X Z or U W, R, Q | wear of the offset, direction of the tip; U and W are added; X and U are diameters |
//! | G10 P10001 to P10099, X Z or U W, R, Q | the offset in the table, radius of the tip, its direction |
//!
//! They count from the next T word on.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::letters::Letters;
use crate::syntax::word_check::{missing, unused, whole};

/// What is added to the number of an offset where G10 means that of the table.
const GEOMETRY: u32 = 10_000;
/// Offsets there are.
const MOST: u32 = 99;

/// The direction of a tip in the numbers of the tool table, which are LinuxCNC's: those of FANUC have
/// X the other way round.
pub(super) const fn in_table(direction: u8) -> u8 {
    match direction {
        1 => 4,
        2 => 3,
        3 => 2,
        4 => 1,
        6 => 8,
        8 => 6,
        other => other,
    }
}

impl Interpreter {
    pub(super) fn set_lathe_offset(&mut self, block: &Block, span: SourceSpan) -> Outcome<()> {
        if let Some((letter, span)) = block.unused(Letters::of(b"PXZUWRQ")) {
            return Err(unused(letter, span));
        }
        let number = whole(block, b'P', GEOMETRY + MOST)?
            .ok_or_else(|| missing(span, "G10", "P", "the number of the offset"))?;
        let (is_geometry, number) = match number.checked_sub(GEOMETRY) {
            Some(number) => (true, number),
            None => (false, number),
        };
        if !(1..=MOST).contains(&number) {
            let message = format!("there is no offset P{number}");
            return Err(BlockDiagnostic::new(
                DiagnosticCode::InvalidValue,
                block.span(b'P'),
                message,
            )
            .because("P1 to P99 are wear, P10001 to P10099 the offsets of the table")
            .help("write one of these"));
        }
        if !block.has_any(Letters::of(b"XZUWRQ")) {
            return Err(missing(
                span,
                "G10",
                "X, Z, U, W, R or Q",
                "what the offset is",
            ));
        }
        let mm = self.state.modal.units.mm();
        let changed = |now: f64, to: u8, by: u8, share: f64| {
            let to = block.get(to).map_or(now, |to| to * mm * share);
            to + block.get(by).map_or(0.0, |by| by * mm * share)
        };
        let direction = whole(block, b'Q', 9)?;
        let radius = block.get(b'R').map(|radius| radius * mm);
        if let Some(direction) = direction.and_then(|it| u8::try_from(it).ok()) {
            // Wear has none of its own.
            self.set_tool_value(number, |tool| tool.orientation = in_table(direction));
        }
        if !is_geometry {
            let wear = self.state.offsets.fanuc.wear.entry(number).or_default();
            wear.x_mm = changed(wear.x_mm, b'X', b'U', 0.5);
            wear.length_mm = changed(wear.length_mm, b'Z', b'W', 1.0);
            wear.radius_mm = radius.unwrap_or(wear.radius_mm);
            return Ok(());
        }
        self.set_tool_value(number, |tool| {
            tool.offset[0] = changed(tool.offset[0], b'X', b'U', 0.5);
            tool.offset[2] = changed(tool.offset[2], b'Z', b'W', 1.0);
            if let Some(radius_mm) = radius {
                tool.diameter_mm = 2.0 * radius_mm;
            }
        });
        Ok(())
    }
}
