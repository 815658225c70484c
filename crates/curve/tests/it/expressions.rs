//! Tests of formulas: what they mean, what is wrong with wrong ones, and where.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test")]

use glidepath_curve::{Expression, ExpressionError};
use glidepath_geometry::number::{Gradient, Interval, Series};
use proptest::prelude::*;

fn value(text: &str) -> f64 {
    Expression::parse(text, &["x", "y"])
        .unwrap_or_else(|e| panic!("{text}: {e:?}"))
        .eval(&[3.0, 0.5])
}

fn wrong(text: &str) -> ExpressionError {
    Expression::parse(text, &["x", "y"]).unwrap_err()
}

#[test]
fn the_usual_meaning() {
    let same = [
        ("-x^2", -9.0),
        ("2^-x", 0.125),
        ("2^3^2", 512.0),
        ("x - 1 - 1", 1.0),
        ("x/3/y", 2.0),
        ("2*-x", -6.0),
        ("--x", 3.0),
        ("1e-3*x + 1.5E2", 150.003),
        (".5*x", 1.5),
        ("cos(pi)", -1.0),
        ("sqrt(x^2 + 7)", 4.0),
        ("atan2(1, -1)", 0.75 * std::f64::consts::PI),
        ("ln(e) + log10(1000)", 4.0),
        ("exp(2) - e^2", 0.0),
        ("asin(y) + acos(y)", std::f64::consts::FRAC_PI_2),
        ("sin(x)/cos(x) - tan(x)", 0.0),
        ("cosh(x)^2 - sinh(x)^2", 1.0),
        ("tanh(x)*cosh(x) - sinh(x)", 0.0),
        ("atan(x) - atan2(x, 1)", 0.0),
        ("(-x)^3", -27.0),
        ("x^0.5 - sqrt(x)", 0.0),
        ("x^y - sqrt(x)", 0.0),
        ("(-8)^(-1)", -0.125),
        ("x^-2147483648", 0.0),
    ];
    for (text, want) in same {
        let got = value(text);
        assert!(
            (got - want).abs() < 1e-12 * want.abs().max(1.0),
            "{text} = {got}"
        );
    }
}

#[test]
fn errors_have_a_place_and_a_remedy() {
    for (text, at, help) in [
        ("2x", 0..2, "*"),
        ("x y", 2..3, "*"),
        ("x**2", 1..3, "^"),
        ("sin(x", 0..5, ")"),
        ("x)", 1..2, "remove"),
        ("x+", 2..2, "complete"),
        ("foo(x)", 0..3, "known"),
        ("abs(x)", 0..3, "smooth"),
        ("Sin(x)", 0..3, "`sin`"),
        ("sin x", 0..3, "parentheses"),
        ("1.2.3*x", 0..4, "*"),
        ("atan2(x)", 0..5, "atan2(y, x)"),
        ("sin(x, y)", 5..6, "atan2"),
        ("x $ y", 2..3, "operators"),
        ("", 0..0, "complete"),
    ] {
        let error = wrong(text);
        assert_eq!(error.at, at, "{text}: {error:?}");
        assert!(error.help.contains(help), "{text}: {error:?}");
    }
    assert!(wrong(&"(".repeat(100_000)).message.contains("nested"));
    assert!(wrong(&"x+".repeat(100_000)).message.contains("nested"));
    assert!(wrong(&"-".repeat(100_000)).message.contains("nested"));
}

#[test]
fn deep_formulas_are_read_in_a_time_that_grows_with_their_length() {
    // Each level of an exponent was once looked at twice as often as the one around it.
    let deep = |inner: &str| format!("x^{}{inner}{}", "-sin(".repeat(60), ")".repeat(60));
    assert!((value(&deep("0")) - 1.0).abs() < 1e-15);
    assert!(value(&deep("y")).is_finite());
}

#[test]
fn derivatives_come_with_the_value() {
    let formula = Expression::parse("20*(1 + cos(x)) * y^3", &["x", "y"]).unwrap();
    let [x, y, _] = Gradient::variables([0.3, 2.0, 0.0]);
    let exact = formula.eval(&[x, y]);
    assert!((exact.partial[0] + 20.0 * 0.3_f64.sin() * 8.0).abs() < 1e-13);
    assert!((exact.partial[1] - 20.0 * (1.0 + 0.3_f64.cos()) * 12.0).abs() < 1e-12);
    let series = formula.eval(&[Series::<3>::variable(0.3), Series::new([2.0, 0.0, 0.0])]);
    assert!((series.derivative(2) + 160.0 * 0.3_f64.cos()).abs() < 1e-12);
}

proptest! {
    #[test]
    fn any_text_is_read_or_refused(text in "[xy0-9.+*/^(), eEsincotaqrlgp-]{0,40}") {
        match Expression::parse(&text, &["x", "y"]) {
            Ok(formula) => {
                let _: f64 = formula.eval(&[0.3, 2.0]);
            }
            Err(error) => {
                prop_assert!(error.at.start <= error.at.end && error.at.end <= text.len() + 1);
                prop_assert!(!error.help.is_empty());
            }
        }
    }

    #[test]
    fn enclosures_hold(x in 0.1..3.0_f64, w in 0.0..0.3_f64, inside in 0.0..1.0_f64) {
        let formula =
            Expression::parse("tanh(x) + x^-2*asin(x/4) - acos(x/4)^3/sinh(x) + x^1.7", &["x"]).unwrap();
        let at = x + inside * w;
        let value: f64 = formula.eval(&[at]);
        prop_assert!(formula.eval(&[Interval::new(x, x + w)]).contains(value));
    }
}
