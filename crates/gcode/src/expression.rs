//! Values: numbers, parameters and bracketed expressions.
//!
//! ```text
//! value     = [sign] ( number | parameter | "[" expression "]" | function )
//! parameter = "#" ( value | "<" name ">" )
//! function  = NAME "[" expression "]" | "ATAN[" expression "]/[" expression "]"
//!           | "EXISTS[#<" name ">]"
//! ```
//!
//! Operators, strongest first, each level from the left: `**`; `*` `/` `MOD`; `+` `-`; `EQ` `NE`
//! `GT` `GE` `LT` `LE`; `AND` `OR` `XOR`. Angles are in degrees. A comparison gives 1 or 0, and
//! two values are equal if they differ by less than 1e-6. A result that is no finite number is an
//! error at the operator that made it.

use crate::cursor::Cursor;
use crate::diagnostic::{Code, Fault, Outcome, Span};
use crate::operation::{FUNCTIONS, Function, OPERATORS, apply, evaluate};

/// Deepest nesting of brackets and of `#` of `#`.
const MAX_DEPTH: u32 = 64;

/// Longest name of a parameter or subroutine, bytes.
pub(crate) const MAX_NAME: usize = 128;

/// Where the values of parameters come from.
pub(crate) trait Scope {
    /// Value of a numbered parameter; `None`: there is no such number.
    fn numbered(&self, number: u32) -> Option<f64>;
    /// Value of a named parameter; `None`: it has none.
    fn named(&self, name: &str) -> Option<f64>;
}

/// Which parameter.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Parameter {
    Numbered(u32),
    Named(String),
}

/// Reads the value of the word whose letter is at `word`.
pub(crate) fn value(cursor: &mut Cursor<'_>, word: usize, scope: &dyn Scope) -> Outcome<f64> {
    if matches!(cursor.next_visible(), Some(b'0'..=b'9' | b'.')) {
        return cursor.number(word);
    }
    if !starts_computed(*cursor) {
        return cursor.number(word);
    }
    let start = cursor.at();
    let value = Reader {
        cursor,
        scope,
        depth: 0,
    }
    .primary(word)?;
    if value.abs() > crate::MAX_NUMBER {
        let span = Span::new(start, cursor.end_of_word());
        let message = format!("the value is {value}, which is too large");
        return Err(Fault::new(Code::NumberOutOfRange, span, message)
            .because(format!(
                "no word or parameter takes a value beyond ±{}",
                crate::MAX_NUMBER
            ))
            .help("check the values it is computed from"));
    }
    Ok(value)
}

/// True if what comes next, a sign apart, is a parameter, a bracket or a function.
fn starts_computed(mut cursor: Cursor<'_>) -> bool {
    while matches!(cursor.next_visible(), Some(b'+' | b'-')) {
        cursor.advance();
    }
    match cursor.next_visible() {
        Some(b'#' | b'[') => true,
        Some(letter) if letter.is_ascii_alphabetic() => function(&mut cursor).is_some(),
        _ => false,
    }
}

/// Skips a function name, if its bracket follows.
fn function(cursor: &mut Cursor<'_>) -> Option<Function> {
    FUNCTIONS.into_iter().find_map(|(name, function)| {
        let mut ahead = *cursor;
        (ahead.eat_word(name) && ahead.next_visible() == Some(b'[')).then(|| {
            *cursor = ahead;
            function
        })
    })
}

/// Reads a parameter whose `#` comes next.
pub(crate) fn parameter(cursor: &mut Cursor<'_>, scope: &dyn Scope) -> Outcome<Parameter> {
    Reader {
        cursor,
        scope,
        depth: 0,
    }
    .parameter()
}

/// Reads a name whose `<` comes next: lower case, without blanks.
pub(crate) fn name(cursor: &mut Cursor<'_>) -> Outcome<String> {
    let start = cursor.at();
    cursor.advance();
    let mut name = String::new();
    loop {
        match cursor.next_visible() {
            Some(b'>') => {
                cursor.advance();
                return Ok(name);
            }
            Some(byte @ (b'!'..=b'~')) if byte != b'(' && name.len() < MAX_NAME => {
                name.push(char::from(byte.to_ascii_lowercase()));
                cursor.advance();
            }
            _ => {
                let span = Span::new(start, cursor.at());
                return Err(Fault::new(Code::Expression, span, "the name is not closed")
                    .because(format!(
                        "a name is ASCII text of up to {MAX_NAME} bytes in < >"
                    ))
                    .help("add `>`"));
            }
        }
    }
}

struct Reader<'c, 't, 's> {
    cursor: &'c mut Cursor<'t>,
    scope: &'s dyn Scope,
    depth: u32,
}

impl Reader<'_, '_, '_> {
    fn deeper(&mut self) -> Outcome<()> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let span = Span::new(self.cursor.at(), self.cursor.at() + 1);
        let message = format!("more than {MAX_DEPTH} levels of brackets");
        Err(Fault::new(Code::Expression, span, message)
            .because("the depth of expressions is bounded")
            .help("compute parts of it into parameters first"))
    }

    /// A value: sign, then number, parameter, bracket or function.
    fn primary(&mut self, word: usize) -> Outcome<f64> {
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

    fn parameter(&mut self) -> Outcome<Parameter> {
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
                Span::new(start, self.cursor.end_of_word()),
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
        let span = Span::new(start, self.cursor.end_of_word());
        match parameter {
            Parameter::Numbered(number) => self
                .scope
                .numbered(number)
                .ok_or_else(|| no_parameter(span, f64::from(number))),
            Parameter::Named(name) => self.scope.named(&name).ok_or_else(|| {
                Fault::new(
                    Code::Parameter,
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
        let span = Span::new(start, self.cursor.at().max(start + 1));
        Err(
            Fault::new(Code::Expression, span, "the bracket is not closed")
                .because("an expression ends with its `]` in the same line")
                .help("add `]`, or an operator between two values"),
        )
    }

    /// Operators of at least the given strength.
    fn level(&mut self, strength: u8) -> Outcome<f64> {
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
            left = apply(operator, left, right, Span::new(start, self.cursor.at()))?;
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
                let span = Span::new(start, self.cursor.at());
                return Err(Fault::new(Code::Expression, span, "ATAN with one argument")
                    .because("ATAN takes two, so that it knows the quadrant")
                    .help("write ATAN[y]/[x]"));
            }
            second = Some(self.bracket()?);
        }
        evaluate(function, x, second, Span::new(start, self.cursor.at()))
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
        let span = Span::new(start, self.cursor.at());
        Err(Fault::new(
            Code::Expression,
            span,
            "EXISTS of something else than one name",
        )
        .because("only a named parameter can be without a value")
        .help("write EXISTS[#<name>]"))
    }
}

#[cold]
pub(crate) fn no_parameter(span: Span, number: f64) -> Box<Fault> {
    Fault::new(
        Code::Parameter,
        span,
        format!("there is no parameter #{number}"),
    )
    .because("parameters have the whole numbers from 1 to 5602")
    .help("use a number from 1 to 5000, or a name: #<name>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    struct Fixed;
    impl Scope for Fixed {
        fn numbered(&self, number: u32) -> Option<f64> {
            (number <= 5602).then(|| f64::from(number) * 10.0)
        }
        fn named(&self, name: &str) -> Option<f64> {
            (name == "two").then_some(2.0)
        }
    }

    fn eval(text: &str) -> Result<f64, Code> {
        let mut cursor = Cursor::new(text.as_bytes());
        cursor.advance();
        value(&mut cursor, 0, &Fixed).map_err(|fault| fault.code)
    }

    #[track_caller]
    fn gives(text: &str, expected: f64) {
        let found = eval(&format!("X{text}"));
        assert!(
            found.is_ok_and(|v| (v - expected).abs() < 1e-12),
            "{text}: {found:?}"
        );
    }

    #[test]
    fn operators_bind_as_documented() {
        gives("[1+2*3]", 7.0);
        gives("[2**3*2]", 16.0);
        gives("[2**3**2]", 64.0);
        gives("[10-4-3]", 3.0);
        gives("[2 - 3 + 4]", 3.0);
        gives("[-7 MOD 3]", 2.0);
        gives("[1+1 EQ 2]", 1.0);
        gives("[1 LT 2 AND 3 GE 4]", 0.0);
        gives("[1 xor 1 or 1]", 1.0);
        gives("[1 EQ 1.0000001]", 1.0);
        gives("[3--2]", 5.0);
        gives("[-[2]**2]", 4.0);
    }

    #[test]
    fn functions_use_degrees() {
        gives("sin[30]", 0.5);
        gives("atan[1]/[-1]", 135.0);
        gives("-SQRT[16]", -4.0);
        gives("[FIX[-2.5]*FUP[2.2]+ROUND[2.5]]", -6.0);
        gives("ACOS[0.5]", 60.0);
        gives("[EXISTS[#<two>]+EXISTS[#<three>]]", 1.0);
        gives("LN[EXP[2]]", 2.0);
    }

    #[test]
    fn parameters() {
        gives("#3", 30.0);
        gives("##3", 300.0);
        gives("#[1+2]", 30.0);
        gives("#<T w o>", 2.0);
        gives("-#<two>", -2.0);
    }

    #[test]
    fn what_has_no_value_is_refused() {
        use Code::{Arithmetic, Expression, NumberOutOfRange, Parameter};
        for (text, code) in [
            ("X[1/0]", Arithmetic),
            ("X[1 MOD 0]", Arithmetic),
            ("XSQRT[-1]", Arithmetic),
            ("XLN[0]", Arithmetic),
            ("XACOS[2]", Arithmetic),
            ("X[[-8]**0.5]", Arithmetic),
            ("X#99999", Parameter),
            ("X#0", Parameter),
            ("X#1.5", Parameter),
            ("X#<three>", Parameter),
            ("X[1 2", Expression),
            ("X[1+2", Expression),
            ("XATAN[1]", Expression),
            ("XEXISTS[#1]", Expression),
            ("XEXISTS[#<foo]", Expression),
            ("X[1000*1000*1000*1000]", NumberOutOfRange),
        ] {
            assert_eq!(eval(text), Err(code), "{text}");
        }
        assert!(eval("X[1+]").is_err() && eval("X[]").is_err() && eval("X[[2").is_err());
        assert_eq!(eval(&format!("X{}", "[".repeat(10_000))), Err(Expression));
        assert_eq!(eval(&format!("X{}1", "#".repeat(10_000))), Err(Expression));
        assert_eq!(
            eval(&format!("X[{}1]", "-".repeat(10_000))),
            Err(Expression)
        );
    }

    proptest! {
        #[test]
        fn sums_agree_with_rust(a in -1e3_f64..1e3, b in -1e3_f64..1e3, c in 1.0_f64..1e3) {
            let found = eval(&format!("X[{a} - {b} * [{a} / {c}] + {c}]"));
            prop_assert_eq!(found, Ok(a - b * (a / c) + c));
        }

        #[test]
        fn any_expression_is_judged_without_a_panic(text in "X[-#<>\\[\\]a-zA-Z0-9.*/+ ]{0,40}") {
            if let Ok(value) = eval(&text) {
                prop_assert!(value.is_finite());
            }
        }
    }
}
