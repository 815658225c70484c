//! Lines of LinuxCNC's programs. Nearly all lines of a long one are straight moves, and each is
//! tried as one first.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::execute::line_origin::LineOrigin;
use crate::execute::program::{Program, is_percent};
use crate::execute::scope::ProgramScope;
use crate::syntax::o_word::o_word;
use crate::syntax::plain_line::read_plain;
use crate::syntax::straight_line::StraightLine;

/// What became of a line that was tried as a straight move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tried {
    /// It was one, and is executed.
    Gone,
    /// Nothing has changed: it may be plain, and is to be looked at more closely.
    Plain,
    /// Nothing has changed: it is not plain.
    Other,
}

impl<R: BufRead> Program<R> {
    /// Reads and executes the next line. `goes_on` if the one before was a straight move.
    pub(crate) fn read_linuxcnc(&mut self, goes_on: bool) -> Outcome<bool> {
        if let Some((part, index)) = self.flow.next_line() {
            self.origin = LineOrigin::Kept(Arc::clone(&part), index);
            self.count_idle()?;
            let has_o_word = part
                .lines
                .get(index)
                .is_some_and(|line| line.o_word.is_some());
            if has_o_word {
                self.execute_flow(&part, index)?;
                return self.close_lathe_cycle().map(|()| true);
            }
            return self.execute_block();
        }
        if !matches!(self.origin, LineOrigin::Stream) {
            self.origin = LineOrigin::Stream;
        }
        // A plain line has no slash and no O word, and its end is found on the way.
        if self.flow.recorder.is_none() {
            match self.go_straight(goes_on) {
                Tried::Gone => return Ok(true),
                Tried::Plain => {
                    if let Some(length) = self.block.parse_plain(self.source.ahead())
                        && self.source.pass(length)
                    {
                        return self.execute_parsed(self.source.number(), Ok(()));
                    }
                }
                Tried::Other => {}
            }
        }
        if !self.source.advance()? {
            return self.end_of_input();
        }
        if self.is_deleted() {
            return Ok(true);
        }
        let o_word = o_word(self.source.text()).inspect_err(|_| self.ended = true)?;
        if self.flow.recorder.is_none() && o_word.is_none() {
            return self.execute_block();
        }
        if self.flow.recorder.is_some() && is_percent(self.source.text()) {
            return self.end_of_input();
        }
        self.begun |= o_word
            .as_ref()
            .is_some_and(|o_word| o_word.keyword.is_some());
        let (number, text) = (self.source.number(), self.source.text().to_vec());
        // What follows depends on every O word, so a diagnostic in one ends the program.
        self.read_flow(number, &text, o_word)
            .inspect_err(|_| self.ended = true)?;
        Ok(true)
    }

    /// Reads and executes the next line if it is nothing but a straight move that nothing is wrong
    /// with.
    #[inline]
    fn go_straight(&mut self, goes_on: bool) -> Tried {
        self.straight.clear();
        let Some(length) = read_plain(self.source.ahead(), &mut self.straight) else {
            return if self.straight.says_more {
                Tried::Plain
            } else {
                Tried::Other
            };
        };
        if self.lathe_cycle.is_some() || !self.source.is_complete(length) {
            return Tried::Plain;
        }
        self.interpreter
            .begin(self.source.number().saturating_add(1));
        let StraightLine { motion, words, .. } = &self.straight;
        let items = &mut self.items;
        if !self.interpreter.go(*motion, words, goes_on, items) {
            return Tried::Plain;
        }
        self.source.pass(length);
        self.begun = true;
        self.was_straight = true;
        self.end_of_line();
        Tried::Gone
    }

    /// Executes the line at the present place as a block.
    fn execute_block(&mut self) -> Outcome<bool> {
        let number = self.line_of_program();
        self.interpreter.line = number;
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let parsed = match &self.origin {
            LineOrigin::Kept(part, index) => match part.lines.get(*index) {
                Some(line) => self.block.parse(&line.text, &scope),
                None => return Ok(true),
            },
            // It was tried as a plain line.
            _ => self.block.parse_any(self.source.text(), &scope),
        };
        self.execute_parsed(number, parsed)
    }
}
