//! O words: the label and keyword at the head of a line.
//!
//! ```text
//! line    = [ "/" ] [ N number ] "O" label keyword values
//! label   = number | "<" name ">" | computed value (calls only)
//! ```

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::cursor::Cursor;
use crate::syntax::expression::name::name;
use crate::syntax::expression::scope::{LOCALS, Scope};
use crate::syntax::expression::value::value;

/// Most arguments of a call: the local parameters.
const MAX_ARGUMENTS: usize = LOCALS;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keyword {
    Sub,
    EndSub,
    Call,
    Return,
    If,
    ElseIf,
    Else,
    EndIf,
    While,
    EndWhile,
    Do,
    Repeat,
    EndRepeat,
    Break,
    Continue,
}

/// Keywords by name, longer names before their beginnings.
const KEYWORDS: [(&[u8], Keyword); 15] = [
    (b"ELSEIF", Keyword::ElseIf),
    (b"ELSE", Keyword::Else),
    (b"ENDSUB", Keyword::EndSub),
    (b"ENDIF", Keyword::EndIf),
    (b"ENDWHILE", Keyword::EndWhile),
    (b"ENDREPEAT", Keyword::EndRepeat),
    (b"SUB", Keyword::Sub),
    (b"CALL", Keyword::Call),
    (b"RETURN", Keyword::Return),
    (b"IF", Keyword::If),
    (b"WHILE", Keyword::While),
    (b"DO", Keyword::Do),
    (b"REPEAT", Keyword::Repeat),
    (b"BREAK", Keyword::Break),
    (b"CONTINUE", Keyword::Continue),
];

/// What ties the O words of one structure together.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Label {
    Number(u32),
    Name(String),
    /// To be computed when the line is executed.
    Computed,
}

impl core::fmt::Display for Label {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "O{number}"),
            Self::Name(name) => write!(f, "O<{name}>"),
            Self::Computed => f.write_str("a computed O word"),
        }
    }
}

/// The head of a line that starts with an O word.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OWord {
    pub(crate) label: Label,
    /// `None`: a program number, without effect.
    pub(crate) keyword: Option<Keyword>,
    /// From the O to the end of the label.
    pub(crate) span: SourceSpan,
    /// Where the label starts.
    label_at: usize,
    /// Where the values start.
    values_at: usize,
}

/// Puts the cursor on the O of a line that starts with an O word.
fn find<'t>(text: &'t [u8]) -> Option<Cursor<'t>> {
    let mut cursor = Cursor::new(text);
    if cursor.next_visible() == Some(b'/') {
        cursor.advance();
    }
    if matches!(cursor.next_visible(), Some(b'n' | b'N')) {
        cursor.advance();
        while matches!(cursor.next_visible(), Some(b'0'..=b'9')) {
            cursor.advance();
        }
    }
    matches!(cursor.next_visible(), Some(b'o' | b'O')).then_some(cursor)
}

/// Reads the head of a line; `None` if the line does not start with an O word.
pub(crate) fn o_word(text: &[u8]) -> Outcome<Option<OWord>> {
    let Some(mut cursor) = find(text) else {
        return Ok(None);
    };
    let start = cursor.at();
    cursor.advance();
    let next = cursor.next_visible();
    let label_at = cursor.at();
    let label = match next {
        Some(b'<') => Label::Name(name(&mut cursor)?),
        Some(b'#' | b'[') => {
            skip_value(&mut cursor, text)?;
            Label::Computed
        }
        _ => {
            let number = cursor.literal(start)?;
            Label::Number(label_number(
                number,
                SourceSpan::new(start, cursor.end_of_word()),
            )?)
        }
    };
    let span = SourceSpan::new(start, cursor.end_of_word());
    cursor.next_visible();
    let keyword = KEYWORDS.into_iter().find(|(name, _)| cursor.eat_word(name));
    let keyword = keyword.map(|(_, keyword)| keyword);
    if keyword.is_none() {
        end_of_line(cursor, text)?;
    }
    if label == Label::Computed && keyword != Some(Keyword::Call) {
        return Err(
            BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, "a computed label")
                .because("only a call may compute which subroutine it means")
                .help("write the number or the name"),
        );
    }
    let values_at = cursor.at();
    Ok(Some(OWord {
        label,
        keyword,
        span,
        label_at,
        values_at,
    }))
}

fn label_number(value: f64, span: SourceSpan) -> Outcome<u32> {
    let nearest = value.round();
    if (value - nearest).abs() > 1e-4 || !(0.0..=f64::from(u32::MAX)).contains(&nearest) {
        let message = format!("{value} is no label");
        return Err(
            BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
                .because("the label of an O word is a whole number, or a name in < >"),
        );
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    Ok(nearest as u32)
}

/// Skips a parameter or a bracketed expression without computing it.
fn skip_value(cursor: &mut Cursor<'_>, text: &[u8]) -> Outcome<()> {
    let start = cursor.at();
    let mut depth = 0_u32;
    while let Some(byte) = cursor.next_visible() {
        match byte {
            b'[' => depth += 1,
            b']' if depth <= 1 => {
                cursor.advance();
                return Ok(());
            }
            b']' => depth -= 1,
            b'<' if depth == 0 => return name(cursor).map(|_| ()),
            b'0'..=b'9' if depth == 0 => return cursor.literal(start).map(|_| ()),
            b'#' => {}
            _ if depth > 0 => {}
            _ => return Err(bad_byte(text, cursor.at())),
        }
        cursor.advance();
    }
    Err(bad_byte(text, text.len()))
}

/// Refuses anything but comments on the rest of the line.
fn end_of_line(mut cursor: Cursor<'_>, text: &[u8]) -> Outcome<()> {
    loop {
        match cursor.next_visible() {
            None | Some(b';') => return Ok(()),
            Some(b'(') => cursor.skip_comment()?,
            Some(byte) if byte.is_ascii_graphic() => {
                let span = SourceSpan::new(cursor.at(), text.len());
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::FlowStructure,
                    span,
                    "text behind an O word",
                )
                .because("a line with an O word has its keyword, its values, and comments")
                .help("put it into a line of its own"));
            }
            Some(_) => return Err(bad_byte(text, cursor.at())),
        }
    }
}

impl OWord {
    /// The value behind the keyword.
    pub(crate) fn one_value(&self, text: &[u8], scope: &dyn Scope) -> Outcome<f64> {
        let mut cursor = Cursor::new(text);
        cursor.seek(self.values_at);
        if !matches!(cursor.next_visible(), Some(b'[' | b'#')) {
            return Err(BlockDiagnostic::new(
                DiagnosticCode::FlowStructure,
                self.span,
                "no value behind the keyword",
            )
            .because("a condition or a count is needed there")
            .help("write it in brackets: [ ]"));
        }
        let value = value(&mut cursor, self.values_at, scope)?;
        end_of_line(cursor, text)?;
        Ok(value)
    }

    /// The value behind the keyword, if there is one.
    pub(crate) fn optional_value(&self, text: &[u8], scope: &dyn Scope) -> Outcome<Option<f64>> {
        let mut cursor = Cursor::new(text);
        cursor.seek(self.values_at);
        match cursor.next_visible() {
            Some(b'[') => self.one_value(text, scope).map(Some),
            _ => self.no_value(text).map(|()| None),
        }
    }

    /// Refuses a value behind the keyword.
    pub(crate) fn no_value(&self, text: &[u8]) -> Outcome<()> {
        let mut cursor = Cursor::new(text);
        cursor.seek(self.values_at);
        end_of_line(cursor, text)
    }

    /// The arguments of a call.
    pub(crate) fn arguments(&self, text: &[u8], scope: &dyn Scope) -> Outcome<Vec<f64>> {
        let mut cursor = Cursor::new(text);
        cursor.seek(self.values_at);
        let mut all = Vec::new();
        while cursor.next_visible() == Some(b'[') {
            if all.len() == MAX_ARGUMENTS {
                let message = format!("more than {MAX_ARGUMENTS} arguments");
                let span = SourceSpan::new(cursor.at(), cursor.at() + 1);
                return Err(
                    BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
                        .because("the arguments become the parameters #1 to #30"),
                );
            }
            all.push(value(&mut cursor, self.values_at, scope)?);
        }
        end_of_line(cursor, text)?;
        Ok(all)
    }

    /// The label, computed if need be.
    pub(crate) fn resolved_label(&self, text: &[u8], scope: &dyn Scope) -> Outcome<Label> {
        if self.label != Label::Computed {
            return Ok(self.label.clone());
        }
        let mut cursor = Cursor::new(text);
        cursor.seek(self.label_at);
        let number = value(&mut cursor, self.label_at, scope)?;
        label_number(number, self.span).map(Label::Number)
    }
}
