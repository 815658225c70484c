//! The codes of the other dialects: what each is on its own control, and what is made of it here.
//!
//! A code that is in no table is not read: LinuxCNC's language has codes of the same number that
//! mean something else, and to skip it could change what the machine does.

pub(crate) mod fanuc;
pub(crate) mod fanuc_lathe;
pub(crate) mod fanuc_systems;
pub(crate) mod listing;
pub(crate) mod marlin;
pub(crate) mod siemens;
pub(crate) mod siemens_names;

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::setup::m_codes::MCodes;
use crate::syntax::dialect::Dialect;

/// What is made of a code of a dialect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Meaning {
    /// It means what it means to LinuxCNC.
    Shared,
    /// It has a meaning of its own, which is made.
    Own,
    /// It moves nothing and gives no place another name.
    ReadOver,
    /// It is not made: what it is, and what to do instead.
    Refused(&'static str, &'static str),
}

/// A code that its dialect has, and that is not made.
#[cold]
pub(crate) fn refused(
    shown: &str,
    what: &str,
    help: &str,
    span: SourceSpan,
) -> Box<BlockDiagnostic> {
    let message = format!("{shown} ({what}) is not supported");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("skipping it would make another motion than the program's")
        .help(help)
}

/// A G code that is in no table.
#[cold]
pub(crate) fn no_g(dialect: Dialect, value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("there is no G{value} in the dialect {dialect}");
    BlockDiagnostic::new(DiagnosticCode::UnknownGCode, span, message)
        .because("what it means on that control is not known here, and skipping it could change what the machine does")
        .help("remove it, or read the program in the dialect it is from: --dialect")
}

/// An M code that is in no table.
#[cold]
pub(crate) fn no_m(dialect: Dialect, value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("there is no M{value} in the dialect {dialect}");
    BlockDiagnostic::new(DiagnosticCode::UnknownMCode, span, message)
        .because("an M code of the machine's builder could have been meant to stop something")
        .help(declare(value))
}

/// What can be done about an M code that is not known.
pub(crate) fn declare(value: f64) -> String {
    if MCodes::can_be_declared(value) {
        format!(
            "declare what it waits for by a table [m_codes.M{value}] in the configuration, or remove it"
        )
    } else {
        "remove it, or put it into a comment".to_owned()
    }
}
