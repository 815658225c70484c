//! SINUMERIK: a line is rewritten into RS274/NGC words, and every byte keeps its place.
//!
//! | SINUMERIK | becomes |
//! |---|---|
//! | `X=expression` | `X[expression]` with `( )` as `[ ]` and `R5` as `#1005` |
//! | `R5=expression` | `#1005=[expression]` |
//! | `CR=`, `TURN=n` | `R`, `P` of n + 1 |
//! | `CYCLE832(tolerance, …)` | `G64 P` of the tolerance |
//! | `G641 ADIS=d`, `G642` … `G645` | `G64 P` of d, `G64` |
//! | `G60` | `G61.1` |
//! | `G71` `G710`, `G700` | `G21`, `G20` |
//! | `G4 F` | `G4 P` |
//! | `M17`, `RET` | `M2` |
//! | `MSG( )`, `;`, `%_N_…`, `G601` … `G603`, `SOFT`, `FFWON` … | nothing |

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::dialect::line_body::body;
use crate::syntax::dialect::siemens::rewritten::Rewritten;
use crate::syntax::word_check::missing;

pub(crate) use marks::marks;

mod marks;
mod rewritten;
#[cfg(test)]
mod tests;

/// Where R parameters begin.
const R_BASE: u32 = 1000;
/// R parameters there are.
const R_COUNT: u32 = 1000;

/// Words without effect on where and how fast the tool goes here: look-ahead and feed forward are
/// always on, every acceleration is limited in jerk, and dense chords are merged within the
/// tolerance.
const NO_EFFECT: [&[u8]; 15] = [
    b"SOFT",
    b"FFWON",
    b"FFWOF",
    b"COMPON",
    b"COMPCAD",
    b"COMPCURV",
    b"COMPSURF",
    b"COMPOF",
    b"UPATH",
    b"SPATH",
    b"STOPRE",
    b"G601",
    b"G602",
    b"G603",
    b"FIFOCTRL",
];

/// Functions of expressions.
const FUNCTIONS: [&[u8]; 12] = [
    b"SIN", b"COS", b"TAN", b"ASIN", b"ACOS", b"SQRT", b"ABS", b"ROUND", b"LN", b"EXP", b"TRUNC",
    b"MOD",
];

/// Rewrites a line.
pub(crate) fn rewrite(text: &[u8]) -> Outcome<Rewritten> {
    let mut writer = Writer {
        text,
        at: 0,
        out: Rewritten::default(),
    };
    if text.trim_ascii_start().starts_with(b"%_N_") {
        return Ok(writer.out);
    }
    writer.line()?;
    Ok(writer.out)
}

struct Writer<'t> {
    text: &'t [u8],
    at: usize,
    out: Rewritten,
}

impl Writer<'_> {
    fn peek(&self, ahead: usize) -> Option<u8> {
        let byte = self.text.get(self.at + ahead)?;
        Some(byte.to_ascii_uppercase())
    }

    fn skip_blanks(&mut self) {
        while matches!(self.peek(0), Some(b' ' | b'\t')) {
            self.at += 1;
        }
    }

    fn copy(&mut self) {
        if let Some(byte) = self.text.get(self.at) {
            self.out.push(&[*byte], self.at);
            self.at += 1;
        }
    }

    fn line(&mut self) -> Outcome<()> {
        let start = body(self.text);
        while self.at < start {
            self.copy();
        }
        // `G4 F` is a dwell, and `ADIS` belongs to G641.
        let dwell = self.has_code(4);
        while let Some(byte) = self.peek(0) {
            match byte {
                b';' => break,
                b'A'..=b'Z' | b'_' | b'$' => self.word(dwell)?,
                _ => self.copy(),
            }
        }
        Ok(())
    }

    /// True if the line has that G code.
    fn has_code(&self, number: u32) -> bool {
        let upper = self.text.to_ascii_uppercase();
        let code = upper.split(|byte| *byte == b';').next().unwrap_or_default();
        (0..code.len()).any(|at| {
            let before = at.checked_sub(1).and_then(|at| code.get(at));
            let tail = code.get(at + 1..).unwrap_or_default();
            let digits = tail.iter().take_while(|byte| byte.is_ascii_digit()).count();
            let value = tail
                .get(..digits)
                .and_then(|d| core::str::from_utf8(d).ok());
            code[at] == b'G'
                && !before.is_some_and(u8::is_ascii_alphanumeric)
                && value.and_then(|value| value.parse().ok()) == Some(number)
        })
    }

    /// Letters, digits and what else may be in a name, from here on.
    fn name_ahead(&self) -> Vec<u8> {
        (0..)
            .map_while(|ahead| self.peek(ahead))
            .take_while(|byte| matches!(byte, b'A'..=b'Z' | b'0'..=b'9' | b'_' | b'$'))
            .collect()
    }

    /// A word: an address with its value, an assignment, or a name.
    fn word(&mut self, dwell: bool) -> Outcome<()> {
        let start = self.at;
        let name = self.name_ahead();
        let length = name.len();
        let letters = name
            .iter()
            .take_while(|byte| !byte.is_ascii_digit())
            .count();
        let mut behind = length;
        while matches!(self.peek(behind), Some(b' ' | b'\t')) {
            behind += 1;
        }
        let assigned = self.peek(behind) == Some(b'=') && self.peek(behind + 1) != Some(b'=');
        if NO_EFFECT.contains(&name.as_slice()) {
            self.at += length;
            return Ok(());
        }
        match (name.as_slice(), assigned) {
            (b"CYCLE832", _) => return self.tolerance_cycle(start, length),
            (b"MSG", _) => {
                self.at = self.text.len();
                return Ok(());
            }
            (b"RET", false) => self.replace(start, length, b"M2"),
            (b"ADIS", true) => return self.value_of(start, behind, b"P", b""),
            (b"CR", true) => return self.value_of(start, behind, b"R", b""),
            (b"TURN", true) => return self.value_of(start, behind, b"P", b"+1"),
            ([b'R', digits @ ..], true) if letters == 1 && !digits.is_empty() => {
                let parameter = r_parameter(digits, SourceSpan::new(start, start + length))?;
                return self.value_of(start, behind, format!("#{parameter}=").as_bytes(), b"");
            }
            ([letter], true) => return self.value_of(start, behind, &[*letter], b""),
            _ if letters == 1 && !assigned => self.address(start, length, &name, dwell)?,
            _ => {
                let span = SourceSpan::new(start, start + length);
                let shown = String::from_utf8_lossy(&name).into_owned();
                return Err(Fault::new(
                    DiagnosticCode::NotSupported,
                    span,
                    format!("{shown} is not supported"),
                )
                .because("of SINUMERIK's language the words of motion, R parameters and CYCLE832 are read")
                .help("let the CAM system write plain blocks"));
            }
        }
        Ok(())
    }

    fn replace(&mut self, start: usize, length: usize, with: &[u8]) {
        self.out.push(with, start);
        self.at = start + length;
    }

    /// A letter and its number, as in RS274/NGC, but for some codes.
    fn address(&mut self, start: usize, length: usize, name: &[u8], dwell: bool) -> Outcome<()> {
        let with: &[u8] = match name {
            b"G641" | b"G642" | b"G643" | b"G644" | b"G645" => b"G64",
            b"G60" => b"G61.1",
            b"G71" | b"G710" => b"G21",
            b"G700" => b"G20",
            b"M17" => b"M2",
            b"G70" | b"G9" | b"G500" => {
                let (what, help) = match name {
                    b"G70" => ("inches for lengths, millimetres for feeds", "write G700"),
                    b"G9" => ("exact stop in one block", "write G60, and G64 behind it"),
                    _ => ("no coordinate system", "write G54 to G57"),
                };
                let shown = String::from_utf8_lossy(name).into_owned();
                let span = SourceSpan::new(start, start + length);
                return Err(Fault::new(
                    DiagnosticCode::NotSupported,
                    span,
                    format!("{shown} ({what}) is not supported"),
                )
                .because("skipping it would make another motion than the program's")
                .help(help));
            }
            [b'F', ..] if dwell => {
                self.replace(start, 1, b"P");
                return Ok(());
            }
            _ => {
                // The number is copied as it is: it may go on with a point.
                self.copy();
                while matches!(self.peek(0), Some(b'0'..=b'9' | b'.' | b'-' | b'+')) {
                    self.copy();
                }
                return Ok(());
            }
        };
        self.replace(start, length, with);
        Ok(())
    }

    /// `NAME=expression` as `with[expression plus]`; `behind` is where the `=` is, from `start`.
    fn value_of(&mut self, start: usize, behind: usize, with: &[u8], plus: &[u8]) -> Outcome<()> {
        self.out.push(with, start);
        self.at = start + behind + 1;
        self.skip_blanks();
        self.out.push(b"[", start);
        self.expression(0)?;
        self.out.push(plus, start);
        self.out.push(b"]", self.at.saturating_sub(1));
        self.out.push(b" ", self.at.saturating_sub(1));
        Ok(())
    }

    /// Copies an expression up to the next word, or up to the `)` or `,` of the outer parenthesis.
    fn expression(&mut self, outer: u32) -> Outcome<()> {
        let mut depth = outer;
        let mut operand = false;
        while let Some(byte) = self.peek(0) {
            match byte {
                b';' => break,
                b' ' | b'\t' => self.at += 1,
                b'(' => {
                    depth += 1;
                    operand = false;
                    self.replace(self.at, 1, b"[");
                }
                b')' | b',' if depth == outer => break,
                b')' => {
                    depth -= 1;
                    operand = true;
                    self.replace(self.at, 1, b"]");
                }
                b'+' | b'-' | b'*' | b'/' => {
                    operand = false;
                    self.copy();
                }
                b'0'..=b'9' | b'.' => {
                    operand = true;
                    self.copy();
                }
                b'"' => {
                    let span = SourceSpan::new(self.at, self.text.len());
                    return Err(
                        Fault::new(DiagnosticCode::NotSupported, span, "a name in quotes")
                            .because("tools have numbers here, and there are no other names")
                            .help("write the number"),
                    );
                }
                _ if operand && depth == outer => break,
                b'A'..=b'Z' | b'_' | b'$' => operand = self.name_in_expression()?,
                _ => return Err(bad_byte(self.text, self.at)),
            }
        }
        Ok(())
    }

    /// A parameter or a function in an expression; true if it is a value.
    fn name_in_expression(&mut self) -> Outcome<bool> {
        let start = self.at;
        let name = self.name_ahead();
        let length = name.len();
        let span = SourceSpan::new(start, start + length);
        if let [b'R', digits @ ..] = name.as_slice()
            && !digits.is_empty()
            && digits.iter().all(u8::is_ascii_digit)
        {
            let parameter = r_parameter(digits, span)?;
            self.replace(start, length, format!("#{parameter}").as_bytes());
            return Ok(true);
        }
        if FUNCTIONS.contains(&name.as_slice()) {
            let with: &[u8] = if name == b"TRUNC" { b"FIX" } else { &name };
            self.replace(start, length, with);
            return Ok(false);
        }
        let shown = String::from_utf8_lossy(&name).into_owned();
        let message = format!("{shown} is not supported in an expression");
        Err(Fault::new(DiagnosticCode::NotSupported, span, message)
            .because("expressions have numbers, R parameters, operators and functions")
            .help("write the value; AC( ) and IC( ) are G90 and G91"))
    }

    /// `CYCLE832(tolerance, …)`.
    fn tolerance_cycle(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.at = start + length;
        self.skip_blanks();
        let span = SourceSpan::new(start, start + length);
        self.out.push(b"G64 ", start);
        if self.peek(0) != Some(b'(') {
            return Err(missing(span, "CYCLE832", "( )", "the tolerance"));
        }
        self.at += 1;
        self.skip_blanks();
        if !matches!(self.peek(0), Some(b')' | b',')) {
            self.out.push(b"P[", start);
            self.expression(0)?;
            self.out.push(b"]", self.at.saturating_sub(1));
        }
        // The other arguments choose between roughing and finishing: the tolerance decides here.
        while let Some(byte) = self.peek(0) {
            self.at += 1;
            if byte == b')' {
                return Ok(());
            }
        }
        Err(Fault::new(
            DiagnosticCode::Expression,
            span,
            "the parenthesis is not closed",
        )
        .help("add `)`"))
    }
}

/// Number of the parameter an R parameter is kept in.
fn r_parameter(digits: &[u8], span: SourceSpan) -> Outcome<u32> {
    let number = core::str::from_utf8(digits)
        .ok()
        .and_then(|d| d.parse::<u32>().ok());
    match number {
        Some(number) if number < R_COUNT => Ok(R_BASE + number),
        _ => Err(Fault::new(
            DiagnosticCode::Parameter,
            span,
            "there is no such R parameter",
        )
        .because(format!(
            "R parameters have the numbers from 0 to {}",
            R_COUNT - 1
        ))
        .help("use another one")),
    }
}
