//! G12 and G13 of Haas' mills: a round pocket about the place where the tool stands.
//!
//! ```text
//! G13 I5. F500 D1              one circle of radius I, counterclockwise; G12 clockwise
//! G13 I5. K20. Q4. F500 D1     circles from I on, Q farther out each, up to K
//! G91 G13 Z-2. L3 …            L levels, Z deeper each
//! ```
//!
//! Radii are those of the pocket: the radius of D is taken away, D0 takes nothing. From the centre the
//! tool goes down at F, on half a circle to the first circle, straight from circle to circle, and on
//! half a circle back to the centre. X and Y are gone to at rapid first.

use core::f64::consts::{PI, TAU};

use glidepath_geometry::{AxisVector, Plane};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::setup::tool_table::MAX_TOOL;
use crate::syntax::block::Block;
use crate::syntax::modes::Distance;
use crate::syntax::word_check::{missing, unused, whole};

/// Most circles of a level, and most levels.
const MOST: u32 = 1000;

impl Interpreter {
    pub(crate) fn circle_pocket(
        &mut self,
        block: &Block,
        is_clockwise: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let is_flat =
            self.state.modal.plane == Plane::Xy && !self.state.offsets.frame.is_in_force();
        if !is_flat || self.state.on_contour || self.state.leaving_contour {
            let message = "a round pocket outside G17, within a frame, or with G41 or G42 on";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message)
                    .because("it is made in the XY plane, with the radius of the tool taken away")
                    .help("write G17, G69, G50 and G40 before it"),
            );
        }
        if let Some((axis, _)) = block.axes().find(|(axis, _)| axis.index() >= 3) {
            return Err(unused(axis.letter(), block.axis_span(axis)));
        }
        let radii = self.pocket_radii(block)?;
        let levels = whole(block, b'L', MOST)?.unwrap_or(1).max(1);
        let incremental = self.state.modal.distance == Distance::Incremental;
        if levels > 1 && !incremental {
            let message = "L of a round pocket with absolute distances (G90)";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CannedCycle,
                block.span(b'L'),
                message,
            )
            .because("with G91 Z is how much deeper each level is")
            .help("write G91 into the block"));
        }
        let values = self.axis_values(block)?;
        let mut center = self.state.offsets.to_program(self.state.position);
        let moved = |at: f64, value: Option<f64>| match value {
            None => at,
            Some(by) if incremental => at + by,
            Some(to) => to,
        };
        (center[0], center[1]) = (moved(center[0], values[0]), moved(center[1], values[1]));
        let across = self.state.offsets.to_machine(center);
        self.straight(block, across, Pace::Rapid, out)?;
        for _ in 0..levels {
            center[2] = moved(center[2], values[2]);
            let center = self.state.offsets.to_machine(center);
            self.straight(block, center, Pace::Feed, out)?;
            self.circles(block, center, &radii, is_clockwise, out)?;
        }
        Ok(())
    }

    /// The radii of the tool's circles, mm.
    fn pocket_radii(&self, block: &Block) -> Outcome<Vec<f64>> {
        let span = block.motion_span();
        let mm = self.state.modal.units.mm();
        let word = |letter: u8| block.get(letter).map(|value| value * mm);
        let offset = whole(block, b'D', MAX_TOOL)?.unwrap_or(self.state.fanuc.radius_offset);
        let named = block.get(b'D').map_or(span, |_| block.span(b'D'));
        if block.get(b'D').is_none() && offset == 0 {
            return Err(missing(
                span,
                "a round pocket",
                "D",
                "whose radius is taken away; D0: none",
            ));
        }
        let tool = self.tool_of(offset, named)?;
        let tool_mm = 0.5 * tool.diameter_mm + self.state.offsets.fanuc.wear(offset).radius_mm;
        let first = word(b'I').ok_or_else(|| {
            missing(
                span,
                "a round pocket",
                "I",
                "the radius of the first circle",
            )
        })?;
        let mut radii = vec![first];
        match (word(b'K'), word(b'Q')) {
            (None, None) => {}
            (Some(last), Some(step)) if last >= first && step > 0.0 => {
                let count = ((last - first) / step - 1e-9).ceil();
                if count > f64::from(MOST) {
                    return Err(not_possible(block, b'Q', "more than 1000 circles"));
                }
                let mut radius = first;
                while radius + step < last - MIN_MOVE {
                    radius += step;
                    radii.push(radius);
                }
                if last > first {
                    radii.push(last);
                }
            }
            (Some(_), None) => {
                let meaning = "from circle to circle, up to K";
                return Err(missing(span, "K of a round pocket", "Q", meaning));
            }
            (Some(_), Some(_)) => {
                return Err(not_possible(block, b'K', "K below I, or Q not above zero"));
            }
            (None, Some(_)) => {
                let meaning = "the radius that the circles go up to";
                return Err(missing(span, "Q of a round pocket", "K", meaning));
            }
        }
        if first - tool_mm <= MIN_MOVE {
            return Err(not_possible(
                block,
                b'I',
                "a first circle no larger than the tool",
            ));
        }
        Ok(radii.into_iter().map(|radius| radius - tool_mm).collect())
    }

    fn circles(
        &mut self,
        block: &Block,
        center: AxisVector,
        radii: &[f64],
        is_clockwise: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let turn = if is_clockwise { -1.0 } else { 1.0 };
        let flat = [center[0], center[1]];
        let beside = |way: f64| [flat[0] + way, flat[1]];
        let place = |way: f64| {
            let mut place = center;
            place[0] += way;
            place
        };
        for (index, radius) in radii.iter().enumerate() {
            if index == 0 {
                let half = Some((beside(0.5 * radius), turn * PI));
                self.make_move(block, place(*radius), half, out)?;
            } else {
                self.make_move(block, place(*radius), None, out)?;
            }
            self.make_move(block, place(*radius), Some((flat, turn * TAU)), out)?;
        }
        let last = radii.last().copied().unwrap_or(0.0);
        let half = Some((beside(0.5 * last), turn * PI));
        self.make_move(block, center, half, out)
    }
}

#[cold]
fn not_possible(block: &Block, letter: u8, what: &str) -> Box<BlockDiagnostic> {
    let message = format!("a round pocket with {what}");
    BlockDiagnostic::new(DiagnosticCode::CannedCycle, block.span(letter), message)
        .because(
            "I is the radius of the first circle, K that of the last one, Q from circle to circle",
        )
        .help("check I, K, Q and the radius of D")
}
