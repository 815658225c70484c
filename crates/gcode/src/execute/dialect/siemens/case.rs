//! `CASE (value) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::{check_end, fault};
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::statement::{Direction, direction};

/// Values that differ by less are the same.
const SAME: f64 = 1e-9;

/// A jump of CASE: which way, to what, and where that stands.
type Jump = (Direction, Vec<u8>, usize);

impl<R: BufRead> Program<R> {
    /// Jumps to the target of the first value that is the one in parentheses; without one, and
    /// without DEFAULT, it goes on.
    pub(super) fn siemens_case(&mut self, index: usize, text: &[u8], at: usize) -> Outcome<()> {
        let (chosen, number) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            let value = input.value()?;
            if !input.eat_name(b"OF") {
                return Err(form(at, text.len()));
            }
            let (mut chosen, mut number): (Option<Jump>, u32) = (None, 0);
            let mut jumps = 0;
            while !input.is_at_end() {
                jumps += 1;
                let is_default = input.eat_name(b"DEFAULT");
                let is_it = is_default || (input.value()? - value).abs() < SAME;
                let jump = jump_ahead(&mut input)?;
                if is_it && chosen.is_none() {
                    (chosen, number) = (Some(jump), jumps);
                }
                if is_default {
                    check_end(&mut input)?;
                }
            }
            if jumps == 0 {
                return Err(form(at, text.len()));
            }
            (chosen, number)
        };
        match chosen {
            // The jumps of a line are told apart by their number.
            Some((way, target, at)) => self.siemens_jump(way, index, &target, (10 + number, at)),
            None => Ok(()),
        }
    }
}

fn jump_ahead(input: &mut Evaluator<'_>) -> Outcome<Jump> {
    input.next_visible();
    let start = input.at;
    let name = input.name_ahead();
    let Some(way) = direction(&name) else {
        return Err(form(start, input.text.len()));
    };
    input.at += name.len();
    input.next_visible();
    let at = input.at;
    let target = input.name_ahead();
    input.at += target.len();
    let is_name = target
        .first()
        .is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_');
    if !is_name {
        return Err(form(start, input.text.len()));
    }
    Ok((way, target, at))
}

fn form(start: usize, end: usize) -> Box<crate::diagnostic::block_diagnostic::BlockDiagnostic> {
    let span = SourceSpan::new(start, end.max(start + 1));
    fault(span, "CASE in another form")
        .help("write CASE (value) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C")
}
