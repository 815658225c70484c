//! Variables of a program: R parameters, and those it declares.

use std::collections::BTreeMap;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::expression::scope::Parameter;

/// Where R parameters begin.
const R_BASE: u32 = 1000;
/// R parameters there are.
const R_COUNT: u32 = 1000;
/// Most variables a program declares.
const MAX_VARIABLES: usize = 1000;
/// Longest name, bytes.
const MAX_NAME: usize = 31;

/// What a variable holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Real,
    /// Whole numbers: what is assigned is rounded.
    Integer,
    /// 0 or 1.
    Truth,
}

impl Kind {
    /// What a variable of the kind holds when the value is assigned.
    pub(crate) fn of(self, value: f64) -> f64 {
        match self {
            Self::Real => value,
            Self::Integer => value.round(),
            Self::Truth => f64::from(u8::from(value != 0.0)),
        }
    }
}

/// The variables a program has declared, by name in capitals.
#[derive(Debug, Clone, Default)]
pub(crate) struct Variables(BTreeMap<Vec<u8>, Kind>);

impl Variables {
    /// Declares a variable; where its value is kept.
    pub(crate) fn declare(
        &mut self,
        name: &[u8],
        kind: Kind,
        span: SourceSpan,
    ) -> Outcome<Parameter> {
        let shown = String::from_utf8_lossy(name).into_owned();
        let letter =
            |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_');
        if !letter(name.first()) || !letter(name.get(1)) || name.len() > MAX_NAME {
            let message = format!("`{shown}` is no name of a variable");
            return Err(Fault::new(DiagnosticCode::Parameter, span, message)
                .because(format!(
                    "a name has two letters or `_` at its beginning and {MAX_NAME} bytes at most; \
                     others are addresses"
                ))
                .help("use another name"));
        }
        if self.0.len() >= MAX_VARIABLES && !self.0.contains_key(name) {
            let message = format!("more than {MAX_VARIABLES} variables");
            return Err(Fault::new(DiagnosticCode::Parameter, span, message)
                .because("the memory of a program is bounded")
                .help("use R parameters"));
        }
        self.0.insert(name.to_vec(), kind);
        Ok(place(name))
    }

    /// A variable by its name in capitals: what it holds, and where.
    pub(crate) fn get(&self, name: &[u8]) -> Option<(Kind, Parameter)> {
        self.0.get(name).map(|kind| (*kind, place(name)))
    }
}

/// Where the value of a variable is kept: apart from the names that the machine has.
fn place(name: &[u8]) -> Parameter {
    let name = String::from_utf8_lossy(name).to_ascii_lowercase();
    Parameter::Named(format!("def.{name}"))
}

/// Where the R parameter of that number is kept.
pub(crate) fn r_parameter(number: f64, span: SourceSpan) -> Outcome<Parameter> {
    let nearest = number.round();
    if (number - nearest).abs() > 1e-4 || !(0.0..f64::from(R_COUNT)).contains(&nearest) {
        let last = R_COUNT - 1;
        return Err(Fault::new(
            DiagnosticCode::Parameter,
            span,
            "there is no such R parameter",
        )
        .because(format!("R parameters have the numbers from 0 to {last}"))
        .help("use another one"));
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "range checked"
    )]
    Ok(Parameter::Numbered(R_BASE + nearest as u32))
}
