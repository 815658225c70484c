//! FANUC: macro B statements, subprograms, and the words that are read otherwise.
//!
//! ```text
//! IF [cond] GOTO n · IF [cond] THEN #i = value · GOTO n · WHILE [cond] DO m … END m
//! G65 P n arguments · M98 P n L k · M99
//! ```
//!
//! A jump looks for its block number from the next line to the end of the program, then from its
//! beginning. Where subprograms are is in [`super::fanuc_call`].

use std::io::BufRead;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc_call::not_returned;
use crate::execute::program::Program;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::{Statement, is_label, is_loop, is_numbered, statement};
use crate::syntax::dialect::line_body::{body, starts_with_word};
use crate::syntax::expression::value::value;

/// The text with blanks in the place of its first bytes, which keeps the columns of the rest.
fn without_head(text: &[u8], length: usize) -> Vec<u8> {
    let mut rest = vec![b' '; length];
    rest.extend_from_slice(text.get(length..).unwrap_or_default());
    rest
}

fn fault(span: SourceSpan, message: impl Into<String>) -> Box<Fault> {
    Fault::new(DiagnosticCode::FlowStructure, span, message)
        .because("IF, WHILE, GOTO and the calls have a line of their own each, in a fixed form")
}

impl<R: BufRead> Program<R> {
    /// Reads and executes the next line; false at the end.
    pub(crate) fn read_fanuc(&mut self) -> Outcome<bool> {
        if !self.tape.advance(&mut self.source)? {
            return self.fanuc_end();
        }
        let index = self.tape.next - 1;
        let Some((number, text)) = self.tape.get(index).cloned() else {
            return self.end_of_input();
        };
        self.set_tape_origin(number, &text);
        let number = self.line_of_program();
        if self.tape.is_again() {
            self.count_idle().inspect_err(|_| self.end())?;
        }
        if self.interpreter.options.block_delete && text.trim_ascii_start().starts_with(b"/") {
            return Ok(true);
        }
        let (statement, at) = statement(&text);
        match statement {
            Statement::Block => return self.execute_text(number, &text),
            Statement::Label(_) if !self.tape.calls.is_empty() => {
                self.end();
                return Err(not_returned(&text));
            }
            Statement::Label(_) => return self.execute_text(number, &without_head(&text, at)),
            Statement::If => {
                if let Some(then) = self.fanuc_if(&text, at).inspect_err(|_| self.end())? {
                    return self.execute_text(number, &without_head(&text, then));
                }
            }
            // What follows depends on it, so a diagnostic ends the program.
            _ => {
                return self
                    .fanuc_flow(statement, index, &text, at)
                    .inspect_err(|_| self.end());
            }
        }
        Ok(true)
    }

    /// Executes a statement other than IF.
    fn fanuc_flow(
        &mut self,
        statement: Statement,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<bool> {
        match statement {
            Statement::Goto => {
                let target = self.fanuc_number(text, at, true)?;
                self.fanuc_go_to(index, target, at)?;
            }
            Statement::While => self.fanuc_while(index, text, at)?,
            Statement::End => {
                let number = self.fanuc_number(text, at, true)?;
                if let Some(start) = self.tape.known_jump(index, number) {
                    self.tape.next = start;
                    return Ok(true);
                }
                let start =
                    self.tape
                        .search_back(index, |line| is_loop(line, b"DO", number), is_label);
                let start = start.ok_or_else(|| {
                    fault(SourceSpan::new(at, text.len()), "an END without its DO")
                        .help("give both the same number")
                })?;
                self.tape.jump(index, number, start);
            }
            Statement::Macro | Statement::Subprogram => {
                self.fanuc_call(text, at, statement == Statement::Macro)?;
            }
            Statement::Return => return self.fanuc_return(text, at),
            Statement::Block | Statement::Label(_) | Statement::If | Statement::LookAhead => {}
        }
        Ok(true)
    }

    /// A whole number at `at`, computed or not; nothing may follow if it is the `last`.
    pub(super) fn fanuc_number(&self, text: &[u8], at: usize, last: bool) -> Outcome<u32> {
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        let number = value(&mut cursor, at.saturating_sub(1), &self.scope())?;
        let behind = cursor.next_visible();
        if last && !matches!(behind, None | Some(b'(' | b';')) {
            let span = SourceSpan::new(cursor.at(), text.len());
            return Err(fault(span, "text behind the statement").help("remove it"));
        }
        let span = SourceSpan::new(at, cursor.end_of_word());
        if number.fract() != 0.0 || !(0.0..=99_999_999.0).contains(&number) {
            let message = format!("{number} is no block, loop or program number");
            return Err(fault(span, message).help("write a whole number"));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        Ok(number as u32)
    }

    /// The condition in brackets at `at`, and where what follows it starts.
    fn fanuc_condition(&self, text: &[u8], at: usize) -> Outcome<(bool, usize)> {
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        if cursor.next_visible() != Some(b'[') {
            return Err(fault(
                SourceSpan::new(at, cursor.at() + 1),
                "a condition is missing",
            )
            .help("write it in brackets: [#1 EQ 2]"));
        }
        let holds = value(&mut cursor, at, &self.scope())? != 0.0;
        cursor.next_visible();
        Ok((holds, cursor.at()))
    }

    /// IF: jumps, or gives where the assignment behind THEN starts.
    fn fanuc_if(&mut self, text: &[u8], at: usize) -> Outcome<Option<usize>> {
        let (holds, then) = self.fanuc_condition(text, at)?;
        let rest = text.get(then..).unwrap_or_default();
        if starts_with_word(rest, b"GOTO") {
            let target = self.fanuc_number(text, then + 4, true)?;
            if holds {
                self.fanuc_go_to(self.tape.next - 1, target, then)?;
            }
            return Ok(None);
        }
        if starts_with_word(rest, b"THEN") {
            return Ok(holds.then_some(then + 4));
        }
        Err(fault(
            SourceSpan::new(then, text.len().max(then + 1)),
            "IF without GOTO or THEN",
        )
        .help("write `IF [condition] GOTO n` or `IF [condition] THEN #i = value`"))
    }

    fn fanuc_while(&mut self, index: usize, text: &[u8], at: usize) -> Outcome<()> {
        let bare = text.get(body(text)..).unwrap_or_default();
        let (holds, number_at) = if starts_with_word(bare, b"DO") {
            (true, at)
        } else {
            let (holds, then) = self.fanuc_condition(text, at)?;
            if !starts_with_word(text.get(then..).unwrap_or_default(), b"DO") {
                return Err(fault(
                    SourceSpan::new(then, text.len().max(then + 1)),
                    "WHILE without DO",
                )
                .help("write `WHILE [condition] DO 1` and `END 1`"));
            }
            (holds, then + 2)
        };
        let number = self.fanuc_number(text, number_at, true)?;
        if holds {
            return Ok(());
        }
        if let Some(behind) = self.tape.known_jump(index, number) {
            self.tape.next = behind;
            return Ok(());
        }
        let end = self.tape.search(
            index + 1,
            &mut self.source,
            |line| is_loop(line, b"END", number),
            is_label,
        )?;
        let end = end.ok_or_else(|| {
            fault(SourceSpan::new(at, text.len()), "a loop without its END")
                .help(format!("add `END {number}`"))
        })?;
        self.tape.jump(index, number, end + 1);
        Ok(())
    }

    fn fanuc_go_to(&mut self, index: usize, number: u32, at: usize) -> Outcome<()> {
        if let Some(block) = self.tape.known_jump(index, number) {
            self.tape.next = block;
            return Ok(());
        }
        let wanted = |line: &[u8]| is_numbered(line, number);
        let ahead = self
            .tape
            .search(index + 1, &mut self.source, wanted, is_label)?;
        let found = ahead.or_else(|| self.tape.search_back(index + 1, wanted, is_label));
        let found = found.ok_or_else(|| {
            let message = format!("there is no block N{number} in the program");
            fault(SourceSpan::new(at, at + 4), message)
                .help("add the block number, or correct the jump")
        })?;
        self.tape.jump(index, number, found);
        Ok(())
    }
}
