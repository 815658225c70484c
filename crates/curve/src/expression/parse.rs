//! The parser of formulas: text to tree, by recursive descent.

use super::error::ExpressionError;
use super::tree::{Function, Node};
use core::f64::consts::{E, PI, TAU};
use core::ops::Range;

/// Nesting of parentheses, signs and operators at most: evaluation walks the tree by recursion.
const MAX_DEPTH: usize = 200;

const CONSTANTS: [(&str, f64); 3] = [("pi", PI), ("tau", TAU), ("e", E)];

pub(super) fn parse(text: &str, variables: &[&str]) -> Result<Node, ExpressionError> {
    let mut parser = Parser {
        text,
        at: 0,
        variables,
        depth: 0,
    };
    let node = parser.sum()?;
    parser.skip_blanks();
    if parser.at < text.len() {
        return Err(parser.unexpected());
    }
    Ok(node)
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    variables: &'a [&'a str],
    /// How deep in the tree what is read now stands.
    depth: usize,
}

type Parsed = Result<Node, ExpressionError>;

fn error(at: Range<usize>, message: String, help: &str) -> ExpressionError {
    ExpressionError {
        message,
        help: help.to_owned(),
        at,
    }
}

impl Parser<'_> {
    fn rest(&self) -> &str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    fn peek(&mut self) -> Option<char> {
        self.skip_blanks();
        self.rest().chars().next()
    }

    /// Takes one of these characters if it is next.
    fn take(&mut self, any: &[char]) -> Option<char> {
        let next = self.peek().filter(|c| any.contains(c))?;
        self.at += next.len_utf8();
        Some(next)
    }

    /// One level further down the tree.
    fn deeper(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(error(
                self.at..self.at,
                format!("the formula is nested more than {MAX_DEPTH} deep"),
                "use fewer terms or parentheses",
            ));
        }
        Ok(())
    }

    fn sum(&mut self) -> Parsed {
        let outside = self.depth;
        let mut left = self.product()?;
        while let Some(operator) = self.take(&['+', '-']) {
            self.deeper()?;
            let (a, b) = (Box::new(left), Box::new(self.product()?));
            left = if operator == '+' {
                Node::Sum(a, b)
            } else {
                Node::Difference(a, b)
            };
        }
        self.depth = outside;
        Ok(left)
    }

    fn product(&mut self) -> Parsed {
        let outside = self.depth;
        let mut left = self.signed()?;
        while let Some(operator) = self.take(&['*', '/']) {
            if let Some(second) = self.take(&['*']) {
                return Err(error(
                    self.at - 2..self.at,
                    format!("`{operator}{second}` is no operator"),
                    "write ^ for a power",
                ));
            }
            self.deeper()?;
            let (a, b) = (Box::new(left), Box::new(self.signed()?));
            left = if operator == '*' {
                Node::Product(a, b)
            } else {
                Node::Quotient(a, b)
            };
        }
        self.depth = outside;
        Ok(left)
    }

    fn signed(&mut self) -> Parsed {
        let Some(sign) = self.take(&['+', '-']) else {
            return self.power();
        };
        self.deeper()?;
        let operand = self.signed()?;
        self.depth -= 1;
        Ok(if sign == '-' {
            Node::Negated(Box::new(operand))
        } else {
            operand
        })
    }

    fn power(&mut self) -> Parsed {
        let base = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(base);
        }
        self.deeper()?;
        let exponent = self.signed()?;
        self.depth -= 1;
        let whole = exponent.constant().and_then(whole);
        Ok(match (whole, exponent.constant()) {
            (Some(exponent), _) => Node::WholePower(Box::new(base), exponent),
            (None, Some(half)) if half.to_bits() == 0.5_f64.to_bits() => {
                Node::Call(Function::Sqrt, Box::new(base))
            }
            _ => Node::Power(Box::new(base), Box::new(exponent)),
        })
    }

    fn atom(&mut self) -> Parsed {
        let Some(next) = self.peek() else {
            return Err(error(
                self.at..self.at,
                "the formula ends where a number, a variable or a function is wanted".to_owned(),
                "complete it",
            ));
        };
        let start = self.at;
        if next == '(' {
            self.at += 1;
            self.deeper()?;
            let inside = self.sum()?;
            self.depth -= 1;
            self.close(start)?;
            return Ok(inside);
        }
        if next.is_ascii_digit() || next == '.' {
            return self.number();
        }
        if next.is_alphabetic() || next == '_' {
            return self.name();
        }
        Err(self.unexpected())
    }

    fn number(&mut self) -> Parsed {
        let start = self.at;
        let bytes = self.rest().as_bytes();
        let digits = |from: usize| {
            bytes[from..]
                .iter()
                .take_while(|b| b.is_ascii_digit())
                .count()
        };
        let mut length = digits(0);
        if bytes.get(length) == Some(&b'.') {
            length += 1 + digits(length + 1);
        }
        if matches!(bytes.get(length), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
            let exponent = digits((length + 1 + sign).min(bytes.len()));
            if exponent > 0 {
                length += 1 + sign + exponent;
            }
        }
        self.at += length;
        let text = &self.text[start..self.at];
        let followed = self.rest().chars().next();
        let foreign = followed.filter(|c| c.is_alphanumeric() || *c == '.' || *c == '(');
        if let Some(foreign) = foreign {
            return Err(error(
                start..self.at + foreign.len_utf8(),
                format!("`{text}` is followed by what does not belong to a number"),
                "write * between factors",
            ));
        }
        text.parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .map(Node::Constant)
            .ok_or_else(|| {
                error(
                    start..self.at,
                    format!("`{text}` is not a number"),
                    "write a decimal number such as 0.5 or 1e-3",
                )
            })
    }

    fn name(&mut self) -> Parsed {
        let start = self.at;
        let length: usize = self
            .rest()
            .chars()
            .take_while(|c| c.is_alphanumeric() || *c == '_')
            .map(char::len_utf8)
            .sum();
        self.at += length;
        let name = &self.text[start..self.at];
        let place = start..self.at;
        if let Some(i) = self.variables.iter().position(|known| *known == name) {
            return Ok(Node::Variable(i));
        }
        if let Some((_, value)) = CONSTANTS.iter().find(|(known, _)| *known == name) {
            return Ok(Node::Constant(*value));
        }
        let function = Function::named(name);
        if function.is_none() && name != "atan2" {
            return Err(self.unknown(place));
        }
        let name = name.to_owned();
        if self.take(&['(']).is_none() {
            return Err(error(
                place,
                format!("the function {name} has no argument"),
                "write the argument in parentheses",
            ));
        }
        self.deeper()?;
        let first = Box::new(self.sum()?);
        let node = match function {
            Some(function) => Node::Call(function, first),
            None => {
                if self.take(&[',']).is_none() {
                    return Err(error(
                        place,
                        "atan2 has two arguments".to_owned(),
                        "write atan2(y, x)",
                    ));
                }
                Node::Atan2(first, Box::new(self.sum()?))
            }
        };
        self.depth -= 1;
        self.close(start)?;
        Ok(node)
    }

    /// Takes the parenthesis that closes what began at `opened`.
    fn close(&mut self, opened: usize) -> Result<(), ExpressionError> {
        if self.take(&[')']).is_some() {
            return Ok(());
        }
        if self.peek().is_some() {
            return Err(self.unexpected());
        }
        Err(error(
            opened..self.text.len(),
            "a parenthesis is not closed".to_owned(),
            "add the missing )",
        ))
    }

    fn unexpected(&mut self) -> ExpressionError {
        let next = self.peek().unwrap_or(' ');
        let help = match next {
            ')' => "remove it, or open it before",
            c if c.is_alphanumeric() || c == '(' => "write * between factors",
            ',' => "only atan2 has two arguments; decimals are written with a point",
            _ => "operators are + - * / ^",
        };
        error(
            self.at..self.at + next.len_utf8(),
            format!("`{next}` is not expected here"),
            help,
        )
    }

    fn unknown(&self, place: Range<usize>) -> ExpressionError {
        let name = &self.text[place.clone()];
        let lower = name.to_lowercase();
        let names: Vec<&str> = self
            .variables
            .iter()
            .copied()
            .chain(CONSTANTS.iter().map(|(name, _)| *name))
            .chain(Function::ALL.iter().map(|(name, _)| *name))
            .chain(["atan2"])
            .collect();
        let help = match lower.as_str() {
            "abs" | "min" | "max" | "floor" | "ceil" | "round" | "sign" | "mod" => {
                "only smooth functions can be used: split the curve at its corners".to_owned()
            }
            "log" => "write ln or log10".to_owned(),
            lower if names.contains(&lower) => format!("write `{lower}`"),
            _ => format!("known are {}", names.join(" ")),
        };
        ExpressionError {
            message: format!("`{name}` is not known"),
            help,
            at: place,
        }
    }
}

/// A whole number that can be an exponent.
fn whole(value: f64) -> Option<i32> {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "whole and small, or not taken"
    )]
    let truncated = value as i32;
    (f64::from(truncated).to_bits() == value.to_bits() && truncated.unsigned_abs() <= 1000)
        .then_some(truncated)
}
