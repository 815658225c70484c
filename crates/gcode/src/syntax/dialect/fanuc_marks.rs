//! The marks of FANUC programs: what only they have.

use crate::syntax::dialect::bare_words::{bare_words, has_code, has_letter, without_comments};
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
    statement || program || is_turret || words || has_own_word(text)
}

/// True if a word stands somewhere in the line that no other language has: coordinates that are polar,
/// mirrored or turned, offsets of G54.1, Haas' codes (with patterns of holes), chamfers and roundings behind a
/// comma, measuring moves, macros behind every move, holes that are repeated by K or that L0 leaves out.
fn has_own_word(text: &[u8]) -> bool {
    // What FANUC prints, and names its variables.
    if [&b"DPRNT["[..], b"BPRNT[", b"SETVN"]
        .iter()
        .any(|word| text.starts_with(word))
        || [&b"POPEN"[..], b"PCLOS"].contains(&text)
    {
        return true;
    }
    // Messages of printers.
    if [&b"M117"[..], b"M118"]
        .iter()
        .any(|word| text.starts_with(word))
    {
        return false;
    }
    let code = without_comments(text);
    let words = bare_words(&code);
    let has = |number: f64| has_code(&words, b'G', number);
    let letter = |letter: u8| has_letter(&words, letter);
    let alone = [
        15.0, 16.0, 31.0, 44.0, 66.0, 67.0, 43.4, 43.5, 50.1, 51.1, 53.1, 68.0, 68.2, 69.0, 154.0,
        150.0, 187.0, 234.0, 254.0, 255.0,
    ];
    let behind_comma = code.windows(3).any(|part| {
        let [b',', b'C' | b'R' | b'A', next] = part else {
            return false;
        };
        next.is_ascii_digit() || b".+-#[".contains(next)
    });
    let drills = [73.0, 81.0, 82.0, 83.0, 84.0, 85.0].into_iter().any(has);
    let pattern = [70.0, 71.0, 72.0].into_iter().any(has);
    alone.into_iter().any(has)
        || pattern && letter(b'I') && letter(b'J') && letter(b'L')
        || drills && has_code(&words, b'L', 0.0)
        || has(30.0) && letter(b'P')
        || has(4.0) && letter(b'X')
        || drills && letter(b'K') && !letter(b'Q')
        || (has(12.0) || has(13.0)) && letter(b'I')
        || (has(54.1) || has(103.0)) && letter(b'P')
        || has_code(&words, b'M', 97.0) && letter(b'P')
        || behind_comma
}

/// True if a line is of a FANUC program, when a program number stands in front of it: P of a drilling
/// cycle, or of a dwell that would be minutes, and tools set by G10.
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
        || [&b"G10L10"[..], b"G10L11", b"G10L12", b"G10L13"]
            .iter()
            .any(|word| has(word))
}

/// True if a line is of a FANUC mill's program, when a program number stands in front of it: the length of the
/// tool beside the place that it is for, which needs no G0, and G41 or G42 with D, which begin and go round
/// corners in another way than LinuxCNC's.
pub(crate) fn marks_of_mill_behind_number(bare: &[u8]) -> bool {
    let code = without_comments(bare.get(body(bare)..).unwrap_or_default());
    let words = bare_words(&code);
    let has = |number: f64| has_code(&words, b'G', number);
    let letter = |letter: u8| has_letter(&words, letter);
    has(43.0) && letter(b'H') && letter(b'Z') || (has(41.0) || has(42.0)) && letter(b'D')
}

/// True for a line with a program number: `O1234`.
pub(super) fn is_program_number(bare: &[u8]) -> bool {
    bare.first() == Some(&b'O')
        && bare
            .get(1..)
            .and_then(digits)
            .is_some_and(|(_, length)| matches!(bare.get(1 + length), None | Some(b'(' | b';')))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_fanuc_and_haas_are_known_anywhere_in_a_line() {
        for line in [
            "N5G0G54.1P3X0",
            "G90G16",
            "G51.1X0",
            "G69",
            "G68X0Y0R90.",
            "G187P1E.01",
            "G90G154P2",
            "M97P100",
            "G12I5.F500",
            "G1X10.,C1.",
            "G1X10.,R#1(ROUND)",
            "G103P1",
            "G43.4H1",
            "G91G31Z-5.F100",
            "G66P9100Z-3.",
            "G44H1",
            "G30P2Z0",
            "G4X1.5",
            "G91G81X5.K3",
            "DPRNT[X#100[53]]",
            "POPEN",
            "G150X5.Y5.Z-4.P21D1",
            "N20G71I25.J0.K30.L4",
            "G81G99Z-10.R2.F100.L0",
        ] {
            assert!(marks(line.as_bytes()), "{line}");
        }
        for line in [
            "G12",
            "G12P1S1T3",
            "G1X10(,C1.)",
            "G1X10;G68",
            "M117A,C5",
            "G10L20P1X0",
            "G54P1",
            "#1=ATAN[1,-1]",
            "G61.1",
            "EXCLUDE_OBJECT_DEFINENAME=LEG15_STL",
            "#<SEG15>=2",
            "M97",
            "G17.1",
            "G30Z0",
            "G4P1",
            "G87X1I2J3K4",
            "M117G31",
            "G71Q100X5Z-20D1I1R0.5",
            "G81Z-5R2L3",
        ] {
            assert!(!marks(line.as_bytes()), "{line}");
        }
    }
}
