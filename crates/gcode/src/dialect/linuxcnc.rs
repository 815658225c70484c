//! Lines of LinuxCNC's programs. Nearly all lines of a long one are straight moves, and each is tried as
//! one first.

use std::io::BufRead;
use std::sync::Arc;

use crate::diagnostic::Outcome;
use crate::flow_word::head;
use crate::parameters::ProgramScope;
use crate::place::Place;
use crate::plain::read_plain;
use crate::plain_move::StraightLine;
use crate::program::{Program, is_percent};

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
        if let Some((code, index)) = self.flow.next_line() {
            self.place = Place::Kept(Arc::clone(&code), index);
            self.count_idle()?;
            let has_head = code
                .lines
                .get(index)
                .is_some_and(|line| line.head.is_some());
            if has_head {
                self.execute_flow(&code, index)?;
                return self.close_contour().map(|()| true);
            }
            return self.execute_block();
        }
        if !matches!(self.place, Place::Stream) {
            self.place = Place::Stream;
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
        let head = head(self.source.text()).inspect_err(|_| self.ended = true)?;
        if self.flow.recorder.is_none() && head.is_none() {
            return self.execute_block();
        }
        if self.flow.recorder.is_some() && is_percent(self.source.text()) {
            return self.end_of_input();
        }
        self.begun |= head.as_ref().is_some_and(|head| head.keyword.is_some());
        let (number, text) = (self.source.number(), self.source.text().to_vec());
        // What follows depends on every O word, so a finding in one ends the program.
        self.read_flow(number, &text, head)
            .inspect_err(|_| self.ended = true)?;
        Ok(true)
    }

    /// Reads and executes the next line if it is nothing but a straight move that nothing is wrong with.
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
        if self.contour.is_some() || !self.source.is_complete(length) {
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
        let scope = ProgramScope {
            parameters: &self.parameters,
            interpreter: &self.interpreter,
        };
        let parsed = match &self.place {
            Place::Kept(code, index) => match code.lines.get(*index) {
                Some(line) => self.block.parse(&line.text, &scope),
                None => return Ok(true),
            },
            // It was tried as a plain line.
            _ => self.block.parse_any(self.source.text(), &scope),
        };
        self.execute_parsed(number, parsed)
    }
}
