//! G74 and G75 of a lathe: along Z or X by depths, with a short way back after each.
//!
//! `G74 R` and `G75 R` say how far back; then `G74 Z Q F` drills along Z by Q, `G75 X P F` grooves
//! along X by P. P and Q without a point count least increments, P as a radius. The tool goes back to
//! where it was.

use glidepath_program::Item;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::settled::MIN_MOVE;
use crate::execute::motion::speed::Pace;
use crate::syntax::block::Block;
use crate::syntax::modes::Units;
use crate::syntax::word_check::{missing, negative};

/// Most depths of a block.
const MOST: f64 = 10_000.0;

impl Interpreter {
    /// G74, or G75 across.
    pub(crate) fn groove(
        &mut self,
        block: &Block,
        across: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let mm = self.state.modal.units.mm();
        if let Some(retract) = block.get(b'R') {
            if retract < 0.0 {
                return Err(negative(block, b'R', "the way back"));
            }
            self.state.fanuc.retract_mm = retract * mm;
        }
        if !block.has_axes() {
            return Ok(());
        }
        let start = self.offsets.to_program(self.state.position);
        let values = self.axis_values(block)?;
        let (axis, other) = if across { (0, 2) } else { (2, 0) };
        if values[other].is_some_and(|to| (to - start[other]).abs() > MIN_MOVE) {
            let message = "several grooves in one block";
            return Err(
                Fault::new(DiagnosticCode::NotSupported, block.motion_span(), message)
                    .because("one is made where the tool stands")
                    .help("write a block for each, with a move in between"),
            );
        }
        let (word, letter) = if across { ("X", b'P') } else { ("Z", b'Q') };
        let span = block.motion_span();
        let end = values[axis].ok_or_else(|| missing(span, "the cycle", word, "the bottom"))?;
        let unit = match (block.has_no_point(letter), self.state.modal.units) {
            (false, _) => 1.0,
            (true, Units::Millimetre) => 1e-3,
            (true, Units::Inch) => 1e-4,
        };
        let depth = (end - start[axis]).abs();
        let peck = block.get(letter).map_or(depth, |peck| peck * unit * mm);
        if peck <= 0.0 || depth / peck > MOST {
            let name = char::from(letter);
            let message = format!("{name} of {peck} mm");
            return Err(
                Fault::new(DiagnosticCode::InvalidValue, block.span(letter), message)
                    .because(format!("{name} is how deep the cycle goes at a time"))
                    .help("write a larger depth: without a point it counts thousandths"),
            );
        }
        let way = (end - start[axis]).signum();
        let mut deep = 0.0;
        while deep + peck < depth - MIN_MOVE {
            deep += peck;
            for (to, pace) in [
                (deep, Pace::Feed),
                ((deep - self.state.fanuc.retract_mm).max(0.0), Pace::Rapid),
            ] {
                let mut point = start;
                point[axis] += way * to;
                let target = self.offsets.to_machine(point);
                self.straight(block, target, pace, out)?;
            }
        }
        let mut point = start;
        point[axis] = end;
        let target = self.offsets.to_machine(point);
        self.straight(block, target, Pace::Feed, out)?;
        let target = self.offsets.to_machine(start);
        self.straight(block, target, Pace::Rapid, out)
    }
}
