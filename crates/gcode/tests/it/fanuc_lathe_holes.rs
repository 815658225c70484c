//! Tests of the cycles for holes on the face of FANUC's and Haas' lathes.

use glidepath_gcode::{FanucControl, FanucParameters, Machine, OffsetMemory, Program, check};
use glidepath_geometry::Axis;
use glidepath_program::ItemKind;

use crate::fanuc_cycles::dwells_of;
use crate::fanuc_lathe_passes::{ends_with, options, with};

#[test]
fn r_of_a_hole_is_a_way_or_a_place() {
    let a = FanucParameters::default();
    let haas = FanucParameters {
        offset_memory: OffsetMemory::Haas,
        ..a
    };
    let b = FanucParameters {
        control: Some(FanucControl::LatheB),
        ..a
    };
    let z = |text: &str, fanuc: FanucParameters| -> Vec<f64> {
        let text = format!("G97 S600 M3\n{text}");
        ends_with(&text, with(fanuc))
            .iter()
            .map(|end| end[1])
            .collect()
    };
    // Without Q at once. R is 8 below the initial level.
    let plain = [10.0, 2.0, -30.0, 10.0];
    assert_eq!(z("G98 G0 X0 Z10\nG83 Z-30 R-8 F200", a), plain);
    // Away from the hole: it is the place, as Haas writes it.
    assert_eq!(z("G98 G0 X0 Z10\nG83 Z-30 R2 F200", a), plain);
    assert_eq!(z("G98 G0 X0 Z10\nG83 Z-30 R2 F200", haas), plain);
    assert_eq!(
        z("G98 G0 X0 Z10\nG83 Z-30 R-2 F200", haas),
        [10.0, -2.0, -30.0, 10.0]
    );
    assert_eq!(z("G98 G0 X0 Z10\nG83 Z-30 F200", haas), [10.0, -30.0, 10.0]);
    // System B: as G90 and G91 say.
    assert_eq!(
        z("G94 G90 G0 X0 Z10\nG99 G83 Z-30 R2 F300", b),
        [10.0, 2.0, -30.0, 2.0]
    );
    assert_eq!(
        z("G94 G90 G0 X0 Z10\nG91 G99 G83 Z-32 R-8 F300", b),
        [10.0, 2.0, -30.0, 2.0]
    );
}

/// X, Z and C at the ends of moves of a lathe with C.
fn turned(text: &str) -> Vec<[f64; 3]> {
    let mut options = options();
    options.machine = Machine::new(&[Axis::X, Axis::Z, Axis::C]);
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => Some([0, 2, 5].map(|axis| segment.end()[axis])),
            _ => None,
        })
        .collect()
}

#[test]
fn h_alone_is_an_increment_of_c() {
    assert_eq!(
        turned("G98 G0 X20. C10.\nH10.\nG1 H-5. F100\nH1."),
        [
            [10.0, 0.0, 10.0],
            [10.0, 0.0, 20.0],
            [10.0, 0.0, 15.0],
            [10.0, 0.0, 16.0]
        ]
    );
    for text in ["G98 G0 X20. H10.", "G98 G0 X20.\nH10."] {
        let report = check(text.as_bytes(), options());
        assert_eq!(
            report.diagnostics[0].code.as_str(),
            "axis-not-configured",
            "{text}"
        );
    }
}

#[test]
fn c_turns_on_the_way_to_a_hole_on_the_face() {
    let text = "G98 G0 X20. Z5. C0\nG83 Z-20. R-1. F100\nC90.\nH45.\nG80";
    let all = turned(text);
    let bottoms: Vec<f64> = all
        .iter()
        .filter(|end| end[1] == -20.0)
        .map(|end| end[2])
        .collect();
    assert_eq!(bottoms, [0.0, 90.0, 135.0], "{all:?}");
    // C turns outside of the holes.
    for pair in all.windows(2) {
        let turns = (pair[0][2] - pair[1][2]).abs() > 0.0;
        assert!(
            !turns || pair[0][1] == pair[1][1] && pair[0][1] > 0.0,
            "{all:?}"
        );
    }
    // Cycles along X and Z turn nothing.
    let mut with_c = options();
    with_c.machine = Machine::new(&[Axis::X, Axis::Z, Axis::C]);
    for text in [
        "G90 X10. Z-5. C90. F100",
        "G90 X10. Z-5. H90. F100",
        "G94 X10. Z-5. C90. F100",
        "G75 X10. Z-5. P1000 Q1000 C90. F100",
    ] {
        let text = format!("G98 G0 X20. Z2.\n{text}");
        let report = check(text.as_bytes(), with_c.clone());
        assert_eq!(report.diagnostics[0].code.as_str(), "unused-word", "{text}");
    }
}

#[test]
fn p_of_holes_on_the_face_is_a_dwell_at_the_bottom() {
    let dwells = |cycle: &str| -> Vec<f64> {
        let text = format!("G98 G0 X0 Z10\n{cycle} Z-30 R-8 P1500 F200");
        dwells_of(&text, options())
    };
    assert_eq!(dwells("G83"), [1.5]);
    assert_eq!(dwells("G83 Q9000"), [1.5]);
    assert_eq!(dwells("G85"), [1.5]);
}

/// A FANUC's lathe comes out of a bore at twice the feed.
#[test]
fn a_bore_is_left_at_twice_the_feed() {
    let text = "G98 G0 X0 Z10\nG85 Z-30 R-8 F200\nG80\nG1 Z20";
    let feeds = |offset_memory| -> Vec<f64> {
        let fanuc = FanucParameters {
            offset_memory,
            ..options().fanuc
        };
        Program::new(text.as_bytes(), with(fanuc))
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Move { rate, .. } => rate.feed_v().filter(|_| !rate.is_rapid()),
                _ => None,
            })
            .map(|feed_v| (feed_v * 60.0).round())
            .collect()
    };
    assert_eq!(feeds(OffsetMemory::Unsaid), [200.0, 400.0, 200.0]);
    assert_eq!(feeds(OffsetMemory::Haas), [200.0, 200.0, 200.0]);
}
