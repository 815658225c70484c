//! The diagnostic for a byte that has no place in a block.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// A byte that can start nothing, at `at`.
#[cold]
pub(crate) fn bad_byte(text: &[u8], at: usize) -> Box<BlockDiagnostic> {
    let rest = text.get(at..).unwrap_or_default();
    match rest.first() {
        Some(0) => {
            let run = rest.iter().take_while(|b| **b == 0).count();
            let span = SourceSpan::new(at, at + run);
            let bytes = if run == 1 {
                "a NUL byte".into()
            } else {
                format!("{run} NUL bytes")
            };
            BlockDiagnostic::new(
                DiagnosticCode::NulByte,
                span,
                format!("{bytes} in the text"),
            )
            .because("the file is damaged, or no text at all")
            .help("restore the file from its source")
        }
        Some(0x80..) => non_ascii(rest, at),
        Some(&byte) => {
            let shown = char::from(byte).escape_default().to_string();
            let message = format!("`{shown}` has no meaning here");
            BlockDiagnostic::new(
                DiagnosticCode::BadCharacter,
                SourceSpan::new(at, at + 1),
                message,
            )
            .because("a block is made of words: a letter and a number each")
            .help("remove it, or put it into a comment")
        }
        None => BlockDiagnostic::new(
            DiagnosticCode::BadCharacter,
            SourceSpan::new(at, at + 1),
            "the line ends too early",
        ),
    }
}

fn non_ascii(rest: &[u8], at: usize) -> Box<BlockDiagnostic> {
    let head = rest.get(..rest.len().min(4)).unwrap_or_default();
    let valid = match core::str::from_utf8(head) {
        Ok(text) => text,
        Err(e) => core::str::from_utf8(head.get(..e.valid_up_to()).unwrap_or_default())
            .unwrap_or_default(),
    };
    let Some(c) = valid.chars().next() else {
        let byte = rest.first().copied().unwrap_or_default();
        let message = format!("byte 0x{byte:02X} is not text");
        return BlockDiagnostic::new(
            DiagnosticCode::NonAsciiCharacter,
            SourceSpan::new(at, at + 1),
            message,
        )
        .because("outside comments a program is ASCII")
        .help("save the file as plain text, or restore it from its source");
    };
    let help = match c {
        '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{fe63}' | '\u{ff0d}' => {
            "write the ASCII minus sign `-`"
        }
        '\u{a0}' | '\u{2000}'..='\u{200b}' | '\u{202f}' | '\u{3000}' => "write an ASCII space",
        '\u{ff10}'..='\u{ff19}' => "write ASCII digits",
        _ => "remove it, or put it into a comment",
    };
    let span = SourceSpan::new(at, at + c.len_utf8());
    let message = format!("`{c}` (U+{:04X}) is not ASCII", u32::from(c));
    BlockDiagnostic::new(DiagnosticCode::NonAsciiCharacter, span, message)
        .because("outside comments a program is ASCII")
        .help(help)
}
