//! REPEAT and REPEATB: parts of the program that are executed again; CALL BLOCK: a part that is executed.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::dialect::tape::Repetition;
use crate::execute::flow::activation::MAX_CALLS;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::statement::{is_header, is_target};
use crate::syntax::word_check::missing;

/// Most turns of one repetition.
const MAX_TURNS: f64 = 9999.0;

/// A label, if one comes next.
fn label_ahead(input: &mut Evaluator<'_>) -> Option<Vec<u8>> {
    input.next_visible();
    let name = input.name_ahead();
    let is_label = !name.is_empty() && name != b"P";
    is_label.then(|| {
        input.at += name.len();
        name
    })
}

/// A label of CALL BLOCK, which a text may name.
fn label_or_text(input: &mut Evaluator<'_>, span: SourceSpan) -> Outcome<Vec<u8>> {
    if input.is_text_next() {
        return input.text_value();
    }
    let meaning = "where the part begins and ends: CALL BLOCK first TO last";
    label_ahead(input).ok_or_else(|| missing(span, "CALL BLOCK", "a label", meaning))
}

impl<R: BufRead> Program<R> {
    /// Begins a part again that is to be repeated, or goes on behind it.
    pub(super) fn siemens_repeat(&mut self) {
        while let Some(part) = self.tape.repetitions.last_mut() {
            if self.tape.calls.len() != part.depth || self.tape.next != part.end {
                return;
            }
            if part.again > 0 {
                part.again -= 1;
                self.tape.next = part.start;
                return;
            }
            self.tape.next = part.back;
            self.tape.repetitions.pop();
        }
    }

    /// `REPEAT A`, `REPEAT A B`, `REPEATB A`, each with `P=n`.
    pub(super) fn siemens_repeat_part(
        &mut self,
        index: usize,
        text: &[u8],
        at: usize,
        is_block: bool,
    ) -> Outcome<()> {
        let span = SourceSpan::new(at.saturating_sub(6), at);
        let (first, last, turns) = self.siemens_part(text, at, span, is_block)?;
        let start = self.siemens_target(index, &first, 2, at)?;
        let end = match &last {
            _ if is_block => start + 1,
            Some(last) => self.siemens_last_line(index, start, last, at)? + 1,
            None => self.siemens_part_end(index, start, span)?,
        };
        self.siemens_begin_part(index, (start, end), turns, span)
    }

    /// `CALL BLOCK A TO B`: the part from one label to another, once; `at` is behind BLOCK.
    pub(super) fn siemens_call_block(
        &mut self,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        let span = SourceSpan::new(at.saturating_sub(b"BLOCK".len()), at);
        let (first, last) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            let first = label_or_text(&mut input, span)?;
            if !input.eat_name(b"TO") {
                return Err(missing(
                    span,
                    "CALL BLOCK",
                    "TO",
                    "the label of the last block",
                ));
            }
            let last = label_or_text(&mut input, span)?;
            check_end(&mut input)?;
            (first, last)
        };
        let start = self.siemens_target(index, &first, 2, at)?;
        let end = self.siemens_last_line(index, start, &last, at)? + 1;
        self.siemens_begin_part(index, (start, end), 1, span)
    }

    /// Goes to a part of the program, which is executed a number of times.
    fn siemens_begin_part(
        &mut self,
        index: usize,
        (start, end): (usize, usize),
        turns: u32,
        span: SourceSpan,
    ) -> Outcome<()> {
        if end <= start || (start..end).contains(&index) {
            let message = "a part that ends before it begins, or repeats itself";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
                    .because(
                        "the first label stands in front of the last, and REPEAT outside of them",
                    )
                    .help("check the labels"),
            );
        }
        if self.tape.repetitions.len() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} repetitions in each other");
            return Err(
                BlockDiagnostic::new(DiagnosticCode::CallDepth, span, message)
                    .because("the depth of repetitions is bounded")
                    .help("check what jumps out of a part that is repeated"),
            );
        }
        let Some(again) = turns.checked_sub(1) else {
            return Ok(());
        };
        self.tape.repetitions.push(Repetition {
            start,
            end,
            back: index + 1,
            again,
            depth: self.tape.calls.len(),
        });
        self.tape.next = start;
        Ok(())
    }

    /// The first label, the last one, and how often.
    fn siemens_part(
        &self,
        text: &[u8],
        at: usize,
        span: SourceSpan,
        is_block: bool,
    ) -> Outcome<(Vec<u8>, Option<Vec<u8>>, u32)> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        let first = label_ahead(&mut input)
            .ok_or_else(|| missing(span, "REPEAT", "a label", "where the part begins"))?;
        let last = if is_block {
            None
        } else {
            label_ahead(&mut input)
        };
        let mut turns = 1.0;
        if input.eat_name(b"P") && input.eat(b'=') {
            turns = input.value()?.round();
        }
        let behind = input.at;
        if !input.is_at_end() || !(0.0..=MAX_TURNS).contains(&turns) {
            let span = SourceSpan::new(behind, text.len().max(behind + 1));
            let message = "what is repeated how often is not clear";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
                    .because(format!(
                        "P is a number from 0 to {MAX_TURNS}, and the last word"
                    ))
                    .help("write REPEAT label P=n, REPEAT first last P=n, or REPEATB label P=n"),
            );
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        let turns = turns as u32;
        Ok((first, last, turns))
    }

    /// The last line of a part: the first one with that label from its beginning on, since parts may end at
    /// labels of one name.
    pub(super) fn siemens_last_line(
        &mut self,
        index: usize,
        start: usize,
        label: &[u8],
        at: usize,
    ) -> Outcome<usize> {
        if let Some(line) = self.tape.known_jump(index, 3) {
            return Ok(line);
        }
        let wanted = |line: &[u8]| is_target(line, label);
        let found = self
            .tape
            .search(start, &mut self.source, wanted, is_header)?;
        match found {
            Some(line) => {
                self.tape.remember_jump(index, 3, line);
                Ok(line)
            }
            // Says where labels are looked for, or that it is in front of the first one.
            None => self.siemens_target(index, label, 3, at),
        }
    }

    /// The line behind a part that has one label: ENDLABEL, or REPEAT itself.
    fn siemens_part_end(&mut self, index: usize, start: usize, span: SourceSpan) -> Outcome<usize> {
        let end = match self.tape.known_jump(index, 4) {
            Some(end) => Some(end).filter(|end| *end != usize::MAX),
            None => self.tape.search(
                start + 1,
                &mut self.source,
                |line| is_target(line, b"ENDLABEL"),
                |_| false,
            )?,
        };
        let known = end.unwrap_or(usize::MAX);
        self.tape.remember_jump(index, 4, known);
        match end {
            Some(end) if start > index || end < index => Ok(end),
            _ if start < index => Ok(index),
            _ => {
                let message = "a part without its end";
                Err(
                    BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
                        .because("a part that begins behind REPEAT ends at ENDLABEL:")
                        .help("add ENDLABEL:, or name the last block: REPEAT first last"),
                )
            }
        }
    }
}
