//! G45 to G48 of FANUC's mills: the offset of D makes the ways of a block longer or shorter.
//!
//! | | each way of the block, in its own direction |
//! |---|---|
//! | G45, G46 | longer, shorter by the offset |
//! | G47, G48 | longer, shorter by twice the offset |
//!
//! They are of their block alone. A way of zero has a direction, too: `X-0` goes down. With the radius of a
//! tool as the offset, straight moves along the axes go beside a contour. They are read in G91 alone: what an
//! absolute coordinate behind them counts from is not known here.

use glidepath_geometry::AxisVector;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::setup::fanuc::OffsetMemory;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::modes::{Distance, Motion};
use crate::syntax::word_check::missing;

/// The code that counts the offset so often.
const fn name(times: i8) -> &'static str {
    match times {
        1 => "G45",
        -1 => "G46",
        2 => "G47",
        _ => "G48",
    }
}

#[cold]
fn refused(
    span: SourceSpan,
    message: String,
    reason: &'static str,
    help: &'static str,
) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(reason)
        .help(help)
}

impl Interpreter {
    /// Refuses what the codes do not go with.
    pub(crate) fn check_lengthening(&self, block: &Block, motion: Option<Motion>) -> Outcome<()> {
        let Some(Coded { code, span }) = block.codes.lengthening else {
            return Ok(());
        };
        let name = name(code);
        let is_haas = self.options.fanuc.offset_memory == OffsetMemory::Haas;
        if is_haas || code == 2 && block.get(b'P').is_some() {
            return Err(refused(
                span,
                format!("{name} of a Haas"),
                "a Haas engraves texts by G47, in letters of its own, and has no G45, G46 and G48",
                "let the CAM system write plain blocks",
            ));
        }
        if !block.has_axes() {
            let meaning = "whose way is made longer or shorter";
            return Err(missing(span, name, "an axis", meaning));
        }
        let is_straight = matches!(motion, Some(Motion::Rapid | Motion::Linear));
        if !is_straight || block.codes.non_modal.is_some() {
            return Err(refused(
                span,
                format!("{name} in a block that is no straight move of G0 or G1"),
                "its offset is added to the ways of straight moves; of arcs a FANUC takes those of quarters alone",
                "let the CAM system write plain blocks, or use G41 or G42",
            ));
        }
        if block.get(b'H').is_some() {
            return Err(refused(
                block.span(b'H'),
                format!("H beside {name}"),
                "whether H is its offset, or D is and H a length, is a parameter of the control (5001#2 and #5)",
                "write the offset as D, or G43 H if the length of the tool is meant",
            ));
        }
        Ok(())
    }

    /// The target of a straight move with the offset of G45 to G48, if the block has one of them.
    pub(crate) fn lengthened(&self, block: &Block, target: AxisVector) -> Outcome<AxisVector> {
        let Some(coded) = block.codes.lengthening else {
            return Ok(target);
        };
        self.check_ways(block, coded)?;
        let number = self.state.fanuc.radius_offset;
        let span = if block.get(b'D').is_some() {
            block.span(b'D')
        } else {
            coded.span
        };
        let tool = self.tool_of(number, span)?;
        let offset_mm = match number {
            0 => 0.0,
            _ => 0.5 * tool.diameter_mm + self.state.offsets.fanuc.wear(number).radius_mm,
        };
        let mut target = target;
        for (axis, way) in block.axes() {
            target[axis.index()] += f64::from(coded.code) * offset_mm * 1.0_f64.copysign(way);
        }
        Ok(target)
    }

    fn check_ways(&self, block: &Block, Coded { code, span }: Coded<i8>) -> Outcome<()> {
        let name = name(code);
        if self.state.modal.distance == Distance::Absolute {
            return Err(refused(
                span,
                format!("{name} in G90"),
                "what the absolute coordinates behind it count from is not known here",
                "write G91, or G41 or G42 with D",
            ));
        }
        let is_turned = self.state.offsets.is_turned() || self.state.is_mapped;
        if is_turned || self.state.fanuc.polar.is_some() {
            return Err(refused(
                span,
                format!("{name} in coordinates that are turned, mirrored, scaled or polar"),
                "which of the ways the offset would be added to is not known here",
                "write G69, G50, G50.1 and G15 before it",
            ));
        }
        if self.state.on_contour || self.state.open.compensation.is_some() {
            return Err(refused(
                span,
                format!("{name} with cutter radius compensation on"),
                "the tool is beside the programmed points already",
                "write G40 and a move before it",
            ));
        }
        if self.has_corners(block) {
            return Err(refused(
                span,
                format!("{name} beside a corner that is broken"),
                "where the corner is depends on the move behind it",
                "write the corner as moves",
            ));
        }
        match block.axes().find(|(axis, _)| axis.index() > 2) {
            None => Ok(()),
            Some((axis, _)) => Err(refused(
                block.axis_span(axis),
                format!("{name} with {axis}"),
                "X, Y and Z are made longer or shorter here",
                "write a block of its own for the other axes",
            )),
        }
    }
}
