//! G58 and G59: the offset of single axes, in its two parts.
//!
//! TRANS says the first part, ATRANS the second one, and their sum is the shift of the frame. G58 puts
//! another value in the place of the first part for the axes that it names, G59 in that of the
//! second one; nothing moves. TRANS with axes leaves what G59 has set (ONE, NC programming, 6FC5398-2EP40, p. 315), and
//! ends what ATRANS has added; TRANS alone ends all.

use std::io::BufRead;

use glidepath_geometry::{AXES, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::frames::{FrameValue, check_shift};
use crate::execute::dialect::siemens::steps::ShiftParts;
use crate::execute::program::Program;
use crate::execute::state::frame::Frame;
use crate::syntax::dialect::siemens::frame_word::{FrameKind, FrameWord};
use crate::syntax::word_check::missing;

impl<R: BufRead> Program<R> {
    /// The parts of the shift in force; `None`: it cannot be told which part said what.
    fn shift_parts(&self) -> Option<ShiftParts> {
        let frame = self.interpreter.state.offsets.frame;
        let none = ShiftParts {
            frame,
            coarse: AxisVector::zeros(),
            fine: AxisVector::zeros(),
            is_own: [false; AXES],
        };
        let known = self.siemens.shift.filter(|known| known.frame == frame);
        known.or_else(|| (!frame.is_in_force()).then_some(none))
    }

    /// The fine parts that TRANS with these words leaves.
    pub(super) fn fine_behind_shift(&self, values: &[FrameValue]) -> AxisVector {
        let parts = self.shift_parts().filter(|_| !values.is_empty());
        parts.map_or_else(AxisVector::zeros, |parts| {
            AxisVector::from_fn(|axis, _| {
                if parts.is_own[axis] {
                    parts.fine[axis]
                } else {
                    0.0
                }
            })
        })
    }

    /// Keeps the parts of the shift behind a frame, which has come behind `before`.
    pub(super) fn remember_shift(&mut self, word: FrameWord, before: Frame, values: &[FrameValue]) {
        let frame = core::mem::replace(&mut self.interpreter.state.offsets.frame, before);
        let last = self.shift_parts();
        self.interpreter.state.offsets.frame = frame;
        let zero = AxisVector::zeros();
        let shift = || self.shift(values).map_or(zero, |shift| shift.shift);
        let is_own = last.map_or([false; AXES], |last| last.is_own);
        let has_fine = word.adds || word.kind == FrameKind::Shift && !values.is_empty();
        let parts = match (word.kind, word.adds) {
            (FrameKind::Shift, false) => {
                let kept = |axis: usize| last.filter(|last| has_fine && last.is_own[axis]);
                let fine =
                    AxisVector::from_fn(|axis, _| kept(axis).map_or(0.0, |last| last.fine[axis]));
                Some((shift(), fine))
            }
            (_, false) => Some((zero, zero)),
            // A shift that is turned is none of the axes.
            (FrameKind::Shift, true) => last
                .filter(|_| !before.is_turned())
                .map(|last| (last.coarse, last.fine + shift())),
            (_, true) => last.map(|last| (last.coarse, last.fine)),
        };
        self.siemens.shift = parts.map(|(coarse, fine)| ShiftParts {
            frame,
            coarse,
            fine,
            is_own: if has_fine { is_own } else { [false; AXES] },
        });
    }

    /// G58 and G59.
    pub(super) fn siemens_axis_offset(
        &mut self,
        is_fine: bool,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        let name = SourceSpan::new(at - 3, at);
        let state = &self.interpreter.state;
        let code = if is_fine { "G59" } else { "G58" };
        if state.on_contour {
            let message = format!("{code} with cutter radius compensation on");
            return Err(BlockDiagnostic::new(DiagnosticCode::CutterRadius, name, message)
                .because("the tool stands beside the programmed point, at a place that depends on the next move")
                .help("write G40 and a move before it"));
        }
        let values = self.frame_values(text, at)?;
        if values.is_empty() {
            return Err(missing(name, code, "an axis", "whose offset it is"));
        }
        let is_tilted = self.interpreter.state.offsets.tilted.is_in_force();
        let Some(mut parts) = self.shift_parts().filter(|_| !is_tilted) else {
            let message =
                format!("{code} in a frame whose shift was turned, or that is not its own");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NotSupported, name, message)
                    .because("which part of the offset it would change cannot be told")
                    .help("write TRANS and what is to be in force anew"),
            );
        };
        let to = self.shift(&values)?.shift;
        let part = if is_fine {
            &mut parts.fine
        } else {
            &mut parts.coarse
        };
        let mut by = AxisVector::zeros();
        for axis in values.iter().filter_map(|value| value.axis) {
            let axis = axis.index();
            by[axis] = to[axis] - part[axis];
            part[axis] = to[axis];
            parts.is_own[axis] |= is_fine;
        }
        let offsets = &mut self.interpreter.state.offsets;
        parts.frame = Frame::shifted(by).with(&offsets.frame);
        check_shift(&parts.frame, name)?;
        offsets.frame = parts.frame;
        self.siemens.shift = Some(parts);
        Ok(())
    }
}
