//! PROC: the first line of a subprogram, with the names of its parameters.

use std::io::BufRead;

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::execute::dialect::siemens::flow::fault;
use crate::execute::program::Program;
use crate::syntax::dialect::siemens::variables::Kind;

/// A parameter: its name, its kind, and the value that it has where the call leaves it out.
type ProcParameter = (Vec<u8>, Kind, f64);

impl<R: BufRead> Program<R> {
    /// `PROC NAME(REAL A, INT B=2) SAVE`: gives the names the values of the call.
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
        for (index, (name, kind, default)) in parameters.into_iter().enumerate() {
            let declared = self
                .siemens
                .variables
                .declare(&name, kind, Vec::new(), span)?;
            let parameter = declared.element(0);
            self.parameters.check_assignable(&parameter, span)?;
            let value = arguments.get(index).copied().flatten().unwrap_or(default);
            self.parameters.assign(&parameter, kind.of(value));
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

    /// The parameters that PROC names, with their kinds and values, and whether it says SAVE.
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
                let word = input.name_ahead();
                input.at += word.len();
                let Some(kind) = Kind::named(&word) else {
                    return Err(no_parameter(&word, start));
                };
                input.next_visible();
                let name = input.name_ahead();
                input.at += name.len();
                if input.next_visible() == Some(b'[') {
                    return Err(no_parameter(b"an array", start));
                }
                let default = if input.eat(b'=') { input.value()? } else { 0.0 };
                parameters.push((name, kind, default));
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

#[cold]
fn no_parameter(word: &[u8], start: usize) -> Box<BlockDiagnostic> {
    let shown = String::from_utf8_lossy(word).into_owned();
    let span = SourceSpan::new(start, start + word.len().max(1));
    let message = format!("a parameter of PROC that is {shown}");
    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
        .because("parameters are REAL, INT or BOOL, and have the value of the call (no VAR)")
        .help("give results back by R parameters")
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
