//! Tests of what F of a FANUC is the feed of: rotary axes beside linear ones, and helices.

use std::f64::consts::PI;

use glidepath_gcode::{Dialect, FanucParameters, Machine, OffsetMemory, Options, Program, check};
use glidepath_geometry::Segment;
use glidepath_program::{ItemKind, Rate};

/// A mill with the rotary axes A, B and C.
fn options() -> Options {
    Options {
        machine: Machine::unlimited(),
        ..crate::fanuc_calls::options()
    }
}

/// Minutes that every move takes at its feed.
fn all_minutes(text: &str, options: Options) -> Vec<f64> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move {
                segment,
                rate: Rate::Feed(feed_v),
                ..
            } => Some(segment.length() / feed_v / 60.0),
            _ => None,
        })
        .collect()
}

/// The same of the last move.
fn minutes(text: &str, options: Options) -> f64 {
    let all = all_minutes(text, options);
    *all.last().expect("a move at feed")
}

#[track_caller]
fn takes(text: &str, expected: f64) {
    let found = minutes(text, options());
    assert!((found - expected).abs() < 1e-9, "{text}: {found}");
}

/// The example of the control's manual.
#[test]
fn degrees_count_as_millimetres() {
    takes("G91 G1 X20. C40. F300.", 20.0_f64.hypot(40.0) / 300.0);
    takes("G1 X1. F300.\nX21. C40.", 20.0_f64.hypot(40.0) / 300.0);
    takes("G1 X3. Y4. Z12. A84. F85.", 1.0);
    // In inches they count as inches.
    takes("G20 G91 G1 X30. C40. F10.", 5.0);
    // Alone F is in degrees.
    takes("G1 A30. B40. F10.", 5.0);
    takes("G20 G1 A30. F10.", 3.0);
    // A time is of all axes.
    takes("G93 G1 X1. A90. F2.", 0.5);
}

#[test]
fn a_helix_is_as_fast_as_its_arc() {
    let around = 20.0 * PI / 100.0;
    takes("G2 I10. Z-60. F100.", around);
    takes("G18 G3 K10. Y5. F100.", around);
    takes("G2 I10. F100.", around);
}

/// In G93 F times the radius is the feed of an arc; of a line it is over its minutes.
#[test]
fn an_arc_in_inverse_time_is_as_fast_as_its_radius() {
    takes("G93 G1 X10. Y10. F4.", 0.25);
    takes("G93 G2 I10. F1.", 2.0 * PI);
    takes("G93 G2 I10. Z-60. F1.", 2.0 * PI);
    takes("G20 G93 G2 I1. F1.", 2.0 * PI);
}

/// The same of all moves together.
fn minutes_in_all(text: &str, options: Options) -> f64 {
    all_minutes(text, options).into_iter().sum()
}

/// Frames change nothing of F, whether they are turned or tilted.
#[test]
fn an_arc_in_a_frame_is_as_fast_as_without_one() {
    let around = 20.0 * PI / 100.0;
    let five = || crate::five_axes::options(Dialect::Fanuc);
    for (text, expected) in [
        ("G93 G2 I10. F1.", 2.0 * PI),
        ("G93 G2 I10. Z-60. F1.", 2.0 * PI),
        ("G2 I10. Z-60. F100.", around),
        ("G2 I10. F100.", around),
        ("G93 G1 X10. Y10. F4.", 0.25),
    ] {
        let turned = format!("G18 G68 X0 Z0 R30.\nG17 {text}");
        let found = minutes_in_all(&turned, options());
        assert!((found - expected).abs() < 1e-5, "{turned}: {found}");
        let tilted = format!("G68.2 X20. Y10. Z0 J30.\nG53.1\nG0 X0 Y0 Z100.\n{text}");
        let found = minutes_in_all(&tilted, five());
        assert!((found - expected).abs() < 1e-5, "{tilted}: {found}");
    }
    let found = minutes_in_all("G68 X0 Y0 R30.\nG93 G18 G2 I10. F1.", options());
    assert!((found - 2.0 * PI).abs() < 1e-5, "{found}");
    // Twice as large, the arc takes twice the feed.
    let found = minutes_in_all("G51 X0 Y0 Z0 P2.\nG93 G2 I10. F1.", options());
    assert!((found - 2.0 * PI).abs() < 1e-5, "{found}");
    // Where the tip is followed it is not known what F is.
    let report = check(&b"G43.4 H1\nG93 G2 I10. F1."[..], five());
    assert_eq!(crate::support::listed(&report), ["2:5 not-supported"]);
    let report = check(&b"G43.4 H1\nG93 G1 X10. F1."[..], five());
    assert!(crate::support::listed(&report).is_empty());
}

/// F of a helix is that of the arc that the tool makes in the plane.
#[test]
fn a_helix_beside_its_contour_is_as_fast_as_its_own_arc() {
    let of_arc = |side: &str| {
        let text = format!(
            "G0 X-10. Y-20.\n{side} D2 G1 Y-10. F100.\nY0\nG2 X10. I10. Z-30.\nG1 Y-10.\nG40 Y-20."
        );
        let moves = Program::new(text.as_bytes(), options())
            .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
            .filter_map(|item| match item.kind {
                ItemKind::Move {
                    segment: segment @ Segment::Arc(_),
                    rate: Rate::Feed(feed_v),
                    ..
                } => Some(segment.length() / feed_v / 60.0),
                _ => None,
            });
        moves.collect::<Vec<_>>()
    };
    // Outside at a radius of 15; inside at 5, where F is the feed of the contour.
    for (side, expected) in [("G41", 15.0 * PI / 100.0), ("G42", 10.0 * PI / 100.0)] {
        let found = of_arc(side);
        assert_eq!(found.len(), 1, "{side}: {found:?}");
        assert!((found[0] - expected).abs() < 1e-9, "{side}: {found:?}");
    }
}

#[test]
fn of_a_haas_it_is_the_feed_of_the_linear_axes() {
    let haas = Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..FanucParameters::default()
        },
        ..options()
    };
    assert_eq!(minutes("G1 X10. A90. F10.", haas.clone()), 1.0);
    let helix = (20.0 * PI).hypot(60.0) / 100.0;
    assert!((minutes("G2 I10. Z-60. F100.", haas.clone()) - helix).abs() < 1e-9);
    assert!((minutes("G93 G2 I10. F1.", haas) - 1.0).abs() < 1e-9);
}
