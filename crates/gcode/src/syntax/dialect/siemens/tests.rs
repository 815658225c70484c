use super::*;
use crate::diagnostic::code::DiagnosticCode;

#[track_caller]
fn becomes(text: &str, expected: &str) {
    let rewritten = rewrite(text.as_bytes()).expect("it can be read");
    let found = String::from_utf8_lossy(&rewritten.text).into_owned();
    let bare = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(bare(&found), bare(expected), "{text}");
}

#[test]
fn words_are_rewritten() {
    becomes(
        "N10 G1 X=R1+5*SIN(30) Y-2.5 F100 ; G2",
        "N10 G1 X[#1001+5*SIN[30]] Y-2.5 F100",
    );
    becomes("R10 = 2 * ( R1 - 3 )", "#1010=[2*[#1001-3]]");
    becomes("G3 X1 Y2 CR=5.5 TURN=2", "G3 X1 Y2 R[5.5] P[2+1]");
    becomes("CYCLE832(0.05,1)", "G64 P[0.05]");
    becomes("CYCLE832()", "G64");
    becomes("G641 ADIS=0.5", "G64 P[0.5]");
    becomes("G642 SOFT FFWON", "G64");
    becomes("N5 G4 F2.5", "N5 G4 P2.5");
    becomes("G60 G71 G1 X1", "G61.1 G21 G1 X1");
    becomes("MSG(\"X1 Y2\")", "");
    becomes("%_N_PART_MPF", "");
    becomes("M17", "M2");
}

#[test]
fn what_is_not_read_is_refused_with_the_word() {
    for (text, start, length) in [
        ("DEF REAL A", 0, 3),
        ("G1 X=AC(5)", 5, 2),
        ("N10 TRAORI", 4, 6),
        ("IF R1==2 GOTOF A", 0, 2),
        ("G1 X1 G500", 6, 4),
    ] {
        let fault = rewrite(text.as_bytes()).expect_err(text);
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
    let rewritten = rewrite(b"G1 X=R1+5 Q7").expect("it can be read");
    let at = rewritten
        .text
        .iter()
        .position(|byte| *byte == b'Q')
        .expect("Q");
    assert_eq!(
        rewritten.origin(SourceSpan::new(at, at + 2)),
        SourceSpan::new(10, 12)
    );
}
