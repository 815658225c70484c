//! Tests of SINUMERIK's structures, jumps, repetitions and variables.

use super::{finds, xs};

#[test]
fn branches_and_loops() {
    let text = "DEF INT NN=3\nIF NN>2\nG0 X1\nIF FALSE\nX2\nELSE\nX3\nENDIF\nELSE\nX4\nENDIF\nX5";
    assert_eq!(xs(text), [1.0, 3.0, 5.0]);
    assert_eq!(
        xs("R1=0\nWHILE R1<3\nR1=R1+1\nG0 X=R1*10\nENDWHILE"),
        [10.0, 20.0, 30.0]
    );
    assert_eq!(
        xs("DEF INT I_A\nFOR I_A=1 TO 2\nFOR R2=1 TO 2\nG0 X=I_A*10+R2\nENDFOR\nENDFOR\nX=I_A"),
        [11.0, 12.0, 21.0, 22.0, 3.0]
    );
    assert_eq!(xs("FOR R1=5 TO 4\nG0 X1\nENDFOR\nG0 X=R1"), [5.0]);
    assert_eq!(xs("REPEAT\nR1=R1+1\nG0 X=R1\nUNTIL R1>=2"), [1.0, 2.0]);
    let text = "LOOP\nR1=R1+1\nIF R1>3 GOTOF END_1\nG0 X=R1\nENDLOOP\nEND_1: G0 X9";
    assert_eq!(xs(text), [1.0, 2.0, 3.0, 9.0]);
}

#[test]
fn jumps_go_where_they_are_told() {
    assert_eq!(xs("GOTOF N30\nN20 G0 X1\nN30 G0 X2"), [2.0]);
    let text = "A_1: R1=R1+1\nG0 X=R1\nIF (R1<3) AND TRUE GOTOB A_1\nGOTO OUT\nX9\nOUT:";
    assert_eq!(xs(text), [1.0, 2.0, 3.0]);
    // GOTO looks forward first, and GOTOC goes on where there is nothing.
    assert_eq!(xs("GOTO B_B\nB_B: G0 X1\nGOTOC NONE\nX2"), [1.0, 2.0]);
    finds("G0 X1\nGOTOB B_B\nB_B: X2", &["2:7 flow-structure"]);
    finds(
        "G0 X1\nB_B: X2\nIF R1==0 GOTOF B_B",
        &["3:16 flow-structure"],
    );
}

#[test]
fn parts_are_repeated() {
    let text = "A_A: R1=R1+1\nG0 X=R1\nREPEAT A_A P=2\nX=R1*10";
    assert_eq!(xs(text), [1.0, 2.0, 3.0, 30.0]);
    let text = "B_B: G0 X=IC(1)\nX=IC(10)\nREPEATB B_B P=3\nX0";
    assert_eq!(xs(text), [1.0, 11.0, 12.0, 13.0, 14.0, 0.0]);
    let text = "A_A: G0 X=IC(1)\nB_B: G0 X=IC(10)\nX=IC(100)\nREPEAT A_A B_B\nX0";
    assert_eq!(xs(text), [1.0, 11.0, 111.0, 112.0, 122.0, 0.0]);
    let text = "REPEAT C_C P=2\nG0 X=IC(5)\nM30\nC_C: G0 X=IC(1)\nENDLABEL:\nM30";
    assert_eq!(xs(text), [1.0, 2.0, 7.0]);
    // The label in front counts, not the one behind.
    let text = "A_A: G0 X=IC(1)\nREPEAT A_A\nM30\nA_A: G0 X=IC(10)\nENDLABEL:";
    assert_eq!(xs(text), [1.0, 2.0]);
    finds("A_A: G0 X1\nREPEAT B_B", &["2:7 flow-structure"]);
    finds("REPEAT A_A\nA_A: G0 X1", &["1:1 flow-structure"]);
    finds("A_A: G0 X1\nREPEAT A_A P=-1", &["2:16 flow-structure"]);
}

#[test]
fn variables_hold_what_they_are_declared_for() {
    let text = "DEF REAL A_A=1.5, B_B\nDEF INT C_C=A_A\nDEF BOOL D_D=7\nB_B=C_C*100+D_D*10\n\
                G0 X=A_A+B_B\nC_C=2.4\nX=C_C";
    assert_eq!(xs(text), [211.5, 2.0]);
    finds("DEF CHAR A_A", &["1:5 not-supported"]);
    finds("DEF REAL A_A[3]", &[]);
    finds("DEF REAL X1=3", &["1:10 parameter"]);
    finds("DEF REAL A_A=1/0", &["1:15 arithmetic"]);
    finds("G0 X=A_A", &["1:6 not-supported"]);
}

#[test]
fn what_does_not_fit_together_is_refused() {
    finds("IF TRUE\nG0 X1", &[]);
    finds("IF FALSE\nG0 X1", &["1:1 flow-structure"]);
    finds("G0 X1\nENDWHILE", &["2:1 flow-structure"]);
    finds(
        "IF FALSE\nWHILE TRUE\nENDIF\nENDWHILE",
        &["1:1 flow-structure"],
    );
    finds("FOR X1=1 TO 3\nENDFOR", &["1:4 flow-structure"]);
    finds("FOR R1=1 TO 3 G0\nENDFOR", &["1:15 flow-structure"]);
    finds("WHILE\nENDWHILE", &["1:5 expression"]);
    finds("GOTOF", &["1:5 missing-word"]);
    finds("GOTOF A_A G0 X1\nA_A:", &["1:11 flow-structure"]);
    finds("CASE R1+1 OF 1 GOTOF A_A", &["1:22 flow-structure"]);
    finds("N5 L54", &["1:4 unknown-subroutine"]);
    finds("GOTOS", &["1:1 not-supported"]);
}

#[test]
fn loops_without_moves_end() {
    finds("LOOP\nR1=R1+1\nENDLOOP", &["2:1 endless-loop"]);
    finds("A_A:\nGOTOB A_A", &["1:1 endless-loop"]);
    let deep: String = (0..70)
        .map(|i| format!("A{i}A: REPEAT A{}A P=9000\n", i + 1))
        .collect();
    finds(
        &format!("G0 X1\n{deep}A70A:\nENDLABEL:"),
        &["66:7 call-depth"],
    );
}

#[test]
fn measurements_are_refused_by_name_with_what_to_write() {
    for (text, expected) in [
        ("MEAS=1 G1 X10 F100", "1:1 not-supported"),
        ("G1 X10 F100 MEAW=-1", "1:13 not-supported"),
    ] {
        finds(text, &[expected]);
        let report = glidepath_gcode::check(text.as_bytes(), super::options());
        let help = &report.diagnostics[0].help;
        assert!(help.contains("G38.3"), "{help}");
    }
}

/// A jump, a structure and a call have blocks of their own, and each is told so.
#[test]
fn what_has_a_block_of_its_own_says_so() {
    for (text, word, why) in [
        ("G0 X1 ELSE", "ELSE", "it has a block of its own"),
        (
            "G0 X1 GOTOF A_A",
            "GOTOF",
            "a jump has a block of its own, or stands behind IF",
        ),
        (
            "G0 X1 CALL \"A\"",
            "CALL",
            "the call of a subprogram has a block of its own",
        ),
    ] {
        let report = glidepath_gcode::check(text.as_bytes(), super::options());
        let found = &report.diagnostics[0];
        assert_eq!(
            found.message,
            format!("{word} beside other words"),
            "{text}"
        );
        assert_eq!(found.reason, why, "{text}");
    }
    let report = glidepath_gcode::check(&b"G0 X1 L10 P2"[..], super::options());
    let said = "L10 (the call of a subprogram beside other words) is not supported";
    assert_eq!(report.diagnostics[0].message, said);
}
