//! The marks of programs for lathes: what tells FANUC's from LinuxCNC's, and what both have, with
//! other moves.

use crate::setup::machine::Machine;
use crate::syntax::dialect::bare_words::{bare_words, has_code, has_letter, without_comments};
use crate::syntax::dialect::fanuc::digits;
use crate::syntax::dialect::question::Doubt;
use glidepath_geometry::Axis;

/// What a line says of the dialect of a lathe's program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LatheMark {
    /// It is LinuxCNC's.
    LinuxCnc,
    /// It is FANUC's.
    Fanuc,
    /// It is of either, and means something else to each.
    Doubt(Doubt),
}

/// What a line, without blanks and in upper case, tells.
pub(super) fn lathe_mark(bare: &[u8], machine: &Machine) -> Option<LatheMark> {
    let text = without_comments(bare);
    let words = bare_words(&text);
    let code = |number: f64| has_code(&words, b'G', number);
    let letter = |letter: u8| has_letter(&words, letter);
    // G8 P is FANUC's look-ahead.
    let is_diameter = (code(7.0) || code(8.0)) && !letter(b'P');
    let is_linuxcnc = is_diameter
        || text.windows(2).any(|pair| pair == b"#<")
        || is_o_word(&text)
        || code(64.0) && letter(b'P')
        || code(96.0) && letter(b'D')
        || code(76.0) && letter(b'J')
        || [43.0, 43.1, 49.0, 61.1, 90.1, 91.1, 18.1]
            .into_iter()
            .any(code);
    if is_linuxcnc {
        return Some(LatheMark::LinuxCnc);
    }
    // Where there is no such axis, U and W are increments of X and Z.
    let has_increments = [(Axis::U, b'U'), (Axis::W, b'W')]
        .into_iter()
        .any(|(axis, of)| !machine.has(axis) && letter(of));
    let has_turret = words.iter().any(|(of, number)| {
        *of == b'T' && number.len() == 4 && number.iter().all(u8::is_ascii_digit)
    });
    if !is_text(&text) && (has_increments || has_turret && !has_code(&words, b'M', 6.0)) {
        return Some(LatheMark::Fanuc);
    }
    let moves = [0.0, 1.0, 2.0, 3.0, 28.0, 30.0, 33.0, 53.0, 10.0, 76.0]
        .into_iter()
        .any(code);
    let has_place = letter(b'X') || letter(b'Z');
    let cycle = code(90.0) || code(92.0) || code(94.0);
    if cycle && has_place && letter(b'F') && !moves {
        return Some(LatheMark::Doubt(Doubt::Cycle));
    }
    let is_drilling = [73.0, 74.0, 81.0, 82.0, 83.0, 84.0, 85.0, 86.0, 89.0]
        .into_iter()
        .any(code);
    ((code(98.0) || code(99.0)) && !is_drilling).then_some(LatheMark::Doubt(Doubt::FeedMode))
}

/// `O100 SUB`, `O<NAME> CALL`.
pub(super) fn is_o_word(text: &[u8]) -> bool {
    let Some(tail) = text.strip_prefix(b"O") else {
        return false;
    };
    let length = match tail.first() {
        Some(b'<') => tail.iter().position(|byte| *byte == b'>').map(|at| at + 1),
        _ => digits(tail).map(|(_, length)| length),
    };
    let behind = length.and_then(|length| tail.get(length..));
    length != Some(0)
        && behind
            .and_then(<[u8]>::first)
            .is_some_and(u8::is_ascii_alphabetic)
}

/// True for a line of other words than letters and numbers: text in front of a program.
fn is_text(text: &[u8]) -> bool {
    text.windows(2)
        .any(|pair| pair.iter().all(u8::is_ascii_alphabetic))
}
