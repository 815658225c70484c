//! The reading of indices of the control's variables, whose names begin with `$`, and of frames as
//! values.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::expression::{Evaluator, unclosed};
use crate::syntax::dialect::siemens::system_index::Index;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::word_check::missing;

/// Most indices of a variable.
const MOST_INDICES: usize = 3;

/// Axes, each with the value behind it.
pub(crate) type AxisValues = Vec<(Axis, f64)>;

/// The axis that a name is.
fn axis_named(name: &[u8]) -> Option<Axis> {
    let [letter] = name else { return None };
    let index = AXIS_LETTERS.iter().position(|axis| axis == letter)?;
    Axis::ALL.get(index).copied()
}

impl Evaluator<'_> {
    /// `[1]`, `[X]`, `[1,X,TR]`; nothing where no bracket comes next.
    pub(crate) fn system_index(&mut self) -> Outcome<Vec<Index>> {
        let start = self.at;
        let mut index = Vec::new();
        if self.peek(0) != Some(b'[') {
            return Ok(index);
        }
        self.at += 1;
        loop {
            self.next_visible();
            let name = self.name_ahead();
            let is_part = [&b"TR"[..], b"FI", b"RT", b"SC", b"MI"].contains(&name.as_slice());
            if let Some(axis) = axis_named(&name) {
                self.at += 1;
                index.push(Index::Axis(axis));
            } else if is_part {
                self.at += name.len();
                index.push(Index::Word(name));
            } else {
                index.push(Index::Value(self.comparison()?));
            }
            if self.eat(b']') {
                return Ok(index);
            }
            if index.len() >= MOST_INDICES || !self.eat(b',') {
                return Err(unclosed(
                    SourceSpan::new(start, self.at.max(start + 1)),
                    "]",
                ));
            }
        }
    }

    /// `CTRANS(X,10,Y,5)`: the name, and axes with their values.
    pub(crate) fn frame_function(&mut self) -> Outcome<(Vec<u8>, AxisValues)> {
        self.next_visible();
        let start = self.at;
        let name = self.name_ahead();
        self.at += name.len();
        let span = SourceSpan::new(start, self.at.max(start + 1));
        if !self.eat(b'(') {
            let meaning = "axes with their values, as in CTRANS(X,10)";
            return Err(missing(span, "a frame", "( )", meaning));
        }
        let mut values = Vec::new();
        while !self.eat(b')') {
            self.next_visible();
            let axis = axis_named(&self.name_ahead());
            let Some(axis) = axis else {
                let span = SourceSpan::new(self.at, self.at + 1);
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::Expression,
                    span,
                    "an axis is missing",
                )
                .because("a frame has axes with a value behind each: CTRANS(X,10,Y,5)")
                .help("write X, Y or Z, a comma and the value"));
            };
            self.at += 1;
            // CMIRROR(X,Y) has axes alone.
            if name == b"CMIRROR" {
                values.push((axis, -1.0));
            } else if self.eat(b',') {
                values.push((axis, self.value()?));
            } else {
                return Err(missing(span, "a frame", ",", "the value behind each axis"));
            }
            if !self.eat(b',') && self.next_visible() != Some(b')') {
                return Err(unclosed(SourceSpan::new(start, self.at), ")"));
            }
        }
        Ok((name, values))
    }
}
