//! The reader of a line's text into a block, word by word.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::block::{Assignment, Block, LineKind, PolarWord};
use crate::syntax::block_reader_of_dialects::{
    check_behind_end_of_block, check_one_command, skip_brackets,
};
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::marlin::{reads_words, shows_text};
use crate::syntax::duplicate_word::duplicate;
use crate::syntax::expression::scope::Scope;
use crate::syntax::expression::vacant::is_vacant;
use crate::syntax::expression::value::{open_expression, parameter, value};
use crate::syntax::letters::{Letters, Slot};
use crate::syntax::plain_line::WordSink;

/// Words of G70 and G71 of a lathe.
const WORDS_OF_LATHE_CYCLES: Letters = Letters::of(b"QDEPIRXYZABCUVW");

impl Block {
    /// Fills the block from the text of a line.
    pub(crate) fn parse(&mut self, text: &[u8], scope: &dyn Scope) -> Outcome<()> {
        let is_plain = match self.dialect {
            Dialect::Fanuc => self.parse_plain_fanuc(text),
            _ => self.parse_plain(text) == Some(text.len()),
        };
        if is_plain {
            return Ok(());
        }
        self.parse_any(text, scope)
    }

    /// Fills the block from the text of a line that is not plain, or not known to be.
    pub(crate) fn parse_any(&mut self, text: &[u8], scope: &dyn Scope) -> Outcome<()> {
        self.clear();
        self.is_plain = false;
        let is_printer = self.dialect == Dialect::Marlin;
        let mut cursor = Cursor::new(text).with_e_words(is_printer);
        match cursor.next_visible() {
            Some(b'%') => return self.percent(cursor),
            Some(b'/') => {
                cursor.advance();
                self.skip_switch(&mut cursor);
            }
            _ => {}
        }
        let (mut start_of_block, mut spindle) = (true, None);
        let mut has_command = false;
        while let Some(byte) = cursor.next_visible() {
            match byte {
                b'(' => {
                    let start = cursor.at() + 1;
                    match self.dialect {
                        Dialect::Fanuc => skip_brackets(&mut cursor)?,
                        _ => cursor.skip_comment()?,
                    }
                    let said = text.get(start..cursor.at() - 1);
                    self.comment.clear();
                    self.comment.extend_from_slice(said.unwrap_or_default());
                }
                b';' => {
                    if self.dialect == Dialect::Fanuc && !start_of_block {
                        check_behind_end_of_block(cursor)?;
                    }
                    break;
                }
                b'A'..=b'Z' | b'a'..=b'z' => {
                    let letter = byte.to_ascii_uppercase();
                    if self.dialect == Dialect::Marlin {
                        check_one_command(&mut has_command, letter, cursor)?;
                    }
                    self.word(&mut cursor, letter, start_of_block, scope)?;
                    start_of_block = false;
                    match self.codes.function.map(|function| function.code) {
                        Some(number) if reads_words(number) => {}
                        Some(number) => {
                            // The rest of the line belongs to the function.
                            if shows_text(number) {
                                self.says(cursor);
                            }
                            break;
                        }
                        None => {}
                    }
                }
                b',' if matches!(self.dialect, Dialect::Fanuc | Dialect::Siemens) => {
                    self.corner_word(&mut cursor, scope)?;
                }
                b'/' if self.dialect == Dialect::Fanuc => {
                    cursor.advance();
                    self.skip_switch(&mut cursor);
                }
                b'@' | b'^' if self.has_linuxcnc_words() => {
                    self.polar_word(&mut cursor, usize::from(byte == b'^'), scope)?;
                    start_of_block = false;
                }
                b'#' if self.dialect != Dialect::Marlin => {
                    self.assignment(&mut cursor, scope)?;
                    start_of_block = false;
                }
                b'[' if self.dialect == Dialect::Fanuc => {
                    self.named_assignment(&mut cursor, scope)?;
                    start_of_block = false;
                }
                b'$' if self.dialect == Dialect::LinuxCnc && has_value(cursor) => {
                    spindle = Some(self.spindle_number(&mut cursor, scope)?);
                    start_of_block = false;
                }
                _ => return Err(odd_character(text, cursor.at(), byte)),
            }
        }
        self.count_increments(scope);
        self.take_units_of_mach();
        self.check_spindle_number(spindle)
    }

    /// G70 and G71 that have no word of a cycle may be Mach3's.
    fn take_units_of_mach(&mut self) {
        if self.dialect == Dialect::LinuxCnc && !self.has_any(WORDS_OF_LATHE_CYCLES) {
            self.codes.take_units_of_mach();
        }
    }

    /// Refuses the number of a spindle where no word tells a spindle something.
    fn check_spindle_number(&self, written: Option<SourceSpan>) -> Outcome<()> {
        match written {
            Some(span) if !self.tells_spindle() => Err(unused_spindle(span)),
            _ => Ok(()),
        }
    }

    /// Keeps the text of a printer's message as one for people.
    fn says(&mut self, cursor: Cursor<'_>) {
        let text = cursor.rest();
        let end = text.iter().position(|byte| *byte == b';');
        self.comment.clear();
        self.comment.extend_from_slice(b"MSG,");
        self.comment
            .extend_from_slice(text.get(..end.unwrap_or(text.len())).unwrap_or_default());
    }

    /// True if the block has a word that tells the spindle something.
    const fn tells_spindle(&self) -> bool {
        let codes = &self.codes;
        codes.spindle.is_some()
            || codes.spindle_mode.is_some()
            || codes.orient.is_some()
            || self.has_any(Letters::of(b"S"))
    }

    /// `$0`, the one spindle there is, or `$-1`, all of them.
    fn spindle_number(&self, cursor: &mut Cursor<'_>, scope: &dyn Scope) -> Outcome<SourceSpan> {
        let start = cursor.at();
        cursor.advance();
        let number = value(cursor, start, scope)?;
        let span = SourceSpan::new(start, cursor.end_of_word());
        if number.abs() <= 0.0 || (number + 1.0).abs() <= 0.0 {
            return Ok(span);
        }
        let message = format!("there is no spindle {number}");
        Err(
            BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("the machine has one spindle, number 0")
                .help("remove the word, or write $0"),
        )
    }

    fn percent(&mut self, mut cursor: Cursor<'_>) -> Outcome<()> {
        self.kind = LineKind::Percent;
        cursor.advance();
        match cursor.next_visible() {
            None => Ok(()),
            // A FANUC passes over the line of the sign in front of a program, and reads nothing behind the one at its end.
            Some(_) if self.dialect == Dialect::Fanuc => Ok(()),
            Some(_) => {
                let span = SourceSpan::new(cursor.at(), cursor.at() + 1);
                Err(BlockDiagnostic::new(
                    DiagnosticCode::StrayPercent,
                    span,
                    "text behind a percent sign",
                )
                .because("a percent sign by itself marks the start or the end of the program")
                .help("give the percent sign a line of its own"))
            }
        }
    }

    fn assignment(&mut self, cursor: &mut Cursor<'_>, scope: &dyn Scope) -> Outcome<()> {
        let start = cursor.at();
        let parameter = parameter(cursor, scope)?;
        let span = SourceSpan::new(start, cursor.end_of_word());
        if cursor.next_visible() != Some(b'=') {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Expression,
                span,
                "a parameter that nothing uses",
            )
            .because("a parameter stands behind a letter, or before `=`")
            .help("write the letter of the word in front, or assign a value"));
        }
        cursor.advance();
        let value = match self.dialect {
            Dialect::Fanuc => open_expression(cursor, scope)?,
            _ => value(cursor, start, scope)?,
        };
        self.any = true;
        self.assignments.push(Assignment {
            parameter,
            value,
            span,
        });
        Ok(())
    }

    fn polar_word(
        &mut self,
        cursor: &mut Cursor<'_>,
        which: usize,
        scope: &dyn Scope,
    ) -> Outcome<()> {
        let start = cursor.at();
        cursor.advance();
        let value = value(cursor, start, scope)?;
        let span = SourceSpan::new(start, cursor.end_of_word());
        if self.polar[which].is_some() {
            return Err(duplicate(if which == 0 { '@' } else { '^' }, span));
        }
        self.any = true;
        self.polar[which] = Some(PolarWord { value, span });
        Ok(())
    }

    fn word(
        &mut self,
        cursor: &mut Cursor<'_>,
        letter: u8,
        first: bool,
        scope: &dyn Scope,
    ) -> Outcome<()> {
        let start = cursor.at();
        cursor.advance();
        match letter {
            b'N' => return block_number(cursor, start, first),
            b'O' if !(self.dialect == Dialect::Marlin && self.names_an_axis(*cursor, letter)) => {
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::FlowStructure,
                    SourceSpan::new(start, start + 1),
                    "an O word inside a block",
                )
                .because("an O word has a line of its own")
                .help("put it into a line of its own"));
            }
            _ => {}
        }
        if self.dialect == Dialect::Marlin && self.names_an_axis(*cursor, letter) {
            return self.flag(letter, SourceSpan::new(start, start + 1));
        }
        let value = match self.dialect {
            Dialect::Fanuc => self.fanuc_value(cursor, start, letter, scope)?,
            _ => value(cursor, start, scope)?,
        };
        let span = SourceSpan::new(start, cursor.end_of_word());
        if self.dialect == Dialect::Fanuc && is_vacant(value) {
            // The word counts as not written.
            return Ok(());
        }
        self.any = true;
        let is_move = letter == b'G' && (0.0..=3.0).contains(&value);
        self.says_modes |= matches!(letter, b'G' | b'M') && !is_move;
        match letter {
            b'G' if self.dialect == Dialect::Fanuc => {
                self.codes
                    .add_fanuc_g(value, self.is_lathe, self.system, span)
            }
            b'G' if self.dialect == Dialect::Marlin => self.codes.add_printer_g(value, span),
            b'G' if self.dialect == Dialect::Siemens => self.codes.add_rewritten_g(value, span),
            b'G' => self.codes.add_g(value, span),
            b'M' if self.dialect == Dialect::Marlin => {
                self.codes.add_printer_m(value, span, &self.declared)
            }
            b'M' if self.dialect == Dialect::Fanuc => {
                self.codes
                    .add_fanuc_m(value, self.is_lathe, span, &self.declared)
            }
            b'M' if self.dialect == Dialect::Siemens => {
                self.codes.add_rewritten_m(value, span, &self.declared)
            }
            b'M' => self.codes.add_m(value, span, &self.declared),
            _ => self
                .add_value(Slot::of(letter), value, span)
                .ok_or_else(|| duplicate(char::from(letter), span)),
        }
    }
}

/// True if what stands behind the next byte is a value: `$0` is a spindle, `$H` a command.
fn has_value(mut cursor: Cursor<'_>) -> bool {
    cursor.advance();
    matches!(
        cursor.next_visible(),
        Some(b'0'..=b'9' | b'.' | b'+' | b'-' | b'#' | b'[')
    )
}

#[cold]
fn unused_spindle(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "nothing in the block uses the spindle's number";
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, span, message)
        .because("it belongs to S, M3, M4, M5, M19, G96 and G97")
        .help("remove it, or add the code it belongs to")
}

fn block_number(cursor: &mut Cursor<'_>, start: usize, first: bool) -> Outcome<()> {
    let value = cursor.number(start)?;
    let span = SourceSpan::new(start, cursor.end_of_word());
    if !first {
        let message = "a block number that is not at the start of the line";
        return Err(
            BlockDiagnostic::new(DiagnosticCode::MisplacedBlockNumber, span, message)
                .because("N numbers the block it starts")
                .help("put it first, or remove it"),
        );
    }
    // LinuxCNC takes parts of numbers, too: blocks that were put in between.
    if value < 0.0 {
        let message = "the block number is negative";
        return Err(
            BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
                .because("N numbers the block it starts")
                .help("write a number of zero or more, or remove it"),
        );
    }
    Ok(())
}

#[cold]
fn odd_character(text: &[u8], at: usize, byte: u8) -> Box<BlockDiagnostic> {
    let span = SourceSpan::new(at, at + 1);
    match byte {
        b')' => BlockDiagnostic::new(DiagnosticCode::BadCharacter, span, "`)` closes no comment")
            .because("no comment is open here")
            .help("remove it"),
        b'/' => BlockDiagnostic::new(DiagnosticCode::BadCharacter, span, "`/` inside a block")
            .because("block delete marks a whole line")
            .help("move it to the start of the line"),
        b'%' => BlockDiagnostic::new(
            DiagnosticCode::StrayPercent,
            span,
            "a percent sign inside a line",
        )
        .because("a percent sign by itself marks the start or the end of the program")
        .help("give the percent sign a line of its own"),
        b'$' => BlockDiagnostic::new(DiagnosticCode::NotSupported, span, "`$` (spindle number)")
            .because("there is one spindle; commands of a controller are no part of a program")
            .help("remove it"),
        _ => bad_byte(text, at),
    }
}
