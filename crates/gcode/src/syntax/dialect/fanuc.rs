//! The statements of a FANUC program: what a line is to the flow of the program.

use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::line_body::{body, starts_with_word};

/// The kinds of statements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Statement {
    Block,
    /// A program number, with the number.
    Label(u32),
    /// A program with a name: `O<PART>`, `<PART>`.
    Name,
    If,
    Goto,
    While,
    End,
    /// A block with a code that calls, or returns.
    Call(Call),
    /// DPRNT: what is printed.
    Print,
    /// BPRNT, POPEN, PCLOS: what goes to another device.
    Device,
    /// SETVN: names of variables.
    Names,
}

/// Codes that call, or return.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CallCode {
    /// G65.
    Macro,
    /// G66: a macro behind every move.
    ModalMacro,
    /// G66.1: a macro behind every block.
    MacroOfEachBlock,
    /// G67.
    EndModalMacro,
    /// M98.
    Subprogram,
    /// M97 of Haas: blocks of the same program.
    Local,
    /// M99.
    Return,
}

/// A code that calls, and where its word stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Call {
    pub(crate) code: CallCode,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// The whole number at the start of a text, and how long it is.
pub(super) fn digits(text: &[u8]) -> Option<(u32, usize)> {
    let length = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let number = core::str::from_utf8(text.get(..length)?).ok()?;
    Some((number.parse().ok()?, length))
}

/// What a line is, and where what follows its keyword starts.
pub(crate) fn statement(text: &[u8]) -> (Statement, usize) {
    let at = body(text);
    let rest = text.get(at..).unwrap_or_default();
    match rest {
        [b'O' | b'o' | b':', tail @ ..] => {
            if let Some((number, length)) = digits(tail) {
                return (Statement::Label(number), at + 1 + length);
            }
            if tail.first() == Some(&b'<') {
                return (Statement::Name, at + 1 + name_length(tail));
            }
        }
        [b'<', ..] => return (Statement::Name, at + name_length(rest)),
        _ => {}
    }
    for (word, statement) in [
        (&b"IF"[..], Statement::If),
        (b"GOTO", Statement::Goto),
        (b"WHILE", Statement::While),
        (b"END", Statement::End),
        (b"DO", Statement::While),
        (b"DPRNT", Statement::Print),
        (b"BPRNT", Statement::Device),
        (b"POPEN", Statement::Device),
        (b"PCLOS", Statement::Device),
        (b"SETVN", Statement::Names),
    ] {
        if starts_with_word(rest, word) {
            return (statement, at + word.len());
        }
    }
    match call_in(text, at) {
        Some(call) => (Statement::Call(call), call.end),
        None => (Statement::Block, at),
    }
}

/// The name of the program that a line is in front of: `O<PART>`, `<PART>`.
pub(crate) fn program_name(text: &[u8]) -> Option<&[u8]> {
    let (Statement::Name, end) = statement(text) else {
        return None;
    };
    let head = text.get(..end)?.trim_ascii_end().strip_suffix(b">")?;
    let open = head.iter().position(|byte| *byte == b'<')?;
    head.get(open + 1..)
}

/// Bytes of a name in `< >`, the brackets included.
fn name_length(text: &[u8]) -> usize {
    let end = text.iter().position(|byte| *byte == b'>');
    end.map_or(text.len(), |end| end + 1)
}

/// The first code of a line that calls, outside of comments and brackets.
fn call_in(text: &[u8], from: usize) -> Option<Call> {
    let (mut at, mut depth) = (from, 0_u32);
    while let Some(byte) = text.get(at) {
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth = depth.saturating_sub(1),
            b';' if depth == 0 => return None,
            b'G' | b'g' | b'M' | b'm' if depth == 0 => {
                let mut cursor = Cursor::new(text);
                cursor.seek(at + 1);
                if matches!(cursor.next_visible(), Some(b'0'..=b'9'))
                    && let Ok(number) = cursor.literal(at)
                    && let Some(code) = call_code(byte.to_ascii_uppercase(), number)
                {
                    return Some(Call {
                        code,
                        start: at,
                        end: cursor.at(),
                    });
                }
            }
            _ => {}
        }
        at += 1;
    }
    None
}

fn call_code(letter: u8, number: f64) -> Option<CallCode> {
    let is = |value: f64| (number - value).abs() < 1e-6;
    Some(match letter {
        b'G' if is(65.0) => CallCode::Macro,
        b'G' if is(66.0) => CallCode::ModalMacro,
        b'G' if is(66.1) => CallCode::MacroOfEachBlock,
        b'G' if is(67.0) => CallCode::EndModalMacro,
        b'M' if is(98.0) => CallCode::Subprogram,
        b'M' if is(97.0) => CallCode::Local,
        b'M' if is(99.0) => CallCode::Return,
        _ => return None,
    })
}

/// True if the line has that block number.
pub(crate) fn is_numbered(text: &[u8], wanted: u32) -> bool {
    let start = text
        .iter()
        .position(|byte| !matches!(byte, b' ' | b'\t' | b'/' | b'1'..=b'9'));
    let text = text.get(start.unwrap_or(0)..).unwrap_or_default();
    match text {
        [b'N' | b'n', tail @ ..] => {
            digits(tail.trim_ascii_start()).is_some_and(|(number, _)| number == wanted)
        }
        _ => false,
    }
}

/// The block number of a line.
pub(crate) fn block_number(text: &[u8]) -> Option<u32> {
    let text = text.trim_ascii_start();
    let [b'N' | b'n', tail @ ..] = text else {
        return None;
    };
    Some(digits(tail.trim_ascii_start())?.0)
}

pub(crate) fn is_label(text: &[u8]) -> bool {
    matches!(statement(text).0, Statement::Label(_) | Statement::Name)
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
