//! Rewrites the words of a line into those of RS274/NGC.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::line_body::body;
use crate::syntax::dialect::siemens::expression::{Evaluator, Names};
use crate::syntax::dialect::siemens::refused_word::unknown;
use crate::syntax::dialect::siemens::rewritten::Rewritten;
use crate::syntax::dialect::siemens::variables::Kind;
use crate::syntax::dialect::words::siemens::{self as words, ADDRESSES};
use crate::syntax::dialect::words::{Meaning, no_g, no_m, refused};
use crate::syntax::expression::scope::Parameter;
use crate::syntax::letters::AXIS_LETTERS;
use crate::syntax::word_check::missing;

/// Words without effect on where and how fast the tool goes here: look-ahead and feed forward are
/// always on, every acceleration is limited in jerk, and dense chords are merged within the
/// tolerance.
const NO_EFFECT: [&[u8]; 28] = [
    b"BRISK",
    b"FNORM",
    b"CFC",
    b"CFIN",
    b"CFTCP",
    b"CPRECON",
    b"CPRECOF",
    b"NORM",
    b"DYNNORM",
    b"DYNPOS",
    b"DYNROUGH",
    b"DYNSEMIFIN",
    b"DYNFINISH",
    b"WALIMON",
    b"STARTFIFO",
    b"STOPFIFO",
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

/// The number that digits write.
fn number_of(digits: &[u8]) -> Option<u32> {
    core::str::from_utf8(digits).ok()?.parse().ok()
}

#[cold]
fn foreign(byte: u8, at: usize) -> Box<Fault> {
    let (span, shown) = (SourceSpan::new(at, at + 1), char::from(byte));
    let message = format!("`{shown}` has no meaning here");
    let (why, help) = match byte {
        b'(' => (
            "a comment begins with `;` in SINUMERIK's language",
            "write the comment behind `;`",
        ),
        _ => (
            "variables are R parameters, and those that DEF declares",
            "read the program in the language it is from: --dialect",
        ),
    };
    Fault::new(DiagnosticCode::BadCharacter, span, message)
        .because(why)
        .help(help)
}

#[cold]
fn no_address(letter: char, span: SourceSpan) -> Box<Fault> {
    let message = format!("{letter} is no address of SINUMERIK's language");
    Fault::new(DiagnosticCode::UnknownWord, span, message)
        .because("on other controls it has several meanings, and here none")
        .help("remove it; a radius is CR=, a dwell G4 F")
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
                b'#' | b'@' | b'^' | b'(' | b'<' | b'[' => {
                    return Err(foreign(byte, self.input.at));
                }
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
            (b"TRAORI", false) => self.orientation(start, length),
            (b"TRAFOOF", false) => {
                self.replace(start, length, b"G43.5");
                Ok(())
            }
            (b"RET", false) => {
                self.replace(start, length, b"M2");
                Ok(())
            }
            (b"WORKPIECE" | b"GROUP_BEGIN" | b"GROUP_END" | b"GROUP_ADDEND", false) => {
                self.input.at = self.input.text.len();
                Ok(())
            }
            (b"CYCLE800", false) => self.swivel(start, length),
            (b"DIAMON", false) => {
                self.replace(start, length, b"G7");
                Ok(())
            }
            (b"DIAMOF", false) => {
                self.replace(start, length, b"G8");
                Ok(())
            }
            (b"SUPA", false) => {
                self.replace(start, length, b"G53");
                Ok(())
            }
            (b"LIMS", true) => self.value_of(start, length, b",S", 0.0),
            (b"RND", true) => self.value_of(start, length, b",R", 0.0),
            (b"RNDM", true) => self.value_of(start, length, b",M", 0.0),
            (b"CHR", true) => self.value_of(start, length, b",C", 0.0),
            (b"CHF", true) => self.value_of(start, length, b",L", 0.0),
            (b"ADIS", true) => self.value_of(start, length, b"P", 0.0),
            (b"CR", true) => self.value_of(start, length, b"R", 0.0),
            (b"TURN", true) => self.value_of(start, length, b"P", 1.0),
            ([letter], true) => self.coordinate(start, *letter),
            ([_], false) => self.address(start, length, &name, dwell),
            _ => Err(unknown(&name, SourceSpan::new(start, start + length))),
        }
    }

    /// `CYCLE800()`, which ends a swivelled plane: there was none.
    fn swivel(&mut self, start: usize, length: usize) -> Outcome<()> {
        let rest = self.input.text.get(start + length..).unwrap_or_default();
        let end = rest.iter().position(|byte| *byte == b')');
        let inside = rest.get(..end.unwrap_or(rest.len())).unwrap_or_default();
        self.input.at = start + length + end.map_or(rest.len(), |end| end + 1);
        if inside.iter().all(|byte| b"( ,\t".contains(byte)) {
            return Ok(());
        }
        let span = SourceSpan::new(start, self.input.at);
        let help = "let the CAM system write the positions of the axes";
        Err(refused("CYCLE800", "a swivelled plane", help, span))
    }

    /// `TRAORI`, `TRAORI(1)`.
    fn orientation(&mut self, start: usize, length: usize) -> Outcome<()> {
        self.replace(start, length, b"G43.4");
        if self.input.peek(0) == Some(b'(') {
            let arguments = self.input.arguments()?;
            let is_first = arguments
                .iter()
                .flatten()
                .all(|number| (number - 1.0).abs() < 1e-9);
            if !is_first {
                let span = SourceSpan::new(start, self.input.at);
                return Err(refused(
                    "TRAORI",
                    "another transformation than the first",
                    "write TRAORI(1)",
                    span,
                ));
            }
        }
        Ok(())
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

    /// A letter and its number: a code of the tables, or an address that this language has.
    fn address(&mut self, start: usize, length: usize, name: &[u8], dwell: bool) -> Outcome<()> {
        let span = SourceSpan::new(start, start + length);
        let number = name.get(1..).and_then(number_of);
        match (name, number) {
            ([b'G', ..], Some(number)) => return self.g_code(span, number),
            ([b'M', ..], Some(number)) => return self.m_code(span, number),
            ([b'F', ..], _) if dwell => self.replace(start, 1, b"P"),
            ([b'L', _, ..], _) => {
                return Err(refused(
                    &String::from_utf8_lossy(name),
                    "a subprogram",
                    "copy its blocks to where it is called",
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

    fn g_code(&mut self, span: SourceSpan, number: u32) -> Outcome<()> {
        let length = span.length;
        let has_point = self.input.peek(length) == Some(b'.');
        let meaning = words::g(number).filter(|_| !has_point);
        let with: &[u8] = match (meaning, number) {
            (Some(Meaning::Own), 641..=645) => b"G64",
            (Some(Meaning::Own), 9) => b"G9",
            (Some(Meaning::Own), 60) => b"G61.1",
            (Some(Meaning::Own), 153) => b"G53",
            (Some(Meaning::Own), 500) => b"G500",
            (Some(Meaning::Own), 71 | 710) => b"G21",
            (Some(Meaning::Own), 700) => b"G20",
            (Some(Meaning::Own), _) => {
                let what = "inches for lengths, millimetres for feeds";
                return Err(refused(&format!("G{number}"), what, "write G700", span));
            }
            (Some(Meaning::ReadOver), _) => b"",
            (Some(Meaning::Shared), _) => {
                self.replace(span.start, 0, format!("G{number}").as_bytes());
                self.input.at = span.start + length;
                return Ok(());
            }
            (Some(Meaning::Refused(what, help)), _) => {
                return Err(refused(&format!("G{number}"), what, help, span));
            }
            (None, _) => return Err(no_g(Dialect::Siemens, f64::from(number), span)),
        };
        self.replace(span.start, length, with);
        Ok(())
    }

    fn m_code(&mut self, span: SourceSpan, number: u32) -> Outcome<()> {
        let meaning = words::m(number);
        let is_declared = self.names.scope.declares_m(number);
        match meaning {
            Some(Meaning::Own) => self.replace(span.start, span.length, b"M2"),
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
