//! The helpers of several tests of programs.

use glidepath_gcode::Report;

/// `line:column code` of every diagnostic.
pub(crate) fn listed(report: &Report) -> Vec<String> {
    report
        .diagnostics
        .iter()
        .map(|d| format!("{}:{} {}", d.line, d.column, d.code))
        .collect()
}
