//! An index of a variable of the control, whose name begins with `$`.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;

/// An index of a variable of the control.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Index {
    /// `X`
    Axis(Axis),
    /// `TR`, `RT`, `FI`, `SC`, `MI`: a part of a frame.
    Word(Vec<u8>),
    Value(f64),
}

/// A name as text.
pub(crate) fn letters(name: &[u8]) -> String {
    String::from_utf8_lossy(name).into_owned()
}

/// A variable of the control that is not known here.
#[cold]
pub(crate) fn not_known(name: &[u8], span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = format!("{} cannot be read", letters(name));
    if name == b"$AA_IM" {
        return BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
            .because("it is read with the letter of an axis, and of X where X counts radii: whether a place of the machine is a diameter is not known here")
            .help("write $AA_IW[X], which is a diameter as X is, or DIAMOF before it");
    }
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("what this variable of the control holds is not known here, or depends on its machine data")
        .help("write the value, or a variable of the program")
}
