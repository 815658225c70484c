//! Tests of what programs do: positions, rates, modes and the order of events.

#![expect(
    clippy::panic,
    clippy::expect_used,
    reason = "a wrong item fails the test"
)]

use core::f64::consts::{PI, TAU};

use glidepath_gcode::{Options, Program};
use glidepath_geometry::{Arc, Axis, AxisVector, Plane, Segment};
use glidepath_program::{Event, Item, ItemKind, PathMode, Rate};

fn items(text: &str) -> Vec<Item> {
    let program = Program::new(text.as_bytes(), Options::default());
    program
        .map(|item| item.unwrap_or_else(|diagnostic| panic!("{text}: {diagnostic}")))
        .collect()
}

fn moves(text: &str) -> Vec<(Segment, Rate, PathMode)> {
    let of = |item: Item| match item.kind {
        ItemKind::Move {
            segment,
            rate,
            mode,
        } => Some((segment, rate, mode)),
        _ => None,
    };
    items(text).into_iter().filter_map(of).collect()
}

fn last(text: &str) -> (Segment, Rate, PathMode) {
    *moves(text).last().expect("a move")
}

#[track_caller]
fn ends_at(text: &str, axes: &[(Axis, f64)]) {
    let mut expected = AxisVector::zeros();
    for (axis, value) in axes {
        expected[axis.index()] = *value;
    }
    let end = last(text).0.end();
    assert!((end - expected).norm() < 1e-9, "{text}: {end}");
}

fn arc(text: &str) -> Arc {
    match last(text).0 {
        Segment::Arc(arc) => arc,
        other => panic!("{text}: {other:?}"),
    }
}

#[track_caller]
fn feeds_at(text: &str, expected_v: f64) {
    match last(text).1 {
        Rate::Feed(feed_v) => {
            assert!(
                (feed_v - expected_v).abs() < 1e-12 * expected_v,
                "{text}: {feed_v}"
            );
        }
        other => panic!("{text}: {other:?}"),
    }
}

use Axis::{A, U, X, Y, Z};

#[test]
fn distances_units_and_spelling() {
    ends_at("G0 X1\nG91 X2\nY3", &[(X, 3.0), (Y, 3.0)]);
    ends_at("g20g0x1 y-.5a10", &[(X, 25.4), (Y, -12.7), (A, 10.0)]);
    ends_at("N10G0X1(c)Y 2 0 ; z", &[(X, 1.0), (Y, 20.0)]);
    ends_at("%\nO0001\nG0 X1\n%\nG0 X2", &[(X, 1.0)]);
    ends_at("G0 X1\nM30\nG0 X2", &[(X, 1.0)]);
    ends_at("G0 X1\rG0 X2\r\nG0 X3", &[(X, 3.0)]);
    ends_at("/G0 X1", &[(X, 1.0)]);
    let options = Options {
        block_delete: true,
        ..Options::default()
    };
    assert_eq!(Program::new(" /G0 X1 @".as_bytes(), options).count(), 0);
}

#[test]
fn coordinate_systems() {
    ends_at("G10 L2 P2 X10 Y20\nG55 G0 X1", &[(X, 11.0)]);
    ends_at("G10 L2 P0 X10\nG0 X1", &[(X, 11.0)]);
    ends_at("G10 L2 P9 Z5\nG59.3 G0 Z1 U1", &[(Z, 6.0), (U, 1.0)]);
    ends_at("G0 X5\nG10 L20 P1 X1\nX2", &[(X, 6.0)]);
    ends_at("G0 X5\nG92 X1\nX2 Y0", &[(X, 6.0)]);
    ends_at("G0 X5\nG92 X1\nG92 X10\nX11", &[(X, 6.0)]);
    ends_at("G0 X5\nG92 X1\nG92.1\nX2", &[(X, 2.0)]);
    ends_at("G0 X5\nG92 X1\nG92.2\nX2\nG92.3\nX3", &[(X, 7.0)]);
    ends_at("G0 X5\nG92 X1\nG92.1\nG92.3\nX3", &[(X, 3.0)]);
    ends_at("G52 X3\nG0 X1", &[(X, 4.0)]);
    ends_at("G10 L2 P1 X10\nG0 X1\nG53 X2", &[(X, 2.0)]);
    ends_at("G10 L2 P1 R90\nG0 X1", &[(Y, 1.0)]);
    ends_at(
        "G10 L2 P1 R90\nG91 G0 X1\nY1 A5",
        &[(X, -1.0), (Y, 1.0), (A, 5.0)],
    );
}

#[test]
fn references_are_reached_by_way_of_the_given_point() {
    let path = moves("G0 X1 Y2 Z3\nG28 Z10");
    assert_eq!(path.len(), 3);
    assert!((path[1].0.end()[2] - 10.0).abs() < 1e-12);
    ends_at("G0 X1 Y2 Z3\nG28 Z10", &[(X, 1.0), (Y, 2.0)]);
    ends_at("G0 X1 Y2\nG28.1\nX9\nG28", &[(X, 1.0), (Y, 2.0)]);
    ends_at("G0 X1\nG30.1\nX9 Y9\nG91 G30 X0", &[(X, 1.0), (Y, 9.0)]);
}

#[test]
fn feedrates() {
    feeds_at("G1 X1 F600", 10.0);
    feeds_at("G20\nG1 X1 F60", 25.4);
    // F acts before G20 of the same block.
    feeds_at("G20 G1 X1 F60", 1.0);
    feeds_at("G20\nG1 A90 F600", 10.0);
    feeds_at("G20\nG1 X1 A90 F600", 254.0);
    feeds_at("G93 G1 X30 Y40 F2", 50.0 * 2.0 / 60.0);
    feeds_at("G93 G2 X10 I5 F1", 5.0 * PI / 60.0);
    feeds_at("G93 G1 A90 F6", 9.0);
    let options = Options {
        default_feed_mm_min: Some(120.0),
        ..Options::default()
    };
    let mut program = Program::new("G1 X1".as_bytes(), options);
    let item = program.next().expect("a move").expect("no diagnostic");
    assert!(
        matches!(
            item.kind,
            ItemKind::Move {
                rate: Rate::Feed(2.0),
                ..
            }
        ),
        "{item:?}"
    );
}

#[test]
fn arcs_in_every_plane() {
    let half = arc("G3 X-10 I-5 F1");
    assert_eq!((half.plane, half.center), (Plane::Xy, [-5.0, 0.0]));
    assert!((half.sweep_rad - PI).abs() < 1e-12);
    // In G18 the positive turn is from Z to X, so a quarter from +Z to +X is G3.
    let quarter = arc("G0 Z5\nG18 G3 X5 Z0 K-5 F1");
    assert_eq!(quarter.plane, Plane::Zx);
    assert!((quarter.sweep_rad - PI / 2.0).abs() < 1e-12);
    let quarter = arc("G0 Y5\nG19 G2 Y0 Z-5 J-5 F1");
    assert!((quarter.sweep_rad + PI / 2.0).abs() < 1e-12);
    let uv = arc("G17.1 G3 U-10 I-5 F1");
    assert_eq!((uv.plane, uv.center), (Plane::Uv, [-5.0, 0.0]));
}

#[test]
fn arcs_of_every_format() {
    assert!((arc("G2 I5 F1").sweep_rad + TAU).abs() < 1e-12);
    assert!((arc("G3 X0 Y0 J5 P3 Z9 F1").sweep_rad - 3.0 * TAU).abs() < 1e-12);
    assert!((arc("G3 X10 Y10 J10 P2 F1").sweep_rad - 2.5 * PI).abs() < 1e-12);
    let absolute = arc("G0 X1\nG90.1 G3 X3 I2 J0 F1");
    assert!((absolute.center[0] - 2.0).abs() < 1e-12);
    assert!((arc("G3 X10 Y10 R10 F1").sweep_rad - PI / 2.0).abs() < 1e-12);
    assert!((arc("G3 X10 Y10 R-10 F1").sweep_rad - 1.5 * PI).abs() < 1e-12);
    assert!((arc("G2 X10 Y10 R10 F1").sweep_rad + PI / 2.0).abs() < 1e-12);
    let inch = arc("G20\nG3 X-2 I-1 F1");
    assert!((inch.center[0] + 25.4).abs() < 1e-12);
    // Half a micrometre short of half the distance: a half circle.
    assert!((arc("G3 X10 R4.9995 F1").sweep_rad - PI).abs() < 1e-6);
    // Centre words alone repeat the modal arc.
    assert_eq!(moves("G2 I5 F1\nI6").len(), 2);
}

#[test]
fn arcs_follow_the_rotation_of_their_coordinate_system() {
    let turned = arc("G10 L2 P1 X100 R90\nG0 X0 Y0\nG3 X-10 I-5 F1");
    assert!((turned.center[0] - 100.0).abs() < 1e-9);
    assert!((turned.center[1] + 5.0).abs() < 1e-9);
    assert!((turned.sweep_rad - PI).abs() < 1e-9);
    let absolute = arc("G10 L2 P1 X100 R90\nG0 X0 Y0\nG90.1 G3 X-10 I-5 J0 F1");
    assert!((absolute.center[0] - turned.center[0]).abs() < 1e-9);
    assert!((absolute.center[1] - turned.center[1]).abs() < 1e-9);
}

#[test]
fn path_modes() {
    let mode = |text: &str| last(text).2;
    assert_eq!(mode("G0 X1"), PathMode::Continuous { tolerance_mm: None });
    assert_eq!(mode("G61\nG0 X1"), PathMode::ExactPath);
    assert_eq!(mode("G61.1 G0 X1"), PathMode::ExactStop);
    let tolerance = |value| PathMode::Continuous {
        tolerance_mm: Some(value),
    };
    assert_eq!(mode("G64 P0.5 Q0.1\nG0 X1"), tolerance(0.5));
    assert_eq!(mode("G20 G64 P0.5 G0 X1"), tolerance(12.7));
    assert_eq!(
        mode("G64 P0.5\nG64\nG0 X1"),
        PathMode::Continuous { tolerance_mm: None }
    );
    assert_eq!(mode("G64 P0\nG0 X1"), PathMode::ExactPath);
}

/// What is in force afterwards is what the program says, and so is what a thread asks for its corners.
#[test]
fn a_run_may_use_more_of_its_tolerance() {
    let text = "G20 G64 P0.5 F9\nG0 X1\nG1 Y1\nG2 X2 Y2 R1\nG42.1 D0.1 G1 X3\nY3\nG40 X4 Y4\nG64 G1 X9\nG61 G1 X8\nG64 P0.25\n";
    let said = |ratio| {
        let options = Options {
            tolerance_ratio: ratio,
            ..Options::default()
        };
        let mut program = Program::new(text.as_bytes(), options);
        let mut modes = Vec::new();
        for item in program.by_ref() {
            if let ItemKind::Move { mode, .. } = item.unwrap().kind {
                modes.push(mode);
            }
        }
        (modes, program.in_force().words())
    };
    let (own, in_force) = said(1.0);
    let twice = |mode: &PathMode| match *mode {
        PathMode::Continuous {
            tolerance_mm: Some(own),
        } => PathMode::Continuous {
            tolerance_mm: Some(2.0 * own),
        },
        mode => mode,
    };
    assert_eq!(
        own[0],
        twice(&PathMode::Continuous {
            tolerance_mm: Some(6.35)
        })
    );
    assert!(own.contains(&PathMode::ExactPath), "{own:?}");
    let expected: Vec<PathMode> = own.iter().map(twice).collect();
    assert_eq!(said(2.0), (expected, in_force));
}

#[test]
fn a_block_acts_in_the_prescribed_order() {
    let all = items("M0 G1 X1 G4 P2.5 M8 M3 M6 T7 S1000 F60 M48\nM1 M9\nM60\nM2\nM3");
    let kinds: Vec<_> = all.iter().map(|item| (item.line, item.kind)).collect();
    let event = ItemKind::Event;
    let (line, head) = (1, &kinds[..7]);
    assert_eq!(
        head,
        [
            (line, event(Event::SpindleSpeed(1000.0))),
            (line, event(Event::SelectTool(7))),
            (line, event(Event::MCode(6))),
            (line, event(Event::MCode(3))),
            (line, event(Event::PassingCode(8))),
            (line, event(Event::PassingCode(48))),
            (line, ItemKind::Dwell(2.5)),
        ]
    );
    assert!(matches!(kinds[7].1, ItemKind::Move { .. }));
    assert_eq!(
        kinds[8..],
        [
            (1, event(Event::ProgramStop(0))),
            (2, event(Event::PassingCode(9))),
            (2, event(Event::OptionalStop)),
            (3, event(Event::ProgramStop(60))),
            (4, event(Event::MCode(5))),
        ]
    );
}

#[test]
fn moves_join_exactly_and_those_of_no_length_are_left_out() {
    let text = "G20 G0 X0.1 Y0.7\nG91 X0.1 Y-0.3\nX0\nG90 X0.2 Y0.4\nG1 F10 X0.3\nG1\nX0.3";
    let path = moves(text);
    assert_eq!(path.len(), 3);
    for pair in path.windows(2) {
        assert_eq!(pair[0].0.end(), pair[1].0.start());
    }
    let mut program = Program::new(text.as_bytes(), Options::default());
    assert_eq!(program.by_ref().count(), 3);
    let totals = program.totals();
    assert_eq!(
        (totals.zero_length_rapids, totals.zero_length_feeds),
        (2, 1)
    );
    assert_eq!(
        (totals.lines, totals.rapids, totals.straight_feeds),
        (7, 2, 1)
    );
}
