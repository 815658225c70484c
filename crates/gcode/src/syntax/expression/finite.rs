//! The check that a result is a finite number.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

pub(crate) fn finite(value: f64, span: SourceSpan) -> Outcome<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(BlockDiagnostic::new(
        DiagnosticCode::Arithmetic,
        span,
        "the result is not a number",
    )
    .because("the operation has no value for these operands, or one that is too large")
    .help("check the values it is computed from"))
}
