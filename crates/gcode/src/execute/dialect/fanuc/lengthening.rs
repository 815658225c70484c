//! G45 to G48 of FANUC's mills: the offset of D makes the ways of a block longer or shorter.
//!
//! | | each way of the block, in its own direction |
//! |---|---|
//! | G45, G46 | longer, shorter by the offset |
//! | G47, G48 | longer, shorter by twice the offset |
//!
//! They are of their block alone. A way of zero has a direction, too: `X-0` goes down. With the radius of a
//! tool as the offset, straight moves along the axes go beside a contour. Of arcs they take a quarter or three
//! quarters of a circle by I, J, K: its centre is as much farther away or nearer as its end, so that it
//! stays one. They are read in G91 alone: what an absolute coordinate behind them counts from is not known here.

use glidepath_geometry::{AxisVector, Plane};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::arc_center::center_letter;
use crate::syntax::block::Block;
use crate::syntax::codes::Coded;
use crate::syntax::modes::{Distance, Motion};
use crate::syntax::word_check::missing;

/// Words of a quarter circle that differ by less are rounding, mm.
const ROUNDING_MM: f64 = 2e-3;

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
        let is_haas = self.options.fanuc.is_haas();
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
        let is_move = matches!(
            motion,
            Some(
                Motion::Rapid | Motion::Linear | Motion::ArcClockwise | Motion::ArcCounterclockwise
            )
        );
        if !is_move || block.codes.non_modal.is_some() {
            return Err(refused(
                span,
                format!("{name} in a block that is no move of G0, G1, G2 or G3"),
                "its offset is added to the ways of moves",
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
        let by_mm = self.lengthening_mm(block, coded)?;
        let mut target = target;
        for (axis, way) in block.axes() {
            target[axis.index()] += by_mm * 1.0_f64.copysign(way);
        }
        Ok(target)
    }

    /// The target of an arc with the offset of G45 to G48, and by how much its centre is farther from the start, in
    /// the two axes of the plane.
    pub(crate) fn lengthened_arc(
        &self,
        block: &Block,
        plane: Plane,
        target: AxisVector,
    ) -> Outcome<(AxisVector, [f64; 2])> {
        let Some(coded) = block.codes.lengthening else {
            return Ok((target, [0.0; 2]));
        };
        let target = self.lengthened(block, target)?;
        let (first, second) = plane.axes();
        let axes = [first, second];
        let ways = axes.map(|axis| block.axes().find(|(other, _)| *other == axis));
        let ways = ways.map(|way| way.map_or(0.0, |(_, way)| way));
        let center = axes.map(|axis| block.get(center_letter(axis)).unwrap_or(0.0));
        let mm = self.state.modal.units.mm();
        let same = |a: f64, b: f64| (a.abs() - b.abs()).abs() * mm <= ROUNDING_MM;
        let is_in_plane = block.axes().all(|(axis, _)| axes.contains(&axis));
        let radius = center.into_iter().find(|way| !same(*way, 0.0));
        let along = center.iter().filter(|way| !same(**way, 0.0)).count();
        let is_quarter = radius.is_some_and(|radius| ways.iter().all(|way| same(*way, radius)));
        if !is_in_plane || along != 1 || !is_quarter || block.get(b'R').is_some() {
            return Err(refused(
                coded.span,
                format!(
                    "{} beside an arc that is no quarter of a circle by {} or {}",
                    name(coded.code),
                    char::from(center_letter(first)),
                    char::from(center_letter(second))
                ),
                "a FANUC takes a quarter or three quarters of a circle, which begin and end along the axes",
                "let the CAM system write plain blocks, or use G41 or G42",
            ));
        }
        let by_mm = self.lengthening_mm(block, coded)?;
        let farther = |way: f64| {
            if same(way, 0.0) {
                0.0
            } else {
                by_mm * 1.0_f64.copysign(way)
            }
        };
        Ok((target, center.map(farther)))
    }

    /// How much longer each way is, mm.
    fn lengthening_mm(&self, block: &Block, coded: Coded<i8>) -> Outcome<f64> {
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
        Ok(f64::from(coded.code) * offset_mm)
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
