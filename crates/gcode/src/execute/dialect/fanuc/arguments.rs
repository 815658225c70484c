//! The words of a call: which program, how often, and the arguments of a macro.
//!
//! A letter is the variable of its own (A is #1, X is #24). I, J and K written more than once are
//! #4 to #6, then #7 to #9 and so on: a set of them ends where a letter comes that is not behind the
//! last one. Of two words for the same variable the later one counts.
//!
//! Where coordinates without a point count least increments, the arguments of a macro count those of their letters, as
//! FANUC's manual says: A, B and C thousandths of a degree, I to K, Q, R and U to Z those of lengths, E and F those of
//! feeds; the other letters are numbers.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::macro_call::Arguments;
use crate::execute::parameters::FANUC_LOCALS;
use crate::execute::program::Program;
use crate::setup::fanuc::PointInput;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::block_reader_of_dialects::{is_without_point, without_point_value};
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::fanuc::{Call, CallCode};
use crate::syntax::expression::name::name;
use crate::syntax::expression::vacant::{VACANT, is_vacant};
use crate::syntax::expression::value::value;
use crate::syntax::least_increments::OF_ANGLES;
use crate::syntax::letters::Letters;
use crate::syntax::modes::{FeedMode, Units};
use crate::syntax::word_check::unused;

/// Variables of the letters, from A; zero: not an argument.
const VARIABLES: [usize; 26] = [
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
];

/// Letters that count least increments without a point, where coordinates do.
const COUNTED: Letters = Letters::of(b"ABCIJKQRUVWXYZ");

/// Most sets of I, J and K.
const MOST_SETS: usize = 10;

/// The words of a call.
#[derive(Debug, Clone)]
pub(super) struct CallWords {
    pub(super) program: Option<u32>,
    /// The number of the block that a subprogram of the same text begins with: `M98 Q100`.
    pub(super) block: Option<u32>,
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

/// Letters of a block that M98 or M97 stands in, which is executed before the call. H and Q are words of
/// other controls' calls.
const BESIDE: Letters = Letters::of(b"GMXYZABCUVWIJRFST");

impl<R: BufRead> Program<R> {
    /// The block that a call stands in without the call and its words, which has the columns of the text. G67 is
    /// executed in front of the rest of its block.
    pub(super) fn beside_call(&self, text: &[u8], call: Call) -> Outcome<Vec<u8>> {
        if call.code == CallCode::EndModalMacro {
            return Ok(Vec::new());
        }
        let mut beside = text.get(..call.start).unwrap_or_default().to_vec();
        if !matches!(call.code, CallCode::Subprogram | CallCode::Local) {
            return Ok(beside);
        }
        let mut cursor = Cursor::new(text);
        cursor.seek(call.end);
        while let Some(byte) = cursor.next_visible() {
            let start = cursor.at();
            match byte {
                b';' => break,
                b'(' => {
                    cursor.skip_comment()?;
                    continue;
                }
                b'<' => {
                    name(&mut cursor)?;
                    continue;
                }
                b'A'..=b'Z' | b'a'..=b'z' => cursor.advance(),
                _ => return Err(bad_byte(text, start)),
            }
            value(&mut cursor, start, &self.scope())?;
            if BESIDE.has(byte.to_ascii_uppercase()) {
                beside.resize(start, b' ');
                beside.extend_from_slice(text.get(start..cursor.at()).unwrap_or_default());
            }
        }
        Ok(beside)
    }

    /// Reads the words of a call from a place on.
    pub(super) fn call_words(&self, text: &[u8], at: usize, is_macro: bool) -> Outcome<CallWords> {
        let mut words = CallWords {
            program: None,
            block: None,
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
            let is_whole = is_without_point(&cursor);
            let argument = value(&mut cursor, start, &self.scope())?;
            let span = SourceSpan::new(start, cursor.end_of_word());
            let argument = if is_whole && is_macro {
                self.argument_without_point(letter, argument, span)?
            } else {
                argument
            };
            match letter {
                // What nothing was assigned to is no word.
                b'L' | b'K' if !is_macro && is_vacant(argument) => {}
                b'L' if is_vacant(argument) => {}
                b'P' => words.program = Some(self.fanuc_number(text, start + 1, false)?),
                b'Q' if !is_macro => {
                    words.block = Some(self.fanuc_number(text, start + 1, false)?);
                }
                b'L' | b'K' if !is_macro || letter == b'L' => {
                    words.turns = self.fanuc_number(text, start + 1, false)?;
                    words.says_turns = true;
                }
                letter if !is_macro && BESIDE.has(letter) => {}
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

impl<R: BufRead> Program<R> {
    /// What an argument of a macro without a decimal point is: it counts least increments of its letter.
    fn argument_without_point(&self, letter: u8, value: f64, span: SourceSpan) -> Outcome<f64> {
        let point = self.block.point;
        let modal = &self.interpreter.state.modal;
        let is_plain = modal.units == Units::Millimetre && modal.feed_mode == FeedMode::PerMinute;
        match letter {
            // An angle, in inches too.
            b'A'..=b'C' if point == PointInput::Increment => Ok(value * OF_ANGLES),
            b'E' | b'F' if point == PointInput::Increment && !is_plain => {
                Err(feed_without_point(letter, value, span))
            }
            _ if COUNTED.has(letter) => {
                without_point_value(point, letter, value, &self.scope(), span)
            }
            _ => Ok(value),
        }
    }
}

/// F of a macro counts as F of a block does, whose increment in inches and per revolution is not known.
#[cold]
fn feed_without_point(letter: u8, value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let letter = char::from(letter);
    let message = format!("{letter}{value} of a macro has no decimal point");
    BlockDiagnostic::new(DiagnosticCode::AmbiguousWord, span, message)
        .because(
            "with `point = \"increment\"` it counts least increments of a feed in inches, per revolution and in G93, \
             and how much one is a parameter of the control says",
        )
        .help(format!("write the point: {letter}{value}. if that is the value"))
}

fn too_many(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("more than {MOST_SETS} sets of I, J and K");
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
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
