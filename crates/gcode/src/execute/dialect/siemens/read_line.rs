//! Reads and executes the next line, or the next step of a cycle.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::procedure::check_extern;
use crate::execute::dialect::siemens::steps::{Before, Step};
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::dialect::line_body::body;
use crate::syntax::dialect::siemens::callee::callee;
use crate::syntax::dialect::siemens::expression::{Evaluator, Names};
use crate::syntax::dialect::siemens::statement::{Statement, is_header, label, statement};
use crate::syntax::dialect::siemens::writer::rewrite;
use crate::syntax::modes::Distance;

/// A main block, whose number stands behind a colon, with the letter of other blocks.
pub(super) fn with_block_number(mut text: Box<[u8]>) -> Box<[u8]> {
    let colon = text.iter().position(|byte| !byte.is_ascii_whitespace());
    if let Some(colon) = colon
        && text.get(colon) == Some(&b':')
        && text.get(colon + 1).is_some_and(u8::is_ascii_digit)
    {
        text[colon] = b'N';
    }
    text
}

/// The text with blanks in the place of its label, which keeps the columns of the rest.
pub(super) fn without_label(text: &[u8]) -> Vec<u8> {
    let (found, behind) = label(text);
    let mut text = text.to_vec();
    if found.is_some() {
        text[..behind].fill(b' ');
    }
    text
}

impl<R: BufRead> Program<R> {
    /// Reads and executes the next line; false at the end.
    pub(crate) fn read_siemens(&mut self) -> Outcome<bool> {
        if let Some(step) = self.siemens.steps.pop_front() {
            return self.siemens_step(step);
        }
        self.siemens_repeat();
        if !self.tape.advance(&mut self.source)? {
            return if self.siemens_return() {
                Ok(true)
            } else {
                self.end_of_input()
            };
        }
        let index = self.tape.next - 1;
        let Some((number, text)) = self.tape.get(index).cloned() else {
            return self.end_of_input();
        };
        self.set_tape_origin(number, &text);
        let text = with_block_number(text);
        if self.tape.is_again() {
            self.count_idle().inspect_err(|_| self.end())?;
        }
        if self.interpreter.options.block_delete && text.trim_ascii_start().starts_with(b"/") {
            return Ok(true);
        }
        // Behind the program itself stand its subprograms, each behind its name.
        if is_header(&text) && (self.begun || !self.tape.calls.is_empty()) {
            return if self.siemens_return() {
                Ok(true)
            } else {
                self.end_of_input()
            };
        }
        let (statement, at) = statement(&text);
        match statement {
            Statement::Block => {
                if let Some(callee) = callee(&text) {
                    let called = self.siemens_call_line(&text, &callee);
                    if called.inspect_err(|_| self.end())? {
                        return Ok(true);
                    }
                }
                if self.siemens.modal_call.is_none() {
                    return self.siemens_block(number, &text);
                }
                // What is called at the end of a move may be refused when the block itself was not.
                self.whole_statement(|program| program.siemens_block(number, &text))
            }
            Statement::Extern => check_extern(&text, at).map(|()| true),
            Statement::TextCall(call) => {
                let called = self.siemens_named_call(call, index, &text, at);
                called.inspect_err(|_| self.end()).map(|()| true)
            }
            Statement::Procedure => {
                let done = self.siemens_procedure(&text, at);
                done.inspect_err(|_| self.end()).map(|()| true)
            }
            Statement::Frame(word) => self.siemens_whole(|program| {
                program.renaming(|program| program.siemens_frame(word, &text, at))
            }),
            Statement::AxisOffset(is_fine) => self.siemens_whole(|program| {
                program.renaming(|program| program.siemens_axis_offset(is_fine, &text, at))
            }),
            Statement::SystemData => {
                self.siemens_whole(|program| program.siemens_system_data(&text, at))
            }
            Statement::Cycle => self.siemens_whole(|program| program.siemens_cycle(&text, at)),
            Statement::Swivel => self.siemens_whole(|program| program.siemens_swivel(&text, at)),
            Statement::Positions => {
                self.siemens_whole(|program| program.siemens_positions(&text, at))
            }
            Statement::ModalCall => {
                self.siemens_whole(|program| program.siemens_modal_call(&text, at))
            }
            // What follows depends on it, so a diagnostic ends the program.
            _ => {
                let done = self.siemens_flow(statement, index, &text, at);
                done.inspect_err(|_| self.end()).map(|()| true)
            }
        }
    }

    /// A statement that has its whole effect, or none.
    fn siemens_whole(&mut self, act: impl FnOnce(&mut Self) -> Outcome<()>) -> Outcome<bool> {
        self.whole_statement(act).map(|()| true)
    }

    /// What reads a text from a place on.
    pub(super) fn evaluator<'t>(
        &'t self,
        scope: &'t ProgramScope<'t>,
        text: &'t [u8],
        at: usize,
    ) -> Evaluator<'t> {
        let names = Names {
            variables: &self.siemens.variables,
            scope,
            in_subprogram: !self.tape.calls.is_empty(),
        };
        Evaluator::new(text, at, names)
    }

    fn siemens_block(&mut self, number: u32, text: &[u8]) -> Outcome<bool> {
        let text = without_label(text);
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let names = Names {
            variables: &self.siemens.variables,
            scope: &scope,
            in_subprogram: !self.tape.calls.is_empty(),
        };
        let mut line = rewrite(&text, names)?;
        let parsed = self.block.parse(&line.text, &scope);
        let goes_on = self.execute_parsed(number, parsed).map_err(|mut fault| {
            fault.span = line.origin(fault.span);
            fault
        })?;
        for assignment in line.texts.drain(..) {
            self.siemens.variables.set_text(assignment);
        }
        let moves = self.block.has_axes() && self.block.codes.non_modal.is_none();
        if moves && !self.ended && self.siemens.modal_call.is_some() {
            let span = SourceSpan::new(body(&text), text.len());
            self.siemens_call_again(span)?;
        }
        if line.ends_subprogram {
            self.siemens_return();
        }
        Ok(goes_on)
    }

    /// A position of a pattern; what is left of it comes behind the cycle there.
    fn siemens_position(&mut self, [first, second]: [f64; 2]) -> Outcome<bool> {
        let rest = core::mem::take(&mut self.siemens.steps);
        let plane = self.interpreter.state.modal.plane;
        let (a, b) = plane.axes();
        let incremental = self.interpreter.state.modal.distance == Distance::Incremental;
        let distance = if incremental { "G90 " } else { "" };
        let modal = Box::new(self.interpreter.state.modal);
        let line = format!("{distance}G0 {a}[{first}] {b}[{second}]");
        let number = self.line_of_program();
        self.kept_lines += 1;
        self.execute_text(number, line.as_bytes())?;
        self.interpreter.state.modal = *modal;
        let here = self.here();
        let span = SourceSpan::new(label(&here.text).1, here.text.trim_ascii_end().len());
        let depth = self.siemens.calls.len();
        self.siemens_call_again(span)?;
        // Those of a subprogram come before what is left of the pattern.
        match self.siemens.calls.get_mut(depth) {
            Some(call) => call.steps.extend(rest),
            None => self.siemens.steps.extend(rest),
        }
        Ok(true)
    }

    /// What was in force before a cycle is so again.
    const fn restore(&mut self, before: Before) {
        let state = &mut self.interpreter.state;
        state.modal = before.modal;
        state.rounds_mm = before.rounds_mm;
        state.diameter_by_distance = before.diameter_by_distance;
    }

    /// A step of the cycle in progress; what is wrong with it is wrong with the cycle's line.
    pub(super) fn siemens_step(&mut self, step: Step) -> Outcome<bool> {
        let line = match step {
            Step::Restore(before) => {
                self.restore(*before);
                return Ok(true);
            }
            Step::Position(place) => return self.siemens_position(place),
            Step::Line(line) => line,
        };
        // A loop around a cycle is as long as all of its steps.
        self.kept_lines += 1;
        let number = self.line_of_program();
        self.execute_text(number, line.as_bytes())
            .map_err(|mut fault| {
                let here = self.here();
                fault.span = SourceSpan::new(label(&here.text).1, here.text.trim_ascii_end().len());
                while let Some(step) = self.siemens.steps.pop_front() {
                    if let Step::Restore(before) = step {
                        self.restore(*before);
                    }
                }
                fault
            })
    }
}
