//! Tests of increments behind new frames, work offsets and tool lengths: places by hand.

use super::{ends, finds, options};
use glidepath_gcode::{Options, Program, SiemensParameters, Tool, ToolTable};
use glidepath_program::ItemKind;
use std::sync::Arc;

/// Ends of moves in X, Y and Z where tool 1 is 10 long and tool 2 is 12.
fn ends_with(siemens: SiemensParameters, text: &str) -> Vec<[f64; 3]> {
    let mut tools = ToolTable::new();
    for (number, length) in [(1, 10.0), (2, 12.0)] {
        let mut tool = Tool::default();
        tool.offset[2] = length;
        tools.set(number, tool);
    }
    let options = Options {
        siemens,
        tools: Some(Arc::new(tools)),
        ..options()
    };
    Program::new(text.as_bytes(), options)
        .filter_map(|item| match item.expect("a sound program").kind {
            ItemKind::Move { segment, .. } => Some(segment.end()),
            _ => None,
        })
        .map(|end| [0, 1, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0))
        .collect()
}

#[test]
fn an_increment_goes_the_shift_of_a_new_frame() {
    for (text, right) in [
        // From X0 of the new frame, which is X10; the next one goes its own way alone.
        (
            "TRANS X10\nG91 G0 X5\nX5",
            vec![[15.0, 0.0, 0.0], [20.0, 0.0, 0.0]],
        ),
        ("TRANS X10\nG0 X=IC(5)", vec![[15.0, 0.0, 0.0]]),
        // An absolute place in G91 is the same place.
        ("TRANS X10\nG91 G0 X=AC(5)", vec![[15.0, 0.0, 0.0]]),
        // Each axis by itself.
        (
            "TRANS X10 Y20\nG91 G0 X5\nY1",
            vec![[15.0, 0.0, 0.0], [15.0, 21.0, 0.0]],
        ),
        // A coordinate that was gone to is the one that counts.
        (
            "TRANS X10\nG0 X1\nG91 X1",
            vec![[11.0, 0.0, 0.0], [12.0, 0.0, 0.0]],
        ),
        // The end of the frame is a shift, too: X5 was reached, and X6 is gone to.
        (
            "TRANS X10\nG91 G0 X5\nTRANS\nX1",
            vec![[15.0, 0.0, 0.0], [6.0, 0.0, 0.0]],
        ),
        // There and back without a move.
        ("TRANS X10\nTRANS\nG91 G0 X1", vec![[1.0, 0.0, 0.0]]),
        ("TRANS X10\nATRANS X2\nG91 G0 X1", vec![[13.0, 0.0, 0.0]]),
        ("TRANS X1\nG58 X4\nG91 G0 X1", vec![[5.0, 0.0, 0.0]]),
        (
            "$P_UIFR[2]=CTRANS(X,100)\nG91 G55 G0 X1",
            vec![[101.0, 0.0, 0.0]],
        ),
        ("G700\nTRANS X1\nG91 G0 X1", vec![[50.8, 0.0, 0.0]]),
        ("TRANS X10\nG1 F600 X=IC(1) Y=IC(2)", vec![[11.0, 2.0, 0.0]]),
    ] {
        assert_eq!(ends(text), right, "{text}");
    }
}

#[test]
fn machine_data_say_whether_increments_go_shifts() {
    let both = SiemensParameters::default();
    let frames = SiemensParameters {
        length_goes_with_increments: false,
        ..both
    };
    let lengths = SiemensParameters {
        frame_goes_with_increments: false,
        ..both
    };
    let text = "T1 M6 D0\nTRANS X10\nG91 D1 G0 X5 Z5\nT2 M6\nZ1\nX1";
    // From X0 to X5 of the frame; Z0 to Z5 of a tip 10 below, then of one 12 below.
    let right = [[15.0, 0.0, 15.0], [15.0, 0.0, 18.0], [16.0, 0.0, 18.0]];
    assert_eq!(ends_with(both, text), right);
    let right = [[15.0, 0.0, 5.0], [15.0, 0.0, 6.0], [16.0, 0.0, 6.0]];
    assert_eq!(ends_with(frames, text), right);
    let right = [[5.0, 0.0, 15.0], [5.0, 0.0, 18.0], [6.0, 0.0, 18.0]];
    assert_eq!(ends_with(lengths, text), right);
}

#[test]
fn an_increment_in_doubt_is_refused() {
    // At X10 of the old coordinates, X0 Y-10 of the new ones.
    finds("G0 X10\nROT RPL=90\nG91 X5", &["3:5 not-supported"]);
    finds("G0 X10\nROT RPL=90\nG0 Y=IC(5)", &["3:6 not-supported"]);
    finds("G0 X10\nMIRROR X0\nG91 X5", &["3:5 not-supported"]);
    // Z has the same coordinate, X and Y get theirs by an absolute place.
    let text = "G0 X10 Z5\nROT RPL=90\nG91 Z-1\nG90 X1 Y2\nG91 X1";
    let right = [
        [10.0, 0.0, 5.0],
        [10.0, 0.0, 4.0],
        [-2.0, 1.0, 4.0],
        [-2.0, 2.0, 4.0],
    ];
    assert_eq!(ends(text), right);
    // At the centre of the turn nothing changes; a turn that is taken back changes nothing.
    assert_eq!(ends("ROT RPL=90\nG91 G0 X5"), [[0.0, 5.0, 0.0]]);
    assert_eq!(
        ends("G0 X10\nROT RPL=90\nROT\nG91 X5"),
        [[10.0, 0.0, 0.0], [15.0, 0.0, 0.0]]
    );
}
