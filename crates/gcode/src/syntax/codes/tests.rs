//! Tests that no number is forgotten where codes are sorted: tables and matches name it in several places,
//! and a place without it would take it for another code.

use std::collections::BTreeMap;

use super::Codes;
use crate::diagnostic::block_diagnostic::Outcome;
use crate::diagnostic::span::SourceSpan;
use crate::setup::m_codes::MCodes;
use crate::syntax::dialect::Dialect;
use crate::syntax::dialect::words::no_g;

type Add = fn(&mut Codes, f64, SourceSpan) -> Outcome<()>;

/// The numbers that are read, by what they are read as; `letter` is G or M.
fn read(letter: char, add: Add) -> BTreeMap<String, Vec<String>> {
    let mut read = BTreeMap::<String, Vec<String>>::new();
    // M codes have no tenths, but for M862 of printers, which is one whatever they are.
    let step = if letter == 'M' { 10 } else { 1 };
    for tenths in (0..10_000).step_by(step) {
        let number = f64::from(tenths) / 10.0;
        let mut codes = Codes::default();
        if add(&mut codes, number, SourceSpan::default()).is_err() {
            continue;
        }
        assert!(
            codes.any(),
            "{letter}{number} is read, and `Codes::any` does not name its group"
        );
        // The variable that a program reads the number back by.
        codes.last_m = None;
        let names = read.entry(format!("{codes:?}")).or_default();
        names.push(format!("{letter}{number}"));
    }
    read
}

/// Numbers that are read as one code: those that mean the same, and no others.
#[track_caller]
fn are_one_code(letter: char, add: Add, expected: &[&str]) {
    let read = read(letter, add);
    assert!(read.len() > 10, "{read:?}");
    let same = read.values().filter(|names| names.len() > 1);
    let same: Vec<String> = same.map(|names| names.join(" ")).collect();
    assert_eq!(same, expected, "numbers that are read as one code");
}

#[test]
fn every_g_number_is_a_code_of_its_own() {
    are_one_code('G', Codes::add_g, &[]);
    are_one_code('G', Codes::add_printer_g, &[]);
    // G505 to G599 have no tenths in a line that was rewritten.
    are_one_code(
        'G',
        |codes, value, span| match value.fract() > 0.0 && value > 500.0 {
            true => Err(no_g(Dialect::Siemens, value, span)),
            false => codes.add_rewritten_g(value, span),
        },
        &[
            "G58 G505",
            "G59 G506",
            "G59.1 G507",
            "G59.2 G508",
            "G59.3 G509",
        ],
    );
    are_one_code(
        'G',
        |codes, value, span| codes.add_fanuc_g(value, false, None, span),
        &["G54.1 G154", "G62 G63 G64", "G43.4 G234"],
    );
    are_one_code(
        'G',
        |codes, value, span| codes.add_fanuc_g(value, true, None, span),
        &["G54.1 G154", "G62 G63 G64"],
    );
}

#[test]
fn every_m_number_is_a_code_of_its_own() {
    let adders: [Add; 4] = [
        |codes, value, span| codes.add_m(value, span, &MCodes::default()),
        |codes, value, span| codes.add_rewritten_m(value, span, &MCodes::default()),
        |codes, value, span| codes.add_fanuc_m(value, false, span, &MCodes::default()),
        |codes, value, span| codes.add_fanuc_m(value, true, span, &MCodes::default()),
    ];
    for add in adders {
        are_one_code('M', add, &["M2 M30"]);
    }
    are_one_code(
        'M',
        |codes, value, span| codes.add_printer_m(value, span, &MCodes::default()),
        // A printer stops until somebody has it go on.
        &["M0 M25"],
    );
}
