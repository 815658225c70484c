//! G73 of FANUC's lathes: passes along a profile that the part has already, nearer and nearer.
//!
//! Each pass begins at the start, shifted as the pass is, goes to the first point as the profile's
//! first block says, along the profile, and back to where the next one begins. The shifts are alike
//! from pass to pass: the first one is the whole relief away, the last one the allowances alone.

use core::f64::consts::PI;

use glidepath_program::Item;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::compensation::element::{Element, Point};
use crate::execute::interpreter::Interpreter;
use crate::execute::lathe_cycle::open::OpenLatheCycle;
use crate::execute::motion::speed::Pace;
use crate::execute::state::fanuc_modal::Repeating;
use crate::syntax::block::Block;

/// Arcs beyond half a turn by no more are half a turn, radians.
const ROUNDING_RAD: f64 = 1e-9;

impl Interpreter {
    /// All passes; the profile has the allowances. The tool is where the last one ends.
    pub(super) fn repeat_profile(
        &mut self,
        cycle: &OpenLatheCycle,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let (block, profile) = (&cycle.block, &cycle.profile);
        let Some(Repeating { relief_mm, passes }) = cycle.words.repeating else {
            return Ok(());
        };
        let start = self.lathe_point();
        for pass in (0..passes).rev() {
            let share = f64::from(pass) / f64::from((passes - 1).max(1));
            let shift = relief_mm.map(|way| way * share);
            let by = |point: Point| [point[0] + shift[0], point[1] + shift[1]];
            let own = profile.shift;
            let begin = [start[0] + own[0] + shift[0], start[1] + own[1] + shift[1]];
            self.straight(block, self.lathe_target(begin), Pace::Rapid, out)?;
            let first = profile.elements.first().map(|element| element.start);
            if let Some(first) = first {
                self.straight(block, self.lathe_target(by(first)), cycle.infeed(), out)?;
            }
            for element in &profile.elements {
                self.repeat_element(block, element, by, out)?;
            }
        }
        Ok(())
    }

    fn repeat_element(
        &mut self,
        block: &Block,
        element: &Element,
        by: impl Fn(Point) -> Point,
        out: &mut Vec<Item>,
    ) -> Outcome<()> {
        let target = self.lathe_target(by(element.end));
        let Some((center, sweep_rad)) = element.arc else {
            return self.straight(block, target, Pace::Feed, out);
        };
        if sweep_rad.abs() > PI + ROUNDING_RAD {
            let message = "an arc of more than half a turn in the profile";
            return Err(BlockDiagnostic::new(
                DiagnosticCode::CannedCycle,
                block.span(b'Q'),
                message,
            )
            .because("the arcs of a profile are half a turn at most")
            .help("draw it as two arcs"));
        }
        let center = self.lathe_target(by(center));
        self.lathe_arc(block, target, center, sweep_rad > 0.0, out)
    }
}
