//! TRANS, ROT, MIRROR, SCALE, and what is added to them.
//!
//! One that is not added comes in the place of all that was in force; without words it ends it. The
//! place of the machine does not change, its coordinates do. Angles of ROT are about X, Y and Z, or
//! with RPL about the axis normal to the plane; of several the one about Z comes first, then the one
//! about the new Y, then the one about the new X. MIRROR turns the sense of arcs and the side of
//! cutter radius compensation round.

use std::io::BufRead;

use glidepath_geometry::{Axis, AxisVector};

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::interpreter::Interpreter;
use crate::execute::program::Program;
use crate::execute::state::frame::Frame;
use crate::syntax::dialect::siemens::frame_word::{FrameKind, FrameWord};
use crate::syntax::dialect::siemens::statement::label;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::word_check::missing;

/// Factors beyond this, or below one over it, are refused.
const MAX_SCALE: f64 = 1000.0;

/// Shifts beyond this are refused, mm or degrees.
const MAX_SHIFT: f64 = 1e6;

/// What one word of a frame says.
pub(super) struct FrameValue {
    /// Which axis; `None`: RPL.
    pub(super) axis: Option<Axis>,
    value: f64,
    span: SourceSpan,
}

impl<R: BufRead> Program<R> {
    /// Executes a frame, whose words begin at `at`.
    pub(super) fn siemens_frame(&mut self, word: FrameWord, text: &[u8], at: usize) -> Outcome<()> {
        let name = SourceSpan::new(label(text).1, at);
        check_no_contour(&self.interpreter, name)?;
        let values = self.frame_values(text, at)?;
        if values.is_empty() && word.adds {
            return Err(missing(
                name,
                "a frame that is added",
                "an axis",
                "what is added",
            ));
        }
        let frame = match word.kind {
            FrameKind::Shift => self.shift(&values)?,
            FrameKind::Turn => self.turn(&values)?,
            FrameKind::Mirror => Frame::scaled(of_axes(&values, 1.0, |_| -1.0)?),
            FrameKind::Scale => {
                let wrong = values
                    .iter()
                    .find(|v| !(1.0 / MAX_SCALE..=MAX_SCALE).contains(&v.value));
                if let Some(wrong) = wrong {
                    let message = format!("a scale of {}", wrong.value);
                    return Err(BlockDiagnostic::new(
                        DiagnosticCode::InvalidValue,
                        wrong.span,
                        message,
                    )
                    .because(format!(
                        "factors are from {} to {MAX_SCALE}",
                        1.0 / MAX_SCALE
                    ))
                    .help("write a factor above zero; MIRROR turns coordinates round"));
                }
                Frame::scaled(of_axes(&values, 1.0, |value| value)?)
            }
        };
        let frame = match word.kind {
            FrameKind::Shift if !word.adds => {
                Frame::shifted(self.fine_behind_shift(&values)).with(&frame)
            }
            _ => frame,
        };
        let offsets = &mut self.interpreter.state.offsets;
        let frame = if word.adds {
            offsets.frame.with(&frame)
        } else {
            offsets.tilted.with(&frame)
        };
        check_scale(&frame, name)?;
        check_shift(&frame, name)?;
        let before = offsets.frame;
        offsets.frame = frame;
        self.remember_shift(word, before, &values);
        Ok(())
    }

    /// The words of a frame.
    pub(super) fn frame_values(&self, text: &[u8], at: usize) -> Outcome<Vec<FrameValue>> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        let mut values: Vec<FrameValue> = Vec::new();
        while !input.is_at_end() {
            let start = input.at;
            let name = input.name_ahead();
            let axis = name
                .first()
                .and_then(|letter| AXIS_LETTERS.iter().position(|axis| axis == letter))
                .and_then(|axis| Axis::ALL.get(axis).copied());
            let axis = match (name.as_slice(), axis) {
                (b"RPL", _) => {
                    input.at += 3;
                    None
                }
                ([_], Some(axis)) => {
                    input.at += 1;
                    Some(axis)
                }
                ([_, b'0'..=b'9', ..], Some(axis)) => {
                    input.at += 1;
                    Some(axis)
                }
                _ => {
                    let span = SourceSpan::new(start, start + name.len().max(1));
                    let message = "a word that is none of a frame";
                    return Err(
                        BlockDiagnostic::new(DiagnosticCode::UnusedWord, span, message)
                            .because("a frame has a line of its own, and axes with their values")
                            .help("write the rest into a line of its own"),
                    );
                }
            };
            let computed = input.eat(b'=');
            let value = if computed {
                input.value()?
            } else {
                input.literal()?
            };
            let span = SourceSpan::new(start, input.at);
            if values.iter().any(|other| other.axis == axis) {
                let message = "the same axis twice";
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::DuplicateWord, span, message)
                        .because("a frame has each word once")
                        .help("remove one of them, or add a second frame"),
                );
            }
            values.push(FrameValue { axis, value, span });
        }
        Ok(values)
    }

    pub(super) fn shift(&self, values: &[FrameValue]) -> Outcome<Frame> {
        let mut shift = AxisVector::zeros();
        let scale = self.interpreter.state.modal.units.mm();
        for FrameValue { axis, value, span } in values {
            let Some(axis) = *axis else {
                return Err(not_here(*span, "RPL"));
            };
            if !self.interpreter.options.machine.has(axis) {
                let message = format!("the machine has no {axis} axis");
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::AxisNotConfigured,
                    *span,
                    message,
                )
                .because("its configuration does not have it")
                .help("remove the word, or configure the axis"));
            }
            shift[axis.index()] = if axis.is_rotary() {
                *value
            } else {
                value * scale
            };
        }
        Ok(Frame::shifted(shift))
    }

    fn turn(&self, values: &[FrameValue]) -> Outcome<Frame> {
        match values {
            [
                FrameValue {
                    axis: None,
                    value,
                    span,
                },
            ] => {
                let normal = self.interpreter.state.modal.plane.normal().index();
                if normal >= 3 {
                    return Err(not_here(*span, "RPL"));
                }
                let mut degrees = [0.0; 3];
                degrees[normal] = *value;
                Ok(Frame::turned(degrees))
            }
            values => Ok(Frame::turned(of_axes(values, 0.0, |value| value)?)),
        }
    }
}

/// Refuses a frame where the place of the tool is beside the program's.
pub(super) fn check_no_contour(interpreter: &Interpreter, span: SourceSpan) -> Outcome<()> {
    // Behind G40 the tool is beside the contour, and the next move has a place of its own.
    if !interpreter.state.on_contour {
        return Ok(());
    }
    let message = "a frame with cutter radius compensation on";
    Err(BlockDiagnostic::new(DiagnosticCode::CutterRadius, span, message)
        .because(
            "the tool stands beside the programmed point, at a place that depends on the next move",
        )
        .help("write G40 and a move before it"))
}

/// Refuses a frame that scales too much.
pub(super) fn check_scale(frame: &Frame, name: SourceSpan) -> Outcome<()> {
    if frame.least_scale() * MAX_SCALE >= 1.0 && frame.greatest_scale() <= MAX_SCALE {
        return Ok(());
    }
    let message = "the scales together are beyond what is possible";
    Err(
        BlockDiagnostic::new(DiagnosticCode::InvalidValue, name, message)
            .because(format!(
                "factors are from {} to {MAX_SCALE}",
                1.0 / MAX_SCALE
            ))
            .help("write SCALE alone before it, which ends the frame"),
    )
}

/// Refuses a frame that is shifted too far.
pub(super) fn check_shift(frame: &Frame, name: SourceSpan) -> Outcome<()> {
    if frame.shift.iter().all(|way| way.abs() <= MAX_SHIFT) {
        return Ok(());
    }
    let message = format!("a shift of more than {MAX_SHIFT} mm or degrees");
    Err(
        BlockDiagnostic::new(DiagnosticCode::InvalidValue, name, message)
            .because("coordinates so far away have no micrometres any more")
            .help("check what is added to what; TRANS alone ends the frame"),
    )
}

/// The values of X, Y and Z, `else` where there is none.
fn of_axes(values: &[FrameValue], other: f64, of: impl Fn(f64) -> f64) -> Outcome<[f64; 3]> {
    let mut all = [other; 3];
    for FrameValue { axis, value, span } in values {
        let slot = axis.and_then(|axis| all.get_mut(axis.index()));
        let Some(slot) = slot else {
            let name = axis.map_or("RPL".to_owned(), |axis| axis.to_string());
            return Err(not_here(*span, &name));
        };
        *slot = of(*value);
    }
    Ok(all)
}

fn not_here(span: SourceSpan, name: &str) -> Box<BlockDiagnostic> {
    let message = format!("{name} in this frame is not supported");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "X, Y and Z can be turned, mirrored and scaled, and every axis shifted; RPL is a word of \
             ROT and AROT alone, in the XY, ZX or YZ plane",
        )
        .help("remove it, or write X, Y or Z")
}
