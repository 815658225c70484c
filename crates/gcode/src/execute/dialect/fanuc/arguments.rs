//! The words of a call: which program, how often, and the arguments of a macro.
//!
//! A letter is the variable of its own (A is #1, X is #24). I, J and K written more than once are
//! #4 to #6, then #7 to #9 and so on: a set of them ends where a letter comes that is not behind the
//! last one. Of two words for the same variable the later one counts.

use std::io::BufRead;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::macro_call::Arguments;
use crate::execute::parameters::FANUC_LOCALS;
use crate::execute::program::Program;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::cursor::Cursor;
use crate::syntax::expression::name::name;
use crate::syntax::expression::vacant::VACANT;
use crate::syntax::expression::value::value;
use crate::syntax::word_check::unused;

/// Variables of the letters, from A; zero: not an argument.
const VARIABLES: [usize; 26] = [
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
];

/// Most sets of I, J and K.
const MOST_SETS: usize = 10;

/// The words of a call.
#[derive(Debug, Clone)]
pub(super) struct CallWords {
    pub(super) program: Option<u32>,
    /// The name of the program, in capitals, in the place of its number: `M98 <PART>`.
    pub(super) name: Option<Vec<u8>>,
    pub(super) turns: u32,
    /// L or K was written.
    pub(super) says_turns: bool,
    pub(super) is_macro: bool,
    pub(super) arguments: Arguments,
}

/// How many sets of I, J and K there were, and which letter was the last.
#[derive(Debug, Default)]
struct Sets {
    count: usize,
    last: Option<u8>,
}

impl Sets {
    /// The variable of the next I, J or K; `None`: there are too many.
    fn next(&mut self, letter: u8) -> Option<usize> {
        if self.last.is_none_or(|last| letter <= last) {
            self.count += 1;
        }
        self.last = Some(letter);
        let set = self.count.checked_sub(1).filter(|set| *set < MOST_SETS)?;
        Some(4 + 3 * set + usize::from(letter - b'I'))
    }
}

impl<R: BufRead> Program<R> {
    /// Reads the words of a call from a place on.
    pub(super) fn call_words(&self, text: &[u8], at: usize, is_macro: bool) -> Outcome<CallWords> {
        let mut words = CallWords {
            program: None,
            name: None,
            turns: 1,
            says_turns: false,
            is_macro,
            arguments: [VACANT; FANUC_LOCALS],
        };
        let mut sets = Sets::default();
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
                b'<' => {
                    words.name = Some(name(&mut cursor)?.to_ascii_uppercase().into_bytes());
                    continue;
                }
                b'A'..=b'Z' => cursor.advance(),
                _ => return Err(bad_byte(text, start)),
            }
            let argument = value(&mut cursor, start, &self.scope())?;
            let span = SourceSpan::new(start, cursor.end_of_word());
            match letter {
                b'P' => words.program = Some(self.fanuc_number(text, start + 1, false)?),
                b'L' | b'K' if !is_macro || letter == b'L' => {
                    words.turns = self.fanuc_number(text, start + 1, false)?;
                    words.says_turns = true;
                }
                b'I'..=b'K' if is_macro => {
                    let variable = sets.next(letter).ok_or_else(|| too_many(span))?;
                    words.arguments[variable - 1] = argument;
                }
                _ => match VARIABLES[usize::from(letter - b'A')] {
                    variable @ 1.. if is_macro => words.arguments[variable - 1] = argument,
                    _ => return Err(unused(char::from(letter), span)),
                },
            }
        }
        Ok(words)
    }
}

fn too_many(span: SourceSpan) -> Box<Fault> {
    let message = format!("more than {MOST_SETS} sets of I, J and K");
    Fault::new(DiagnosticCode::InvalidValue, span, message)
        .because("the last of them is #31 to #33")
        .help("pass the others in common variables, #100 to #199")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_end_where_a_letter_is_not_behind_the_last() {
        let mut sets = Sets::default();
        let found: Vec<_> = b"IJKIKIJJ"
            .iter()
            .map(|letter| sets.next(*letter).unwrap_or(0))
            .collect();
        assert_eq!(found, [4, 5, 6, 7, 9, 10, 11, 14]);
    }
}
