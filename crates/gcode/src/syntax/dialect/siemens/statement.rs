//! The statements of a SINUMERIK program: what a line is to the flow of the program.

use crate::syntax::dialect::line_body::body;
use crate::syntax::dialect::siemens::frame_word::FrameWord;

/// Which way a jump looks for its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    /// GOTOF: towards the end of the program.
    Forward,
    /// GOTOB: towards its beginning.
    Back,
    /// GOTO: forward, then from the beginning.
    Any,
    /// GOTOC: as GOTO; without an end it goes on with the next block.
    IfAny,
}

/// A call of a subprogram that a text or a path names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TextCall {
    /// EXTCALL: a file beside the control's own programs.
    External,
    /// CALL.
    ByName,
    /// PCALL.
    ByPath,
}

impl TextCall {
    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::External => "EXTCALL",
            Self::ByName => "CALL",
            Self::ByPath => "PCALL",
        }
    }
}

/// The kinds of statements.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Statement {
    Block,
    /// IF with a jump in the same line.
    IfJump,
    If,
    Else,
    EndIf,
    While,
    EndWhile,
    For,
    EndFor,
    Loop,
    EndLoop,
    /// REPEAT alone, which UNTIL ends.
    Repeat,
    Until,
    /// REPEAT with labels.
    RepeatPart,
    /// REPEATB with a label.
    RepeatBlock,
    Goto(Direction),
    /// DEF.
    Define,
    /// CASE … OF …: jumps by a value.
    Case,
    /// EXTERN: what a subprogram takes, which the subprogram says itself.
    Extern,
    /// PROC: the first line of a subprogram.
    Procedure,
    /// TRANS and the like.
    Frame(FrameWord),
    /// G58 and G59: true for G59, the part that ATRANS adds.
    AxisOffset(bool),
    /// `$P_UIFR[1]=…`, `$P_PFRAME=…`, `$TC_DP3[1,1]=…`: what the control keeps of coordinate systems and tools.
    SystemData,
    /// A call of a cycle by name.
    Cycle,
    /// HOLES1, HOLES2, CYCLE801, CYCLE802.
    Positions,
    /// CYCLE800.
    Swivel,
    /// MCALL.
    ModalCall,
    TextCall(TextCall),
}

impl Statement {
    /// The statement that ends the structure which this one begins.
    pub(crate) const fn end(self) -> Option<Self> {
        Some(match self {
            Self::If => Self::EndIf,
            Self::While => Self::EndWhile,
            Self::For => Self::EndFor,
            Self::Loop => Self::EndLoop,
            Self::Repeat => Self::Until,
            _ => return None,
        })
    }

    /// True for what ends a structure.
    pub(crate) const fn is_end(self) -> bool {
        matches!(
            self,
            Self::EndIf | Self::EndWhile | Self::EndFor | Self::EndLoop | Self::Until
        )
    }
}

/// Cycles that are made.
const CYCLES: [&[u8]; 20] = [
    b"CYCLE81",
    b"CYCLE82",
    b"CYCLE83",
    b"CYCLE84",
    b"CYCLE85",
    b"CYCLE86",
    b"CYCLE87",
    b"CYCLE88",
    b"CYCLE89",
    b"CYCLE840",
    b"CYCLE71",
    b"CYCLE95",
    b"CYCLE97",
    b"CYCLE98",
    b"CYCLE76",
    b"CYCLE77",
    b"POCKET1",
    b"POCKET2",
    b"POCKET3",
    b"POCKET4",
];

/// Beginnings of the names of what a program may set.
const SYSTEM_DATA: [&[u8]; 3] = [b"$P_UIFR", b"$P_PFRAME", b"$TC_DP"];

/// Letters, digits and underscores at the start of a text.
pub(crate) fn name_at(text: &[u8], at: usize) -> &[u8] {
    let rest = text.get(at..).unwrap_or_default();
    let is_name = |byte: &&u8| byte.is_ascii_alphanumeric() || matches!(**byte, b'_' | b'$');
    let length = rest.iter().take_while(is_name).count();
    &rest[..length]
}

/// Where what is neither blank nor of a comment comes next.
fn blank_to(text: &[u8], at: usize) -> usize {
    let rest = text.get(at..).unwrap_or_default();
    at + rest
        .iter()
        .take_while(|byte| matches!(byte, b' ' | b'\t'))
        .count()
}

/// The label of a line, and where what follows it starts.
pub(crate) fn label(text: &[u8]) -> (Option<&[u8]>, usize) {
    let at = body(text);
    let name = name_at(text, at);
    let behind = blank_to(text, at + name.len());
    let letter = name
        .first()
        .is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
    if letter && text.get(behind) == Some(&b':') && text.get(behind + 1) != Some(&b'=') {
        return (Some(name), blank_to(text, behind + 1));
    }
    (None, at)
}

/// True if the line has that label, or that block number.
pub(crate) fn is_target(text: &[u8], wanted: &[u8]) -> bool {
    if label(text)
        .0
        .is_some_and(|name| name.eq_ignore_ascii_case(wanted))
    {
        return true;
    }
    let start = text
        .iter()
        .position(|byte| !matches!(byte, b' ' | b'\t' | b'/'))
        .unwrap_or_default();
    let number = name_at(text, start);
    let [b'N' | b'n', digits @ ..] = number else {
        return false;
    };
    !digits.is_empty() && number.eq_ignore_ascii_case(wanted)
}

/// Where a jump begins in a line, outside of its comment.
pub(crate) fn jump_in(text: &[u8], from: usize) -> Option<usize> {
    let end = text.iter().position(|byte| *byte == b';');
    let code = text.get(..end.unwrap_or(text.len())).unwrap_or_default();
    let mut at = from;
    while at < code.len() {
        let name = name_at(code, at);
        if direction(name).is_some() {
            return Some(at);
        }
        at += name.len().max(1);
    }
    None
}

/// True for the line in front of a program among several of a file: `%_N_NAME_SPF`.
pub(crate) fn is_header(text: &[u8]) -> bool {
    text.trim_ascii_start().starts_with(b"%_N_")
}

/// The name of a program in the line in front of it, and whether it is that of `%_N_NAME_SPF`.
pub(crate) fn is_header_of(text: &[u8], name: &[u8]) -> bool {
    let text = text.trim_ascii();
    let rest = text.strip_prefix(b"%_N_").unwrap_or_default();
    let stem = rest.get(..rest.len().saturating_sub(4)).unwrap_or_default();
    let kind = rest.get(stem.len()..).unwrap_or_default();
    stem.eq_ignore_ascii_case(name)
        && (kind.eq_ignore_ascii_case(b"_SPF") || kind.eq_ignore_ascii_case(b"_MPF"))
}

/// The jump of that name.
pub(crate) fn direction(name: &[u8]) -> Option<Direction> {
    let is = |word: &[u8]| name.eq_ignore_ascii_case(word);
    Some(match () {
        () if is(b"GOTOF") => Direction::Forward,
        () if is(b"GOTOB") => Direction::Back,
        () if is(b"GOTO") => Direction::Any,
        () if is(b"GOTOC") => Direction::IfAny,
        () => return None,
    })
}

/// What a line is, and where what follows its keyword starts; for a cycle, where its name starts.
pub(crate) fn statement(text: &[u8]) -> (Statement, usize) {
    let at = label(text).1;
    let name = name_at(text, at).to_ascii_uppercase();
    let behind = at + name.len();
    if let Some(direction) = direction(&name) {
        return (Statement::Goto(direction), behind);
    }
    if let Some(frame) = FrameWord::named(&name) {
        return (Statement::Frame(frame), behind);
    }
    if let [b'G', b'5', digit @ (b'8' | b'9'), rest @ ..] = name.as_slice()
        && !rest.first().is_some_and(u8::is_ascii_digit)
        && text.get(at + 3) != Some(&b'.')
    {
        return (Statement::AxisOffset(*digit == b'9'), at + 3);
    }
    if SYSTEM_DATA.iter().any(|known| name.starts_with(known)) {
        return (Statement::SystemData, at);
    }
    if CYCLES.contains(&name.as_slice()) {
        return (Statement::Cycle, at);
    }
    if [&b"HOLES1"[..], b"HOLES2", b"CYCLE801", b"CYCLE802"].contains(&name.as_slice()) {
        return (Statement::Positions, at);
    }
    if name == b"CYCLE800" {
        return (Statement::Swivel, at);
    }
    let statement = match name.as_slice() {
        b"IF" if jump_in(text, behind).is_some() => Statement::IfJump,
        b"IF" => Statement::If,
        b"ELSE" => Statement::Else,
        b"ENDIF" => Statement::EndIf,
        b"WHILE" => Statement::While,
        b"ENDWHILE" => Statement::EndWhile,
        b"FOR" => Statement::For,
        b"ENDFOR" => Statement::EndFor,
        b"LOOP" => Statement::Loop,
        b"ENDLOOP" => Statement::EndLoop,
        b"REPEATB" => Statement::RepeatBlock,
        b"REPEAT" if matches!(text.get(blank_to(text, behind)), None | Some(b';')) => {
            Statement::Repeat
        }
        b"REPEAT" => Statement::RepeatPart,
        b"UNTIL" => Statement::Until,
        b"DEF" => Statement::Define,
        b"CASE" => Statement::Case,
        b"EXTERN" => Statement::Extern,
        b"PROC" => Statement::Procedure,
        b"MCALL" => Statement::ModalCall,
        b"EXTCALL" => Statement::TextCall(TextCall::External),
        b"CALL" => Statement::TextCall(TextCall::ByName),
        b"PCALL" => Statement::TextCall(TextCall::ByPath),
        _ => return (Statement::Block, at),
    };
    (statement, behind)
}
