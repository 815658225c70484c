//! Refused blocks of FANUC's programs.

use crate::execute::whole_or_nothing::tests::{Table, five_axes, lathe, mill, try_all};
use crate::syntax::dialect::Dialect;

const WORDS: &str = "\
    G17 | G18 | G19 | G20 | G21 | G90 | G91 | G94 F50 | G95 F1 | F222 | G40 | G41 D1 | G42 D2 | \
    G43 H1 | G43 H2 Z5 | G44 H1 | G49 | H3 | D3 | G54 | G55 | G54.1 P3 | G61 | G64 | G9 | \
    G96 S100 | G97 S100 | G98 | G99 | S100 | T2 | T2 M6 | M6 | M3 S100 | M5 | M8 | M9 | \
    M29 S100 | M19 | M0 | M1 | G80 | N5 | N50 | G4 P100 | G10 L2 P1 X5 | G10 L20 P2 X5 | \
    G10 L10 P1 R3 | G10 L12 P2 R1 | G28 | G30 | G52 X1 | G92 X3 | G15 | G16 | G50 | \
    G51 X0 Y0 P2 | G50.1 X0 | G51.1 X0 | G68 X0 Y0 R30 | G69 | #100=7 | #1=3 | #5221=4 | \
    #2001=3 | #500=2 | G62 | G63 | G31 Z-1 F10 | G60 | G110 | G154 P2 | M23 | G91 G45 D1 | G101 X0 | G100 X0";

const WRONG: &str = "\
    G1 X9999. F100 | G0 Y-9999. | G2 X7 Y7 R0.1 | G81 X1 Z-9999. R2 | J7 | X1.2.3 | M5.5 | M999 | \
    G0 G1 | #6000=1 | #100=[1/0] | #3000=1 | E7";

const BLOCKS: &str = "\
    X9999. | G2 X1 Y1 | G2 X3 Y0 I1 J7 | G3 X5 Y0 I9999 | G33 Z-5 | G33 Z9999. F1 | \
    G73 X1 Z-5 R1 | G73 X1 Z-9999. R1 Q1 | G74 Z-9999. R1 | G76 X1 Z-5 R1 Q9999 | \
    G76 X1 Z-9999. R1 Q1 | G82 Z-1 P-1 R1 | G83 Z-5 R1 Q0 | G84 Z-9999. R1 F1 | G84.2 Z-5 R1 F0 | \
    G85 X9999. Z-1 R1 | G87 X1 Z-1 R1 Q1 | G88 Z-9999. R1 | G89 Z-9999. R1 P1 | \
    G91 G81 X400 Z-1 R1 K9 | T99 M6 | G43 H99 | G41 D99 | G10 L2 P12 X1 | G10 L10 P99 R1 | \
    G10 L99 P1 R1 | G53 X9999. | G53 X1 G91 | G28 X9999. | G30 P5 X1 | G92 | G52 | G68 R30 G18 | \
    G68 X0 Y0 R30 G1 X9999. | G51 X0 Y0 P0 | G51 X0 Y0 I2 J1 G2 X9 Y9 R20 | G16 G2 X9 Y9 R90 | \
    G16 X9999. Y30 | G54.1 P999 | G4 | G31 X9999. F10 | G31 | M29 | G12 I9999 D1 F100 | G13 I20 | \
    G13 I20 D2 Z-9999. F500 | G70 I9999 J1 L4 | G150 | G1 X1 ,R5 ,C5 | G1 X5 ,R50 | G1 Y9999. | \
    Y9999. ,C1 | G1 X5 Y0.01 | G2 X5.5 Y0 I0.25 | X#33[1] | #100=5 #101=6 G1 X9999. | \
    #3006=1 X9999. | #5041=3 | #0=1 | #2001=#0 | G5.1 Q1 | G07.1 C5 | G1 A5 | G1 ,A45 | \
    G1 X1 ,A45 Y9999. | X20 ,A10 | G83.5 X1 | SETVN 10[DEPTH] | DPRNT[X | IF [1 EQ 1 | G90 G91 | \
    G1 X1 X2 | N77 G1 X9999. | N77 X1.2.3 | G68.2 X1 J30 | G43.4 H1 | G254 | G40 G2 X9 Y9 R20 | \
    M30 X9999. G1 | G91 G45 X9999. D1 | G45 X1 H2 | G91 G46 G2 X1 Y1 R3 D1 | G101 X5 | G101 Z0";

const BEHIND: &str = "#110=#4014\nG40\nG0 Z3\nX2 Y1\nG1 X3 Y1 F120\nG2 X5 Y1 I1 J0\nG91 X1\nG90 G81 X1 Y2 Z-1 R1\nX3\nG80\nG69\nG50.1 X0 Y0\nG50\nG15\n\
    G10 L2 P1 X1\nG1 X#100 Y#101 F100\n#1=#2\n#111=#5221\n#112=#4003\nM5\nG0 X0 Y0\nM30";

#[test]
fn of_a_mill() {
    try_all(&Table {
        options: || mill(Dialect::Fanuc),
        before: &[
            "N10 G0 X1 Y1 Z1",
            "T1 M6\nG0 X-20 Y-20\nG1 G41 D1 X0 Y0 F600\nY40\nM8",
            "T1 M6\nG0 X-20 Y-20\nG1 G42 D1 X0 Y0 F600\nY40\nG40",
            "G1 X10 F600 ,R2",
            "G1 X10 F600\n,A45",
            "G43 H1\nG92 X3\nG55\n#100=1\n#1=2",
            "G0 Z5\nG98 G81 X1 Y1 Z-1 R1 F100",
            "G20 G91 G18 G95 F0.1 M3 S100",
            "G68 X0 Y0 R30\nG51 X0 Y0 P2\nG0 X1",
            "G16\nG0 X5 Y30",
            "M3 S100\nM29 S100\nG84 Z-5 R1 F1",
            "G10 L20 P2 X5\nG54.1 P2\nG52 X5\nG31 Z-2 F10",
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
        options: || lathe(Dialect::Fanuc),
        before: &[
            "G98 F300\nG0 X62 Z2\nM3 S100",
            "T0303\nG98\nG0 X62 Z2\nG1 X60 F300 ,R2",
            "G98\nG0 X62 Z2\nG71 U2.5 R0.5\nG97 S600 M3",
            "G99\nG0 X34 Z6 M3 S600\nG76 P010060 Q100 R0.1\nG90 X30 Z-5 F1",
            "T0101\nG42\nG98\nG1 X40 Z0 F300\nZ-10",
        ],
        words: "\
            G20 | G98 F50 | G99 F0.2 | G96 S100 | G50 S1000 | G50 X5 | T0202 | T0300 | S200 | \
            M8 | G55 | G10 P1 X5 | G40 | G41 | #100=3 | G4 U1 | G28 U0 | M23 | M24 | N7",
        wrong: "\
            G1 X9999. | G0 Z-9999. | G2 X70 Z-1 R0.1 | G90 X56 Z-9999. F300 | \
            G92 X29 Z-9999. F1.5 | Y5 | X1.2.3 | M999 | T0177 | X5 U1",
        blocks: "\
            G71 P10 Q50 U1 | G70 P10 Q50 | G71 U-1 R1 | G72 W0 R1 | G73 U1 R0 | \
            G74 Z-9999. Q5000 F300 | G75 X9999. P2000 F100 | G76 P010060 Q-1 R0.1 | \
            G76 X29 Z-9999. P1000 Q500 F1.5 | G76 X29 Z-9 P1000 Q500 | \
            G83 Z-9999. R-8 Q20000 F200 | G84 Z-9999. R-8 F1 | G94 X20 Z-9999. R-3 F300 | \
            G32 Z-5 | G32 Z-9999. F1 | G32 X40 Z-9 F1 Q5 E1 | G34 Z-5 F1 | G1 Z-9999. ,C1 | \
            G1 Z5 A30 | G90 | G53 X9999. | G10 P99 X1 | G77 X5",
        behind: "G40\nG0 X60 Z3\nG1 X50 F100\n#101=#4109\nG90 X56 Z-3 F300\nX52\nG71 U2\nG76 P010060 Q100 R0.1\nG0 X62 Z4\nM30",
    });
}

#[test]
fn of_a_lathe_with_a_profile() {
    try_all(&Table {
        options: || lathe(Dialect::Fanuc),
        before: &["G98\nG0 X62 Z2\nG71 U2.5 R0.5"],
        words: "",
        wrong: "",
        blocks: "\
            G71 P10 Q50 U0.6 W0.3 F300 S200 D0 | G71 P10 Q50 U900 F300 | \
            G71 P10 Q50 U0.6 W9999 F300 | G70 P10 Q99 | G73 P10 Q50 U0.6 W0.3 F300",
        behind: "G0 X60\nM30\nN10 G0 X20\nN20 G1 Z-20 F100\nN30 X40\nN40 Z-40\nN50 X60\n",
    });
}

#[test]
fn with_five_axes() {
    try_all(&Table {
        options: || five_axes(Dialect::Fanuc),
        before: &[
            "G0 X1 Y1 Z1",
            "G43.4 H1\nG0 X1 Y2 Z3 A30",
            "G43.5 H1\nG0 X1 Y2 Z3",
            "G68.2 X20 Y10 Z0 I0 J30 K0\nG53.1",
            "G68.2 X0 J30",
            "G68.2 P2 Q1 X0 Y0 Z0",
            "G68.2 X20 Y10 Z0 I0 J30 K0\nG53.1\nG41 D1\nG1 X0 Y9 F100\nY40",
            "G43 H1 Z3\nG254",
        ],
        words: "\
            G43 H2 | G43.4 H2 | G43.5 H2 | G49 | G55 | G10 L2 P1 X5 | G92 X1 | G52 X1 | \
            G68.2 X1 Y1 Z1 I0 J20 K0 | G68.2 P1 X0 Y0 Z0 I10 J20 K0 | G68.2 P2 Q1 X1 Y0 Z0 | \
            G53.1 | G69 | G254 | G255 | T2 M6 | M8 | G17 | #100=1",
        wrong: "\
            G1 X9999. F100 | G1 X600 A10 F100 | G1 A9999 | G1 B5 | G2 X5 Y5 | G31 Z-9999. F10 | \
            M999 | Q7",
        blocks: "\
            G68.2 P4 J30 | G53.1 P3 | G53.1 X5 | G81 X1 Z-1 R9999 | G28 X9999. | G53 G0 Z9999. | \
            G68.2 P2 Q5 X0 | G68.2 P2 Q3 X0 Y0 Z0 | G43.4 H99 | G1 X1 I0 J0 K0 | G40 X9999. | \
            G84 Z-5 R1 F100",
        behind: "G40\nG0 X1 A5 C10\nG1 X5 Y5 A10 F200\nG69\nG49\nG255\nG0 X0\nG68.2 X1 Y1 Z0 I0 J20 K0\nG53.1\nG0 Z5\nM30",
    });
}
