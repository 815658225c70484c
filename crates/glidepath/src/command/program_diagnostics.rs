//! The diagnostics of a program, on standard error, or in a few lines for others.

use crate::output;
use crate::report::ProgramDiagnostic;
use glidepath_gcode::Diagnostic;
use glidepath_planner::Refusal;

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

/// Why a program is refused, in a few lines.
pub(super) fn refusal_text(refusal: &Refusal) -> String {
    const MOST: usize = 5;
    let Refusal::Program {
        diagnostics,
        unlisted,
    } = refusal
    else {
        return refusal.to_string();
    };
    let mut lines: Vec<String> = diagnostics
        .iter()
        .take(MOST)
        .map(|found| {
            let help = &found.help;
            format!(
                "line {}, column {}: {}; {help}",
                found.line, found.column, found.message
            )
        })
        .collect();
    let more = diagnostics.len().saturating_sub(MOST) as u64 + u64::from(*unlisted);
    if more > 0 {
        lines.push(format!("and {more} more"));
    }
    lines.join("\n")
}
