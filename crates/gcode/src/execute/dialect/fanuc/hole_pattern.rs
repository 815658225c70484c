//! G70 and G71 of Haas' mills: holes of the cycle in force along a circle or an arc about the place where the
//! tool stands.
//!
//! ```text
//! G81 G99 Z-10. R2. F100. L0     the cycle; L0: no hole in the middle
//! G70 I25. J15. L8               8 holes on a circle of radius I, the first one at the angle J
//! G71 I25. J15. K30. L4          4 holes, K from one to the next
//! ```
//!
//! Angles count counterclockwise from +X. The tool ends at the last hole.

use glidepath_geometry::{AXES, Plane};
use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::canned_cycle::MAX_HOLES;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::word_check::{missing, unused, whole};

impl Interpreter {
    /// G70, or G71 if it is an arc.
    pub(crate) fn hole_pattern(
        &mut self,
        block: &Block,
        is_arc: bool,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let span = block.motion_span();
        let name = if is_arc { "G71" } else { "G70" };
        if let Some((axis, _)) = block.axes().next() {
            return Err(unused(axis.letter(), block.axis_span(axis)));
        }
        if self.state.modal.plane != Plane::Xy {
            let message = "holes along a pattern outside G17";
            return Err(refused(span, message)
                .because("a pattern is one of the XY plane")
                .help("write G17"));
        }
        let Some(hole) = self.hole_of_series(block)? else {
            return Err(refused(span, "holes along a pattern without a cycle")
                .because("the cycle in force says what is made at each hole")
                .help("write the cycle before it, as G81 with L0; inches and millimetres are G20 and G21"));
        };
        let need = |letter: u8, meaning: &str| {
            let text = char::from(letter).to_string();
            block
                .get(letter)
                .ok_or_else(|| missing(span, name, &text, meaning))
        };
        let radius_mm = need(b'I', "the radius")? * self.state.modal.units.mm();
        let first_deg = block.degrees(b'J').unwrap_or(0.0);
        let count = whole(block, b'L', MAX_HOLES)?.filter(|count| *count > 0);
        let count = count.ok_or_else(|| missing(span, name, "L", "how many holes"))?;
        let step_deg = match block.degrees(b'K') {
            Some(step) if is_arc => step,
            None if !is_arc => 360.0 / f64::from(count),
            None => return Err(missing(span, name, "K", "the angle from hole to hole")),
            Some(_) => return Err(unused('K', block.span(b'K'))),
        };
        if radius_mm <= 0.0 {
            let message = format!("a pattern of the radius {radius_mm} mm");
            return Err(refused(block.span(b'I'), message)
                .because("I is the radius")
                .help("write it above zero"));
        }
        let middle = self.state.offsets.to_program(self.state.position);
        let places = (0..count).map(|index| {
            let angle = (first_deg + f64::from(index) * step_deg).to_radians();
            let mut place = [None; AXES];
            place[0] = Some(middle[0] + radius_mm * angle.cos());
            place[1] = Some(middle[1] + radius_mm * angle.sin());
            place
        });
        let places: Vec<_> = places.collect();
        self.make_holes(block, hole, &places, out)
    }
}

#[cold]
fn refused(span: SourceSpan, message: impl Into<String>) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(DiagnosticCode::CannedCycle, span, message.into())
}
