//! Loops of FANUC's programs: WHILE, DO and END.
//!
//! A program may leave a loop by GOTO, and comes into it by its DO alone.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::fanuc::statement::fault;
use crate::execute::program::Program;
use crate::syntax::dialect::fanuc::{is_label, is_loop};
use crate::syntax::dialect::line_body::{body, starts_with_word};

/// Most loops within each other, and their largest number.
const MOST_LOOP: u32 = 3;

impl<R: BufRead> Program<R> {
    pub(super) fn fanuc_while(&mut self, index: usize, text: &[u8], at: usize) -> Outcome<()> {
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
        if !(1..=MOST_LOOP).contains(&number) {
            let span = SourceSpan::new(number_at, text.len().max(number_at + 1));
            return Err(fault(span, format!("there is no loop {number}")).help(
                "loops are numbered 1 to 3: write DO 1, DO 2 or DO 3, and END with the same number",
            ));
        }
        self.tape.leave_loop(number);
        if holds {
            self.tape.open_loop(number, index);
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

    /// END: back to the line with its DO.
    pub(super) fn fanuc_end_of_loop(
        &mut self,
        index: usize,
        text: &[u8],
        at: usize,
    ) -> Outcome<()> {
        let number = self.fanuc_number(text, at, true)?;
        let span = SourceSpan::new(at, text.len().max(at + 1));
        let start = match self.tape.known_jump(index, number) {
            Some(start) => start,
            None => {
                let wanted = |line: &[u8]| is_loop(line, b"DO", number);
                self.tape
                    .search_back(index, wanted, is_label)
                    .ok_or_else(|| {
                        fault(span, "an END without its DO").help("give both the same number")
                    })?
            }
        };
        if !self.tape.is_in_loop(number, start) {
            return Err(fault(span, format!("loop {number} was not begun"))
                .help("come into a loop by its DO: a GOTO may leave it, and not lead into it"));
        }
        self.tape.jump(index, number, start);
        Ok(())
    }
}
