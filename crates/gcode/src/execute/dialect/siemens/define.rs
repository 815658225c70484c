//! DEF: variables of a program or a subprogram, of numbers and of texts, and arrays of them.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::check_end;
use crate::execute::program::Program;
use crate::execute::scope::ProgramScope;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::text_variables::{MAX_TEXT, TextAssignment};
use crate::syntax::dialect::siemens::variables::{Kind, MAX_DIMENSIONS};

/// Most elements along one dimension of an array.
const MAX_SIZE: f64 = 10_000.0;

impl<R: BufRead> Program<R> {
    /// `DEF REAL A, B=5, C[3]=SET(1,2,4)`.
    pub(super) fn siemens_define(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let (kind, mut at) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            let kind = match input.eat_name(b"STRING") {
                true => None,
                false => Some(kind_ahead(&mut input)?),
            };
            (kind, input.at)
        };
        let Some(kind) = kind else {
            return self.siemens_define_texts(text, at);
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

/// What DEF says of one variable of texts.
struct DefinedText {
    name: Vec<u8>,
    sizes: Vec<usize>,
    value: Option<Vec<u8>>,
    span: SourceSpan,
}

/// How long texts may be: in brackets behind STRING.
fn length_ahead(input: &mut Evaluator<'_>) -> Outcome<usize> {
    if input.peek(0) != Some(b'[') {
        return Ok(MAX_TEXT);
    }
    let start = input.at;
    match sizes(input)?.as_slice() {
        [length] if *length <= MAX_TEXT => Ok(*length),
        _ => {
            let span = SourceSpan::new(start, input.at);
            let message = "the length of a text is not possible";
            Err(
                BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                    .because(format!("a text has 1 to {MAX_TEXT} bytes"))
                    .help("write one such number in the brackets"),
            )
        }
    }
}

/// `NAME`, `NAME="A"`, `NAME[3]`.
fn text_ahead(input: &mut Evaluator<'_>) -> Outcome<DefinedText> {
    input.next_visible();
    let start = input.at;
    let name = input.name_ahead();
    input.at += name.len();
    let sizes = if input.peek(0) == Some(b'[') {
        sizes(input)?
    } else {
        Vec::new()
    };
    let span = SourceSpan::new(start, input.at.max(start + 1));
    let value = if input.eat(b'=') {
        if !sizes.is_empty() || !input.is_text_next() {
            let message = "a variable of texts that no text is given to";
            return Err(BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                .because(
                    "behind DEF STRING and the name of a single variable stands a text in quotes",
                )
                .help("write it, or assign the elements of the array one by one"));
        }
        Some(input.text_value()?)
    } else {
        None
    };
    Ok(DefinedText {
        name,
        sizes,
        value,
        span,
    })
}

impl<R: BufRead> Program<R> {
    /// `DEF STRING[20] NAME="X", OTHER, LIST[3]`.
    fn siemens_define_texts(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let (most, mut at) = {
            let scope = self.scope();
            let mut input = self.evaluator(&scope, text, at);
            (length_ahead(&mut input)?, input.at)
        };
        loop {
            let scope = ProgramScope {
                parameters: &self.parameters,
                interpreter: &self.interpreter,
            };
            let mut input = self.evaluator(&scope, text, at);
            let defined = text_ahead(&mut input)?;
            let goes_on = input.eat(b',');
            if !goes_on {
                check_end(&mut input)?;
            }
            at = input.at;
            let DefinedText {
                name,
                sizes,
                value,
                span,
            } = defined;
            let variables = &mut self.siemens.variables;
            variables.declare_text(&name, most, sizes, span)?;
            if let Some(value) = value {
                variables.check_text(&name, &value, span)?;
                variables.set_text(TextAssignment {
                    name,
                    element: 0,
                    value,
                });
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
        let help = match name.as_slice() {
            b"FRAME" => "write TRANS, ROT and the like, or set $P_UIFR or $P_PFRAME",
            b"AXIS" => "write the letter of the axis itself",
            _ => "use one of these",
        };
        BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
            .because("variables are REAL, INT, BOOL or STRING, and of this program")
            .help(help)
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
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                    .because(format!(
                        "it has a whole number of them along each dimension, 1 to {MAX_SIZE}"
                    ))
                    .help("write another size"),
            );
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
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                    .because(format!("an array has {MAX_DIMENSIONS} dimensions at most"))
                    .help("add `]`"),
            );
        }
    }
}

#[cold]
fn no_values(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "an array that one value is given to";
    BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
        .because("each element has a value of its own")
        .help("write SET(a, b, …), or REP(a) for the same in all")
}
