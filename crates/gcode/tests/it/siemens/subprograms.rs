//! Tests of subprograms, arrays and CASE.

use glidepath_gcode::{NoSubroutineFile, Options, Program, SubroutineFile, Subroutines, check};
use glidepath_program::ItemKind;

use super::{ends, finds, options, xs};
use crate::support::listed;

/// Options with files of subprograms: name and text.
fn with_files(files: &[(&str, &str)]) -> Options {
    let files: Vec<(String, String)> = files
        .iter()
        .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
        .collect();
    let find = move |wanted: &str| {
        let found = files.iter().find(|(name, _)| name == wanted);
        found
            .map(|(name, text)| SubroutineFile {
                name: name.as_str().into(),
                text: text.as_bytes().into(),
            })
            .ok_or_else(|| NoSubroutineFile::Missing {
                looked_in: vec!["/programs".to_owned()],
            })
    };
    Options {
        subroutines: Some(Subroutines::new(find)),
        ..options()
    }
}

pub(super) fn xs_with(text: &str, files: &[(&str, &str)]) -> Vec<f64> {
    Program::new(text.as_bytes(), with_files(files))
        .filter_map(
            |item| match item.unwrap_or_else(|d| panic!("{text}\n{d}")).kind {
                ItemKind::Move { segment, .. } => Some(segment.end()[0]),
                _ => None,
            },
        )
        .collect()
}

#[track_caller]
pub(super) fn found(text: &str, files: &[(&str, &str)], expected: &[&str]) {
    let report = check(text.as_bytes(), with_files(files));
    assert_eq!(listed(&report), expected, "{text}");
}

#[test]
fn a_file_is_called_by_its_name() {
    let step = ("L771.SPF", "G91 G0 X5\nM17\nG0 X99");
    assert_eq!(
        xs_with("L771 P3\nG90 G0 X1", &[step]),
        [5.0, 10.0, 15.0, 1.0]
    );
    assert_eq!(
        xs_with(
            "G0 X1\nSlot_A ; now\nG0 X2",
            &[("slot_a.spf", "G0 X7\nRET")]
        ),
        [1.0, 7.0, 2.0]
    );
    // The end of the file is its end; M30 there leads back, too; a block with M17 moves first.
    assert_eq!(
        xs_with("L1\nG0 X2", &[("L1.SPF", "%_N_L1_SPF\nG0 X7")]),
        [7.0, 2.0]
    );
    assert_eq!(xs_with("L1\nG0 X2", &[("L1.SPF", "G0 X7 M30")]), [7.0, 2.0]);
    assert_eq!(xs_with("L1 P0\nG0 X2", &[("L1.SPF", "G0 X7")]), [2.0]);
    // Calls in calls.
    let nested = [("L1.SPF", "G0 X1\nL2\nG0 X3"), ("L2.SPF", "G0 X2\nM17")];
    assert_eq!(xs_with("L1 P2", &nested), [1.0, 2.0, 3.0, 1.0, 2.0, 3.0]);
    found("L9", &[], &["1:1 unknown-subroutine"]);
    found("NOT_THERE(1)", &[], &["1:1 unknown-subroutine"]);
    found("NOT_THERE", &[], &["1:1 not-supported"]);
    found("L1 P-1", &[("L1.SPF", "G0 X1")], &["1:4 invalid-value"]);
    found("L1 X5", &[("L1.SPF", "G0 X1")], &["1:4 flow-structure"]);
    found("L1", &[("L1.SPF", "L1")], &["1:1 call-depth"]);
    finds("L54", &["1:1 unknown-subroutine"]);
}

#[test]
fn subprograms_stand_behind_the_program_too() {
    let text = "%_N_MAIN_MPF\nG0 X1\nL10 P2\nGOTOF END\nEND: G0 X9\nM30\n%_N_L10_SPF\nEND: G91 G0 X5\nG90\nM17\n";
    assert_eq!(xs(text), [1.0, 6.0, 11.0, 9.0]);
    // A program ends where the next one begins.
    assert_eq!(xs("%_N_MAIN_MPF\nG0 X1\n%_N_L10_SPF\nG0 X5\nM17\n"), [1.0]);
}

#[test]
fn parameters_have_the_values_of_the_call() {
    let file = (
        "BORE.SPF",
        "PROC BORE(REAL DEPTH, INT COUNT=2, BOOL _BACK) SAVE DISPLOF\nDEF INT NN\nFOR NN=1 TO COUNT\nG0 X=DEPTH*NN\nENDFOR\nIF _BACK==TRUE\nG91 X-1\nENDIF\nRET",
    );
    let head = "EXTERN BORE(REAL, INT, BOOL)\n";
    assert_eq!(
        xs_with(&format!("{head}BORE(3,3,FALSE)"), &[file]),
        [3.0, 6.0, 9.0]
    );
    // What is left out has the value of PROC, or 0. SAVE brings G90 back.
    assert_eq!(
        xs_with(&format!("{head}R1=4\nBORE(R1,,TRUE)\nG0 X1"), &[file]),
        [4.0, 8.0, 7.0, 1.0]
    );
    found("BORE(1,2,0,5)", &[file], &["1:5 expression"]);
    found("L1(5)", &[("L1.SPF", "G0 X5")], &["1:1 expression"]);
    finds("PROC MAIN(REAL AA)\nG0 X1", &["1:5 flow-structure"]);
    assert_eq!(xs("PROC MAIN\nG0 X1\nM30"), [1.0]);
    // ENDPROC is an end like M17, of a program and of a subprogram.
    assert_eq!(xs("PROC MAIN SAVE\nG0 X1\nENDPROC"), [1.0]);
    let proc = ("L2.SPF", "PROC L2(REAL AA)\nG0 X=AA\nENDPROC");
    assert_eq!(xs_with("L2(3)\nG0 X4\nM30", &[proc]), [3.0, 4.0]);
    let report = check(&b"PROC MAIN\nG0 X1\nENDPROC"[..], options());
    assert!(report.is_accepted() && report.diagnostics.is_empty());
}

#[test]
fn variables_are_of_their_own_subprogram() {
    let file = ("SUB.SPF", "DEF REAL VALUE=7\nG0 X=VALUE\nM17");
    assert_eq!(
        xs_with("DEF REAL VALUE=1\nSUB\nG0 X=VALUE", &[file]),
        [7.0, 1.0]
    );
    // R parameters are common.
    let file = ("SUB.SPF", "R5=R5+1\nM17");
    assert_eq!(xs_with("R5=1\nSUB P3\nG0 X=R5", &[file]), [4.0]);
}

#[test]
fn a_subprogram_behind_every_move() {
    let file = ("DOT.SPF", "G0 Z-1\nZ5\nM17");
    let text = "G0 Z5\nMCALL DOT\nG0 X1\nX2\nMCALL\nX3";
    assert_eq!(
        xs_with(text, &[file]),
        [0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0]
    );
    let empty = "MCALL DOT()\nG0 X1\nMCALL\nG0 X0";
    assert_eq!(xs_with(empty, &[file]), [1.0, 1.0, 1.0, 0.0]);
    // Said where it is written, and once.
    found("MCALL DOT(5)\nG0 X1\nX2", &[file], &["1:7 expression"]);
    let row = "MCALL DOT\nHOLES1(10,0,0,5,20,2)\nMCALL\nG0 X0";
    assert_eq!(
        xs_with(row, &[file]),
        [15.0, 15.0, 15.0, 35.0, 35.0, 35.0, 0.0]
    );
}

#[test]
fn repetitions_and_calls_do_not_meddle() {
    // The file is as long as the part that is repeated.
    let file = ("L1.SPF", "G91\nX1\nG90\nM17");
    let text = "AA: G1 X0\nL1\nBB:\nREPEAT AA BB P=2\nG0 X9";
    assert_eq!(
        xs_with(text, &[file]),
        [1.0, 0.0, 1.0, 0.0, 1.0, 9.0],
        "{text}"
    );
}

#[test]
fn arrays_have_elements() {
    let text = "DEF REAL PX[3]=SET(1,2,4)\nDEF INT NN\nFOR NN=0 TO 2\nG0 X=PX[NN]\nENDFOR\nPX[1]=7\nG0 X=PX[1]";
    assert_eq!(xs(text), [1.0, 2.0, 4.0, 7.0]);
    let text = "DEF REAL GRID[2,3]\nGRID[0,0]=SET(1,2,3,4,5,6)\nG0 X=GRID[1,0]\nX=GRID[0,2]\nGRID=REP(9)\nX=GRID[1,2]\nGRID[1,0]=REP(8,2)\nX=GRID[1,1]\nX=GRID[1,2]";
    assert_eq!(xs(text), [4.0, 3.0, 9.0, 8.0, 9.0]);
    finds("DEF REAL A[3]", &["1:10 parameter"]);
    finds("DEF REAL PX[0]", &["1:12 parameter"]);
    finds("DEF REAL PX[3]=5", &["1:16 parameter"]);
    finds("DEF REAL PX[2]=SET(1,2,3)", &["1:16 parameter"]);
    finds("DEF REAL PX[9,9,9,9]", &["1:12 expression"]);
    finds("DEF REAL PX[10000,2]", &["1:10 parameter"]);
    finds("DEF REAL PX[2]\nPX[2]=1", &["2:1 parameter"]);
    finds("DEF REAL PX[2]\nG0 X=PX[0,1]", &["2:6 parameter"]);
    finds("DEF REAL PX[2]\nG0 X=PX", &["2:6 parameter"]);
}

#[test]
fn a_value_chooses_among_jumps() {
    let text = |value: u32| {
        format!(
            "R1={value}\nCASE (R1) OF 1 GOTOF ONE 2 GOTOF TWO DEFAULT GOTOF OTHER\nONE: G0 X1\nGOTOF READY\nTWO: G0 X2\nGOTOF READY\nOTHER: G0 X3\nREADY: M30"
        )
    };
    assert_eq!(xs(&text(1)), [1.0]);
    assert_eq!(xs(&text(2)), [2.0]);
    assert_eq!(xs(&text(5)), [3.0]);
    // Without DEFAULT it goes on.
    assert_eq!(xs("CASE(5) OF 1 GOTOF ONE\nG0 X7\nONE: G0 X1"), [7.0, 1.0]);
    finds("CASE (1) OF", &["1:5 flow-structure"]);
    finds("CASE (1) OF 1 X5", &["1:15 flow-structure"]);
    finds("CASE (1) OF 1 GOTOF AWAY", &["1:21 flow-structure"]);
}

#[test]
fn texts_of_messages_are_skipped_and_nothing_else() {
    assert_eq!(
        ends("MSG(\"A ) B; C\") G0 X5"),
        [[5.0, 0.0, 0.0]],
        "a move behind a message"
    );
    assert_eq!(xs("WORKPIECE(,\"\",,\"BOX\",112)\nG0 X1"), [1.0]);
}

#[test]
fn a_text_names_a_subprogram() {
    let rough = ("ROUGH.SPF", "G0 X7\nM17\nG0 X99");
    for call in [
        "EXTCALL \"ROUGH\"",
        "EXTCALL(\"ROUGH\")",
        "N10 EXTCALL(\"rough.spf\") ; now",
        "EXTCALL \"/_N_WKS_DIR/_N_PART_WPD/_N_ROUGH_SPF\"",
        "EXTCALL \"USB:NC/ROUGH_SPF\"",
        "CALL \"ROUGH\"",
        "CALL \"RO\"<<\"UGH\"",
        "PCALL ROUGH",
        "PCALL /_N_SPF_DIR/_N_ROUGH_SPF",
        "PCALL /_N_SPF_DIR/ROUGH()",
    ] {
        assert_eq!(
            xs_with(&format!("G0 X1\n{call}\nG0 X2"), &[rough]),
            [1.0, 7.0, 2.0],
            "{call}"
        );
    }
    // The name in a variable, another one at each turn.
    assert_eq!(
        xs_with(
            "DEF STRING[20] NAME\nR1=1\nA:\nNAME=\"STEP\"<<R1\nCALL NAME\nR1=R1+1\nIF R1<3 GOTOB A\nG0 X9",
            &[("STEP1.SPF", "G0 X1"), ("STEP2.SPF", "G0 X2")]
        ),
        [1.0, 2.0, 9.0]
    );
    // The kind of the file where the text says it.
    let both = [("PART.SPF", "G0 X5"), ("PART.MPF", "G0 X6\nM30")];
    assert_eq!(
        xs_with(
            "EXTCALL \"PART\"\nEXTCALL \"PART.MPF\"\nCALL \"_N_PART_SPF\"",
            &both
        ),
        [5.0, 6.0, 5.0]
    );
    // With arguments; behind a line of its own in the program.
    assert_eq!(
        xs_with(
            "PCALL /_N_SPF_DIR/_N_HOLE_SPF(5, 2)",
            &[("HOLE.SPF", "PROC HOLE(REAL AA, REAL BB)\nG0 X=AA+BB\nM17")]
        ),
        [7.0]
    );
    assert_eq!(
        xs_with("CALL \"HOLE\"\nG0 X2\nM30\n%_N_HOLE_SPF\nG0 X8\nM17", &[]),
        [8.0, 2.0]
    );
}

#[test]
fn texts_that_name_none() {
    for (text, code) in [
        ("EXTCALL \"NONE\"", "1:9 unknown-subroutine"),
        ("CALL \"/_N_SPF_DIR/\"", "1:6 unknown-subroutine"),
        ("CALL \"../..\"", "1:6 unknown-subroutine"),
        ("EXTCALL", "1:1 missing-word"),
        ("CALL 5", "1:1 missing-word"),
        ("EXTCALL(\"A\"", "1:1 missing-word"),
        ("CALL BLOCK A TO B", "1:11 flow-structure"),
        ("CALL BLOCK A", "1:6 missing-word"),
        ("CALL BLOCK TO", "1:6 missing-word"),
        ("CALL \"A\" BLOCK A TO B", "1:10 not-supported"),
        ("PCALL", "1:6 unknown-subroutine"),
    ] {
        found(text, &[("A.SPF", "G0 X7")], &[code]);
    }
}

#[test]
fn parts_of_the_program_are_called() {
    // As posts write them, each part ending at a label of the same name.
    let text = "G0 X1\nN10 CALL BLOCK LABEL2 TO LABEL0\nCALL BLOCK LABEL1 TO LABEL0 ; again\nG0 X4\nM30\n\n\
                LABEL1: ;FIRST\nG0 X2\nLABEL0:\n\nLABEL2:\nG0 X3\nG91\nX5\nG90\nLABEL0:\n";
    assert_eq!(xs(text), [1.0, 3.0, 8.0, 2.0, 4.0]);
    // The last block is executed, too; labels in texts.
    assert_eq!(
        xs("GOTOF B\nA: G0 X1\nX2\nC: X3\nB: G0 X9\nCALL BLOCK \"A\" TO \"C\"\nX5"),
        [9.0, 1.0, 2.0, 3.0, 5.0]
    );
    assert_eq!(
        xs("GOTOF B\nA1: G0 X1\nE: X2\nA2: X3\nE: X4\nB:\nREPEAT A2 E P=2\nREPEAT A1 E\nX5"),
        [3.0, 4.0, 3.0, 4.0, 1.0, 2.0, 5.0]
    );
}

#[test]
fn a_declaration_of_a_subprogram_stands_alone() {
    finds("EXTERN A1(REAL) G0 X5", &["1:17 flow-structure"]);
    finds("EXTERN A1 G0 X5", &["1:11 flow-structure"]);
    finds(
        "N10 EXTERN A1(REAL, INT) ; of the shop\nEXTERN A1\nEXTERN A2 (REAL)",
        &[],
    );
}
