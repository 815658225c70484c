//! Tests of the levels of FANUC's cycles: where they begin, R, the bottom, and where they come out.

use glidepath_gcode::{FanucParameters, OffsetMemory, Options, Program, check};
use glidepath_program::{Event, ItemKind, Rate};

use crate::fanuc_calls::{ends, finds, options};
use crate::fanuc_cycles::last;

/// The way out to a level below the bottom leads through the part.
#[test]
fn a_cycle_that_begins_below_its_bottom_is_refused() {
    for (text, at) in [
        ("G0 Z-20\nG98 G81 X10 Z-10 R2 F600", "2:5 canned-cycle"),
        ("G0 Z-10\nG98 G81 X10 Z-10 R2 F600", "2:5 canned-cycle"),
        ("G0 Z-20\nG98 G85 X10 Z-10 R2 F600", "2:5 canned-cycle"),
        ("G0 Z-20\nG91 G98 G81 X10 Z-5 R15 F600", "2:9 canned-cycle"),
        // The level of the series is that of its first block.
        (
            "G0 Z-20\nG99 G81 X10 Z-30 R2 F600\nG98 X20 Z-10",
            "3:5 canned-cycle",
        ),
        (
            "G0 Z-20\nG99 G81 Z-10 R2 F600 L0\nG98 G70 I5 L3",
            "3:5 canned-cycle",
        ),
    ] {
        finds(text, &[at]);
    }
    let end = |text: &str| last(text)[2];
    assert_eq!(end("G0 Z-20\nG99 G81 X10 Z-10 R2 F600"), 2.0);
    assert_eq!(end("G0 Z-9\nG98 G81 X10 Z-10 R2 F600"), -9.0);
    // What a Haas makes of a level below R is not known.
    let haas = |text: &str| {
        let haas = Options {
            fanuc: FanucParameters {
                offset_memory: OffsetMemory::Haas,
                ..FanucParameters::default()
            },
            ..options()
        };
        crate::support::listed(&check(text.as_bytes(), haas))
    };
    assert_eq!(
        haas("G0 Z-9\nG98 G81 X10 Z-10 R2 F600"),
        ["2:5 canned-cycle"]
    );
    assert!(haas("G0 Z-9\nG99 G81 X10 Z-10 R2 F600").is_empty());
    assert!(haas("G0 Z2\nG98 G81 X10 Z-10 R2 F600").is_empty());
}

#[test]
fn g89_is_at_rapid_above_r() {
    let text = "G0 Z5\nG89 X0 Y0 Z-8 R2 F120";
    let up: Vec<(f64, bool)> = Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => Some((segment.end()[2], rate == Rate::Rapid)),
            _ => None,
        })
        .collect();
    assert_eq!(
        up,
        [
            (5.0, true),
            (2.0, true),
            (-8.0, false),
            (2.0, false),
            (5.0, true)
        ]
    );
}

#[test]
fn levels_stay_where_distances_change_to_increments() {
    // A row and a column of holes from a hole that was given by coordinates.
    let bottoms = |text: &str| -> Vec<[f64; 3]> {
        let all = ends(text).into_iter();
        all.filter(|[_, _, z]| *z < 0.0).collect()
    };
    let text = "G0 Z10.\nG99 G81 Z-5. R2. F100. L0\nG91 X10. L2\nY5.\nG90 X0 Y0\nG80";
    let expected = [
        [10.0, 0.0, -5.0],
        [20.0, 0.0, -5.0],
        [20.0, 5.0, -5.0],
        [0.0, 0.0, -5.0],
    ];
    assert_eq!(bottoms(text), expected);
    // And the other way round: R is at 10 - 8, the bottom 5 below it. A new R alone leaves the bottom.
    let text = "G0 Z10.\nG91 G99 G81 X1. Z-5. R-8. F100.\nG90 X7.\nG91 X1. R-9.\nX1. Z-2.";
    let expected = [
        [1.0, 0.0, -3.0],
        [7.0, 0.0, -3.0],
        [8.0, 0.0, -3.0],
        [9.0, 0.0, -1.0],
    ];
    assert_eq!(bottoms(text), expected);
}

/// Below R the tool goes across where it stands, then up to R, and with G98 back to where it began.
#[test]
fn a_cycle_that_begins_below_r() {
    assert_eq!(
        ends("G0 Z1\nG98 G81 X10 Z-5 R2 F100\nX20")[1..],
        [
            [10.0, 0.0, 1.0],
            [10.0, 0.0, 2.0],
            [10.0, 0.0, -5.0],
            [10.0, 0.0, 1.0],
            [20.0, 0.0, 1.0],
            [20.0, 0.0, 2.0],
            [20.0, 0.0, -5.0],
            [20.0, 0.0, 1.0],
        ]
    );
    assert_eq!(
        ends("G0 Z1\nG99 G81 X10 Z-5 R2 F100\nX20")[1..],
        [
            [10.0, 0.0, 1.0],
            [10.0, 0.0, 2.0],
            [10.0, 0.0, -5.0],
            [10.0, 0.0, 2.0],
            [20.0, 0.0, 2.0],
            [20.0, 0.0, -5.0],
            [20.0, 0.0, 2.0],
        ]
    );
}

/// Whoever crosses below R is told; above it, and where the tool stands over the hole already, it is not.
#[test]
fn the_way_across_below_r_is_told() {
    let is_told = |text: &str| {
        let report = check(text.as_bytes(), options());
        assert!(report.is_accepted(), "{text}");
        report.lacks.crossing
    };
    assert!(is_told("G0 Z1\nG98 G81 X10 Z-5 R2 F100"));
    assert!(is_told("G0 Z1\nG99 G81 X10 Z-5 R2 F100"));
    assert!(is_told("G0 X10 Z1\nG98 G81 X10 Z-5 R2 F100\nX20"));
    assert!(!is_told("G0 X10 Z1\nG99 G81 X10 Z-5 R2 F100\nX20"));
    assert!(!is_told("G0 Z5\nG98 G81 X10 Z-5 R2 F100\nX20"));
}

/// A tap in a holder comes out to R at its feed, and goes on at rapid.
#[test]
fn a_tap_is_out_at_r() {
    let text = "S500 M3\nG0 Z50\nG98 G84 Z-5 R5 F500";
    let rates: Vec<String> = Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let mark = if rate.is_rapid() { "r" } else { "" };
                Some(format!("{}{mark}", segment.end()[2]))
            }
            ItemKind::Event(Event::MCode(code)) => Some(format!("M{code}")),
            _ => None,
        })
        .collect();
    let from_r = rates.iter().position(|it| it == "5r").expect("R");
    assert_eq!(
        rates[from_r..],
        ["5r", "M49", "-5", "M4", "5", "M3", "M48", "50r"]
    );
}
