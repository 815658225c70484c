//! Letters that a computed value may stand after: the addresses of SINUMERIK's language.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::words::siemens::ADDRESSES;

#[cold]
pub(super) fn no_address(letter: char, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("{letter} is no address of SINUMERIK's language");
    BlockDiagnostic::new(DiagnosticCode::UnknownWord, span, message)
        .because("on other controls it has several meanings, and here none")
        .help("remove it; a radius is CR=, a dwell G4 F")
}

/// Refuses a letter that no computed value may stand after.
pub(super) fn check_computed(letter: u8, span: SourceSpan) -> Outcome<()> {
    if letter == b'G' {
        let fault = BlockDiagnostic::new(
            DiagnosticCode::NotSupported,
            span,
            "a G code that is computed",
        );
        return Err(fault
            .because("what a block does has to be seen in it")
            .help("write the code itself, or IF and a block for each"));
    }
    if ADDRESSES.contains(&letter) {
        return Ok(());
    }
    Err(no_address(char::from(letter), span))
}
