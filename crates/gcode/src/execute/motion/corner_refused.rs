//! The diagnostics for corners that are not broken.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::motion::corner_geometry::CornerFault;
use crate::syntax::block::Block;
use crate::syntax::dialect::Dialect;

#[cold]
pub(super) fn no_second_move(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a corner that is broken has no move in the plane behind it";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("the word in the block before counts between two moves of G1, G2 and G3")
        .help("write the moves one behind the other, or write the chamfer or arc out")
}

#[cold]
pub(super) fn below_zero(value: f64, span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("a chamfer or an arc of {value} at a corner");
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
        .because("it is a length, and says nothing of the side")
        .help("write zero or more")
}

#[cold]
pub(super) fn changed_between(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message =
        "a corner that is broken in front of another plane, tool, compensation or spindle speed";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("both moves of a corner have to be made with the same")
        .help("write the change into the block before the corner, or write the chamfer or arc out")
}

#[cold]
pub(super) fn timed(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a corner that is broken with a feed that is a time (G93)";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("the time of a block is of its move, and the corner has none of its own")
        .help("write G94 or G95 before both moves, or write the chamfer or arc out")
}

#[cold]
pub(super) fn not_in_plane(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a corner that is broken outside the plane";
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("both moves have to be in the plane of arcs")
        .help("write G17, G18 or G19, or write the chamfer or arc out")
}

#[cold]
pub(super) fn cannot_break(
    block: &Block,
    span: SourceSpan,
    fault: CornerFault,
) -> Box<BlockDiagnostic> {
    let message = "the corner before this move cannot be broken";
    let why = match (fault, block.dialect) {
        (CornerFault::ChamferAtArc, Dialect::Siemens) => {
            "beside an arc: the control's manual gives CHR and CHF for two straight moves, and not from where they count along an arc"
        }
        (CornerFault::ChamferAtArc, _) => "a Haas makes chamfers between straight moves alone",
        (fault, _) => fault.why(),
    };
    let help = if fault.is_of_size() {
        "write a smaller value"
    } else {
        "write the chamfer or arc out"
    };
    BlockDiagnostic::new(DiagnosticCode::InvalidValue, span, message)
        .because(why)
        .help(help)
}
