//! Refused blocks of SINUMERIK's programs.

use crate::execute::whole_or_nothing::tests::{Table, five_axes, lathe, mill, try_all};
use crate::syntax::dialect::Dialect;

const WORDS: &str = "\
    G17 | G18 | G19 | G70 | G71 | G700 | G710 | G90 | G91 | G94 F50 | G95 F1 | F222 | FB=50 | \
    G40 | G41 | G42 | D0 | D1 | T2 | T3 D1 | T2 M6 | M6 | G54 | G55 | G505 | G500 | G60 | G64 | \
    G9 | G601 | G96 S100 | G97 S100 | LIMS=300 | S100 | M3 S100 | M5 | M8 | M9 | M0 | M1 | N5 | \
    G4 F1 | G4 S1 | CFC | CFIN | CFTCP | RNDM=2 | RNDM=0 | FRCM=50 | G110 X1 Y1 | G111 X5 | \
    G112 Y5 | DIAMON | DIAMOF | DIAM90 | R1=3 | R5=R1+1 | SUPA | G53 | G153 | KONT | NORM | \
    SOFT | BRISK | MSG(\"HI\") | G450 | G451 | G33 Z-5 K1 | G290 | TURN=1 | SPOS=10 | G25 S5 | \
    STOPRE";

const WRONG: &str = "\
    G1 X9999 F100 | G0 Y-9999 | G2 X7 Y7 CR=0.1 | J7 G1 X1 | X1.2.3 | M5.5 | M999 | G0 G1 | \
    R6000=1 | R7=1/0 | G1 X20 RND=2 CHR=1 | ZZ=5 | AP=9 RP=9999";

const BLOCKS: &str = "\
    X9999 | G2 X1 Y1 | G2 X3 Y0 I1 J7 | G3 X5 Y0 I9999 | CIP X5 Y5 I1 | CIP X9999 Y5 I1 J9 | \
    CT X9999 Y5 | G33 Z9999 K1 | G331 Z-5 K0 | G331 Z9999 K1 | G331 Z-5 K1 S100 | G332 Z5 K1 | \
    G63 Z9999 | T99 | T99 M6 | D7 | G41 D7 | G53 X9999 | SUPA X9999 | G599 | G510 | TRANS X | \
    TRANS X1 Q2 | ATRANS | TRANS X1 X2 | ROT RPL=30 X5 | ROT X5 RPL | AROT RPL= | SCALE X0 | \
    ASCALE X1000000 | MIRROR A0 | AMIRROR Q1 | TRANS X99999999 | G58 | G59 X1 Q1 | \
    G58 Z99999999 | $P_UIFR[1]=CTRANS(X,1):CROT(X,5) | $P_UIFR[1,X,FI]=3 | \
    $P_UIFR[999]=CTRANS(X,1) | $P_PFRAME=CTRANS(X,1):CSCALE(X,0) | $TC_DP3[1,0]=5 | \
    $TC_DP99[1,1]=5 | $TC_DP3[1,1]=1/0 | CYCLE81(5,0,1) | CYCLE81(10,0,2,-9999) | \
    CYCLE82(10,0,2) | CYCLE83(10,0,2,-5) | CYCLE84(10,0,2,-5) | CYCLE85(10,0,2,-5,,1,0) | \
    CYCLE86(10,0,2,-5,,1,9) | CYCLE71(1) | CYCLE97(1) | CYCLE76(1) | POCKET3(1) | \
    POCKET4(10,0,2,-9999,20,0,0) | CYCLE95(\"NONE\",1) | CYCLE999(1) | MCALL CYCLE81(1,2) | \
    MCALL CYCLE95(\"A\") | MCALL NONE(1) | HOLES1(0,0,0,1,1,0) | HOLES2(0,0,9999,0,0,3) | \
    CYCLE801(1) | CYCLE802(111,111,1) | HOLES1(0,0,0,450,100,3) | \
    CYCLE802(111,111,0,0,9,9,9999,9) | CYCLE800(0,\"TC1\",0,57,20,10,0,30,0,0,0,0,0,-1) | \
    R1=5 R2=6 G1 X9999 | G1 X5 Y0.01 | G2 X5.5 Y0 I0.25 | G1 ANG=45 | G1 X9999 ANG=45 | \
    X20 ANG=10 | G1 X5 RND=50 | Y9999 | Y40 RND=90 | G110 X1 G1 X9999 | RP=9999 AP=5 | \
    G91 X=AC(9999) | X=IC(9999) | G1 X=R9999 | G90 G91 | G1 X1 X2 | WAITM(1,1) | G1 A5 | \
    ORIVECT | TRAORI | G642 ADIS=-1 | G40 G2 X9 Y9 CR=20 | M30 G1 X9999 | G4 | G96 S-1 | FRC=5 | \
    TLIFT | G147 X1 | X10 Y9999 | X11 Y11 R1=9 | SPLINE | BSPLINE X1";

const BEHIND: &str = "G40\nG0 Z3\nX2 Y1\nG1 X3 Y1 F120\nG2 X5 Y1 I1 J0\nG91 X1\nG90\nAP=30 RP=5\nCT X9 Y9\nG1 X=R1 Y=R2 F100\nX12 Y3\nG58 X1\nTRANS X5\nATRANS Y1\nG0 X0\nCYCLE81(10,0,2,-5)\nMCALL\nROT\nM5\nG0 X0 Y0\nM30";

#[test]
fn of_a_mill() {
    try_all(&Table {
        options: || mill(Dialect::Siemens),
        before: &[
            "G0 X1 Y1 Z1",
            "T1 M6 D1\nF600\nG0 X0 Y-20\nG1 G41 X0 Y-10\nY10\nM8",
            "T1 M6 D1\nF600\nG0 X0 Y-20\nG1 G42 X0 Y-10\nY10\nG40",
            "F600\nG1 X10 RND=2",
            "F600 RNDM=2 FRCM=50\nG1 X10",
            "F600\nG1 X10\nANG=45",
            "T1 M6 D1\nG55\nTRANS X5\nATRANS Y2\nROT RPL=30\nR1=3",
            "G58 X5\nG59 X1\nG91 G70",
            "SPOS=0\nG331 Z-5 K1 S100",
            "MCALL CYCLE81(10,0,2,-5)",
            "MCALL CYCLE81(10,0,2,-5)\nF600\nG0 X0 Y-20",
            "G111 X5 Y5\nG0 RP=3 AP=20\nG95 F0.1 M3 S100",
            "G500\n$P_UIFR[2]=CTRANS(X,1)\n$TC_DP3[1,1]=7",
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
        options: || lathe(Dialect::Siemens),
        before: &[
            "G18 DIAMON\nG0 X40 Z2",
            "G18 DIAM90 LIMS=1200 M4\nG96 S200\nG0 X100 Z0",
            "G18\nT1 D1\nF600\nG1 X30 CHR=2",
            "G18\nT1 D1\nG42\nG1 X40 Z0 F300\nZ-10",
        ],
        words: "\
            G91 | DIAMON | DIAMOF | DIAM90 | G96 S100 | G97 S100 | G961 S5 | G95 F0.1 | T2 D1 | \
            LIMS=5 | TRANS Z1 | R1=2 | M8 | G70",
        wrong: "\
            G1 X9999 F1 | G0 Z-9999 | G2 X70 Z-1 CR=0.1 | G33 Z-9999 K1 | G33 Z-5 | Y5 | \
            X=DIC(9999) | M999",
        blocks: "\
            CYCLE95(\"NONE\",1,0,0,0,1,1,1,9) | CYCLE97(1) | \
            CYCLE97(2,,0,-9999,20,20,5,5,1,0,30,0,5,1,3,1) | G331 Z9999 K1 | SPOS=5 G1 X9999 | \
            G34 Z-5 K1 | Y3",
        behind: "G40\nG0 X60 Z3\nG1 X50 F1\nX=IC(5)\nG33 Z1 K0.5\nG0 X40\nM30",
    });
}

#[test]
fn with_five_axes() {
    try_all(&Table {
        options: || five_axes(Dialect::Siemens),
        before: &[
            "G0 X1 Y1 Z1",
            "T1 M6 D1\nTRAORI\nG0 X1 Y2 Z3 A30",
            "T1 M6 D1\nTRAORI\nORIVECT\nG0 X0 Y0 Z20 A3=0 B3=0 C3=1",
            "CYCLE800(0,\"TC1\",0,57,20,10,0,30,0,0,0,0,0,-1)",
            "TRANS X5\nF600\nG1 X10 RND=2",
            "T1 M6 D1\nCYCLE800(0,\"TC1\",0,57,20,10,0,30,0,0,0,0,0,-1)\nF600\nG1 G41 X0 Y9\nY40",
        ],
        words: "\
            TRAORI | TRAFOOF | ORIVECT | ORIAXES | T2 D1 | G55 | TRANS X1 | ROT X30 | M8 | R1=1 | \
            G18 | G91 | CYCLE800()",
        wrong: "\
            G1 X9999 F100 | G1 X600 A10 F100 | G1 A9999 | G1 B5 | G2 X5 Y5 | M999 | \
            G1 X5 A3=0 B3=0 C3=0 | G1 X5 A3=0 B3=0 C3=-1",
        blocks: "\
            CYCLE800(1,\"\",0,57,0,0,0,30,0,0,0,0,0,-1) | \
            CYCLE800(0,\"TC1\",0,57,20,10,0,999,0,0,0,0,0,-1) | \
            CYCLE800(0,\"TC1\",0,57,9999,10,9999,30,0,0,0,0,0,-1) | \
            CYCLE800(0,\"TC1\",1,57,20,10,0,30,0,0,0,0,0,-1) | \
            CYCLE800(0,\"TC1\",0,57,20,10,0,30,0,0,0,0,0,7) | CYCLE800( | \
            $P_PFRAME=CTRANS(X,99999999) | TRANS A99999999 | CYCLE81(10,0,2,-9999) | SUPA Z9999 | \
            G331 Z-5 K1",
        behind: "G40\nG0 X1 A5 C10\nG1 X5 Y5 A10 F200\nTRAFOOF\nCYCLE800()\nTRANS X3\nG0 X0\nCYCLE800(0,\"TC1\",0,57,20,10,0,20,0,0,0,0,0,-1)\nG0 Z5\nM30",
    });
}
