//! Tests of expressions: values, precedence, diagnostics.

use proptest::prelude::*;

use crate::diagnostic::code::DiagnosticCode;
use crate::syntax::cursor::Cursor;
use crate::syntax::expression::scope::Scope;
use crate::syntax::expression::value::value;

struct Fixed;
impl Scope for Fixed {
    fn numbered(&self, number: u32) -> Option<f64> {
        (number <= 5602).then(|| f64::from(number) * 10.0)
    }
    fn named(&self, name: &str) -> Option<f64> {
        (name == "two").then_some(2.0)
    }
}

fn eval(text: &str) -> Result<f64, DiagnosticCode> {
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
    use DiagnosticCode::{Arithmetic, Expression, NumberOutOfRange, Parameter};
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
