//! The scope: where an expression gets the values of its parameters from.

use crate::diagnostic::block_diagnostic::BlockDiagnostic;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::siemens::system_index::Index;

/// Parameters local to a subroutine call, `#1` to `#30`: its arguments at first.
pub(crate) const LOCALS: usize = 30;

/// Where the values of parameters come from.
pub(crate) trait Scope {
    /// Value of a numbered parameter; `None`: there is no such number.
    fn numbered(&self, number: u32) -> Option<f64>;
    /// Value of a named parameter; `None`: it has none.
    fn named(&self, name: &str) -> Option<f64>;
    /// Why the program may not read a numbered parameter, if it may not.
    fn refuses(&self, _number: u32) -> Option<&'static str> {
        None
    }
    /// Value of a variable of a SINUMERIK control; `None`: it is not known.
    fn system_value(&self, _name: &[u8], _index: &[Index]) -> Option<f64> {
        None
    }
    /// The number of a FANUC variable that has a name.
    fn named_number(&self, _name: &str) -> Option<u32> {
        None
    }
    /// The number of the tool of that name in the tool table.
    fn tool_named(&self, _name: &str) -> Option<u32> {
        None
    }
    /// Whether the machine's builder declared an M code.
    fn declares_m(&self, _number: u32) -> bool {
        false
    }
    /// The language whose operators and functions there are.
    fn dialect(&self) -> Dialect {
        Dialect::LinuxCnc
    }
    /// The least increment of coordinates in the units in force: what FANUC's ROUND in an address
    /// rounds to.
    fn least_increment(&self) -> f64 {
        0.001
    }
    /// True where `ATAN[a]/[b]` is from 0 to 360 degrees, and `ASIN` from 270 to 90.
    fn has_full_arctangent(&self) -> bool {
        false
    }
}

/// The parameter that is meant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Parameter {
    Numbered(u32),
    Named(String),
}

#[cold]
pub(crate) fn no_parameter(span: SourceSpan, number: f64) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::Parameter,
        span,
        format!("there is no parameter #{number}"),
    )
    .because("parameters have the whole numbers from 1 to 5601")
    .help("use a number from 1 to 5000, or a name: #<name>")
}
