//! Tests of saved modal state (M70 to M73), and overrides switched by the program (M50 to M53).

use crate::support::listed;
use glidepath_gcode::{Dialect, Options, Program, check};
use glidepath_program::{Event, ItemKind, PathMode, Rate};

/// What a program does: ends of moves in X and Z with their feedrate in mm/min, and events.
fn items(text: &str) -> String {
    let program = Program::new(text.as_bytes(), Options::default());
    let shown = program.map(|item| match item {
        Err(diagnostic) => diagnostic.to_string(),
        Ok(item) => match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                let feed = match rate {
                    Rate::Rapid => "r".to_owned(),
                    Rate::Feed(v) => format!("f{:.1}", 60.0 * v),
                    other => format!("{other:?}"),
                };
                format!("{feed}({:.1},{:.1})", end[0], end[2])
            }
            ItemKind::Event(Event::MCode(code) | Event::PassingCode(code)) => format!("M{code}"),
            ItemKind::Event(Event::SpindleSpeed(speed)) => format!("S{speed:.0}"),
            other => format!("{other:?}"),
        },
    });
    shown.collect::<Vec<_>>().join(" ")
}

#[track_caller]
fn finds(text: &str, expected: &str) {
    let report = check(text.as_bytes(), Options::default());
    let found = listed(&report);
    assert_eq!(found.first().map(String::as_str), Some(expected), "{text}");
}

#[test]
fn a_state_is_saved_and_restored_whole() {
    let mut program = Program::new(
        "G18 G20 G91 G90.1 G95 F0.5 G99 G7 G61.1 G55 G43.1 Z2\nM70\n\
         G17 G21 G90 G91.1 G94 F9 G98 G8 G64 P1 G54 G49\nM72\nG90 G0 X4 Z1"
            .as_bytes(),
        Options::default(),
    );
    let saved = {
        let mut only = Program::new(
            "G18 G20 G91 G90.1 G95 F0.5 G99 G7 G61.1".as_bytes(),
            Options::default(),
        );
        assert!(only.next().is_none());
        *only.modal()
    };
    assert_eq!(saved.path_mode, PathMode::ExactStop);
    let end = program.by_ref().last();
    let restored = *program.modal();
    assert_eq!((restored.plane, restored.units), (saved.plane, saved.units));
    assert_eq!(restored.arc_distance, saved.arc_distance);
    assert_eq!(
        (restored.feed, restored.feed_mode),
        (saved.feed, saved.feed_mode)
    );
    assert_eq!(
        (restored.retract, restored.diameter),
        (saved.retract, saved.diameter)
    );
    assert_eq!(restored.path_mode, saved.path_mode);
    // Inches, diameters, and the tool offset.
    let end = end.and_then(Result::ok).map(|item| item.kind);
    assert!(
        matches!(end, Some(ItemKind::Move { segment, .. })
            if (segment.end()[0] - 50.8).abs() < 1e-9 && (segment.end()[2] - 76.2).abs() < 1e-9),
        "{end:?}"
    );
}

#[test]
fn the_motion_mode_and_offsets_values_stay() {
    assert_eq!(
        items("F60 G0 M70\nG1 X1\nM72\nX2"),
        "f60.0(1.0,0.0) f60.0(2.0,0.0)"
    );
    assert_eq!(items("M70\nG10 L2 P1 X5 R0\nM72\nG0 X1"), "r(6.0,0.0)");
}

#[test]
fn spindle_and_coolant_go_back_by_events() {
    let text = "S100 M3 M8 M70\nS200 M4 M7 M49\nM72\nM72\nM5 M9\nM72";
    assert_eq!(
        items(text),
        "S100 M3 M8 S200 M4 M7 M49 S100 M3 M9 M8 M48 M5 M9 M3 M8"
    );
    assert_eq!(items("M70\nS50 M3 M7\nM72"), "S50 M3 M7 S0 M5 M9");
    let surface = "G0 X10\nG96 S100 M3 M70\nG97 S50\nM72\nG0 X20";
    assert_eq!(
        items(surface),
        "r(10.0,0.0) S1592 M3 S50 S1592 r(20.0,0.0) S796"
    );
}

#[test]
fn each_subroutine_has_a_place_of_its_own() {
    let text = "o1 sub\nG91\nM70\nG90 X5\nM72\nX1\no1 endsub\n\
                G0 X1 M70\no1 call\nX1\nM72\nX1";
    assert_eq!(
        items(text),
        "r(1.0,0.0) r(5.0,0.0) r(6.0,0.0) r(7.0,0.0) r(1.0,0.0)"
    );
    finds("o1 sub\nM72\no1 endsub\nM70\no1 call", "2:1 saved-state");
    finds("o1 sub\nM70\no1 endsub\no1 call\nM72", "5:1 saved-state");
    finds("M70\nM71\nM72", "3:1 saved-state");
    finds("M72", "1:1 saved-state");
}

#[test]
fn m73_restores_on_every_return() {
    let sub = "o1 sub\nM73\nG91 G1 F120 S9\nX1\no2 if [#1]\no1 return\no2 endif\nX1\no1 endsub\n";
    let text = format!("{sub}G90 F60 G1 X3\no1 call [1]\nX1\no1 call [0]\nX1");
    assert_eq!(
        items(&text),
        "f60.0(3.0,0.0) S9 f120.0(4.0,0.0) S0 f60.0(1.0,0.0) S9 f120.0(2.0,0.0) f120.0(3.0,0.0) S0 \
         f60.0(1.0,0.0)"
    );
    let forgets = "o1 sub\nM73\nG91\nM71\no1 endsub\nG0 X1\no1 call\nX1";
    assert_eq!(items(forgets), "r(1.0,0.0) r(2.0,0.0)");
    // The last state saved is the one restored.
    let again = "o1 sub\nM73\nG91\nM70\nG90\no1 endsub\nG0 X1\no1 call\nX1";
    assert_eq!(items(again), "r(1.0,0.0) r(2.0,0.0)");
    // The program itself returns nowhere.
    assert_eq!(items("S5 M73\nS6\nM2"), "S5 S6");
}

#[test]
fn cutter_radius_compensation_ends_and_never_begins() {
    let ends = "F60 M70\nG41.1 D2 G1 X5\nX9\nM72\nX20 Y5";
    let expected = "F60\nG41.1 D2 G1 X5\nX9\nG40\nX20 Y5";
    assert_eq!(items(ends), items(expected));
    let stays = "F60 G41.1 D2 G1 X5\nM70\nX9\nM72\nX20\nG40";
    assert_eq!(items(stays), items("F60 G41.1 D2 G1 X5\nX9\nX20\nG40"));
    finds("F60 G41.1 D2\nM70\nG40\nM72", "4:1 cutter-radius");
    finds("F60 G41.1 D2\nM70\nG40\nG42.1 D2\nM72", "5:1 cutter-radius");
    finds(
        "F60 G41.1 D2\nM70\nG40\nG55\nG41.1 D2\nM72",
        "6:1 cutter-radius",
    );
    finds(
        "o1 sub\nM73\nG40\no1 endsub\nF60 G41.1 D2\no1 call",
        "4:1 cutter-radius",
    );
}

#[test]
fn a_refused_block_leaves_what_was_saved() {
    let report = check(
        "G91\nM70\nG90\nM70 G0 X1.2.3\nM70 G1 X1\nM72\nG0 X1\nX1".as_bytes(),
        Options::default(),
    );
    // That there is no feedrate may be because of the first.
    assert_eq!(report.diagnostics.len(), 1);
    assert!((report.final_position[0] - 2.0).abs() < 1e-12);
    let report = check(
        "G43.1 Z5\nM70\nG49\nM72 G1 X1\nG0 Z1".as_bytes(),
        Options::default(),
    );
    assert_eq!(report.diagnostics.len(), 1);
    assert!((report.final_position[2] - 1.0).abs() < 1e-12);
}

#[test]
fn overrides_that_are_on_stay_on() {
    assert_eq!(
        items("M50\nM50 P1\nM51 P1\nM52 P0\nM53 P0\nM49\nM48\nM50"),
        "M49 M48"
    );
    for text in ["M50 P0", "M51 P0", "M52", "M52 P1", "M53 P1"] {
        finds(text, "1:1 not-supported");
    }
    finds("M49\nM50 P1", "2:1 not-supported");
    finds("M50 P2", "1:5 invalid-value");
    finds("M48 P1", "1:5 unused-word");
    finds("M50 M51", "1:5 modal-group-conflict");
}

#[test]
fn other_controls_have_other_meanings() {
    for (text, dialect) in [
        ("M70", Dialect::Fanuc),
        ("M72", Dialect::Siemens),
        ("M50 P1", Dialect::Fanuc),
        ("M71", Dialect::Marlin),
    ] {
        let options = Options {
            dialect,
            ..Options::default()
        };
        let report = check(text.as_bytes(), options);
        let found = report
            .diagnostics
            .first()
            .map(|diagnostic| diagnostic.code.as_str());
        assert_eq!(found, Some("not-supported"), "{text}");
    }
}
