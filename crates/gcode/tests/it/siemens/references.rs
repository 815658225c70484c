//! Tests of parameters that are variables of the call (VAR). Values are computed by hand.

use super::finds;
use super::subprograms::{found, xs_with};

const SWAP: (&str, &str) = (
    "SWAP.SPF",
    "PROC SWAP(VAR REAL AA, VAR REAL BB)\nDEF REAL TT\nTT=AA\nAA=BB\nBB=TT\nRET",
);
const SUM: (&str, &str) = (
    "SUM.SPF",
    "; adds up\nPROC SUM(VAR REAL OF_[3], VAR REAL to_)\nDEF INT II\nFOR II=0 TO 2\nTO_=TO_+OF_[II]\nOF_[II]=0\nENDFOR\nRET",
);

#[test]
fn what_is_assigned_goes_to_the_variable_of_the_call() {
    let text = "EXTERN SWAP(VAR REAL, VAR REAL)\nDEF REAL XX=3, YY=5\nSWAP(XX,YY)\nG0 X=XX\nX=YY";
    assert_eq!(xs_with(text, &[SWAP]), [5.0, 3.0]);
    // An element of an array and an R parameter; what lies beside them stays.
    let text =
        "DEF REAL LL[3]=SET(1,2,4)\nR5=9 R6=7\nSWAP(LL[R7+1], R5)\nG0 X=LL[1]\nX=R5\nX=LL[2]+R6";
    assert_eq!(xs_with(text, &[SWAP]), [9.0, 2.0, 11.0]);
    // Every turn of a call.
    let more = ("MORE.SPF", "PROC MORE(VAR INT AA)\nAA=AA+0.6\nRET");
    assert_eq!(xs_with("DEF INT XX\nMORE(XX) P3\nG0 X=XX", &[more]), [3.0]);
    // Without VAR it has a value of its own.
    let keep = ("KEEP.SPF", "PROC KEEP(REAL AA)\nAA=9\nRET");
    assert_eq!(xs_with("DEF REAL XX=1\nKEEP(XX)\nG0 X=XX", &[keep]), [1.0]);
    // Its own variables have their own places, whatever their names.
    let own = (
        "OWN.SPF",
        "PROC OWN(VAR REAL AA)\nDEF REAL XX=50\nAA=AA+XX\nRET",
    );
    assert_eq!(
        xs_with("DEF REAL XX=1, AA=2\nOWN(XX)\nG0 X=XX\nX=AA", &[own]),
        [51.0, 2.0]
    );
}

#[test]
fn arrays_are_given_as_a_whole() {
    let head = "EXTERN SUM(VAR REAL[3], VAR REAL)\nDEF REAL LL[3]=SET(1,2,4), SS=10\n";
    let text = format!("{head}SUM(LL,SS)\nG0 X=SS\nX=LL[2]+7");
    assert_eq!(xs_with(&text, &[SUM]), [17.0, 7.0]);
    // From call to call.
    let twice = (
        "TWICE.SPF",
        "PROC TWICE(VAR REAL OF_[], VAR REAL TO_)\nSUM(OF_,TO_)\nOF_[1]=6\nSUM(OF_ , TO_)\nRET",
    );
    let text = format!("{head}TWICE(LL,SS)\nG0 X=SS\nX=LL[1]+3");
    assert_eq!(xs_with(&text, &[SUM, twice]), [23.0, 3.0]);
    let last = ("LAST.SPF", "PROC LAST(VAR INT OF_[,2])\nOF_[1,1]=7.6\nRET");
    let text = "DEF INT LL[2,2]\nLAST(LL)\nG0 X=LL[1,1]\nX=LL[1,0]";
    assert_eq!(xs_with(text, &[last]), [8.0, 0.0]);
}

#[test]
fn what_is_no_variable_of_that_kind_is_refused() {
    let one = ("L1.SPF", "PROC L1(VAR REAL AA)\nM17");
    for call in [
        "L1(5)",
        "L1()",
        "L1(R1+1)",
        "DEF INT NN\nL1(NN)",
        "DEF REAL NN[2]\nL1(NN)",
    ] {
        found(call, &[one], &["1:9 parameter"]);
    }
    for text in [
        "DEF REAL LL[4], SS\nSUM(LL,SS)",
        "DEF REAL LL[3,1], SS\nSUM(LL,SS)",
    ] {
        found(text, &[SUM], &["2:10 parameter"]);
    }
    found("DEF REAL SS\nSUM(R1,SS)", &[SUM], &["2:10 parameter"]);
    // An array is no value, with VAR or without.
    let keep = ("KEEP.SPF", "PROC KEEP(REAL AA)\nG0 X=AA\nRET");
    let array = "DEF REAL LL[3]\n";
    found(&format!("{array}KEEP(LL)"), &[keep], &["1:11 parameter"]);
    found(&format!("{array}KEEP(LL+1)"), &[keep], &["2:6 parameter"]);
    finds(&format!("{array}R1=LL"), &["2:4 parameter"]);
    // MCALL gives the values that variables have then.
    found(
        "DEF REAL XX\nMCALL L1(XX)\nG0 X1",
        &[one],
        &["1:9 parameter"],
    );
    assert_eq!(
        xs_with("DEF REAL XX=3\nMCALL KEEP(XX)\nXX=5\nG0 Y1\nMCALL", &[keep]),
        [0.0, 3.0]
    );
    for (proc, expected) in [
        ("PROC L1(REAL AA[3])\nM17", "1:9 not-supported"),
        ("PROC L1(VAR REAL AA=3)\nM17", "1:9 not-supported"),
        ("PROC L1(VAR STRING[5] AA)\nM17", "1:13 not-supported"),
        ("PROC L1(VAR REAL AA[3)\nM17", "1:20 expression"),
    ] {
        found("L1(5)", &[("L1.SPF", proc)], &[expected]);
    }
}
