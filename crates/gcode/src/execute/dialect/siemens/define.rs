//! DEF: variables of a program or a subprogram, and arrays of them.

use std::io::BufRead;

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::variables::{Kind, MAX_DIMENSIONS};

/// Most elements along one dimension of an array.
const MAX_SIZE: f64 = 10_000.0;

impl<R: BufRead> Program<R> {
    /// `DEF REAL A, B=5, C[3]=SET(1,2,4)`.
    pub(super) fn siemens_define(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let (kind, mut at) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            let kind = kind_ahead(&mut input)?;
            (kind, input.at)
        };
        loop {
            let scope = ProgramScope {
                parameters: &self.parameters,
                interpreter: &self.interpreter,
            };
            let mut input = self.evaluator(&scope, text, at);
            input.next_visible();
            let start = input.at;
            let name = input.name_ahead();
            input.at += name.len();
            let sizes = if input.next_visible() == Some(b'[') {
                sizes(&mut input)?
            } else {
                Vec::new()
            };
            let span = SourceSpan::new(start, input.at.max(start + 1));
            let count: usize = sizes.iter().product();
            let is_array = !sizes.is_empty();
            let values = match input.eat(b'=') {
                false => Vec::new(),
                true if is_array => {
                    input.next_visible();
                    if !matches!(input.name_ahead().as_slice(), b"SET" | b"REP") {
                        return Err(no_values(SourceSpan::new(input.at, text.len())));
                    }
                    input.filling(count)?
                }
                true => vec![input.value()?],
            };
            let goes_on = input.eat(b',');
            if !goes_on {
                check_end(&mut input)?;
            }
            at = input.at;
            let declared = self.siemens.variables.declare(&name, kind, sizes, span)?;
            for index in 0..declared.count() {
                let parameter = declared.element(index);
                self.parameters.check_assignable(&parameter, span)?;
                let value = values.get(index).copied().unwrap_or(0.0);
                self.parameters.assign(&parameter, kind.of(value));
            }
            if !goes_on {
                return Ok(());
            }
        }
    }
}

/// REAL, INT or BOOL.
fn kind_ahead(input: &mut Evaluator<'_>) -> Outcome<Kind> {
    input.next_visible();
    let start = input.at;
    let name = input.name_ahead();
    input.at += name.len();
    Kind::named(&name).ok_or_else(|| {
        let shown = String::from_utf8_lossy(&name).into_owned();
        let span = SourceSpan::new(start, input.at.max(start + 1));
        let message = format!("DEF {shown} is not supported");
        Fault::new(DiagnosticCode::NotSupported, span, message)
            .because("variables are REAL, INT or BOOL, and of this program")
            .help("use one of these")
    })
}

/// How many elements an array has along each dimension; the bracket comes next.
fn sizes(input: &mut Evaluator<'_>) -> Outcome<Vec<usize>> {
    let start = input.at;
    input.eat(b'[');
    let mut sizes = Vec::new();
    loop {
        let size = input.value()?;
        let span = SourceSpan::new(start, input.at);
        if !(1.0..=MAX_SIZE).contains(&size) || size.fract() != 0.0 {
            let message = format!("an array of {size} elements");
            return Err(Fault::new(DiagnosticCode::Parameter, span, message)
                .because(format!(
                    "it has a whole number of them along each dimension, 1 to {MAX_SIZE}"
                ))
                .help("write another size"));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        sizes.push(size as usize);
        if input.eat(b']') {
            return Ok(sizes);
        }
        if sizes.len() >= MAX_DIMENSIONS || !input.eat(b',') {
            let message = "the sizes of an array are not closed";
            return Err(Fault::new(DiagnosticCode::Expression, span, message)
                .because(format!("an array has {MAX_DIMENSIONS} dimensions at most"))
                .help("add `]`"));
        }
    }
}

#[cold]
fn no_values(span: SourceSpan) -> Box<Fault> {
    let message = "an array that one value is given to";
    Fault::new(DiagnosticCode::Parameter, span, message)
        .because("each element has a value of its own")
        .help("write SET(a, b, …), or REP(a) for the same in all")
}
