//! FANUC: macro B statements, subprograms, and the words that are read otherwise.
//!
//! ```text
//! IF [cond] GOTO n · IF [cond] THEN #i = value · GOTO n · WHILE [cond] DO m … END m
//! G65 P n arguments · M98 P n L k · M99
//! ```
//!
//! Programs and subprograms are in one file, each from its O number to M99 or M30. A jump looks for
//! its block number from the next line to the end of the program, then from its beginning.
//! Arguments of G65 are the parameters of their letters (A is #1, X is #24); M98 shares those of
//! its caller.

use std::io::BufRead;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::tape::SubprogramCall;
use crate::execute::flow::activation::MAX_CALLS;
use crate::execute::program::Program;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::{Statement, is_label, is_loop, is_numbered, statement};
use crate::syntax::dialect::line_body::{body, starts_with_word};
use crate::syntax::expression::scope::LOCALS;
use crate::syntax::expression::value::value;
use crate::syntax::word_check::{missing, unused};

/// Parameters of the letters of G65, by letter from A; zero: not an argument.
const ARGUMENTS: [usize; 26] = [
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
];

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
            return self.end_of_input();
        }
        let index = self.tape.next - 1;
        let Some((number, text)) = self.tape.get(index).cloned() else {
            return self.end_of_input();
        };
        self.set_tape_origin(number, &text);
        self.count_idle().inspect_err(|_| self.end())?;
        if self.interpreter.options.block_delete && text.trim_ascii_start().starts_with(b"/") {
            return Ok(true);
        }
        let (statement, at) = statement(&text);
        match statement {
            Statement::Block => return self.execute_text(number, &text),
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
                let start =
                    self.tape
                        .search_back(index, |line| is_loop(line, b"DO", number), is_label);
                self.tape.next = start.ok_or_else(|| {
                    fault(SourceSpan::new(at, text.len()), "an END without its DO")
                        .help("give both the same number")
                })?;
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
    fn fanuc_number(&self, text: &[u8], at: usize, last: bool) -> Outcome<u32> {
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
        let end = self.tape.search(
            index + 1,
            &mut self.source,
            |line| is_loop(line, b"END", number),
            is_label,
        )?;
        self.tape.next = 1 + end.ok_or_else(|| {
            fault(SourceSpan::new(at, text.len()), "a loop without its END")
                .help(format!("add `END {number}`"))
        })?;
        Ok(())
    }

    fn fanuc_go_to(&mut self, index: usize, number: u32, at: usize) -> Outcome<()> {
        let wanted = |line: &[u8]| is_numbered(line, number);
        let ahead = self
            .tape
            .search(index + 1, &mut self.source, wanted, is_label)?;
        let found = ahead.or_else(|| self.tape.search_back(index + 1, wanted, is_label));
        self.tape.next = found.ok_or_else(|| {
            let message = format!("there is no block N{number} in the program");
            fault(SourceSpan::new(at, at + 4), message)
                .help("add the block number, or correct the jump")
        })?;
        Ok(())
    }

    /// G65 and M98.
    fn fanuc_call(&mut self, text: &[u8], at: usize, is_macro: bool) -> Outcome<()> {
        let span = SourceSpan::new(body(text), at);
        let mut arguments = [0.0; LOCALS];
        let (mut program, mut turns) = (None, 1);
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        while let Some(byte) = cursor.next_visible() {
            let start = cursor.at();
            let letter = byte.to_ascii_uppercase();
            match letter {
                b';' => break,
                b'(' => {
                    cursor.skip_comment()?;
                    continue;
                }
                b'A'..=b'Z' => cursor.advance(),
                _ => return Err(bad_byte(text, start)),
            }
            let argument = value(&mut cursor, start, &self.scope())?;
            let slot = ARGUMENTS[usize::from(letter - b'A')];
            match letter {
                b'P' => program = Some(self.fanuc_number(text, start + 1, false)?),
                b'L' | b'K' if !is_macro || letter == b'L' => {
                    turns = self.fanuc_number(text, start + 1, false)?;
                }
                _ if is_macro && slot > 0 => arguments[slot - 1] = argument,
                _ => {
                    let span = SourceSpan::new(start, cursor.end_of_word());
                    return Err(unused(char::from(letter), span));
                }
            }
        }
        let Some(program) = program else {
            return Err(missing(span, "the call", "P", "the program's number"));
        };
        let wanted = |line: &[u8]| statement(line).0 == Statement::Label(program);
        let first = self.tape.search(0, &mut self.source, wanted, |_| false)?;
        let Some(first) = first else {
            let message = format!("there is no program O{program}");
            return Err(Fault::new(DiagnosticCode::UnknownSubroutine, span, message)
                .because("a subprogram is in the same file as its caller")
                .help("copy it behind the end of this program"));
        };
        if self.tape.calls.len() >= MAX_CALLS {
            let message = format!("more than {MAX_CALLS} calls in each other");
            return Err(Fault::new(DiagnosticCode::CallDepth, span, message)
                .because("the depth of calls is bounded")
                .help("check what should end the recursion"));
        }
        if turns == 0 {
            return Ok(());
        }
        self.tape.calls.push(SubprogramCall {
            first: first + 1,
            back: self.tape.next,
            again: turns - 1,
            own_parameters: is_macro,
        });
        self.tape.next = first + 1;
        if is_macro {
            self.parameters.enter(&arguments);
        }
        Ok(())
    }

    /// M99: back to the caller, or the end of the program.
    fn fanuc_return(&mut self, text: &[u8], at: usize) -> Outcome<bool> {
        let mut cursor = Cursor::new(text);
        cursor.seek(at);
        if !matches!(cursor.next_visible(), None | Some(b'(' | b';' | b'%')) {
            let span = SourceSpan::new(cursor.at(), text.len());
            return Err(Fault::new(DiagnosticCode::NotSupported, span, "words behind M99")
                .because("a return leads to behind the call, and a program that repeats itself never ends")
                .help("write M99 alone; use GOTO inside the caller"));
        }
        let Some(call) = self.tape.calls.last_mut() else {
            return self.end_of_input();
        };
        if call.again > 0 {
            call.again -= 1;
            self.tape.next = call.first;
            return Ok(true);
        }
        let call = *call;
        self.tape.calls.pop();
        self.tape.next = call.back;
        if call.own_parameters {
            self.parameters.leave(None);
        }
        Ok(true)
    }
}
