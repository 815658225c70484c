//! Tests of series of holes on FANUC's and Haas' mills: what is in force behind G80, patterns of Haas. Values
//! are computed by hand.

use glidepath_gcode::{FanucParameters, OffsetMemory, Options, Program, check};
use glidepath_program::{Event, ItemKind, Rate};

use crate::fanuc_calls::{finds, options};
use crate::support::listed;

/// Ends of moves, with `r` where they are rapids; dwells and M codes beside them.
fn steps(text: &str) -> Vec<String> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Dwell(seconds) => Some(format!("{seconds}s")),
            ItemKind::Event(Event::MCode(code)) => Some(format!("M{code}")),
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

/// The moves alone.
fn ways(text: &str) -> Vec<String> {
    let all = steps(text).into_iter();
    all.filter(|step| step.contains(' ')).collect()
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

#[test]
fn the_far_side_of_a_bore() {
    let head = "G0 X10. Y20. Z30. S500 M3\n";
    // Aside by -0.5 in X past the wall to -12, up to -8 at feed, out to where the series began, also with G99.
    let hole = |x: f64| {
        let beside = x - 0.5;
        [
            "M19".to_owned(),
            format!("{beside} 20 30r"),
            format!("{beside} 20 -12r"),
            format!("{x} 20 -12r"),
            "M3".to_owned(),
            format!("{x} 20 -8"),
            "0.2s".to_owned(),
            "M19".to_owned(),
            format!("{beside} 20 -8r"),
            format!("{beside} 20 30r"),
            format!("{x} 20 30r"),
            "M3".to_owned(),
        ]
    };
    let text = format!("{head}G99 G87 X10. Z-8. R-12. I-.5 P200 F100\nX40.\nG80\nX0");
    let found = steps(&text);
    assert_eq!(found[2..14], hole(10.0));
    assert_eq!(found[14], "40 20 30r");
    assert_eq!(found[15..27], hole(40.0));
    assert_eq!(found[27..], ["0 20 30r"]);
    // With G91 R counts from the initial level, Z from R.
    let text = format!("{head}G91 G87 X0 Z4. R-42. I-.5 P200 F100");
    assert_eq!(steps(&text)[2..], hole(10.0));
    for (words, expected) in [
        // That of other controls.
        ("G87 Z-8. R2. I.5 F100", "2:1 canned-cycle"),
        ("G87 Z-8. R-12. F100", "2:1 missing-word"),
        ("G87 Z-8. R-12. Q.5 F100", "2:16 ambiguous-word"),
        ("M5\nG87 Z-8. R-12. I.5 F100", "3:1 spindle"),
        (
            "G68 X0 Y0 R90.\nG87 X1. Z-8. R-12. I.5 F100",
            "3:1 canned-cycle",
        ),
    ] {
        finds(&format!("{head}{words}"), &[expected]);
    }
    let haas = FanucParameters {
        offset_memory: OffsetMemory::Haas,
        ..FanucParameters::default()
    };
    let options = Options {
        fanuc: haas,
        ..options()
    };
    let text = format!("{head}G87 X1. Z-8. R-12. I.5 F100");
    assert_eq!(
        listed(&check(text.as_bytes(), options)),
        ["2:1 canned-cycle"]
    );
}
