//! The diagnostic for a word that a block has twice.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::Fault;
use crate::diagnostic::span::SourceSpan;

#[cold]
pub(crate) fn duplicate(letter: char, span: SourceSpan) -> Box<Fault> {
    Fault::new(
        DiagnosticCode::DuplicateWord,
        span,
        format!("a second {letter} in the block"),
    )
    .because("a block has each word once")
    .help("remove one of them, or write two blocks")
}
