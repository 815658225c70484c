//! Tests of series of holes on FANUC's and Haas' mills: what is in force behind G80, patterns of Haas. Values
//! are computed by hand.

use glidepath_gcode::Program;
use glidepath_program::{ItemKind, Rate};

use crate::fanuc_calls::{finds, options};

/// Ends of moves, with `r` where they are rapids.
fn ways(text: &str) -> Vec<String> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                let [x, y, z] = [0, 1, 2].map(|axis| (end[axis] * 1e3).round() / 1e3 + 0.0);
                let mark = if rate == Rate::Rapid { "r" } else { "" };
                Some(format!("{x} {y} {z}{mark}"))
            }
            _ => None,
        })
        .collect()
}

#[test]
fn behind_g80_moves_are_what_they_were_in_front_of_the_cycle() {
    let holes = "G81 X1. Y1. Z-5. R2. F100\nG80\nX9.";
    let last = |text: &str| ways(text).pop().expect("a move");
    // Whether the code stands alone with coordinates, or beside other words.
    for (head, mark) in [
        ("G1 X0 Y0 Z20. F500 M8\nG0 Z10.\nX5.\n", "r"),
        ("G1 X0 Y0 Z20. F500 M8\nG0 Z10.\n", "r"),
        ("G0 X0 Y0 Z20. M8\nG1 Z10. F500\nX5.\n", ""),
        ("G0 X0 Y0 Z20. M8\nG1 Z10. F500\n", ""),
        ("G0 Z10.\n", "r"),
        ("Z10. M8\n", "r"),
    ] {
        assert_eq!(
            last(&format!("{head}{holes}")),
            format!("9 1 10{mark}"),
            "{head}"
        );
        let again = format!("{head}G81 X1. Y1. Z-5. R2. F100\nG80\n{holes}");
        assert_eq!(last(&again), format!("9 1 10{mark}"), "{head}");
    }
    // An arc in front of plain lines is over.
    let text = format!("G0 Z10.\nG2 X2. I1. F500\nG1 Y2.\nG0 X5.\n{holes}");
    assert_eq!(last(&text), "9 1 10r");
    // In one block.
    assert_eq!(
        last("G0 Z10. M8\nG1 X1. F500\nG81 X2. Z-5. R2. F100\nG80 X9."),
        "9 0 10"
    );
}

#[test]
fn holes_on_a_circle() {
    let head = "G0 X10. Y20. Z10.\n";
    // Four holes of radius 5, the first one at 90 degrees; none in the middle.
    let text = format!("{head}G81 G99 Z-3. R2. F100 L0\nG70 I5. J90. L4\nG80\nX0 Y0");
    assert_eq!(
        ways(&text)[1..],
        [
            "10 25 10r",
            "10 25 2r",
            "10 25 -3",
            "10 25 2r",
            "5 20 2r",
            "5 20 -3",
            "5 20 2r",
            "10 15 2r",
            "10 15 -3",
            "10 15 2r",
            "15 20 2r",
            "15 20 -3",
            "15 20 2r",
            "0 0 2r",
        ]
    );
    // With G98 to the initial level, with an arc of 30 degrees; the cycle is in force behind it.
    let text = format!("{head}G81 G98 Z-3. R2. F100 L0\nG71 I10. J0 K-90. L2\nX0 Y0");
    assert_eq!(
        ways(&text)[1..],
        [
            "20 20 10r",
            "20 20 2r",
            "20 20 -3",
            "20 20 10r",
            "10 10 10r",
            "10 10 2r",
            "10 10 -3",
            "10 10 10r",
            "0 0 10r",
            "0 0 2r",
            "0 0 -3",
            "0 0 10r",
        ]
    );
    // In inches.
    let text = "G20\nG0 X1. Z1.\nG81 G99 Z-.1 R.1 F10. L0\nG70 I1. L1\nG80";
    assert_eq!(ways(text)[1], "50.8 0 25.4r");
}

#[test]
fn patterns_that_are_refused() {
    let cycle = "G81 G99 Z-3. R2. F100 L0\n";
    finds("G70 I5. J0 L4", &["1:1 canned-cycle"]);
    finds(&format!("{cycle}G80\nG70 I5. J0 L4"), &["3:1 canned-cycle"]);
    for (text, code) in [
        ("G70 J0 L4", "2:1 missing-word"),
        ("G70 I5. J0", "2:1 missing-word"),
        ("G70 I5. J0 L0", "2:1 missing-word"),
        ("G71 I5. J0 L4", "2:1 missing-word"),
        ("G70 I5. K5. L4", "2:9 unused-word"),
        ("G70 I0 L4", "2:5 canned-cycle"),
        ("G70 X5. I5. L4", "2:5 unused-word"),
        ("G72 I5. J0 L4", "2:1 not-supported"),
    ] {
        finds(&format!("{cycle}{text}"), &[code]);
    }
}
