//! Diagnostics about a program: where, what, why, and how to mend it.

pub(crate) mod block_diagnostic;
pub(crate) mod code;
pub(crate) mod excerpt;
pub(crate) mod span;

use std::sync::Arc;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::excerpt::Excerpt;

/// Most diagnostics listed in a [`Report`](crate::Report), and of a tool table.
pub const MAX_DIAGNOSTICS: usize = 20;

/// A diagnostic about a program.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{line}:{column}: error[{code}]: {message}", of_file(.file.as_deref()))]
pub struct Diagnostic {
    /// The file of a subroutine it is in; `None`: the program itself.
    pub file: Option<Arc<str>>,
    /// Source line, from 1.
    pub line: u32,
    /// Byte of the line at which the diagnostic starts, from 1.
    pub column: u32,
    /// Bytes the diagnostic covers.
    pub length: u32,
    /// Its kind.
    pub code: DiagnosticCode,
    /// What is wrong, in a sentence without a full stop.
    pub message: String,
    /// Why that is wrong; may be empty.
    pub reason: String,
    /// How to mend it; may be empty.
    pub help: String,
    /// The source around it.
    pub excerpt: Excerpt,
}

/// What stands before the line of a diagnostic in another file than the program.
fn of_file(file: Option<&str>) -> String {
    file.map_or_else(String::new, |file| format!("{file}:"))
}
