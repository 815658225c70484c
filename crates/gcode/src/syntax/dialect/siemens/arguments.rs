//! The arguments in parentheses: numbers, variables, places that are left out, texts in quotes.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::expression::{Evaluator, unclosed};
use crate::syntax::dialect::siemens::variables::Declared;

/// Most arguments of a call.
const MAX_ARGUMENTS: usize = 40;

/// Numbers, and texts in their places; `None` where an argument is another kind or left out.
type Arguments = (Vec<Option<f64>>, Vec<Option<Vec<u8>>>);

/// An argument of a call of a subprogram.
#[derive(Debug, Clone)]
pub(crate) struct Argument {
    /// Its value; `None`: it is an array.
    pub(crate) value: Option<f64>,
    /// The variable that it is, which a parameter of VAR stands for.
    pub(crate) variable: Option<Declared>,
}

impl Argument {
    pub(crate) const fn of_value(value: f64) -> Self {
        Self {
            value: Some(value),
            variable: None,
        }
    }
}

impl Evaluator<'_> {
    /// What is in the parentheses that begin here; `None` where an argument is left out.
    pub(crate) fn arguments(&mut self) -> Outcome<Vec<Option<f64>>> {
        self.list_of(Self::value)
    }

    /// The same of a call of a subprogram, which may be given variables.
    pub(crate) fn call_arguments(&mut self) -> Outcome<Vec<Option<Argument>>> {
        self.list_of(Self::call_argument)
    }

    fn call_argument(&mut self) -> Outcome<Argument> {
        let Some(variable) = self.whole_variable()? else {
            return Ok(Argument::of_value(self.value()?));
        };
        let is_array = !variable.sizes.is_empty();
        let value = (!is_array).then(|| self.read(&variable.element(0)));
        Ok(Argument {
            value,
            variable: Some(variable),
        })
    }

    fn list_of<T>(
        &mut self,
        argument: impl Fn(&mut Self) -> Outcome<T>,
    ) -> Outcome<Vec<Option<T>>> {
        let start = self.at;
        let mut arguments = Vec::new();
        if !self.eat(b'(') {
            return Ok(arguments);
        }
        loop {
            let value = match self.next_visible() {
                Some(b',' | b')') => None,
                _ => Some(argument(self)?),
            };
            arguments.push(value);
            let ends = self.next_visible() == Some(b')');
            if ends || arguments.len() >= MAX_ARGUMENTS || self.peek(0) != Some(b',') {
                if self.eat(b')') {
                    return Ok(arguments);
                }
                return Err(unclosed(
                    SourceSpan::new(start, self.at.max(start + 1)),
                    ")",
                ));
            }
            self.at += 1;
        }
    }

    /// The same where some of them are texts in quotes: the numbers, and the texts in their places.
    pub(crate) fn arguments_and_texts(&mut self) -> Outcome<Arguments> {
        let start = self.at;
        let (mut numbers, mut texts) = (Vec::new(), Vec::new());
        if !self.eat(b'(') {
            return Ok((numbers, texts));
        }
        loop {
            let (mut number, mut text) = (None, None);
            match self.next_visible() {
                Some(b',' | b')') => {}
                Some(b'"') => text = Some(self.text_in_quotes()?),
                _ => number = Some(self.value()?),
            }
            numbers.push(number);
            texts.push(text);
            if self.eat(b')') {
                return Ok((numbers, texts));
            }
            if numbers.len() >= MAX_ARGUMENTS || !self.eat(b',') {
                return Err(unclosed(
                    SourceSpan::new(start, self.at.max(start + 1)),
                    ")",
                ));
            }
        }
    }

    /// A text whose first quote comes next, without its quotes.
    pub(crate) fn text_in_quotes(&mut self) -> Outcome<Vec<u8>> {
        let start = self.at;
        let rest = self.text.get(start + 1..).unwrap_or_default();
        let Some(length) = rest.iter().position(|byte| *byte == b'"') else {
            let span = SourceSpan::new(start, self.text.len().max(start + 1));
            return Err(BlockDiagnostic::new(
                DiagnosticCode::Expression,
                span,
                "the text is not closed",
            )
            .because("a text stands between two quotes")
            .help("add `\"`"));
        };
        self.at = start + length + 2;
        Ok(rest.get(..length).unwrap_or_default().to_vec())
    }
}
