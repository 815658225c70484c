//! Expressions as SINUMERIK writes them.
//!
//! ```text
//! value    = term [ ( "==" | "<>" | "<" | "<=" | ">" | ">=" ) term ]
//! term     = operand { operator operand }
//! operand  = [ "+" | "-" | NOT | B_NOT ] ( number | "(" value ")" | R5 | R[value] | NAME | $PI | TRUE | FALSE
//!          | FUNCTION "(" value { "," value } ")" )
//! ```
//!
//! Texts are compared as values are ([`text`](super::text)). Operators, strongest first: `*` `/` `DIV`
//! `MOD`; `+` `-`; `B_AND`; `B_XOR`; `B_OR`; `AND`; `XOR`; `OR`. Comparisons bind
//! weaker than all of them on this control, other than in most languages, so that `R1>5 AND R2<3`
//! would not be what it looks like: beside a comparison these want parentheses here. Angles are in
//! degrees. A comparison gives 1 or 0, and two values are equal if they differ by less than 1e-12 of
//! the greater.

use crate::diagnostic::block_diagnostic::{BlockDiagnostic, Outcome};
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::bad_byte::bad_byte;
use crate::syntax::cursor::MAX_NUMBER;
use crate::syntax::dialect::siemens::function::{FUNCTIONS, Function};
use crate::syntax::dialect::siemens::operator::{
    Compare, LOGIC, OPERATORS, Operator, apply, bits, comparison, finite,
};
use crate::syntax::dialect::siemens::system_index::not_known;
use crate::syntax::dialect::siemens::text_variables::TextAssignment;
use crate::syntax::dialect::siemens::variables::Variables;
use crate::syntax::expression::scope::{Parameter, Scope};

/// Deepest nesting of parentheses and signs.
const MAX_DEPTH: u32 = 64;
/// Where values come from.
#[derive(Clone, Copy)]
pub(crate) struct Names<'a> {
    pub(crate) variables: &'a Variables,
    pub(crate) scope: &'a dyn Scope,
    /// The line is of a subprogram, which M2, M17, M30 and RET end.
    pub(crate) in_subprogram: bool,
}

/// Reads a line from left to right and computes what is in it.
pub(crate) struct Evaluator<'a> {
    pub(crate) text: &'a [u8],
    pub(crate) at: usize,
    pub(super) names: Names<'a>,
    /// What the line has assigned so far: words behind it read that.
    pub(super) assigned: Vec<(Parameter, f64)>,
    pub(super) assigned_texts: Vec<TextAssignment>,
    depth: u32,
    /// The last operator of truth values in these parentheses.
    pub(super) logic: Option<SourceSpan>,
}

impl<'a> Evaluator<'a> {
    pub(crate) const fn new(text: &'a [u8], at: usize, names: Names<'a>) -> Self {
        Self {
            text,
            at,
            names,
            assigned: Vec::new(),
            assigned_texts: Vec::new(),
            depth: 0,
            logic: None,
        }
    }

    /// The byte that comes `ahead` bytes later, in capitals.
    pub(crate) fn peek(&self, ahead: usize) -> Option<u8> {
        let byte = self.text.get(self.at + ahead)?;
        Some(byte.to_ascii_uppercase())
    }

    /// Skips blanks, then tells what comes next.
    pub(crate) fn next_visible(&mut self) -> Option<u8> {
        while matches!(self.peek(0), Some(b' ' | b'\t')) {
            self.at += 1;
        }
        self.peek(0)
    }

    /// Letters, digits and what else may be in a name, from here on, in capitals.
    pub(crate) fn name_ahead(&self) -> Vec<u8> {
        (0..)
            .map_while(|ahead| self.peek(ahead))
            .take_while(|byte| matches!(byte, b'A'..=b'Z' | b'0'..=b'9' | b'_' | b'$'))
            .collect()
    }

    /// Skips a name if it comes next.
    pub(crate) fn eat_name(&mut self, name: &[u8]) -> bool {
        self.next_visible();
        let found = self.name_ahead() == name;
        if found {
            self.at += name.len();
        }
        found
    }

    /// Skips a byte if it comes next.
    pub(crate) fn eat(&mut self, byte: u8) -> bool {
        let found = self.next_visible() == Some(byte);
        self.at += usize::from(found);
        found
    }

    /// Whether the line, but for a comment, ends here.
    pub(crate) fn is_at_end(&mut self) -> bool {
        matches!(self.next_visible(), None | Some(b';'))
    }

    /// The value of the expression that begins here.
    pub(crate) fn value(&mut self) -> Outcome<f64> {
        self.next_visible();
        let start = self.at;
        let value = self.comparison()?;
        self.in_range(value, start)
    }

    fn in_range(&self, value: f64, start: usize) -> Outcome<f64> {
        if value.abs() > MAX_NUMBER {
            let message = format!("the value is {value}, which is too large");
            let span = SourceSpan::new(start, self.at);
            return Err(
                BlockDiagnostic::new(DiagnosticCode::NumberOutOfRange, span, message)
                    .because(format!(
                        "no word or parameter takes a value beyond ±{MAX_NUMBER}"
                    ))
                    .help("check the values it is computed from"),
            );
        }
        Ok(value)
    }

    /// The number with its sign that stands here without an equals sign.
    pub(crate) fn literal(&mut self) -> Outcome<f64> {
        let negative = self.next_visible() == Some(b'-');
        if matches!(self.peek(0), Some(b'+' | b'-')) {
            self.at += 1;
        }
        if !matches!(self.next_visible(), Some(b'0'..=b'9' | b'.')) {
            let span = SourceSpan::new(self.at.saturating_sub(1), self.at.max(1));
            let message = "a number is missing";
            return Err(
                BlockDiagnostic::new(DiagnosticCode::MissingNumber, span, message)
                    .because("a letter and its number make a word")
                    .help("write the number, or `=` and an expression"),
            );
        }
        let start = self.at;
        let value = self.number()?;
        let value = self.in_range(value, start)?;
        Ok(if negative { -value } else { value })
    }

    fn deeper(&mut self) -> Outcome<()> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let span = SourceSpan::new(self.at, self.at + 1);
        let message = format!("more than {MAX_DEPTH} levels of parentheses");
        Err(
            BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                .because("the depth of expressions is bounded")
                .help("compute parts of it into R parameters first"),
        )
    }

    pub(super) fn comparison(&mut self) -> Outcome<f64> {
        self.deeper()?;
        let outer = self.logic.take();
        let start = self.at;
        let is_text = self.is_text_next();
        let mut value = if is_text {
            self.compared_texts()?
        } else {
            self.level(1)?
        };
        let mut compared = is_text;
        if is_text && self.operator_ahead().is_some() {
            return Err(beside_comparison(SourceSpan::new(start, self.at)));
        }
        while let Some((compare, length)) = self.comparator() {
            let at = self.at;
            self.at += length;
            let right = self.level(1)?;
            if compared || self.logic.is_some() {
                let span = self.logic.unwrap_or(SourceSpan::new(at, at + length));
                return Err(beside_comparison(span));
            }
            compared = true;
            value = f64::from(u8::from(compare(value, right)));
        }
        self.logic = outer;
        self.depth -= 1;
        finite(value, SourceSpan::new(start, self.at))
    }

    /// The comparison that comes next, and how long it is.
    pub(super) fn comparator(&mut self) -> Option<(Compare, usize)> {
        let first = self.next_visible()?;
        comparison(first, self.peek(1))
    }

    /// The operator that comes next, its strength, and how long it is.
    fn operator_ahead(&mut self) -> Option<(Operator, u8, usize)> {
        let name = match self.next_visible() {
            Some(byte @ (b'*' | b'/' | b'+' | b'-')) => vec![byte],
            _ => self.name_ahead(),
        };
        let found = OPERATORS.into_iter().find(|(known, ..)| *known == name);
        found.map(|(known, operator, strength)| (operator, strength, known.len()))
    }

    /// Operators of at least the given strength.
    pub(super) fn level(&mut self, strength: u8) -> Outcome<f64> {
        let mut left = self.operand()?;
        loop {
            let found = self.operator_ahead();
            let start = self.at;
            let Some((operator, own, length)) = found.filter(|(_, own, _)| *own >= strength) else {
                return Ok(left);
            };
            self.at += length;
            let span = SourceSpan::new(start, self.at);
            if own <= LOGIC {
                self.logic = Some(span);
            }
            self.deeper()?;
            let right = self.level(own + 1)?;
            self.depth -= 1;
            left = apply(operator, left, right, SourceSpan::new(start, self.at))?;
        }
    }

    fn operand(&mut self) -> Outcome<f64> {
        if self.next_visible() == Some(b'\'') {
            return self.bits();
        }
        let start = self.at;
        match self.next_visible() {
            Some(sign @ (b'+' | b'-')) => {
                self.deeper()?;
                self.at += 1;
                let value = self.operand()?;
                self.depth -= 1;
                Ok(if sign == b'-' { -value } else { value })
            }
            Some(b'(') => {
                let start = self.at;
                self.at += 1;
                let value = self.comparison()?;
                if self.eat(b')') {
                    return Ok(value);
                }
                Err(unclosed(
                    SourceSpan::new(start, self.at.max(start + 1)),
                    ")",
                ))
            }
            Some(b'0'..=b'9' | b'.') => self.number(),
            Some(b'A'..=b'Z' | b'_' | b'$') => self.named(),
            Some(b'"') => {
                let span = SourceSpan::new(self.at, self.text.len());
                let fault =
                    BlockDiagnostic::new(DiagnosticCode::NotSupported, span, "a text in quotes");
                Err(fault
                    .because("a text stands in MSG( ), behind T=, GOTO and variables of DEF STRING, and is compared with texts")
                    .help("write a number, or a variable that has one"))
            }
            None | Some(b';' | b')' | b',' | b'=' | b'<' | b'>' | b'*' | b'/' | b']') => {
                let span = SourceSpan::new(start.saturating_sub(1), start.max(1));
                let fault =
                    BlockDiagnostic::new(DiagnosticCode::Expression, span, "a value is missing");
                Err(fault
                    .because("a number, a variable, a function or parentheses are needed there")
                    .help("write the value"))
            }
            Some(_) => Err(bad_byte(self.text, self.at)),
        }
    }

    /// A parameter, a variable, a constant or a function.
    fn named(&mut self) -> Outcome<f64> {
        let start = self.at;
        let name = self.name_ahead();
        if let Some((_, parameter)) = self.assignable()? {
            return Ok(self.read(&parameter));
        }
        self.at += name.len();
        match name.as_slice() {
            b"TRUE" => return Ok(1.0),
            b"FALSE" => return Ok(0.0),
            b"$PI" => return Ok(core::f64::consts::PI),
            b"NOT" => {
                self.deeper()?;
                self.logic = Some(SourceSpan::new(start, self.at));
                let value = self.operand()?;
                self.depth -= 1;
                return Ok(f64::from(u8::from(value == 0.0)));
            }
            b"B_NOT" => {
                self.deeper()?;
                let value = self.operand()?;
                self.depth -= 1;
                return Ok(f64::from(!bits(value, SourceSpan::new(start, self.at))?));
            }
            b"STRLEN" => return self.text_length(start),
            _ => {}
        }
        if name.first() == Some(&b'$') {
            let index = self.system_index()?;
            let value = self.names.scope.system_value(&name, &index);
            return value.ok_or_else(|| not_known(&name, SourceSpan::new(start, self.at)));
        }
        let span = SourceSpan::new(start, self.at);
        let function = FUNCTIONS.into_iter().find(|(known, ..)| *known == name);
        let Some((_, function, count)) = function.filter(|_| self.next_visible() == Some(b'('))
        else {
            let shown = String::from_utf8_lossy(&name).into_owned();
            let message = format!("{shown} is not supported in an expression");
            return Err(BlockDiagnostic::new(DiagnosticCode::NotSupported, span, message)
                .because(
                    "expressions have numbers, R parameters, variables of DEF REAL, INT and BOOL, \
                     operators and functions; texts are compared with texts",
                )
                .help("declare it by DEF, or write the value"));
        };
        self.call(function, count, start)
    }

    fn call(&mut self, function: Function, count: usize, start: usize) -> Outcome<f64> {
        self.deeper()?;
        let outer = self.logic.take();
        let arguments = self.arguments()?;
        self.logic = outer;
        self.depth -= 1;
        let span = SourceSpan::new(start, self.at);
        let given: Vec<f64> = arguments.iter().flatten().copied().collect();
        if arguments.len() != count || given.len() != count {
            let message = format!("{} arguments in the place of {count}", given.len());
            return Err(
                BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
                    .because("a function has a fixed number of arguments")
                    .help("write them with commas between them"),
            );
        }
        finite(function.of(&given), span)
    }

    /// What a variable holds where it is read: words in front of it may have assigned it.
    pub(super) fn read(&self, parameter: &Parameter) -> f64 {
        let own = self.assigned.iter().rev().find(|(it, _)| it == parameter);
        if let Some((_, value)) = own {
            return *value;
        }
        let scope = self.names.scope;
        let value = match parameter {
            Parameter::Numbered(number) => scope.numbered(*number),
            Parameter::Named(name) => scope.named(name),
        };
        value.unwrap_or(0.0)
    }
}

#[cold]
fn beside_comparison(span: SourceSpan) -> Box<BlockDiagnostic> {
    let message = "a comparison beside another one, or beside AND, OR or XOR";
    BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
        .because(
            "on a SINUMERIK comparisons bind weakest, so that it does not mean what it looks like",
        )
        .help("put each comparison into parentheses: (R1>5) AND (R2<3)")
}

pub(super) fn unclosed(span: SourceSpan, with: &str) -> Box<BlockDiagnostic> {
    let message = "the parenthesis is not closed";
    BlockDiagnostic::new(DiagnosticCode::Expression, span, message)
        .because("an expression ends in its own line")
        .help(format!("add `{with}`, or an operator between two values"))
}
