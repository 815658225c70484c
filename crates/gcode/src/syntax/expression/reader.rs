//! The reader of a value, from left to right, by recursive descent with a bounded depth.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::cursor::Cursor;
use crate::syntax::dialect::Dialect;
use crate::syntax::expression::function::{Function, evaluate, function};
use crate::syntax::expression::name::name;
use crate::syntax::expression::operator::{COMPARISON, apply, operators};
use crate::syntax::expression::scope::{Parameter, Scope, no_parameter};

/// Deepest nesting of brackets and of `#` of `#`.
const MAX_DEPTH: u32 = 64;

pub(crate) struct Reader<'c, 't, 's> {
    pub(super) cursor: &'c mut Cursor<'t>,
    pub(super) scope: &'s dyn Scope,
    pub(super) depth: u32,
    /// What FANUC's ROUND rounds to.
    pub(super) rounds_to: f64,
}

impl Reader<'_, '_, '_> {
    fn deeper(&mut self) -> Outcome<()> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let span = SourceSpan::new(self.cursor.at(), self.cursor.at() + 1);
        let message = format!("more than {MAX_DEPTH} levels of brackets");
        Err(
            BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                .because("the depth of expressions is bounded")
                .help("compute parts of it into parameters first"),
        )
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
                match function(self.cursor, self.scope.dialect()) {
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
            if self.scope.dialect() == Dialect::Fanuc {
                return Err(no_name(SourceSpan::new(start, self.cursor.at())));
            }
            return Ok(Parameter::Named(name));
        }
        if self.scope.dialect() == Dialect::Fanuc
            && matches!(self.cursor.peek(), Some(b'A'..=b'Z' | b'a'..=b'z' | b'_'))
        {
            self.depth -= 1;
            return self.named_variable(start);
        }
        let number = self.primary(start)?;
        self.depth -= 1;
        let nearest = number.round();
        // FANUC's #0 is the null.
        let least = f64::from(u8::from(self.scope.dialect() != Dialect::Fanuc));
        if (number - nearest).abs() > 1e-4 || !(least..=f64::from(u32::MAX)).contains(&nearest) {
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

    /// The variable of a name that SETVN gave: `#DEPTH`.
    fn named_variable(&mut self, start: usize) -> Outcome<Parameter> {
        let mut name = String::new();
        while let Some(byte) = self.cursor.peek() {
            if !byte.is_ascii_alphanumeric() && byte != b'_' {
                break;
            }
            name.push(char::from(byte));
            self.cursor.advance();
        }
        let number = self.scope.named_number(&name);
        number.map(Parameter::Numbered).ok_or_else(|| {
            let span = SourceSpan::new(start, self.cursor.at());
            let message = format!("there is no variable #{name}");
            BlockDiagnostic::new(DiagnosticCode::Parameter, span, message)
                .because("names of variables are those that SETVN gave; what the control itself names is not known here")
                .help("write its number, or name it by SETVN before")
        })
    }

    fn parameter_value(&mut self) -> Outcome<f64> {
        let start = self.cursor.at();
        let parameter = self.parameter()?;
        let span = SourceSpan::new(start, self.cursor.end_of_word());
        match parameter {
            Parameter::Numbered(number) => match self.scope.refuses(number) {
                Some(why) => Err(BlockDiagnostic::new(
                    DiagnosticCode::Parameter,
                    span,
                    format!("#{number} cannot be read"),
                )
                .because(why)
                .help("compute what it is for without it")),
                None => self
                    .scope
                    .numbered(number)
                    .ok_or_else(|| no_parameter(span, f64::from(number))),
            },
            Parameter::Named(name) => self.scope.named(&name).ok_or_else(|| {
                BlockDiagnostic::new(
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
        Err(BlockDiagnostic::new(
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
        let mut has_compared = false;
        loop {
            self.cursor.next_visible();
            let start = self.cursor.at();
            let mut ahead = *self.cursor;
            let found = operators(self.scope.dialect())
                .iter()
                .find(|(name, _, _)| ahead.eat_word(name));
            let Some(&(_, operator, own)) = found.filter(|(_, _, own)| *own >= strength) else {
                return Ok(left);
            };
            *self.cursor = ahead;
            if own == COMPARISON && self.scope.dialect() == Dialect::Fanuc {
                if has_compared {
                    return Err(second_comparison(SourceSpan::new(start, self.cursor.at())));
                }
                has_compared = true;
            }
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
        let (x, mut second) = self.arguments(function)?;
        let divides = function == Function::Atan && second.is_none();
        if divides {
            self.cursor.next_visible();
            let mut ahead = *self.cursor;
            if ahead.eat_word(b"/") && ahead.next_visible() == Some(b'[') {
                *self.cursor = ahead;
                second = Some(self.bracket()?);
            } else if self.scope.dialect() != Dialect::Fanuc {
                let span = SourceSpan::new(start, self.cursor.at());
                return Err(BlockDiagnostic::new(
                    DiagnosticCode::Expression,
                    span,
                    "ATAN with one argument",
                )
                .because("ATAN takes two, so that it knows the quadrant")
                .help("write ATAN[y]/[x]"));
            }
        }
        let span = SourceSpan::new(start, self.cursor.at());
        let value = evaluate(function, x, second, self.rounds_to, span)?;
        // ATAN from 0 to 360, ASIN from 270 to 90.
        let is_full = (function == Function::Atan && second.is_some()
            || function == Function::Asin)
            && self.scope.has_full_arctangent()
            && value < 0.0;
        Ok(if is_full { value + 360.0 } else { value })
    }

    /// The arguments in the brackets of a function: one, or two with a comma between them.
    fn arguments(&mut self, function: Function) -> Outcome<(f64, Option<f64>)> {
        let takes_two = self.scope.dialect() == Dialect::Fanuc
            && matches!(function, Function::Atan | Function::Pow);
        if !takes_two {
            return Ok((self.bracket()?, None));
        }
        let start = self.cursor.at();
        self.deeper()?;
        self.cursor.next_visible();
        self.cursor.advance();
        let outer = self.cursor.set_list(true);
        let x = self.level(1)?;
        let mut second = None;
        if self.cursor.next_visible() == Some(b',') {
            self.cursor.advance();
            second = Some(self.level(1)?);
        }
        self.cursor.set_list(outer);
        self.depth -= 1;
        let is_closed = self.cursor.next_visible() == Some(b']');
        if is_closed && (second.is_some() || function == Function::Atan) {
            self.cursor.advance();
            return Ok((x, second));
        }
        let span = SourceSpan::new(start, self.cursor.at().max(start + 1));
        Err(BlockDiagnostic::new(
            DiagnosticCode::Expression,
            span,
            "the arguments of the function are not complete",
        )
        .because("POW takes two, with a comma between them, and their bracket is closed")
        .help("write POW[a,b]"))
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
        Err(BlockDiagnostic::new(
            DiagnosticCode::Expression,
            span,
            "EXISTS of something else than one name",
        )
        .because("only a named parameter can be without a value")
        .help("write EXISTS[#<name>]"))
    }
}

/// AND, OR and XOR of FANUC are done before comparisons, bit by bit.
#[cold]
fn second_comparison(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a second comparison in one bracket";
    BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
        .because("a FANUC takes AND, OR and XOR before comparisons, so that they would join the values beside them")
        .help("write brackets round each comparison: [[#1 EQ 5] AND [#2 EQ 3]]")
}

#[cold]
fn no_name(span: SourceSpan) -> Box<BlockDiagnostic> {
    BlockDiagnostic::new(
        DiagnosticCode::Parameter,
        span,
        "a variable with a name in < >",
    )
    .because("FANUC's variables have numbers; names in < > are LinuxCNC's")
    .help("use #100 to #199, or #500 to #999")
}
