//! Polar words: `@` is a distance from the origin of the program, `^` an angle from X in degrees.
//!
//! With G90 both are absolute, and one that is missing keeps its value; with G91 both are added to
//! where the machine stands, as the program sees it. They stand for X and Y.

use glidepath_geometry::AXES;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::syntax::block::Block;
use crate::syntax::modes::Distance;

impl Interpreter {
    /// Puts X and Y in the place of polar words. In G91 they are increments.
    pub(crate) fn resolve_polar(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let [distance, angle] = block.polar;
        let Some(first) = distance.or(angle) else {
            return Ok(());
        };
        let refuse = |message: &str, reason: &str, help: &str| {
            BlockDiagnostic::new(DiagnosticCode::Polar, first.span, message)
                .because(reason)
                .help(help)
        };
        if values[0].is_some() || values[1].is_some() {
            return Err(refuse(
                "polar words beside X or Y",
                "`@` and `^` stand for X and Y",
                "write one or the other",
            ));
        }
        let program = self.state.offsets.to_program(self.state.position);
        let (x, y) = (program[0], program[1]);
        let (mut radius, mut degrees) = (x.hypot(y), y.atan2(x).to_degrees());
        let incremental = self.state.modal.distance == Distance::Incremental;
        if radius == 0.0 && (incremental || angle.is_none()) {
            return Err(refuse(
                "polar words at the origin without an angle",
                "the origin has no angle to keep or to add to",
                "write both `@` and `^`, with G90",
            ));
        }
        let scale = self.state.modal.units.mm();
        if let Some(distance) = distance {
            let value = distance.value * scale;
            radius = if incremental { radius + value } else { value };
        }
        if let Some(angle) = angle {
            degrees = if incremental {
                degrees + angle.value
            } else {
                angle.value
            };
        }
        let (sin, cos) = degrees.to_radians().sin_cos();
        let base = if incremental { (x, y) } else { (0.0, 0.0) };
        values[0] = Some(radius * cos - base.0);
        values[1] = Some(radius * sin - base.1);
        Ok(())
    }
}
