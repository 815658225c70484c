//! What a line of a FANUC program is to the flow of the program.

use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::line_body::{body, starts_with_word};

/// What a line is to the flow of the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Statement {
    Block,
    /// A program number, with the number.
    Label(u32),
    If,
    Goto,
    While,
    End,
    /// G65.
    Macro,
    /// M98.
    Subprogram,
    /// M99.
    Return,
    /// Look-ahead: always on.
    LookAhead,
}

/// True if a line, without blanks and in upper case, is of a FANUC program.
pub(super) fn marks(bare: &[u8]) -> bool {
    let at = body(bare);
    let text = bare.get(at..).unwrap_or_default();
    let starts = |word: &[u8]| text.starts_with(word);
    let number = |text: &[u8]| text.first().is_some_and(u8::is_ascii_digit);
    let target = |text: &[u8]| number(text) || matches!(text.first(), Some(b'#' | b'['));
    let jump = text.strip_prefix(b"GOTO").is_some_and(target);
    let statement = starts(b"IF[") || starts(b"WHILE[") || jump;
    let program = bare.first() == Some(&b':') && number(bare.get(1..).unwrap_or_default());
    let call = [&b"G65P"[..], b"M98P", b"G05.1Q", b"G5.1Q", b"G05P10000"];
    statement || program || call.iter().any(|word| starts(word))
}

/// The whole number at the start of a text, and how long it is.
fn digits(text: &[u8]) -> Option<(u32, usize)> {
    let length = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let number = core::str::from_utf8(text.get(..length)?).ok()?;
    Some((number.parse().ok()?, length))
}

/// What a line is, and where what follows its keyword starts.
pub(crate) fn statement(text: &[u8]) -> (Statement, usize) {
    let at = body(text);
    let rest = text.get(at..).unwrap_or_default();
    if let [b'O' | b'o' | b':', tail @ ..] = rest
        && let Some((number, length)) = digits(tail)
    {
        return (Statement::Label(number), at + 1 + length);
    }
    for (word, statement) in [
        (&b"IF"[..], Statement::If),
        (b"GOTO", Statement::Goto),
        (b"WHILE", Statement::While),
        (b"END", Statement::End),
        (b"DO", Statement::While),
    ] {
        if starts_with_word(rest, word) {
            return (statement, at + word.len());
        }
    }
    let mut cursor = Cursor::new(text);
    cursor.seek(at);
    // The code may stand behind others, as in `G0 G90 G65 P1`: only at the start it is looked for.
    let letter = cursor.next_visible().map(|byte| byte.to_ascii_uppercase());
    cursor.advance();
    let word = matches!(letter, Some(b'G' | b'M'));
    let number = word.then(|| cursor.literal(at).ok()).flatten();
    let is = |value: f64| number.is_some_and(|number| (number - value).abs() < 1e-6);
    let followed_by = |letters: &[u8]| {
        let mut ahead = cursor;
        let next = ahead.next_visible().map(|byte| byte.to_ascii_uppercase());
        next.is_some_and(|next| letters.contains(&next))
    };
    let end = cursor.at();
    match letter {
        Some(b'G') if is(65.0) => (Statement::Macro, end),
        Some(b'G') if is(5.1) && followed_by(b"QR") => (Statement::LookAhead, end),
        Some(b'G') if (is(5.0) || is(8.0)) && followed_by(b"P") => (Statement::LookAhead, end),
        Some(b'M') if is(98.0) => (Statement::Subprogram, end),
        Some(b'M') if is(99.0) => (Statement::Return, end),
        _ => (Statement::Block, at),
    }
}

/// True if the line has that block number.
pub(crate) fn is_numbered(text: &[u8], wanted: u32) -> bool {
    let start = text
        .iter()
        .position(|byte| !matches!(byte, b' ' | b'\t' | b'/'));
    let text = text.get(start.unwrap_or(0)..).unwrap_or_default();
    match text {
        [b'N' | b'n', tail @ ..] => {
            digits(tail.trim_ascii_start()).is_some_and(|(number, _)| number == wanted)
        }
        _ => false,
    }
}

pub(crate) fn is_label(text: &[u8]) -> bool {
    matches!(statement(text).0, Statement::Label(_))
}

/// True for `DO m` or `END m` of that number; `DO` may stand behind a condition.
pub(crate) fn is_loop(text: &[u8], word: &[u8], wanted: u32) -> bool {
    let wanted_kind = if word == b"DO" {
        Statement::While
    } else {
        Statement::End
    };
    let (kind, _) = statement(text);
    if kind != wanted_kind {
        return false;
    }
    let upper = text.to_ascii_uppercase();
    let found = upper.windows(word.len()).rposition(|window| window == word);
    let tail = found.and_then(|at| upper.get(at + word.len()..));
    tail.and_then(|tail| digits(tail.trim_ascii_start()))
        .is_some_and(|(number, _)| number == wanted)
}
