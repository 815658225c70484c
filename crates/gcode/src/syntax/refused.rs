//! Codes that are refused: those that do not exist, and those that are not supported.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::words::declare;

#[cold]
pub(crate) fn unknown_g(value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::UnknownGCode,
        span,
        format!("there is no G{value}"),
    )
    .because("skipping it could change what the machine does")
    .help("remove it, or put it into a comment")
}

#[cold]
pub(crate) fn unknown_m(value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::UnknownMCode,
        span,
        format!("there is no M{value}"),
    )
    .because("an unknown M code could have been meant to stop something")
    .help(declare(value))
}

/// G codes that exist and are not supported, each with what it is.
#[cold]
pub(crate) fn refused_g(tenths: u32, value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let (what, help) = match tenths {
        870 => (
            "back boring",
            "write the moves out; the spindle has to stop in a known position for them",
        ),
        880 => (
            "boring with retraction by hand",
            "use G86 or G89, which retract by themselves",
        ),
        _ => return unknown_g(value, span),
    };
    BlockDiagnostic::new(
        DiagnosticCode::NotSupported,
        span,
        format!("G{value} ({what}) is not supported"),
    )
    .because("skipping it would make another motion than the program's")
    .help(help)
}

/// M codes that exist and are not supported, each with what it is.
#[cold]
pub(crate) fn refused_m(number: u32, value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let what = match number {
        50..=53 => "overrides switched by the program",
        70..=73 => "saved modal state",
        98 | 99 => "subprogram call of another dialect",
        _ => return unknown_m(value, span),
    };
    let help = match number {
        50..=53 => "remove it; the operator sets the overrides",
        98 | 99 => "write O words (sub, call), or select the dialect it is from",
        _ => "set the modes again by their codes",
    };
    BlockDiagnostic::new(
        DiagnosticCode::NotSupported,
        span,
        format!("M{number} ({what}) is not supported"),
    )
    .because("skipping it could change what the machine does")
    .help(help)
}
