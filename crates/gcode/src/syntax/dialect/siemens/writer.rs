//! The writer, which rewrites the words of a line into those of RS274/NGC.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::line_body::body;
use crate::syntax::dialect::siemens::computed_words::check_computed;
use crate::syntax::dialect::siemens::expression::{Evaluator, Names};
use crate::syntax::dialect::siemens::refused_word::unknown;
use crate::syntax::dialect::siemens::rewritten::Rewritten;
use crate::syntax::dialect::words::{Meaning, refused, siemens_names};
use crate::syntax::named_word::Named;

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
    writer.out.texts = writer.input.assigned_texts;
    Ok(writer.out)
}

#[cold]
fn foreign(byte: u8, at: usize) -> Box<BlockDiagnostic> {
    let (span, shown) = (SourceSpan::new(at, at + 1), char::from(byte));
    let message = format!("`{shown}` has no meaning here");
    let (why, help) = match byte {
        b'(' => (
            "a comment begins with `;` in SINUMERIK's language",
            "write the comment behind `;`",
        ),
        b',' => (
            "a comma stands between the arguments of a call",
            "write a blank between words, and a point in numbers",
        ),
        _ => (
            "variables are R parameters, and those that DEF declares",
            "read the program in the language it is from: --dialect",
        ),
    };
    BlockDiagnostic::new(DiagnosticCode::BadCharacter, span, message)
        .because(why)
        .help(help)
}

/// The code that stands for a name.
const fn code_named(name: &[u8]) -> Option<&'static [u8]> {
    Some(match name {
        b"TRAFOOF" => b"G43.5",
        b"CIP" => b"G2.5",
        b"CT" => b"G2.6",
        b"DIAMON" => b"G7",
        b"DIAMOF" => b"G8",
        b"DIAM90" => b"G7.2",
        b"CFC" => b"G16.1",
        b"CFTCP" => b"G16.2",
        b"CFIN" => b"G16.3",
        b"ORIVECT" | b"ORIPLANE" => b"G16.4",
        b"ORIAXES" => b"G16.5",
        b"SUPA" => b"G53",
        _ => return None,
    })
}

/// The letters that stand for the name of a value, and what is added to it.
const fn letters_for(name: &[u8]) -> Option<(&'static [u8], f64)> {
    Some(match name {
        b"RND" => (b",R", 0.0),
        b"RNDM" => (b",M", 0.0),
        b"CHR" => (b",C", 0.0),
        b"CHF" => (b",L", 0.0),
        b"ADIS" => (b"P", 0.0),
        b"CR" => (b"R", 0.0),
        b"SF" => (b"Q", 0.0),
        b"TURN" => (b"P", 1.0),
        // The first spindle, which is the only one.
        b"S1" => (b"S", 0.0),
        _ => return None,
    })
}

/// A line being rewritten.
pub(super) struct Writer<'a> {
    pub(super) input: Evaluator<'a>,
    pub(super) names: Names<'a>,
    pub(super) out: Rewritten,
}

impl Writer<'_> {
    pub(super) fn copy(&mut self) {
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
                // Words behind a comma are what names become here, and none of the language.
                b',' if self.is_letter_behind() => return Err(foreign(byte, self.input.at)),
                _ => self.copy(),
            }
        }
        Ok(())
    }

    /// True if a letter is next behind the byte that comes next.
    fn is_letter_behind(&self) -> bool {
        let rest = self.input.text.get(self.input.at + 1..).unwrap_or_default();
        let behind = rest.trim_ascii_start().first();
        behind.is_some_and(u8::is_ascii_alphabetic)
    }

    /// True if the line has that G code.
    pub(super) fn has_code(&self, number: u32) -> bool {
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

    /// True if the line has that name.
    pub(super) fn has_name(&self, name: &[u8]) -> bool {
        let upper = self.input.text.to_ascii_uppercase();
        let code = upper.split(|byte| *byte == b';').next().unwrap_or_default();
        let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
        code.split(|byte| !is_part(byte)).any(|word| word == name)
    }

    /// A word: an address with its value, an assignment, or a name.
    fn word(&mut self, dwell: bool) -> Outcome<()> {
        let start = self.input.at;
        let name = self.input.name_ahead();
        let length = name.len();
        let is_assigned = self.is_assigned(length);
        let second = name.get(1);
        let is_name = second.is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_');
        match is_name.then(|| siemens_names::meaning(&name)).flatten() {
            Some(Meaning::ReadOver) => return self.read_over(length, is_assigned),
            Some(Meaning::Refused(what, help)) => {
                let shown = String::from_utf8_lossy(&name).into_owned();
                return Err(refused(
                    &shown,
                    what,
                    help,
                    SourceSpan::new(start, start + length),
                ));
            }
            _ => {}
        }
        if matches!(name.as_slice(), b"AP" | b"RP") && is_assigned {
            return self.polar_value(start, &name);
        }
        if let Some(Named::Via(axis)) = Named::of_name(&name).filter(|_| is_assigned) {
            return self.via(start, length, axis);
        }
        if let Some(word) = Named::of_name(&name).filter(|_| is_assigned) {
            return self.value_of(start, length, &[b',', word.letter()], 0.0);
        }
        if self.names.variables.text(&name).is_some() {
            return self.text_assignment(start);
        }
        if let Some((array, first)) = self.input.array_to_fill()? {
            return self.fill(start, array, first);
        }
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
        if let Some(code) = code_named(&name).filter(|_| !is_assigned) {
            self.replace(start, length, code);
            self.skip_no_arguments();
            return Ok(());
        }
        match (name.as_slice(), is_assigned) {
            _ if is_address => {
                let end = digits + 1;
                self.address(start, end, name.get(..end).unwrap_or_default(), dwell)
            }
            (b"CYCLE832", _) => self.tolerance_cycle(start, length),
            (b"TRAORI", false) => self.orientation(start, length),
            (b"FGROUP", false) => self.feed_group(start, length),
            (b"RET" | b"ENDPROC", false) => self.return_to_caller(start, length),
            (b"CTOL", true) => self.contour_tolerance(start, length),
            // The first spindle, which is the only one.
            (b"S" | b"S1", true) if self.speed_range().is_some() => {
                let limit = self.speed_range().unwrap_or_default();
                self.value_of(start, length, limit, 0.0)
            }
            ([b'H', number @ ..], true) if number.iter().all(u8::is_ascii_digit) => {
                self.computed_plc_function(start, &name)
            }
            (b"M" | b"M1", true) => self.computed_m_code(start, length),
            (b"SPOS", false) if self.input.peek(length) == Some(b'[') => self.spindle_angle(start),
            (b"SETMS", false) => self.master_spindle(start, length),
            (b"T", true) if self.is_text_assigned() => self.tool_by_name(start),
            (name, true) if letters_for(name).is_some() => self.lettered(start, name),
            ([letter], true) => {
                check_computed(*letter, SourceSpan::new(start, start + length))?;
                self.coordinate(start, *letter)
            }
            ([_], false) => self.address(start, length, &name, dwell),
            _ => Err(unknown(&name, SourceSpan::new(start, start + length))),
        }
    }

    /// `TRAFOOF()` is `TRAFOOF`.
    fn skip_no_arguments(&mut self) {
        let rest = self.input.text.get(self.input.at..).unwrap_or_default();
        if rest.starts_with(b"()") {
            self.input.at += 2;
        }
    }

    /// A value that gets a letter; ADIS beside its code alone, as its letter is that of other words, too.
    fn lettered(&mut self, start: usize, name: &[u8]) -> Outcome<()> {
        if name == b"ADIS" && !(641..=645).any(|code| self.has_code(code)) {
            let span = SourceSpan::new(start, start + name.len());
            return Err(BlockDiagnostic::new(
                DiagnosticCode::UnusedWord,
                span,
                "ADIS without G641",
            )
            .because("it is the distance from the corner of G641 to G645")
            .help("write G641 into the same block"));
        }
        let (letters, plus) = letters_for(name).unwrap_or_default();
        self.value_of(start, name.len(), letters, plus)
    }

    /// `RET`, `ENDPROC`.
    fn return_to_caller(&mut self, start: usize, length: usize) -> Outcome<()> {
        let span = SourceSpan::new(start, start + length);
        let rest = self.input.text.get(start + length..).unwrap_or_default();
        if rest.trim_ascii_start().starts_with(b"(") {
            let help = "write RET alone";
            return Err(refused("RET( )", "a return to another place", help, span));
        }
        self.end_program(span, b"M2");
        Ok(())
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

    /// Writes what stands for a word that begins at `start` and ends here.
    pub(super) fn put(&mut self, start: usize, head: &[u8], value: f64) {
        let last = self.input.at.saturating_sub(1).max(start);
        self.out.push(head, start);
        self.out.push(value.to_string().as_bytes(), start);
        self.out.push(b"] ", last);
    }

    pub(super) fn replace(&mut self, start: usize, length: usize, with: &[u8]) {
        self.out.push(with, start);
        self.input.at = start + length;
    }

    /// Skips a word that is read over, with what belongs to it.
    fn read_over(&mut self, length: usize, is_assigned: bool) -> Outcome<()> {
        self.input.at += length;
        // `FGREF[A]=10`
        let has_index = self.input.next_visible() == Some(b'[');
        if has_index {
            let rest = self.input.text.get(self.input.at..).unwrap_or_default();
            let end = rest.iter().position(|byte| *byte == b']');
            self.input.at += end.map_or(rest.len(), |end| end + 1);
        }
        if is_assigned || has_index && self.is_assigned(0) {
            self.input.eat(b'=');
            self.input.value()?;
        } else if self.input.next_visible() == Some(b'(') {
            self.skip_parentheses();
        }
        Ok(())
    }

    /// Skips what is in the parentheses that come next: texts in quotes may have anything in them.
    fn skip_parentheses(&mut self) {
        let (mut depth, mut is_text) = (0_u32, false);
        while let Some(byte) = self.input.peek(0) {
            self.input.at += 1;
            match byte {
                b'"' => is_text = !is_text,
                b'(' if !is_text => depth += 1,
                b')' if !is_text => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return;
            }
        }
    }

    /// The end of a program, or of a subprogram, whose caller goes on.
    pub(super) fn end_program(&mut self, span: SourceSpan, code: &[u8]) {
        self.out.ends_subprogram = self.names.in_subprogram;
        let code = if self.names.in_subprogram { b"" } else { code };
        self.replace(span.start, span.length, code);
    }

    /// `NAME=expression` as `with[value]`, `plus` added to it; `length` is that of the name.
    pub(super) fn value_of(
        &mut self,
        start: usize,
        length: usize,
        with: &[u8],
        plus: f64,
    ) -> Outcome<()> {
        self.input.at = start + length;
        self.input.eat(b'=');
        let value = self.input.value()? + plus;
        self.put(start, &[with, b"["].concat(), value);
        Ok(())
    }
}
