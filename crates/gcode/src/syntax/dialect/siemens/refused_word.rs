//! The diagnostic for a word that SINUMERIK's tables do not have.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::statement::{Statement, statement};

/// A word of a block that is in no table, or that has a block of its own.
#[cold]
pub(super) fn unknown(name: &[u8], span: SourceSpan) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(name).into_owned();
    let why = match statement(name).0 {
        Statement::Block => None,
        Statement::TextCall(_) => Some("the call of a subprogram has a block of its own"),
        Statement::Goto(_) => Some("a jump has a block of its own, or stands behind IF"),
        Statement::Else
        | Statement::EndIf
        | Statement::EndWhile
        | Statement::EndFor
        | Statement::Loop
        | Statement::EndLoop => Some("it has a block of its own"),
        _ => Some("it stands alone in its block, with its own words behind it"),
    };
    if let Some(why) = why {
        let message = format!("{shown} beside other words");
        return BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
            .because(why)
            .help("write it into a block of its own");
    }
    let message = format!("{shown} is not supported");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because(
            "of SINUMERIK's language the words of motion, variables, structures, jumps, frames and \
             the cycles in the manual are read; it is no subprogram in the program or beside it, \
             and no variable",
        )
        .help("let the CAM system write plain blocks, declare a variable by DEF, or give the folder of the subprogram")
}
