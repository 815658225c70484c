//! PROC: the first line of a subprogram, with the names of its parameters: values of the call, or its variables.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::fault;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::arguments::Argument;
use crate::syntax::dialect::siemens::expression::Evaluator;
use crate::syntax::dialect::siemens::variables::{Declared, Kind, MAX_DIMENSIONS};

/// A parameter that PROC names.
struct ProcParameter {
    name: Vec<u8>,
    kind: Kind,
    /// Its value where the call leaves it out.
    default: f64,
    /// VAR: it is a variable of the call, with so many elements along each dimension; `None`: any number.
    reference: Option<Vec<Option<f64>>>,
    span: SourceSpan,
}

impl<R: BufRead> Program<R> {
    /// `PROC NAME(REAL A, INT B=2, VAR REAL C[3]) SAVE`: gives the names the values of the call, or its variables.
    pub(super) fn siemens_procedure(&mut self, text: &[u8], at: usize) -> Outcome<()> {
        let arguments = self.siemens.calls.last().map(|call| call.arguments.clone());
        let is_called = arguments.is_some();
        let arguments = arguments.unwrap_or_default();
        let (parameters, is_saved) = self.siemens_head(text, at)?;
        let span = SourceSpan::new(at, text.trim_ascii_end().len().max(at + 1));
        if !is_called && !parameters.is_empty() {
            let message = "a subprogram with parameters that nothing calls";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::FlowStructure, span, message)
                    .because("its parameters have the values of a call")
                    .help("run the program that calls it"),
            );
        }
        if arguments.len() > parameters.len() {
            let message = format!(
                "{} arguments of a subprogram that takes {}",
                arguments.len(),
                parameters.len()
            );
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                    .because("each argument is of a name in PROC")
                    .help("correct the call, or PROC"),
            );
        }
        for (index, parameter) in parameters.into_iter().enumerate() {
            let argument = arguments.get(index).cloned().flatten();
            self.siemens_bind(&parameter, argument, span)?;
        }
        if is_saved {
            let saved = (
                self.interpreter.state.modal,
                self.interpreter.state.offsets.frame,
            );
            if let Some(call) = self.siemens.calls.last_mut() {
                call.saved = Some(Box::new(saved));
            }
        }
        Ok(())
    }

    /// Gives a parameter what the call has in its place.
    fn siemens_bind(
        &mut self,
        parameter: &ProcParameter,
        argument: Option<Argument>,
        head: SourceSpan,
    ) -> Outcome<()> {
        let (name, kind) = (&parameter.name, parameter.kind);
        if let Some(sizes) = &parameter.reference {
            let variable = variable_of(parameter, sizes, argument)?;
            return self.siemens.variables.refer(name, variable, head);
        }
        let value = match argument {
            None => parameter.default,
            Some(argument) => argument.value.ok_or_else(|| {
                let shown = String::from_utf8_lossy(name);
                let message = format!("{shown} is one value, and the call gives an array");
                BlockDiagnostic::new(DiagnosticCode::Parameter, parameter.span, message)
                    .because("without VAR a parameter has a value of its own")
                    .help("write an element of the array in the call, or VAR and brackets in PROC")
            })?,
        };
        let variables = &mut self.siemens.variables;
        let place = variables.declare(name, kind, Vec::new(), head)?.element(0);
        self.parameters.check_assignable(&place, head)?;
        self.parameters.assign(&place, kind.of(value));
        Ok(())
    }

    /// The parameters that PROC names, and whether it says SAVE.
    fn siemens_head(&self, text: &[u8], at: usize) -> Outcome<(Vec<ProcParameter>, bool)> {
        let scope = self.scope();
        let mut input = self.evaluator(&scope, text, at);
        input.next_visible();
        input.at += input.name_ahead().len();
        let mut parameters = Vec::new();
        if input.eat(b'(') && !input.eat(b')') {
            loop {
                input.next_visible();
                let start = input.at;
                parameters.push(parameter_ahead(&mut input)?);
                if input.eat(b')') {
                    break;
                }
                if !input.eat(b',') {
                    let span = SourceSpan::new(start, input.at.max(start + 1));
                    let message = "the parameters of PROC are not closed";
                    return Err(
                        BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                            .help("add `)`"),
                    );
                }
            }
        }
        let mut is_saved = false;
        while !input.is_at_end() {
            let start = input.at;
            let word = input.name_ahead();
            input.at += word.len().max(1);
            match word.as_slice() {
                b"SAVE" => is_saved = true,
                b"DISPLOF" | b"DISPLON" | b"SBLOF" | b"SBLON" | b"ACTBLOCNO" => {}
                _ => {
                    let span = SourceSpan::new(start, input.at);
                    let message = "a word of PROC that is not known";
                    return Err(
                        BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                            .because(
                                "behind its parameters stand SAVE, DISPLOF, SBLOF and the like",
                            )
                            .help("remove it"),
                    );
                }
            }
        }
        Ok((parameters, is_saved))
    }
}

/// `REAL A`, `INT B=2`, `VAR REAL C`, `VAR REAL D[3]`, `VAR REAL E[]`.
fn parameter_ahead(input: &mut Evaluator<'_>) -> Outcome<ProcParameter> {
    input.next_visible();
    let start = input.at;
    let is_reference = input.eat_name(b"VAR");
    input.next_visible();
    let word_at = input.at;
    let word = input.name_ahead();
    input.at += word.len();
    let Some(kind) = Kind::named(&word) else {
        return Err(no_parameter(&word, word_at));
    };
    input.next_visible();
    let name = input.name_ahead();
    input.at += name.len();
    let has_brackets = input.next_visible() == Some(b'[');
    if has_brackets && !is_reference {
        return Err(no_parameter(b"an array without VAR", start));
    }
    let sizes = if has_brackets {
        sizes_ahead(input)?
    } else {
        Vec::new()
    };
    let span = SourceSpan::new(start, input.at);
    let has_value = input.eat(b'=');
    if has_value && is_reference {
        return Err(no_parameter(b"VAR with a value", start));
    }
    let default = if has_value { input.value()? } else { 0.0 };
    Ok(ProcParameter {
        name,
        kind,
        default,
        reference: is_reference.then_some(sizes),
        span,
    })
}

/// `[3]`, `[3,2]`, `[]`, `[,]`: `None` where no number stands.
fn sizes_ahead(input: &mut Evaluator<'_>) -> Outcome<Vec<Option<f64>>> {
    let start = input.at;
    input.eat(b'[');
    let mut sizes = Vec::new();
    loop {
        let size = match input.next_visible() {
            Some(b',' | b']') => None,
            _ => Some(input.value()?),
        };
        sizes.push(size);
        if input.eat(b']') {
            return Ok(sizes);
        }
        if sizes.len() >= MAX_DIMENSIONS || !input.eat(b',') {
            let span = SourceSpan::new(start, input.at.max(start + 1));
            let message = "the sizes of an array are not closed";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                    .because(format!("an array has {MAX_DIMENSIONS} dimensions at most"))
                    .help("add `]`"),
            );
        }
    }
}

/// The variable of the call that a parameter of VAR stands for.
fn variable_of(
    parameter: &ProcParameter,
    sizes: &[Option<f64>],
    argument: Option<Argument>,
) -> Outcome<Declared> {
    let shown = String::from_utf8_lossy(&parameter.name).into_owned();
    let refuse = |message: String, help: &str| {
        BlockDiagnostic::new(DiagnosticCode::Parameter, parameter.span, message)
            .because("a parameter of VAR is the variable of the call itself, and what is assigned to it is assigned there")
            .help(help)
    };
    let Some(variable) = argument.and_then(|argument| argument.variable) else {
        return Err(refuse(
            format!("{shown} is VAR, and the call gives no variable for it"),
            "write a variable in the call, of the same kind; MCALL gives values only",
        ));
    };
    if variable.kind != parameter.kind {
        return Err(refuse(
            format!("{shown} is of another kind than the variable of the call"),
            "declare both as REAL, or both as INT or BOOL; R parameters are REAL",
        ));
    }
    let is_size = |(wanted, size): (&Option<f64>, &usize)| {
        let size = f64::from(u32::try_from(*size).unwrap_or(u32::MAX));
        wanted.is_none_or(|wanted| wanted.to_bits() == size.to_bits())
    };
    let is_like =
        variable.sizes.len() == sizes.len() && sizes.iter().zip(&variable.sizes).all(is_size);
    if !is_like {
        return Err(refuse(
            format!("{shown} has another size than the variable of the call"),
            "write the same size as in its DEF, or empty brackets for any",
        ));
    }
    Ok(variable)
}

#[cold]
fn no_parameter(word: &[u8], start: usize) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(word).into_owned();
    let span = SourceSpan::new(start, start + word.len().max(1));
    let message = format!("a parameter of PROC that is {shown}");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("parameters are REAL, INT or BOOL with the value of the call, or VAR: a variable or an array of the call")
        .help("give others by R parameters")
}

/// Refuses what stands behind EXTERN, its name and its types, which would be left out; `at` is behind EXTERN.
pub(super) fn check_extern(text: &[u8], at: usize) -> Outcome<()> {
    let rest = text.get(at..).unwrap_or_default();
    let is_gap = |byte: &u8| byte.is_ascii_whitespace();
    let start = rest.iter().take_while(|byte| is_gap(byte)).count();
    let name = rest[start..]
        .iter()
        .take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'_')
        .count();
    let gap = rest[start + name..]
        .iter()
        .take_while(|byte| is_gap(byte))
        .count();
    let types = start + name + gap;
    let end = match rest.get(types) {
        Some(b'(') => rest[types..]
            .iter()
            .position(|byte| *byte == b')')
            .map_or(rest.len(), |length| types + length + 1),
        _ => start + name,
    };
    let behind = rest.get(end..).unwrap_or_default();
    match behind.iter().position(|byte| !is_gap(byte)) {
        Some(more) if behind[more] != b';' => {
            let span = SourceSpan::new(at + end + more, text.len());
            Err(fault(span, "text behind the statement").help("give it a line of its own"))
        }
        _ => Ok(()),
    }
}
