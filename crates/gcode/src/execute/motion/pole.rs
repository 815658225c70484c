//! Polar coordinates about a pole: SINUMERIK's AP and RP, and G110 to G112, which set the pole.
//!
//! ```text
//!   G110: from the place the program went to last · G111: from the program's zero
//!   G112: from the last pole           each by X and Y, or by AP and RP
//! ```
//!
//! AP is the angle from the first axis of the plane, in degrees, RP the distance from the pole. One
//! that is missing keeps its value. With G2 and G3 the pole is the centre, unless the block names one.

use glidepath_geometry::{AXES, Axis};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::axis_words::axis_value;
use crate::execute::state::pole::Pole;
use crate::syntax::block::Block;
use crate::syntax::modes::{Distance, PoleFrom};
use crate::syntax::named_word::Named;
use crate::syntax::word_check::missing;

/// True if the block has polar coordinates.
pub(super) fn is_polar(block: &Block) -> bool {
    polar_span(block).is_some()
}

/// Where the first polar word of a block stands.
fn polar_span(block: &Block) -> Option<SourceSpan> {
    let found = [Named::PolarAngle, Named::PolarRadius].map(|word| block.named.find(word));
    let spans = found.into_iter().flatten().map(|word| word.span);
    spans.min_by_key(|span| span.start)
}

impl Interpreter {
    /// G110, G111 and G112.
    pub(crate) fn set_pole(
        &mut self,
        block: &Block,
        from: PoleFrom,
        span: SourceSpan,
    ) -> Outcome<()> {
        let scale = self.state.modal.units.mm();
        let mut at = match from {
            PoleFrom::Place => {
                let here = self.state.offsets.to_program(self.state.position);
                [here[0], here[1], here[2]]
            }
            PoleFrom::Zero => [0.0; 3],
            PoleFrom::Pole => self.state.pole.at,
        };
        if is_polar(block) {
            let (radius, degrees) = (
                block.named.get(Named::PolarRadius),
                block.named.get(Named::PolarAngle),
            );
            let (Some(radius), Some(degrees)) = (radius, degrees) else {
                let meaning = "the place of the pole";
                return Err(missing(span, "a pole by an angle", "AP and RP", meaning));
            };
            if let Some((axis, _)) = block.axes().next() {
                return Err(beside(block.axis_span(axis)));
            }
            let (first, second) = self.plane_of_pole(span)?;
            let (sin, cos) = degrees.to_radians().sin_cos();
            at[first] += radius * scale * cos;
            at[second] += radius * scale * sin;
        } else {
            for (axis, value) in block.axes() {
                let Some(slot) = at.get_mut(axis.index()) else {
                    let message = format!("{axis} in the place of a pole");
                    let span = block.axis_span(axis);
                    return Err(BlockDiagnostic::new(DiagnosticCode::Polar, span, message)
                        .because("a pole is a point of X, Y and Z")
                        .help("write the axes of the plane"));
                };
                let is_diameter = axis == Axis::X && self.state.modal.diameter;
                if is_diameter && from != PoleFrom::Zero {
                    return Err(pole_beside_diameters(block.axis_span(axis)));
                }
                let share = if is_diameter { 0.5 } else { 1.0 };
                *slot += share * axis_value(axis, value, scale);
            }
        }
        self.state.pole = Pole {
            at,
            ..Pole::default()
        };
        Ok(())
    }

    /// Indices of the axes of the plane, which are two of X, Y and Z.
    fn plane_of_pole(&self, span: SourceSpan) -> Outcome<(usize, usize)> {
        let (first, second) = self.state.modal.plane.axes();
        if first.index() < 3 && second.index() < 3 {
            return Ok((first.index(), second.index()));
        }
        let message = "polar coordinates in a plane that is not of X, Y and Z";
        Err(BlockDiagnostic::new(DiagnosticCode::Polar, span, message)
            .help("write G17, G18 or G19"))
    }

    /// Keeps the polar words of a block that moves.
    pub(crate) fn take_pole_words(&mut self, block: &Block) {
        if let Some(radius) = block.named.get(Named::PolarRadius) {
            self.state.pole.radius_mm = Some(radius * self.state.modal.units.mm());
        }
        if let Some(degrees) = block.named.get(Named::PolarAngle) {
            self.state.pole.degrees = Some(degrees);
        }
    }

    /// Puts the point that is meant into the places of the two axes.
    pub(crate) fn resolve_pole(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let Some(span) = polar_span(block) else {
            return Ok(());
        };
        let (first, second) = self.plane_of_pole(span)?;
        let refuse = |message: &str, reason: &str, help: &str| {
            Err(BlockDiagnostic::new(DiagnosticCode::Polar, span, message)
                .because(reason)
                .help(help))
        };
        if values[first].is_some() || values[second].is_some() {
            return Err(beside(span));
        }
        if self.state.modal.distance == Distance::Incremental {
            return refuse(
                "polar coordinates with incremental distances (G91)",
                "an angle that is added to the last one is not made",
                "write G90 into this block",
            );
        }
        let pole = &self.state.pole;
        let Some(radius_mm) = pole.radius_mm else {
            return Err(missing(span, "AP", "RP", "the distance from the pole"));
        };
        let Some(degrees) = pole.degrees else {
            return Err(missing(span, "RP", "AP", "the angle about the pole"));
        };
        if radius_mm < 0.0 {
            return refuse(
                "RP is negative",
                "it is the distance from the pole",
                "write zero or more, and the angle to the other side",
            );
        }
        let (sin, cos) = degrees.to_radians().sin_cos();
        values[first] = Some(pole.at[first] + radius_mm * cos);
        values[second] = Some(pole.at[second] + radius_mm * sin);
        Ok(())
    }
}

#[cold]
fn pole_beside_diameters(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "X of a pole that counts from a place, where X is a diameter";
    BlockDiagnostic::new(DiagnosticCode::Polar, span, message)
        .because("whether the distance is a radius or a diameter is not known: they are two places")
        .help("write the pole by G111, from the zero of the program")
}

#[cold]
fn beside(span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::Polar,
        span,
        "polar coordinates beside those of the plane",
    )
    .because("AP and RP stand for the two axes of the plane")
    .help("write one or the other")
}
