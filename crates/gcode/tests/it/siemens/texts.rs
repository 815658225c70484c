//! Tests of texts in SINUMERIK's programs, of bits, and of lines that read what they assign.

use std::sync::Arc;

use glidepath_gcode::{Options, Program, ToolTable, check};
use glidepath_program::{Event, ItemKind};

use super::{finds, options, xs};

#[test]
fn texts_are_kept_joined_and_compared() {
    let text = "DEF STRING[20] KIND=\"MILL\", OTHER\nIF KIND==\"MILL\"\nG0 X1\nENDIF\n\
                OTHER=KIND<<\"_\"<<6\nIF OTHER==\"MILL_6\" GOTOF A_A\nX2\nA_A: X3\n\
                IF (OTHER<>\"mill_6\") AND (STRLEN(OTHER)==6)\nX4\nENDIF";
    assert_eq!(xs(text), [1.0, 3.0, 4.0]);
    // Elements of an array; values as digits.
    let text = "DEF STRING LIST[2]\nDEF BOOL IS_ON=TRUE\nLIST[0]=<<2.5 LIST[1]=\"A\"<<IS_ON\n\
                IF LIST[0]<<LIST[1]==\"2.5ATRUE\"\nG0 X1\nENDIF";
    assert_eq!(xs(text), [1.0]);
    // A program and its subprogram have variables of their own.
    let text = "DEF STRING NAME=\"A\"\nSUB_A\nIF NAME==\"A\"\nG0 X2\nENDIF\nM30\n%_N_SUB_A_SPF\n\
                DEF STRING NAME=\"B\"\nIF NAME==\"B\"\nG0 X1\nENDIF\nM17";
    assert_eq!(xs(text), [1.0, 2.0]);
}

#[test]
fn texts_that_are_not_possible_are_refused() {
    finds("DEF STRING[3] AB=\"ABCD\"", &["1:15 parameter"]);
    finds("DEF STRING[3] AB\nAB=\"ABC\"<<1", &["2:1 parameter"]);
    finds("DEF STRING[0] AB", &["1:11 parameter"]);
    finds("DEF STRING[2000] AB", &["1:11 parameter"]);
    finds("DEF STRING AB=5", &["1:12 parameter"]);
    finds("DEF STRING AB\nG0 X=AB", &["2:6 expression"]);
    finds("DEF STRING AB\nIF AB==5\nENDIF", &["2:4 missing-word"]);
    finds(
        "DEF STRING AB\nIF AB==\"A\" OR TRUE\nENDIF",
        &["2:4 expression"],
    );
    finds("DEF FRAME AB", &["1:5 not-supported"]);
}

#[test]
fn jumps_go_to_the_label_that_a_text_names() {
    let text = "R1=1\nA_A: GOTOF \"L_\"<<R1\nL_1: G0 X1\nR1=2\nGOTOB \"A_A\"\nL_2: X2\nR1=3\n\
                DEF STRING TO_=\"L_3\"\nGOTO TO_\nX9\nL_3: X3";
    assert_eq!(xs(text), [1.0, 2.0, 3.0]);
    assert_eq!(xs("IF TRUE GOTOF \"N30\"\nG0 X1\nN30 G0 X2"), [2.0]);
    assert_eq!(xs("GOTOC \"NONE\"\nG0 X1"), [1.0]);
    finds("GOTOF \"L_\"<<7", &["1:7 flow-structure"]);
}

#[test]
fn a_tool_is_chosen_by_a_text() {
    let table = b"T1 Z10 D6 ;MILL_6\nT2 Z20 D10 ;MILL_10\n";
    let options = Options {
        tools: Some(Arc::new(ToolTable::parse(table).expect("a table"))),
        ..options()
    };
    let text = "DEF STRING[20] NAME\nNAME=\"MILL_\"<<10\nT=NAME\nM6\nD1\nG0 Z1";
    let items = Program::new(text.as_bytes(), options);
    let items: Vec<_> = items.map(|item| item.expect("a sound program")).collect();
    let chosen = items
        .iter()
        .any(|item| matches!(item.kind, ItemKind::Event(Event::SelectTool(2))));
    assert!(chosen, "{items:?}");
}

#[test]
fn bits_of_whole_numbers() {
    // 13 is 1101, 6 is 0110.
    let text = "R1=13 R2=6\nG0 X=R1 B_AND R2\nX=R1 B_OR R2\nX=R1 B_XOR R2\nX=B_NOT R2";
    assert_eq!(xs(text), [4.0, 15.0, 11.0, -7.0]);
    // Stronger than AND and OR, weaker than sums.
    assert_eq!(
        xs("IF 4 B_AND 1+3 AND TRUE\nG0 X1\nENDIF\nG0 X='B1100' B_AND 'HC'"),
        [1.0, 12.0]
    );
    finds("R1=1.5 B_AND 1", &["1:8 arithmetic"]);
}

#[test]
fn words_read_what_those_before_them_assign() {
    assert_eq!(xs("R1=5 R2=R1*2 R1=R1+1\nG0 X=R2\nX=R1"), [10.0, 6.0]);
    assert_eq!(xs("R1=5\nR1=R1+1 G0 X=R1"), [6.0]);
    assert_eq!(
        xs("DEF INT AB[2]\nAB[0]=1.6 AB[1]=AB[0]\nG0 X=AB[1]"),
        [2.0]
    );
}

#[test]
fn an_exponent_is_written_by_ex() {
    for text in ["R1=1E3", "R1=1.5E-3", "R1=(2*1E+3)"] {
        let report = check(text.as_bytes(), options());
        let fault = &report.diagnostics[0];
        assert_eq!(fault.code.as_str(), "malformed-number", "{text}");
        assert!(fault.help.contains("EX"), "{fault}");
    }
    assert_eq!(xs("R1=1EX2\nG0 X=R1"), [100.0]);
}
