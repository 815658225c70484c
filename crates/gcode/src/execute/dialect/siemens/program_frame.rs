//! The frame of a program by its name: `$P_PFRAME`.
//!
//! ```text
//! $P_PFRAME=CTRANS(X,10):CROT(Z,30)      as TRANS X10, then AROT Z30
//! $P_PFRAME=$P_PFRAME:CSCALE(X,2)        as ASCALE X2
//! $P_PFRAME[X,TR]=5                      the shift along X alone
//! $P_PFRAME[Z,RT], [X,SC], [X,MI]        what is in force, to be read
//! ```
//!
//! It counts in the plane of CYCLE800. Angles are those of ROT: about Z, then about the new Y, then about
//! the new X.

use std::io::BufRead;

use glidepath_geometry::{Axis, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::dialect::siemens::frames::{check_no_contour, check_scale, check_shift};
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::execute::state::frame::Frame;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::system_index::{Index, letters};
use crate::syntax::dialect::siemens::system_variable::AxisValues;

impl Interpreter {
    /// The frame of the program, in the plane of CYCLE800.
    fn program_frame(&self) -> Frame {
        self.state
            .offsets
            .tilted
            .inverse()
            .with(&self.state.offsets.frame)
    }

    /// `$P_PFRAME[X,TR]` and the like; `None`: it is not known.
    pub(super) fn program_frame_value(&self, axis: Axis, part: &[u8]) -> Option<f64> {
        let frame = self.program_frame();
        let index = axis.index();
        match part {
            b"TR" => Some(self.in_variable_units(frame.shift, axis)),
            b"FI" => Some(0.0),
            _ if index >= 3 => None,
            b"RT" => frame.angles_deg().map(|degrees| degrees[index]),
            // What is turned and stretched at once has no factors of its own.
            b"SC" => frame.factors().map(|factors| factors[index].abs()),
            b"MI" => frame
                .factors()
                .map(|factors| f64::from(u8::from(factors[index] < 0.0))),
            _ => None,
        }
    }

    /// The frame that a function makes, as CTRANS does.
    fn frame_of(&self, function: &[u8], values: &AxisValues, span: SourceSpan) -> Outcome<Frame> {
        let mm = self.variable_unit_mm();
        let linear = |fallback: f64| {
            let mut all = [fallback; 3];
            for (axis, value) in values {
                let Some(slot) = all.get_mut(axis.index()) else {
                    return Err(no_frame(function, span));
                };
                *slot = *value;
            }
            Ok(all)
        };
        match function {
            b"CTRANS" => {
                let mut shift = AxisVector::zeros();
                for (axis, value) in values {
                    let unit = if axis.is_rotary() { 1.0 } else { mm };
                    shift[axis.index()] = value * unit;
                }
                Ok(Frame::shifted(shift))
            }
            b"CROT" => Ok(Frame::turned(linear(0.0)?)),
            b"CSCALE" | b"CMIRROR" => {
                let factors = linear(1.0)?;
                let frame =
                    Frame::scaled(factors.map(|factor| if factor == 0.0 { 1.0 } else { factor }));
                if factors.contains(&0.0) {
                    return Err(no_frame(function, span));
                }
                Ok(frame)
            }
            _ => Err(no_frame(function, span)),
        }
    }

    /// Frames with colons between them, the first one outermost.
    fn frame_chain(&self, input: &mut Evaluator<'_>) -> Outcome<Frame> {
        let mut frame = Frame::default();
        loop {
            let start = input.at;
            let inner = if input.eat_name(b"$P_PFRAME") {
                self.program_frame()
            } else {
                let (function, values) = input.frame_function()?;
                self.frame_of(&function, &values, SourceSpan::new(start, input.at))?
            };
            frame = frame.with(&inner);
            if !input.eat(b':') {
                return Ok(frame);
            }
        }
    }
}

impl<R: BufRead> Program<R> {
    /// A line that sets the frame of the program; what it is to be begins at `at`.
    pub(super) fn set_program_frame(
        &mut self,
        text: &[u8],
        (at, index): (usize, &[Index]),
        span: SourceSpan,
    ) -> Outcome<()> {
        check_no_contour(&self.interpreter, span)?;
        let frame = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            let frame = match index {
                [] => self.interpreter.frame_chain(&mut input)?,
                [Index::Axis(axis), Index::Word(part)] if part == b"TR" => {
                    let value = input.value()?;
                    let mut frame = self.interpreter.program_frame();
                    let mm = self.interpreter.variable_unit_mm();
                    let unit = if axis.is_rotary() { 1.0 } else { mm };
                    frame.shift[axis.index()] = value * unit;
                    frame
                }
                _ => return Err(no_frame(b"$P_PFRAME", span)),
            };
            check_end(&mut input)?;
            frame
        };
        check_scale(&frame, span)?;
        check_shift(&frame, span)?;
        self.renaming(|program| {
            let offsets = &mut program.interpreter.state.offsets;
            offsets.frame = offsets.tilted.with(&frame);
            Ok(())
        })
    }
}

#[cold]
fn no_frame(name: &[u8], span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("this part of {} cannot be set", letters(name));
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("a frame is CTRANS, CROT, CSCALE and CMIRROR of X, Y and Z, with colons between them; by its parts only the shifts (TR) are set")
        .help("write TRANS, ROT, SCALE and MIRROR")
}
