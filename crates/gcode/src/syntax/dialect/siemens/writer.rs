//! Rewrites the words of a line into those of RS274/NGC.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::line_body::body;
use crate::syntax::dialect::siemens::expression::{Evaluator, Names};
use crate::syntax::dialect::siemens::refused_word::unknown;
use crate::syntax::dialect::siemens::rewritten::Rewritten;
use crate::syntax::dialect::siemens::variables::Kind;
use crate::syntax::expression::scope::Parameter;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::word_check::missing;

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

/// The parameter that shows the program coordinate of X; those of the other axes follow.
const COORDINATES: u32 = 5420;

/// Rewrites a line; the values of its expressions take their place.
pub(crate) fn rewrite(text: &[u8], names: Names<'_>) -> Outcome<Rewritten> {
    let mut writer = Writer {
        input: Evaluator::new(text, 0, names),
        names,
        out: Rewritten::default(),
    };
    if text.trim_ascii_start().starts_with(b"%_N_") {
        return Ok(writer.out);
    }
    writer.line()?;
    Ok(writer.out)
}

struct Writer<'a> {
    input: Evaluator<'a>,
    names: Names<'a>,
    out: Rewritten,
}

impl Writer<'_> {
    fn copy(&mut self) {
        if let Some(byte) = self.input.text.get(self.input.at) {
            self.out.push(&[*byte], self.input.at);
            self.input.at += 1;
        }
    }

    fn line(&mut self) -> Outcome<()> {
        let start = body(self.input.text);
        while self.input.at < start {
            self.copy();
        }
        // `G4 F` is a dwell, and `ADIS` belongs to G641.
        let dwell = self.has_code(4);
        while let Some(byte) = self.input.peek(0) {
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
        let upper = self.input.text.to_ascii_uppercase();
        let code = upper.split(|byte| *byte == b';').next().unwrap_or_default();
        (0..code.len()).any(|at| {
            let before = at.checked_sub(1).and_then(|at| code.get(at));
            let tail = code.get(at + 1..).unwrap_or_default();
            let digits = tail.iter().take_while(|byte| byte.is_ascii_digit()).count();
            let value = tail
                .get(..digits)
                .and_then(|d| core::str::from_utf8(d).ok());
            code[at] == b'G'
                && !before.is_some_and(u8::is_ascii_alphabetic)
                && value.and_then(|value| value.parse().ok()) == Some(number)
        })
    }

    /// A word: an address with its value, an assignment, or a name.
    fn word(&mut self, dwell: bool) -> Outcome<()> {
        let start = self.input.at;
        let name = self.input.name_ahead();
        let length = name.len();
        if NO_EFFECT.contains(&name.as_slice()) {
            self.input.at += length;
            return Ok(());
        }
        let is_assigned = self.is_assigned(length);
        if let Some((kind, parameter)) = self.input.assignable()? {
            if self.is_assigned(0) {
                return self.assignment(start, kind, parameter);
            }
            self.input.at = start;
        }
        let digits = name
            .iter()
            .skip(1)
            .take_while(|b| b.is_ascii_digit())
            .count();
        // `G0X=R1` has no blanks: the number of the address ends where the next letter is.
        let is_address = digits > 0 && (digits + 1 < length || !is_assigned);
        match (name.as_slice(), is_assigned) {
            _ if is_address => {
                let end = digits + 1;
                self.address(start, end, name.get(..end).unwrap_or_default(), dwell)
            }
            (b"CYCLE832", _) => self.tolerance_cycle(start, length),
            (b"MSG", _) => {
                self.input.at = self.input.text.len();
                Ok(())
            }
            (b"RET", false) => {
                self.replace(start, length, b"M2");
                Ok(())
            }
            (b"ADIS", true) => self.value_of(start, length, b"P", 0.0),
            (b"CR", true) => self.value_of(start, length, b"R", 0.0),
            (b"TURN", true) => self.value_of(start, length, b"P", 1.0),
            ([letter], true) => self.coordinate(start, *letter),
            ([_], false) => self.address(start, length, &name, dwell),
            _ => Err(unknown(&name, SourceSpan::new(start, start + length))),
        }
    }

    /// True if an equals sign stands behind the name of that length.
    fn is_assigned(&self, length: usize) -> bool {
        let mut behind = length;
        while matches!(self.input.peek(behind), Some(b' ' | b'\t')) {
            behind += 1;
        }
        self.input.peek(behind) == Some(b'=') && self.input.peek(behind + 1) != Some(b'=')
    }

    /// An assignment to a variable, whose `=` comes next.
    fn assignment(&mut self, start: usize, kind: Kind, parameter: Parameter) -> Outcome<()> {
        self.input.eat(b'=');
        let value = kind.of(self.input.value()?);
        let name = match &parameter {
            Parameter::Numbered(number) => format!("#{number}=["),
            Parameter::Named(name) => format!("#<{name}>=["),
        };
        self.input.assigned.push(parameter);
        self.put(start, name.as_bytes(), value);
        Ok(())
    }

    /// Writes what stands for a word that begins at `start` and ends here.
    fn put(&mut self, start: usize, head: &[u8], value: f64) {
        let last = self.input.at.saturating_sub(1).max(start);
        self.out.push(head, start);
        self.out.push(value.to_string().as_bytes(), start);
        self.out.push(b"] ", last);
    }

    fn replace(&mut self, start: usize, length: usize, with: &[u8]) {
        self.out.push(with, start);
        self.input.at = start + length;
    }

    /// A letter and its number, as in RS274/NGC, but for some codes.
    fn address(&mut self, start: usize, length: usize, name: &[u8], dwell: bool) -> Outcome<()> {
        let with: &[u8] = match name {
            b"G641" | b"G642" | b"G643" | b"G644" | b"G645" => b"G64",
            b"G60" => b"G61.1",
            b"G71" | b"G710" => b"G21",
            b"G700" => b"G20",
            b"M17" => b"M2",
            b"G70" | b"G9" | b"G500" | [b'L', _, ..] => {
                let (what, help) = match name {
                    [b'L', ..] => ("a subprogram", "copy its blocks to where it is called"),
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
                while matches!(self.input.peek(0), Some(b'0'..=b'9' | b'.' | b'-' | b'+')) {
                    self.copy();
                }
                return Ok(());
            }
        };
        self.replace(start, length, with);
        Ok(())
    }

    /// `NAME=expression` as `with[value]`, `plus` added to it; `length` is that of the name.
    fn value_of(&mut self, start: usize, length: usize, with: &[u8], plus: f64) -> Outcome<()> {
        self.input.at = start + length;
        self.input.eat(b'=');
        let value = self.input.value()? + plus;
        self.put(start, &[with, b"["].concat(), value);
        Ok(())
    }

    /// `X=expression`, `X=AC(expression)` or `X=IC(expression)`.
    ///
    /// What AC and IC say holds for that word alone, whatever G90 and G91 say for the others: the
    /// value is changed by where the axis stands, so that it means the same in the mode in force.
    fn coordinate(&mut self, start: usize, letter: u8) -> Outcome<()> {
        self.input.at = start + 1;
        self.input.eat(b'=');
        self.input.next_visible();
        let absolute = match self.input.name_ahead().as_slice() {
            b"AC" => true,
            b"IC" => false,
            _ => return self.value_of(start, 1, &[letter], 0.0),
        };
        let word = SourceSpan::new(self.input.at, self.input.at + 2);
        self.input.at += 2;
        let centre = matches!(letter, b'I' | b'J' | b'K');
        let of_axis = if centre {
            b'X' + (letter - b'I')
        } else {
            letter
        };
        let axis = AXIS_LETTERS.iter().position(|axis| *axis == of_axis);
        let Some(axis) = axis else {
            let message = "AC( ) or IC( ) of what is no coordinate";
            return Err(Fault::new(DiagnosticCode::NotSupported, word, message)
                .because("they say from where a coordinate counts")
                .help("write the value alone"));
        };
        let arguments = self.input.arguments()?;
        let [Some(value)] = arguments.as_slice() else {
            return Err(missing(word, "AC or IC", "( )", "one value in parentheses"));
        };
        let scope = self.names.scope;
        let here = u32::try_from(axis)
            .ok()
            .and_then(|axis| scope.numbered(COORDINATES + axis));
        let here = here.unwrap_or(0.0);
        let incremental = match (self.has_code(90), self.has_code(91)) {
            (true, _) => false,
            (_, true) => true,
            _ => scope.named("_incremental") == Some(1.0),
        };
        let value = match (absolute, centre || incremental) {
            (true, true) => value - here,
            (false, false) => value + here,
            _ => *value,
        };
        self.put(start, &[letter, b'['], value);
        Ok(())
    }

    /// `CYCLE832(tolerance, …)`.
    fn tolerance_cycle(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.input.at = start + length;
        let span = SourceSpan::new(start, start + length);
        self.out.push(b"G64 ", start);
        if !self.input.eat(b'(') {
            return Err(missing(span, "CYCLE832", "( )", "the tolerance"));
        }
        if !matches!(self.input.next_visible(), Some(b')' | b',')) {
            let value = self.input.value()?;
            self.put(start, b"P[", value);
        }
        // The other arguments choose between roughing and finishing: the tolerance decides here.
        while let Some(byte) = self.input.peek(0) {
            self.input.at += 1;
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
