//! The marks of FANUC programs: what only they have.

use crate::syntax::dialect::fanuc::digits;
use crate::syntax::dialect::line_body::body;

/// True if a line, without blanks and in upper case, is of a FANUC program.
pub(crate) fn marks(bare: &[u8]) -> bool {
    let at = body(bare);
    let text = bare.get(at..).unwrap_or_default();
    let starts = |word: &[u8]| text.starts_with(word);
    let number = |text: &[u8]| text.first().is_some_and(u8::is_ascii_digit);
    let target = |text: &[u8]| number(text) || matches!(text.first(), Some(b'#' | b'['));
    let jump = text.strip_prefix(b"GOTO").is_some_and(target);
    let statement = starts(b"IF[") || starts(b"WHILE[") || jump;
    let program = bare.first() == Some(&b':') && number(bare.get(1..).unwrap_or_default());
    let call = [&b"G65P"[..], b"M98P", b"G05.1Q", b"G5.1Q", b"G05P10000"];
    // Lathes: the highest speed, roughing along a profile, a tool with its offset.
    let lathe = [&b"G50S"[..], b"G71U", b"G71P", b"G72W", b"G72P"];
    let turret = text.strip_prefix(b"T").and_then(digits);
    let is_turret = turret.is_some_and(|(_, length)| length == 4 && text.len() == 5);
    let words = call.iter().chain(&lathe).any(|word| starts(word));
    statement || program || is_turret || words
}

/// True if a line is of a FANUC program, when a program number stands in front of it: P of a drilling
/// cycle, or of a dwell that would be minutes, offsets of G54.1, and tools set by G10.
pub(crate) fn marks_behind_number(bare: &[u8]) -> bool {
    let text = bare.get(body(bare)..).unwrap_or_default();
    let has = |word: &[u8]| text.windows(word.len()).any(|part| part == word);
    let number_behind = |letter: u8| {
        let at = text.iter().position(|byte| *byte == letter)?;
        let (number, length) = digits(text.get(at + 1..)?)?;
        let has_point = text.get(at + 1 + length) == Some(&b'.');
        (!has_point).then_some(number)
    };
    let drills = [&b"G73"[..], b"G81", b"G83", b"G85"]
        .iter()
        .any(|word| has(word));
    let dwells = has(b"G4P") || has(b"G04P") || has(b"G82") || has(b"G89");
    drills && number_behind(b'P').is_some()
        || dwells && number_behind(b'P').is_some_and(|number| number > 99)
        || [
            &b"G54.1P"[..],
            b"G154P",
            b"G10L10",
            b"G10L11",
            b"G10L12",
            b"G10L13",
        ]
        .iter()
        .any(|word| has(word))
}

/// True for a line with a program number: `O1234`.
pub(super) fn is_program_number(bare: &[u8]) -> bool {
    bare.first() == Some(&b'O')
        && bare
            .get(1..)
            .and_then(digits)
            .is_some_and(|(_, length)| matches!(bare.get(1 + length), None | Some(b'(' | b';')))
}
