//! The diagnostic for a word that a block has twice.

use core::fmt::Display;

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

#[cold]
pub(crate) fn duplicate(word: impl Display, span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::DuplicateWord,
        span,
        format!("a second {word} in the block"),
    )
    .because("a block has each word once")
    .help("remove one of them, or write two blocks")
}
