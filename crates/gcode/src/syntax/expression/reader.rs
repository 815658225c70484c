//! Reads a value from left to right, by recursive descent with a bounded depth.

use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::fault::{Fault, Outcome};
use crate::diagnostic::span::SourceSpan;
use crate::syntax::cursor::Cursor;
use crate::syntax::expression::function::{Function, evaluate, function};
use crate::syntax::expression::name::name;
use crate::syntax::expression::operator::{OPERATORS, apply};
use crate::syntax::expression::scope::{Parameter, Scope, no_parameter};

/// Deepest nesting of brackets and of `#` of `#`.
const MAX_DEPTH: u32 = 64;

pub(crate) struct Reader<'c, 't, 's> {
    pub(super) cursor: &'c mut Cursor<'t>,
    pub(super) scope: &'s dyn Scope,
    pub(super) depth: u32,
}

impl Reader<'_, '_, '_> {
    fn deeper(&mut self) -> Outcome<()> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let span = SourceSpan::new(self.cursor.at(), self.cursor.at() + 1);
        let message = format!("more than {MAX_DEPTH} levels of brackets");
        Err(Fault::new(DiagnosticCode::Expression, span, message)
            .because("the depth of expressions is bounded")
            .help("compute parts of it into parameters first"))
    }

    /// A value: sign, then number, parameter, bracket or function.
    pub(super) fn primary(&mut self, word: usize) -> Outcome<f64> {
        match self.cursor.next_visible() {
            Some(b'#') => self.parameter_value(),
            Some(b'[') => self.bracket(),
            Some(sign @ (b'+' | b'-')) => {
                self.deeper()?;
                self.cursor.advance();
                let value = self.primary(word)?;
                self.depth -= 1;
                Ok(if sign == b'-' { -value } else { value })
            }
            Some(letter) if letter.is_ascii_alphabetic() => {
                let start = self.cursor.at();
                match function(self.cursor) {
                    Some(function) => self.call(function, start),
                    None => self.cursor.literal(word),
                }
            }
            _ => self.cursor.literal(word),
        }
    }

    pub(super) fn parameter(&mut self) -> Outcome<Parameter> {
        let start = self.cursor.at();
        self.deeper()?;
        self.cursor.advance();
        if self.cursor.next_visible() == Some(b'<') {
            let name = name(self.cursor)?;
            self.depth -= 1;
            return Ok(Parameter::Named(name));
        }
        let number = self.primary(start)?;
        self.depth -= 1;
        let nearest = number.round();
        if (number - nearest).abs() > 1e-4 || !(1.0..=f64::from(u32::MAX)).contains(&nearest) {
            return Err(no_parameter(
                SourceSpan::new(start, self.cursor.end_of_word()),
                number,
            ));
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "range checked"
        )]
        Ok(Parameter::Numbered(nearest as u32))
    }

    fn parameter_value(&mut self) -> Outcome<f64> {
        let start = self.cursor.at();
        let parameter = self.parameter()?;
        let span = SourceSpan::new(start, self.cursor.end_of_word());
        match parameter {
            Parameter::Numbered(number) => self
                .scope
                .numbered(number)
                .ok_or_else(|| no_parameter(span, f64::from(number))),
            Parameter::Named(name) => self.scope.named(&name).ok_or_else(|| {
                Fault::new(
                    DiagnosticCode::Parameter,
                    span,
                    format!("the parameter <{name}> has no value"),
                )
                .because("a named parameter has a value from its first assignment on")
                .help("assign it first, or ask with EXISTS")
            }),
        }
    }

    /// An expression in brackets, `[` next.
    fn bracket(&mut self) -> Outcome<f64> {
        let start = self.cursor.at();
        self.deeper()?;
        self.cursor.advance();
        let value = self.level(1)?;
        self.depth -= 1;
        if self.cursor.next_visible() == Some(b']') {
            self.cursor.advance();
            return Ok(value);
        }
        let span = SourceSpan::new(start, self.cursor.at().max(start + 1));
        Err(Fault::new(
            DiagnosticCode::Expression,
            span,
            "the bracket is not closed",
        )
        .because("an expression ends with its `]` in the same line")
        .help("add `]`, or an operator between two values"))
    }

    /// Operators of at least the given strength.
    pub(super) fn level(&mut self, strength: u8) -> Outcome<f64> {
        let bracket = self.cursor.at().saturating_sub(1);
        let mut left = self.primary(bracket)?;
        loop {
            self.cursor.next_visible();
            let start = self.cursor.at();
            let mut ahead = *self.cursor;
            let found = OPERATORS
                .into_iter()
                .find(|(name, _, _)| ahead.eat_word(name));
            let Some((_, operator, own)) = found.filter(|(_, _, own)| *own >= strength) else {
                return Ok(left);
            };
            *self.cursor = ahead;
            self.deeper()?;
            let right = if own == 5 {
                self.primary(start)?
            } else {
                self.level(own + 1)?
            };
            self.depth -= 1;
            left = apply(
                operator,
                left,
                right,
                SourceSpan::new(start, self.cursor.at()),
            )?;
        }
    }

    /// A function whose bracket comes next.
    fn call(&mut self, function: Function, start: usize) -> Outcome<f64> {
        if function == Function::Exists {
            return self.exists(start);
        }
        let x = self.bracket()?;
        let mut second = None;
        if function == Function::Atan {
            self.cursor.next_visible();
            if !self.cursor.eat_word(b"/") || self.cursor.next_visible() != Some(b'[') {
                let span = SourceSpan::new(start, self.cursor.at());
                return Err(
                    Fault::new(DiagnosticCode::Expression, span, "ATAN with one argument")
                        .because("ATAN takes two, so that it knows the quadrant")
                        .help("write ATAN[y]/[x]"),
                );
            }
            second = Some(self.bracket()?);
        }
        evaluate(
            function,
            x,
            second,
            SourceSpan::new(start, self.cursor.at()),
        )
    }

    fn exists(&mut self, start: usize) -> Outcome<f64> {
        self.cursor.next_visible();
        self.cursor.advance();
        if self.cursor.next_visible() == Some(b'#')
            && let Parameter::Named(name) = self.parameter()?
            && self.cursor.next_visible() == Some(b']')
        {
            self.cursor.advance();
            return Ok(f64::from(u8::from(self.scope.named(&name).is_some())));
        }
        let span = SourceSpan::new(start, self.cursor.at());
        Err(Fault::new(
            DiagnosticCode::Expression,
            span,
            "EXISTS of something else than one name",
        )
        .because("only a named parameter can be without a value")
        .help("write EXISTS[#<name>]"))
    }
}
