//! Tests of SINUMERIK's lines: what each is rewritten into, and what is refused.

use glidepath_geometry::Axis;

use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::code::DiagnosticCode;
use crate::diagnostic::span::SourceSpan;
use crate::syntax::dialect::siemens::expression::{Evaluator, Names};
use crate::syntax::dialect::siemens::rewritten::Rewritten;
use crate::syntax::dialect::siemens::statement::{Statement, is_target, label, statement};
use crate::syntax::dialect::siemens::system_index::Index;
use crate::syntax::dialect::siemens::variables::{Kind, Variables};
use crate::syntax::dialect::siemens::writer::rewrite;
use crate::syntax::expression::scope::Scope;

/// Ten times the number of an R parameter; 7 for every variable; X stands at 100, in G90.
struct Fixed;
impl Scope for Fixed {
    fn numbered(&self, number: u32) -> Option<f64> {
        match number {
            1000..2000 => Some(10.0 * f64::from(number - 1000)),
            5420 => Some(100.0),
            _ => Some(0.0),
        }
    }
    fn system_value(&self, name: &[u8], index: &[Index]) -> Option<f64> {
        // Increments count from where the axes stand.
        match (name, index) {
            (b"COUNTED", [Index::Axis(Axis::X)]) => Some(100.0),
            (b"COUNTED", _) => Some(0.0),
            _ => None,
        }
    }
    fn named(&self, name: &str) -> Option<f64> {
        Some(if name.starts_with("def.") { 7.0 } else { 0.0 })
    }
}

fn variables() -> Variables {
    let mut variables = Variables::default();
    for (name, kind) in [
        (&b"DEPTH"[..], Kind::Real),
        (b"COUNT", Kind::Integer),
        (b"_ON", Kind::Truth),
    ] {
        variables
            .declare(name, kind, Vec::new(), SourceSpan::default())
            .expect("a name");
    }
    variables
}

fn rewritten(text: &str) -> Outcome<Rewritten> {
    let (variables, scope) = (variables(), Fixed);
    let names = Names {
        variables: &variables,
        scope: &scope,
        in_subprogram: false,
    };
    rewrite(text.as_bytes(), names)
}

fn value(text: &str) -> Result<f64, DiagnosticCode> {
    let (variables, scope) = (variables(), Fixed);
    let names = Names {
        variables: &variables,
        scope: &scope,
        in_subprogram: false,
    };
    let mut evaluator = Evaluator::new(text.as_bytes(), 0, names);
    let value = evaluator.value().map_err(|fault| fault.code)?;
    assert!(evaluator.is_at_end(), "{text}: read to {}", evaluator.at);
    Ok(value)
}

#[track_caller]
fn becomes(text: &str, expected: &str) {
    let rewritten = rewritten(text).expect("it can be read");
    let found = String::from_utf8_lossy(&rewritten.text).into_owned();
    let bare = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(bare(&found), bare(expected), "{text}");
}

#[test]
fn words_are_rewritten() {
    becomes(
        "N10 G1 X=R1+5*SQRT(4) Y-2.5 F100 ; G2",
        "N10 G1 X[20] Y-2.5 F100",
    );
    becomes("R10 = 2 * ( R1 - 3 )", "#1010=[14]");
    becomes("R[R1+1]=1 R2=2", "#1011=[1] #1002=[2]");
    becomes(
        "DEPTH=-R1 COUNT=2.5 _ON=5",
        "#<def.depth>=[-10] #<def.count>=[3] #<def._on>=[1]",
    );
    becomes("G0X=DEPTH*2Y5", "G0X[14] Y5");
    becomes("G3 X1 Y2 CR=5.5 TURN=2", "G3 X1 Y2 R[5.5] P[3]");
    becomes("CYCLE832(0.05,1)", "G64 P[0.05]");
    becomes("CYCLE832()", "G64");
    becomes("G641 ADIS=0.5", "G64 P[0.5]");
    becomes("G642 SOFT FFWON", "G64");
    becomes("N5 G4 F2.5", "N5 G4 P2.5");
    becomes("G60 G71 G1 X1", "G61.1 G71 G1 X1");
    becomes("MSG(\"X1 Y2\")", "");
    becomes("%_N_PART_MPF", "");
    becomes("M17", "M2");
}

#[test]
fn coordinates_count_from_where_they_say() {
    becomes("G0 X=AC(5)", "G0 X[5]");
    becomes("G0 X=IC(5)", "G0 X[105]");
    becomes("G91 X=AC(5)", "G91 X[-95]");
    becomes("G91 X=IC(5)", "G91 X[5]");
    becomes("G2 I=AC(40) J=IC(3)", "G2 I[-60] J[3]");
}

#[test]
fn expressions_are_those_of_the_control() {
    for (text, expected) in [
        ("2+3*4", 14.0),
        ("-(2+3)*4", -20.0),
        ("7 DIV 2 + -7 MOD 3", 2.0),
        ("7/2", 3.5),
        ("R1==10", 1.0),
        ("(R1>5) AND (R2<3)", 0.0),
        ("(R1>5) OR (R2<3)", 1.0),
        ("NOT (R1<>10)", 1.0),
        ("R[R1-8]", 20.0),
        ("ATAN2(1,-1)", 135.0),
        ("TRUNC(-2.5)+ROUND(2.5)+ROUNDUP(2.1)", 4.0),
        ("POT(3)+ABS(-1)+MINVAL(1,2)+MAXVAL(1,2)+BOUND(0,5,9)", 18.0),
        ("1.5EX-3*1EX3", 1.5),
        ("0.1+0.2==0.3", 1.0),
        ("TRUE+FALSE", 1.0),
        ("DEPTH-count", 0.0),
    ] {
        let found = value(text);
        assert!(
            found.is_ok_and(|v| (v - expected).abs() < 1e-12),
            "{text}: {found:?}"
        );
    }
}

#[test]
fn what_has_no_value_is_refused() {
    use DiagnosticCode::{Arithmetic, Expression, NotSupported, NumberOutOfRange, Parameter};
    for (text, code) in [
        ("R1>5 AND R2<3", Expression),
        ("1<2<3", Expression),
        ("NOT R1==10", Expression),
        ("1/0", Arithmetic),
        ("SQRT(-1)", Arithmetic),
        ("SIN(1,2)", Expression),
        ("SIN()", Expression),
        ("(1+2", Expression),
        ("1+", Expression),
        ("", Expression),
        ("OTHER", NotSupported),
        ("$AA_IM[X]", NotSupported),
        ("R1000", Parameter),
        ("R[-1]", Parameter),
        ("1EX9*10", NumberOutOfRange),
    ] {
        assert_eq!(value(text), Err(code), "{text}");
    }
    for deep in ["(", "-", "NOT ", "SIN("] {
        assert_eq!(value(&deep.repeat(10_000)), Err(Expression), "{deep}");
    }
}

#[test]
fn what_is_not_read_is_refused_with_the_word() {
    for (text, start, length) in [
        ("N10 TRACYL", 4, 6),
        ("G1 X1 G74", 6, 3),
        ("N5 HOLES2(1,2)", 3, 6),
        ("OTHER=5", 0, 5),
        ("F=AC(5)", 2, 2),
    ] {
        let fault = rewritten(text).expect_err(text);
        assert_eq!(
            (fault.span.start, fault.span.length),
            (start, length),
            "{text}"
        );
        assert_eq!(fault.code, DiagnosticCode::NotSupported);
    }
}

#[test]
fn places_lead_back_to_the_line() {
    let rewritten = rewritten("G1 X=R1+5 K7").expect("it can be read");
    let at = rewritten
        .text
        .iter()
        .position(|byte| *byte == b'K')
        .expect("K");
    assert_eq!(
        rewritten.origin(SourceSpan::new(at, at + 2)),
        SourceSpan::new(10, 12)
    );
}

#[test]
fn labels_and_statements_are_told_from_blocks() {
    assert_eq!(label(b"N10 A_1: G0"), (Some(&b"A_1"[..]), 9));
    assert_eq!(label(b"G0 X1"), (None, 0));
    assert!(is_target(b"N10 again:", b"AGAIN") && is_target(b"N10 G0", b"n10"));
    assert!(!is_target(b"N100 G0", b"N10") && !is_target(b"AGAIN2: G0", b"AGAIN"));
    for (text, expected) in [
        ("N5 IF R1>2 GOTOF END", Statement::IfJump),
        ("A: IF (R1>2) ; GOTOF", Statement::If),
        ("REPEAT ; body", Statement::Repeat),
        ("REPEAT A P=3", Statement::RepeatPart),
        ("IFX=3", Statement::Block),
        ("LOOPS=3", Statement::Block),
    ] {
        assert_eq!(statement(text.as_bytes()).0, expected, "{text}");
    }
}
