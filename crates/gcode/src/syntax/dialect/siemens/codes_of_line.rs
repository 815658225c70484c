//! The words of a letter and a number: the G and M codes of the tables, and the addresses of
//! SINUMERIK's language.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::bare_words::{bare_words, has_letter, without_comments};
use crate::syntax::dialect::siemens::computed_words::no_address;
use crate::syntax::dialect::siemens::writer::Writer;
use crate::syntax::dialect::words::siemens::{self as words, ADDRESSES};
use crate::syntax::dialect::words::{Meaning, no_g, no_m, refused};
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::number::code_number;
use crate::syntax::word_check::missing;

/// The number that digits write.
fn number_of(digits: &[u8]) -> Option<u32> {
    core::str::from_utf8(digits).ok()?.parse().ok()
}

/// G58 or G59 that is not the first word of its block.
#[cold]
fn beside_offset(number: u32, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("words in front of G{number}");
    BlockDiagnostic::new(DiagnosticCode::UnusedWord, span, message)
        .because("it changes the offset of an axis, in a block of its own")
        .help("write it first in its block")
}

impl Writer<'_> {
    /// `M=R1`, `M1=3`.
    pub(super) fn computed_m_code(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.input.at = start + length;
        self.input.eat(b'=');
        let value = self.input.value()?;
        let span = SourceSpan::new(start, self.input.at);
        let number = code_number(value).ok_or_else(|| no_m(Dialect::Siemens, value, span))?;
        self.m_code(span, number)
    }

    /// A letter and its number: a code of the tables, or an address that this language has.
    pub(super) fn address(
        &mut self,
        start: usize,
        length: usize,
        name: &[u8],
        dwell: bool,
    ) -> Outcome<()> {
        let span = SourceSpan::new(start, start + length);
        let number = name.get(1..).and_then(number_of);
        match (name, number) {
            ([b'G', ..], Some(number)) => return self.g_code(span, number),
            ([b'M', ..], Some(number)) => return self.m_code(span, number),
            ([b'H', ..], _) => return self.plc_function(span, name),
            ([b'S', ..], _) if self.speed_range().is_some() => {
                self.replace(start, 1, self.speed_range().unwrap_or_default());
            }
            ([b'F', ..], _) if dwell => self.replace(start, 1, b"P"),
            ([b'L', _, ..], _) => {
                return Err(refused(
                    &String::from_utf8_lossy(name),
                    "the call of a subprogram beside other words",
                    "write it into a block of its own",
                    span,
                ));
            }
            ([letter, ..], _) if !ADDRESSES.contains(letter) => {
                return Err(no_address(char::from(*letter), span));
            }
            _ => self.copy(),
        }
        // The number is copied as it is: it may go on with a point.
        while matches!(self.input.peek(0), Some(b'0'..=b'9' | b'.' | b'-' | b'+')) {
            self.copy();
        }
        Ok(())
    }

    /// `H5`, `H5.5`: a function of the machine's PLC.
    fn plc_function(&mut self, span: SourceSpan, name: &[u8]) -> Outcome<()> {
        self.check_plc_function(span, name)?;
        self.input.at = span.start + 1;
        while matches!(self.input.peek(0), Some(b'0'..=b'9' | b'.' | b'-' | b'+')) {
            self.input.at += 1;
        }
        Ok(())
    }

    /// `H=5`, `H1=R1`: the same.
    pub(super) fn computed_plc_function(&mut self, start: usize, name: &[u8]) -> Outcome<()> {
        self.check_plc_function(SourceSpan::new(start, start + name.len()), name)?;
        self.input.at = start + name.len();
        self.input.eat(b'=');
        self.input.value()?;
        Ok(())
    }

    /// Refuses a function of the PLC, unless it does nothing on this machine.
    fn check_plc_function(&self, span: SourceSpan, name: &[u8]) -> Outcome<()> {
        if self.names.scope.system_value(b"H", &[]) != Some(1.0) {
            let shown = String::from_utf8_lossy(name);
            let message = format!("{shown} (a function of the machine's PLC) is not supported");
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because("it could have been meant to stop or to clamp something")
                .help("write an M code with a table [m_codes.M…] in its place, or set h_words = \"read-over\" in [program] if it does nothing on this machine"));
        }
        Ok(())
    }

    /// What S is in a line with G25 or G26: a limit of the spindle's speed.
    pub(super) fn speed_range(&self) -> Option<&'static [u8]> {
        if self.has_code(26) {
            Some(b",H")
        } else if self.has_code(25) {
            Some(b",E")
        } else {
            None
        }
    }

    /// Refuses G25 and G26 of the working area, and without S.
    fn check_speed_range(&self, number: u32, span: SourceSpan) -> Outcome<()> {
        let bare: Vec<u8> = self
            .input
            .text
            .iter()
            .filter(|byte| !byte.is_ascii_whitespace())
            .map(u8::to_ascii_uppercase)
            .collect();
        let code = without_comments(&bare);
        let words = bare_words(&code);
        if AXIS_LETTERS
            .iter()
            .any(|letter| has_letter(&words, *letter))
        {
            return Err(refused(
                &format!("G{number} with axes"),
                "a limit of the working area",
                "set the travel of the axes in the configuration",
                span,
            ));
        }
        if !has_letter(&words, b'S') {
            let name = format!("G{number}");
            return Err(missing(span, &name, "S", "a limit of the spindle's speed"));
        }
        Ok(())
    }

    fn g_code(&mut self, span: SourceSpan, number: u32) -> Outcome<()> {
        let length = span.length;
        let has_point = self.input.peek(length) == Some(b'.');
        let meaning = words::g(number).filter(|_| !has_point);
        let with: &[u8] = match (meaning, number) {
            (Some(Meaning::Own), 641..=645) => b"G64",
            (Some(Meaning::Own), 25 | 26) => {
                self.check_speed_range(number, span)?;
                b""
            }
            (Some(Meaning::Own), 9) => b"G9",
            (Some(Meaning::Own), 60) => b"G61.1",
            (Some(Meaning::Own), 153) => b"G53",
            (Some(Meaning::Own), 500) => b"G500",
            (Some(Meaning::Own), 710) => b"G21",
            (Some(Meaning::Own), 700) => b"G20",
            // G97.1: G97 without the limit of LIMS.
            (Some(Meaning::Own), 961) => b"G96 G94",
            (Some(Meaning::Own), 971) => b"G97.1 G94",
            (Some(Meaning::Own), 972) => b"G97.1",
            (Some(Meaning::Own), 973) => b"G97.1 G95",
            (Some(Meaning::Own), 58 | 59) => return Err(beside_offset(number, span)),
            (Some(Meaning::ReadOver), _) => b"",
            (Some(Meaning::Shared), _)
            | (Some(Meaning::Own), 70 | 71 | 110..=112 | 331 | 332 | 505..=599) => {
                self.replace(span.start, 0, format!("G{number}").as_bytes());
                self.input.at = span.start + length;
                return Ok(());
            }
            (Some(Meaning::Refused(what, help)), _) => {
                return Err(refused(&format!("G{number}"), what, help, span));
            }
            (None | Some(Meaning::Own), _) => {
                return Err(no_g(Dialect::Siemens, f64::from(number), span));
            }
        };
        self.replace(span.start, length, with);
        Ok(())
    }

    fn m_code(&mut self, span: SourceSpan, number: u32) -> Outcome<()> {
        let meaning = words::m(number);
        let is_declared = self.names.scope.declares_m(number);
        match meaning {
            _ if matches!(number, 2 | 17 | 30) => {
                self.end_program(span, if number == 30 { b"M30" } else { b"M2" });
            }
            Some(Meaning::ReadOver) if !is_declared => {
                self.replace(span.start, span.length, b"");
            }
            Some(Meaning::Refused(what, help)) if !is_declared => {
                return Err(refused(&format!("M{number}"), what, help, span));
            }
            None if !is_declared => {
                return Err(no_m(Dialect::Siemens, f64::from(number), span));
            }
            _ => {
                self.replace(span.start, 0, format!("M{number}").as_bytes());
                self.input.at = span.start + span.length;
            }
        }
        Ok(())
    }
}
