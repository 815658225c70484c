//! Names of parameters and subroutines: `<name>`.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::cursor::Cursor;

/// Longest name of a parameter or subroutine, bytes.
pub(crate) const MAX_NAME: usize = 128;

/// Reads a name whose `<` comes next: lower case, without blanks.
pub(crate) fn name(cursor: &mut Cursor<'_>) -> Outcome<String> {
    let start = cursor.at();
    cursor.advance();
    let mut name = String::new();
    loop {
        match cursor.next_visible() {
            Some(b'>') => {
                cursor.advance();
                return Ok(name);
            }
            Some(byte @ (b'!'..=b'~')) if byte != b'(' && name.len() < MAX_NAME => {
                name.push(char::from(byte.to_ascii_lowercase()));
                cursor.advance();
            }
            _ => {
                let span = SourceSpan::new(start, cursor.at());
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::Expression,
                    span,
                    "the name is not closed",
                )
                .because(format!(
                    "a name is ASCII text of up to {MAX_NAME} bytes in < >"
                ))
                .help("add `>`"));
            }
        }
    }
}
