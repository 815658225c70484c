//! Execution of one line: its block, with what belongs to it beside the interpreter (assignments,
//! the ends of the tape, the profiles of lathe cycles).

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::block_order::AfterBlock;
use crate::execute::dialect::siemens::steps::Step;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::block::{Assignment, LineKind};
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::bare_words::{goes_on_with_thread, says_nothing};
use crate::syntax::expression::scope::Parameter;
use crate::syntax::modes::Motion;

/// Most lines of comments between two blocks of a thread.
const MOST_SILENT: usize = 100;

impl<R: BufRead> Program<R> {
    /// Whether the block goes on with a thread in the next line: what cannot be read there is refused
    /// there.
    fn look_at_next_thread(&mut self) {
        let motion = match self.block.codes.motion {
            Some(coded) => coded.code,
            None => self.interpreter.state.modal.motion,
        };
        let is_thread = motion == Some(Motion::Thread) && self.block.has_axes();
        let has_tape = matches!(self.block.dialect, Dialect::Fanuc | Dialect::Siemens);
        self.interpreter.thread_goes_on =
            is_thread && has_tape && !self.is_typed && self.is_thread_next();
    }

    /// Whether the next line that says anything goes on with a thread.
    fn is_thread_next(&mut self) -> bool {
        // Within a cycle its own lines come next.
        if let Some(step) = self.siemens.steps.front() {
            return matches!(step, Step::Line(line) if line.starts_with("G33"));
        }
        for next in self.tape.next..self.tape.next + MOST_SILENT {
            let is_there = self.tape.reach(next, &mut self.source).unwrap_or(false);
            let Some((_, text)) = self.tape.get(next).filter(|_| is_there) else {
                return false;
            };
            if !says_nothing(text) {
                return goes_on_with_thread(text);
            }
        }
        false
    }

    /// Executes a text as a block.
    pub(crate) fn execute_text(&mut self, number: u32, text: &[u8]) -> Outcome<bool> {
        self.interpreter.line = number;
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let parsed = self.block.parse(text, &scope);
        self.execute_parsed(number, parsed)
    }

    /// Executes the block, once it has been read.
    pub(crate) fn execute_parsed(&mut self, number: u32, parsed: Outcome<()>) -> Outcome<bool> {
        self.begun |= self.block.any || parsed.is_err();
        parsed?;
        if !self.block.comment.is_empty() {
            self.remark(number);
        }
        match self.block.kind {
            LineKind::Block if self.block.any => {}
            LineKind::Block => return Ok(true),
            LineKind::Percent if self.percent || self.begun => {
                return match self.block.dialect {
                    Dialect::Fanuc => self.fanuc_end(),
                    _ => self.end_of_input(),
                };
            }
            LineKind::Percent => {
                self.percent = true;
                return Ok(true);
            }
        }
        let is_fanuc = self.block.dialect == Dialect::Fanuc;
        for assignment in &self.block.assignments {
            match assignment.parameter {
                Parameter::Numbered(variable) if is_fanuc => {
                    self.check_fanuc_assignable(variable, assignment.value, assignment.span)?;
                }
                _ => self
                    .parameters
                    .check_assignable(&assignment.parameter, assignment.span)?,
            }
        }
        self.look_at_next_thread();
        match self.asked_lathe_cycle(&self.block)? {
            None => self.execute_checked(number)?,
            // Its words are looked at behind the block.
            Some(asked) => self.whole_statement(|program| {
                program.execute_checked(number)?;
                program.open_lathe_cycle(&asked)
            })?,
        }
        self.end_of_line();
        Ok(true)
    }

    /// Executes the block, of which nothing beside the interpreter is to be refused, and assigns.
    fn execute_checked(&mut self, number: u32) -> Outcome<()> {
        let is_fanuc = self.block.dialect == Dialect::Fanuc;
        let flow = if self.lathe_cycle.is_some() {
            self.draw_block()?;
            AfterBlock::Continue
        } else {
            self.interpreter
                .execute(&self.block, number, &mut self.items)?
        };
        if is_fanuc {
            for index in 0..self.block.assignments.len() {
                let assigned = self.block.assignments.get(index);
                if let Some(&Assignment {
                    parameter: Parameter::Numbered(variable),
                    value,
                    ..
                }) = assigned
                {
                    self.assign_fanuc(variable, value, number);
                }
            }
        } else {
            for assignment in &self.block.assignments {
                self.parameters
                    .assign(&assignment.parameter, assignment.value);
            }
        }
        // The items of the last block are still to be given out.
        self.ended = flow == AfterBlock::End;
        Ok(())
    }
}
