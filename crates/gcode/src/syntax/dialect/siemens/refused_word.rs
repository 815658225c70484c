//! The diagnostic for a word that SINUMERIK's tables do not have.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// A word that is in no table.
#[cold]
pub(super) fn unknown(name: &[u8], span: SourceSpan) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(name).into_owned();
    let message = format!("{shown} is not supported");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "of SINUMERIK's language the words of motion, variables, structures, jumps, frames and \
             the cycles in the manual are read; it is no subprogram in the program or beside it, \
             and no variable",
        )
        .help("let the CAM system write plain blocks, declare a variable by DEF, or give the folder of the subprogram")
}
