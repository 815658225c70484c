//! Tests of series of holes on FANUC's and Haas' mills: what is in force behind G80. Values are
//! computed by hand.

use glidepath_gcode::Program;
use glidepath_program::{ItemKind, Rate};

use crate::fanuc_calls::options;

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
