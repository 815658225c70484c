//! G16: the first axis of the plane is a radius, the second an angle.
//!
//! In G90 they are about the zero of the program. In G91 a radius is about where the tool is, and an
//! angle is added to the last one. A word that is missing keeps its value; what it is before the first one is not
//! known, and refused.

use glidepath_geometry::{AXES, Axis};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::execute::interpreter::Interpreter;
use crate::execute::motion::axis_words::axis_value;
use crate::execute::state::fanuc_modal::Polar;
use crate::syntax::block::Block;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::modes::Distance;

impl Interpreter {
    /// G15 and G16, and what the words of a block that moves make of the radius and the angle.
    pub(super) fn fanuc_polar(&mut self, block: &Block) {
        if let Some(coded) = block.codes.polar_mode {
            self.state.fanuc.polar = coded.code.then(Polar::default);
        }
    }

    /// Takes the words of a block that moves.
    pub(crate) fn take_polar_words(&mut self, block: &Block) {
        let Some(mut polar) = self.state.fanuc.polar else {
            return;
        };
        let (first, second) = self.state.modal.plane.axes();
        let incremental = self.state.modal.distance == Distance::Incremental;
        let here = self.state.offsets.to_program(self.state.position);
        let scale = self.state.modal.units.mm();
        for (axis, value) in block.axes() {
            if axis == first {
                polar.is_said[0] = true;
                polar.radius_mm = axis_value(axis, value, scale);
                polar.centre = if incremental {
                    [here[first.index()], here[second.index()]]
                } else {
                    [0.0; 2]
                };
            } else if axis == second {
                polar.is_said[1] = true;
                let degrees = block.degrees(AXIS_LETTERS[axis.index()]).unwrap_or(value);
                polar.degrees = if incremental {
                    polar.degrees + degrees
                } else {
                    degrees
                };
            }
        }
        self.state.fanuc.polar = Some(polar);
    }

    /// Puts the point that is meant into the places of the two axes.
    pub(crate) fn resolve_fanuc_polar(
        &self,
        block: &Block,
        values: &mut [Option<f64>; AXES],
    ) -> Outcome<()> {
        let Some(polar) = self.state.fanuc.polar else {
            return Ok(());
        };
        let (first, second) = self.state.modal.plane.axes();
        let axes = [first.index(), second.index()];
        let is_meant = block.codes.non_modal.is_none() && block.codes.frame.is_none();
        if !is_meant || axes.iter().all(|axis| values[*axis].is_none()) {
            return Ok(());
        }
        if let Some(unsaid) = polar.is_said.iter().position(|is_said| !is_said) {
            return Err(unsaid_polar(block, unsaid, [first, second]));
        }
        let here = self.state.offsets.to_program(self.state.position);
        let incremental = self.state.modal.distance == Distance::Incremental;
        for (axis, place) in axes.into_iter().zip(polar.point()) {
            values[axis] = Some(if incremental {
                place - here[axis]
            } else {
                place
            });
        }
        Ok(())
    }

    /// The holes of a block that is repeated in G91: each as if the block stood there once more.
    pub(crate) fn repeat_polar(&mut self, block: &Block, places: &mut [[Option<f64>; AXES]]) {
        let Some(mut polar) = self.state.fanuc.polar else {
            return;
        };
        if self.state.modal.distance != Distance::Incremental {
            return;
        }
        let (first, second) = self.state.modal.plane.axes();
        let word = |wanted| block.axes().find(|(axis, _)| *axis == wanted);
        let (radius, angle) = (word(first), word(second));
        if radius.is_none() && angle.is_none() {
            return;
        }
        for place in places.iter_mut().skip(1) {
            if radius.is_some() {
                polar.centre = polar.point();
            }
            polar.degrees += block.degrees(AXIS_LETTERS[second.index()]).unwrap_or(0.0);
            for (axis, at) in [first, second].into_iter().zip(polar.point()) {
                place[axis.index()] = Some(at);
            }
        }
        self.state.fanuc.polar = Some(polar);
    }
}

#[cold]
fn unsaid_polar(block: &Block, which: usize, axes: [Axis; 2]) -> Box<BlockDiagnostic> {
    let (name, said) = if which == 0 {
        ("radius", axes[1])
    } else {
        ("angle", axes[0])
    };
    let letter = axes[which].letter();
    let message = format!("{} with G16 before the first {name}", said.letter());
    BlockDiagnostic::new(DiagnosticCode::Polar, block.axis_span(said), message)
        .because(format!(
            "no block since G16 has said the {name}, and what the control takes for it is not known"
        ))
        .help(format!(
            "write {letter}, which is the {name}, into this block"
        ))
}
