//! What is wrong with a program, on standard error.

use crate::output;
use crate::report::ProgramDiagnostic;
use glidepath_gcode::Diagnostic;

/// Prints what is wrong with a program to standard error.
pub(super) fn print_diagnostics(name: &str, diagnostics: &[Diagnostic], more: u32) {
    let printed: Vec<ProgramDiagnostic<'_>> = diagnostics
        .iter()
        .map(|diagnostic| ProgramDiagnostic::new(name, diagnostic))
        .collect();
    output::diagnostics(
        printed
            .iter()
            .map(|diagnostic| diagnostic as &dyn miette::Diagnostic),
    );
    if more > 0 {
        output::note(&format!("{name}: {more} more findings are not shown"));
    }
}
