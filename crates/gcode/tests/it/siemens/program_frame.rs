//! Tests of the frame of a program by its name, $P_PFRAME. Values are computed by hand.

use super::{ends, finds, xs};

#[test]
fn a_frame_is_set_by_its_name() {
    // Turned by 90 degrees about X10: the program's X is the machine's Y.
    assert_eq!(
        ends("$P_PFRAME=CTRANS(X,10):CROT(Z,90)\nG0 X1 Y0"),
        [[10.0, 1.0, 0.0]]
    );
    assert_eq!(
        ends("TRANS X10\n$P_PFRAME=$P_PFRAME:CMIRROR(X):CSCALE(Y,2)\nG0 X1 Y1"),
        [[9.0, 2.0, 0.0]]
    );
    assert_eq!(xs("TRANS X10\n$P_PFRAME[X,TR]=5\nG0 X1"), [6.0]);
    assert_eq!(xs("TRANS X10\n$P_PFRAME=CTRANS()\nG0 X1"), [1.0]);
    finds("$P_PFRAME[X,RT]=5", &["1:1 not-supported"]);
    finds("$P_PFRAME=CSCALE(X,0)", &["1:11 not-supported"]);
    finds("$P_PFRAME=CFINE(X,1)", &["1:11 not-supported"]);
}

#[test]
fn a_frame_is_read_by_its_parts() {
    let text = "TRANS X10\nAROT Z30\nR1=$P_PFRAME[X,TR] R2=$P_PFRAME[Z,RT]\nTRANS\nG0 X=R1\nX=R2";
    assert_eq!(xs(text), [10.0, 30.0]);
    let text = "MIRROR X0\nASCALE Y3\nR1=$P_PFRAME[X,MI] R2=$P_PFRAME[Y,SC] R3=$P_PFRAME[Y,MI]\n\
                TRANS\nG0 X=R1\nX=R2\nX=R3";
    assert_eq!(xs(text), [1.0, 3.0, 0.0]);
    let text = "$P_UIFR[2]=CTRANS(X,7)\nG55\nR1=$P_IFRAME[X,TR] R2=$P_UIFRNUM\nG500\nG0 X=R1\nX=R2";
    assert_eq!(xs(text), [7.0, 2.0]);
    finds("R1=$P_ACTFRAME[X,TR]", &["1:4 not-supported"]);
}
