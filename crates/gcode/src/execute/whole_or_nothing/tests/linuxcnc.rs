//! Refused blocks of LinuxCNC's programs.

use crate::execute::whole_or_nothing::tests::{Table, five_axes, lathe, mill, try_all};
use crate::setup::options::{Connections, Options};
use crate::syntax::dialect::Dialect;

const WORDS: &str = "\
    G17 | G18 | G19 | G20 | G21 | G90 | G91 | G90.1 | G91.1 | G93 F2 | G94 F50 | G95 F1 | F222 | \
    G40 | G41 D1 | G42 D2 | G41.1 D3 | G43 H1 | G43.1 Z5 | G43.2 H2 | G49 | G54 | G55 | G59.3 | \
    G61 | G61.1 | G64 | G64 P0.1 | G96 D100 S100 | G97 S100 | G98 | G99 | G7 | G8 | S100 | T2 | \
    T2 M6 | M6 | M61 Q2 | M3 S100 | M4 S100 | M5 | M7 | M8 | M9 | M48 | M49 | M50 P0 | M51 P0 | \
    M53 P0 | M19 R10 | M62 P1 | M64 P1 | M66 P1 L0 | M66 E0 L0 | M67 E0 Q1 | M70 | M71 | M72 | \
    M73 | M0 | M1 | M60 | G80 | N5 | G4 P1 | G10 L2 P1 X5 | G10 L20 P2 X5 | G10 L1 P1 Z3 | \
    G10 L10 P1 Z3 | G10 L11 P2 Z3 | G28 | G28.1 | G30 | G30.1 | G30 X1 | G52 X1 | G53 | G92 X3 | \
    G92.1 | G92.2 | G92.3 | #5=7 | #<a>=3 | #<_b>=4 | #5161=1 | #5599=0";

const WRONG: &str = "\
    G1 X9999 F100 | G0 Y-9999 | G2 X7 Y7 R0.1 | G81 X1 Z-9999 R2 | J7 | X1.2.3 | M5.5 | M999 | \
    G0 G1 | #6000=1 | #7=[1/0] | M2 X9999 G1";

const BLOCKS: &str = "\
    X9999 | X1 Y2 Q1 | G1 X1 F0 | G2 X1 Y1 | G2 X3 Y0 I1 J7 | G3 X5 Y0 I9999 | G3 X5 Y1 R2 I1 | \
    G2 X9999 Y0 R9000 | G5 X1 Y1 | G5 X9999 Y1 P1 Q1 I1 J1 | G5.1 X1 | G5.1 X9999 Y9999 I1 J1 | \
    G5.2 X1 Y1 P-1 | G5.2 X1 Y1 P1 L1 | G5.2 X1 P1 | G5.2 X9999 Y1 P1 | G5.3 | G6.2 X0 Y0 K0 P1 | \
    G6.2 X0 Y0 K-5 | G6.2 K0 | G6.2 X9999 Y9999 K1 | G33 X1 K0 | G33 Z9999 K1 | G33.1 Z9999 K1 | \
    G33.1 Z-5 K0 | G38.2 Z9999 F10 | G38.2 F10 | G38.5 X0 Y0 Z0 F10 | G73 X1 Z-5 R1 | \
    G73 X1 Z-9999 R1 Q1 | G74 Z-9999 R1 S100 | G76 P1 Z-5 I-1 J0.1 R1 K2 | G76 P0 Z-5 | \
    G76 P1 Z-9999 I-1 J0.1 R1 K2 Q29.5 | G82 Z-1 P-1 R1 | G83 Z-5 R1 Q0 | G84 Z-9999 R1 | \
    G85 X9999 Z-1 R1 | G86 Z-9999 R1 | G87 X1 Z-1 R1 I1 J1 K9999 | G89 Z-9999 R1 P1 | \
    G81 X1 Y1 Z-1 R2 L9999999 | G81 R1 | G91 G81 X400 Z-1 R1 L9 | G80 X1 | G70 Q100 | \
    G71 Q100 D1 | T99 M6 | T99 | G43 H99 | G41 D99 | G41 D1 G18 | G41.1 D0 G19 | G10 L2 P12 X1 | \
    G10 L3 P1 X1 | G10 L1 P99 X1 | G10 L1 P1 R-1 Q99 | G10 L20 P1 | G53 X1 G91 | \
    G53 G2 X1 Y1 R3 | G53 G1 X9999 | G28 X9999 | G30 Z9999 | G92 | G92 X1 M2 G1 Y9999 | G64 P-1 | \
    G96 S100 D-1 | G4 P-1 | G4 | M66 P1 E1 L0 | M66 P1 L1 Q0 | M66 P1 L0 G1 X9999 | M62 P99 | \
    M62 P1 G1 X9999 | M67 E0 Q5 G1 X9999 | M68 E99 Q1 | M52 P1 | M19 R400 | M19 R10 P9 | \
    M72 X9999 | M70 G1 X9999 | M73 G1 X9999 | M3 S-1 X9999 | M6 T2 G43 H2 G55 G91 G1 X9999 | \
    T3 M6 G10 L1 P3 Z5 X9999 | G65 P1 | G12 X1 | M428 | M429 X9999 | G1 A5 | U1 | E5 | \
    #1=5 #<x>=6 #<_y>=7 #31=4 G1 X9999 | #1=5 X1.2.3 | (MSG, HELLO) G1 X9999 | G1 X[1/0] | \
    G1 X#9999 | G90 G91 | G1 X1 X2 | G999 | G1 @5 | G1 @5 ^400 | G0 X1 Z | %% | G41 D1 G1 X9999 | \
    G1 Y0.01 | G1 X5 Y0.01 | G2 X5.5 Y0 I0.25 | G18 X1 | G40 G2 X9 Y9 R20 | G40 X9999 | \
    G54 G1 X9999 | G10 L2 P1 R45 X400";

const BEHIND: &str = "G5.3\nM72\nG40\nG0 Z3\nX2 Y1\nG1 X3 Y1 F120\nG2 X5 Y1 I1 J0\nG91 X1\nG90 G81 X1 Y2 Z-1 R1\nX3\n\
    G80\nG10 L2 P1 X1\nG92 X#5420\nG1 X#5 Y#31 F100\n#1=[#1+#2]\nM5\nG0 X0 Y0\nM2";

#[test]
fn of_a_mill() {
    try_all(&Table {
        options: || mill(Dialect::LinuxCnc),
        before: &[
            "G0 X1 Y1 Z1",
            "T1 M6\nG41 D1\nG1 X5 Y0 F100\nX10\nM8",
            "T1 M6\nG42 D1\nG1 X5 Y0 F100\nX10\nG40",
            "G1 X0 F100\nG5.2 X1 Y2 P1\nX3 Y4 P1\nX5 Y6",
            "G1 F100\nG6.2 X0 Y0 K0\nX1 Y1 K0\nX2 Y0 K0\nX3 Y0 K0\nK1\nK1\nK1",
            "M70\nM3 S100\nG91\nM7\nM8\n#1=3\n#2=4\n#<x>=1",
            "G43 H1\nG92 X3\nG55\nG10 L2 P2 R30\n#31=1",
            "G0 Z5\nG81 X1 Y1 Z-1 R1 F100",
            "G1 F100\nG5 I0 J3 P0 Q-3 X1 Y1",
            "G20 G91 G18 G95 F0.1 M3 S100\nM73",
            "G93\nG1 X1 F2",
            "G38.2 Z-1 F10\nG92.2",
        ],
        words: WORDS,
        wrong: WRONG,
        blocks: BLOCKS,
        behind: BEHIND,
    });
}

#[test]
fn of_a_lathe() {
    try_all(&Table {
        options: || lathe(Dialect::LinuxCnc),
        before: &[
            "G18 G7\nG0 X20 Z2\nM3 S100",
            "o100 sub\nG0 X10 Z0\nG1 X12 Z-5\nX20\no100 endsub\nG18 G7\nG0 X30 Z2 F100",
        ],
        words: "G8 | G96 D100 S100 | G95 F0.1 | T2 M6 | G43 H3 | #5=8",
        wrong: "G1 X9999 | G71 Q100 D-1 | G71 Q100 D1 Z5 | G70 Q7 D1 | G33 Z-9999 K1",
        blocks: "#5=7 G72 Q100 D0 | G71 Q100 | G76 P0.1 Z-9999 I-1 J0.1 R1 K2 | G1 Y5",
        behind: "G0 X#5\nG71 Q100 D1\nG0 X30 Z3\nG33 Z1 K0.5\nM2",
    });
}

#[test]
fn with_five_axes() {
    try_all(&Table {
        options: || five_axes(Dialect::LinuxCnc),
        before: &[
            "G0 X1 Y1 Z1",
            "T1 M6 G43 H1\nG0 X10 Y0 Z30 A20 C30",
            "M429\nG0 X1",
            "G41 D1\nG1 X5 Y0 F100\nX10",
        ],
        words: "M428 | M429 | M430 | G43 H2 | G49 | G55 | G10 L2 P1 X5 | G92 X1 | T2 M6 | M8",
        wrong: "\
            G1 X9999 F100 | G1 X600 A10 F100 | G1 A9999 | G1 B5 | G2 X5 Y5 | G38.2 Z-9999 F10 | \
            M999",
        blocks: "G33.1 Z-5 K1 | G81 X1 Z-1 R9999 | G28 A5 X9999 | G53 G0 Z9999",
        behind: "G40\nG0 X1 A5 C10\nG1 X5 Y5 A10 F200\nG49\nG0 X0\nM2",
    });
}

#[test]
fn with_inputs_and_a_probe() {
    try_all(&Table {
        options: || Options {
            connections: Connections::Real,
            probing_v: Some(100.0),
            ..mill(Dialect::LinuxCnc)
        },
        before: &["G0 X1 Y1 Z1", "M66 P2 L1 Q5", "G38.2 Z-1 F10"],
        words: "M66 P1 L1 Q5 | M66 E0 L0 | M66 P0 L0 | M62 P1 | M19 R10",
        wrong: "G1 X9999 F100 | G38.2 Z-9999 F10 | G2 X7 Y7 R0.1 | M999",
        blocks: "G38.2 Z-1 F9999999 | G38.2 Z-9999 F10 | G38.3 F10",
        behind: "G0 X5\n#1=#5399\n#2=#5063\nG1 X1 F100\nM2",
    });
}
