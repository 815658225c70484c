//! Tests of what is refused: kind, line and column of the diagnostic for each.

use crate::support::listed;
use glidepath_gcode::{AxisTravel, Dialect, Machine, Options, Program, Report, check};
use glidepath_geometry::Axis;
use glidepath_program::{Item, ItemKind, Rate};
use proptest::prelude::*;

fn report(text: &str) -> Report {
    check(text.as_bytes(), Options::default())
}

#[track_caller]
fn refuses(text: &str, expected: &str) {
    assert_eq!(listed(&report(text)), [expected], "{text}");
}

#[track_caller]
fn accepts(text: &str) {
    assert_eq!(listed(&report(text)), Vec::<String>::new(), "{text}");
}

#[test]
fn text_that_is_no_block() {
    refuses("G0 X1\n  ) G0", "2:3 bad-character");
    refuses("G0 X1 /Y2", "1:7 bad-character");
    refuses("G0 X1 & Y2", "1:7 bad-character");
    refuses("G0 X1 * Y2", "1:7 bad-character");
    refuses("(a\u{e9}) G0 X\u{2212}1", "1:11 non-ascii-character");
    refuses("G0 (open", "1:4 unclosed-comment");
    refuses("G0 (a(b))", "1:6 nested-comment");
    refuses("%O1000", "1:2 stray-percent");
    refuses("G0 X1 %", "1:7 stray-percent");
    refuses("G0 X", "1:4 missing-number");
    refuses("G", "1:1 missing-number");
    refuses("G0 N5 X1", "1:4 misplaced-block-number");
    refuses("N-1 G0", "1:1 invalid-value");
    refuses("N10 N", "1:5 missing-number");
}

#[test]
fn codes_and_words() {
    refuses("G5.21", "1:1 unknown-g-code");
    refuses("G-1", "1:1 unknown-g-code");
    refuses("G99999999", "1:1 unknown-g-code");
    refuses("G1 M117", "1:4 unknown-m-code");
    refuses("G33.1 Z-1 K1", "1:1 not-connected");
    refuses("M19 R90", "1:1 not-connected");
    refuses("M64 P1", "1:1 not-connected");
    refuses("G38.2 X1 F1", "1:1 not-connected");
    refuses("G41 D1", "1:5 unknown-tool");
    refuses("G43 H1", "1:5 unknown-tool");
    refuses("G0 X1 E2", "1:7 unknown-word");
    refuses("G0 X1 X2", "1:7 duplicate-word");
    refuses("G0 G1 X1 F1", "1:4 modal-group-conflict");
    refuses("M3 M5", "1:4 modal-group-conflict");
    refuses("G4 G53 P1", "1:4 modal-group-conflict");
    refuses("G0 X1 I2", "1:7 unused-word");
    refuses("G0 X1 P2", "1:7 unused-word");
    refuses("G61 P0.1", "1:5 unused-word");
    refuses("H1", "1:1 unused-word");
    refuses("G10 L2 P1 X0 Q1", "1:14 unused-word");
    refuses("G10 L20 P1 X0 R90", "1:15 unused-word");
    refuses("G4 G64 P1", "1:8 ambiguous-word");
    refuses("G4", "1:1 missing-word");
    refuses("G4 P-1", "1:4 invalid-value");
    refuses("G64 P-0.1", "1:5 invalid-value");
    refuses("G64 P0.1 Q-1", "1:10 invalid-value");
    refuses("S-1", "1:1 invalid-value");
    refuses("T1.5", "1:1 not-an-integer");
    refuses("T-1", "1:1 invalid-value");
    refuses("G92", "1:1 missing-word");
    refuses("G52", "1:1 missing-word");
    refuses("G10 P1 X0", "1:1 missing-word");
    refuses("G10 L2 X0", "1:1 missing-word");
    refuses("G10 L1 P1 X0", "1:8 unknown-tool");
    refuses("G10 L3 P1 X0", "1:5 not-supported");
    refuses("G10 L2 P10 X0", "1:8 invalid-value");
}

#[test]
fn motion_modes() {
    refuses("X1", "1:1 no-motion-mode");
    refuses("G0 X1\nG80\nY2 X1", "3:1 no-motion-mode");
    refuses("G80 X1", "1:1 no-motion-mode");
    refuses("G1 G92 X1", "1:1 axis-words-conflict");
    refuses("G53 X1", "1:5 no-motion-mode");
    refuses("G0 G53", "1:4 machine-coordinates");
    refuses("G0 G53 G91 X1", "1:4 machine-coordinates");
    refuses("F1 G2 G53 X1 I1", "1:7 machine-coordinates");
    accepts("G0\nG53 X1");
    accepts("G40 G49 G80 G0 G17 G90 X1");
}

#[test]
fn feedrates() {
    refuses("G1 X1", "1:1 missing-feed");
    refuses("F100\nG93\nG1 X1", "3:1 missing-feed");
    refuses("G93 G1 X1 F1\nG94\nX2", "3:1 missing-feed");
    refuses("G1 X1 F0", "1:7 bad-feed");
    refuses("G1 X1 F-1", "1:7 bad-feed");
    accepts("G93 G1 X1 F2\nX2 F3\nG94 X3 F100");
}

#[test]
fn arcs() {
    let arc = |words: &str| format!("G0 X0 Y0 Z0 F100\n{words}\n");
    refuses(&arc("G2 X10 Y0 R4.99"), "2:11 arc-radius-too-small");
    refuses(&arc("G2 X10 Y0 I3"), "2:11 arc-radius-mismatch");
    refuses(&arc("G2 X0 Y0 R5"), "2:10 arc-full-circle-with-radius");
    refuses(&arc("G2 X10 Y0"), "2:1 arc-without-center");
    refuses(&arc("G90.1 G2 X10 Y0 I5"), "2:7 arc-without-center");
    refuses(&arc("G3 X10 Y10 I0 J0"), "2:12 arc-zero-radius");
    refuses(&arc("G3 X10 Y10 I10 J10"), "2:12 arc-zero-radius");
    refuses(&arc("G3 X10 Y0 R0"), "2:11 arc-zero-radius");
    refuses(&arc("G2 X10 Y0 I5 K1"), "2:14 arc-offset-outside-plane");
    refuses(&arc("G18 G2 X10 Y0 I5 J1"), "2:18 arc-offset-outside-plane");
    refuses(&arc("G2 X10 Y0 I5 R5"), "2:14 arc-overdetermined");
    refuses(&arc("G2 X10 Y0 I5 P0"), "2:14 invalid-value");
    refuses(&arc("G2 X10 Y0 I5 P1.5"), "2:14 not-an-integer");
    refuses("G10 L2 P1 R30\nG18 G2 X10 Z0 I5 F1\n", "2:5 arc-plane");
    refuses("G17.1 G2 U10 V0 X1 I5 F1\n", "1:7 arc-plane");
    // The published rule of centre-format arcs: 0.0127 mm, or 0.1 % and at most 1.27 mm.
    accepts(&arc("G2 X10.012 Y0 I5"));
    refuses(&arc("G2 X10.026 Y0 I5"), "2:15 arc-radius-mismatch");
    accepts(&arc("G2 X200.1 Y0 I100"));
    refuses(&arc("G2 X200.11 Y0 I100"), "2:15 arc-radius-mismatch");
    refuses(&arc("G2 X6002.6 Y0 I3000"), "2:15 arc-radius-mismatch");
}

fn mill() -> Options {
    let travel = AxisTravel {
        min: -50.0,
        max: 100.0,
    };
    let machine = Machine::new(&[Axis::X, Axis::Y])
        .with_travel(Axis::X, travel)
        .with_travel(Axis::Y, travel);
    Options {
        machine,
        ..Options::default()
    }
}

#[test]
fn axes_and_soft_limits() {
    let found = |text: &str| listed(&check(text.as_bytes(), mill()));
    assert_eq!(found("G0 X1 Z1"), ["1:7 axis-not-configured"]);
    assert_eq!(found("G0 Y100.1 X1"), ["1:4 soft-limit"]);
    assert_eq!(found("G0 X-50.1"), ["1:4 soft-limit"]);
    assert_eq!(found("G0 X100 Y-50"), Vec::<String>::new());
    assert_eq!(found("G20 G0 X3.93700787401574803"), Vec::<String>::new());
    // Both ends inside, the bulge outside.
    assert_eq!(found("G0 X95 Y0\nG3 X95 Y20 J10 F100"), ["2:4 soft-limit"]);
    assert_eq!(
        found("G0 X95 Y0\nG2 X95 Y20 J10 F100"),
        Vec::<String>::new()
    );
    // The limits are machine coordinates.
    assert_eq!(found("G10 L2 P1 X60\nG0 X50"), ["2:4 soft-limit"]);
    assert_eq!(found("G28"), Vec::<String>::new());
    let report = check("G0 X120".as_bytes(), mill());
    let message = &report.diagnostics[0].message;
    assert!(
        ["X", "120", "100"]
            .iter()
            .all(|part| message.contains(part)),
        "{message}"
    );
}

#[test]
fn a_machine_outside_its_limits_may_come_back() {
    let mut options = mill();
    options.start[0] = 150.0;
    let found = |text: &str| listed(&check(text.as_bytes(), options.clone()));
    assert_eq!(found("G0 X120 Y5\nX50"), Vec::<String>::new());
    assert_eq!(found("G0 X151"), ["1:4 soft-limit"]);
}

#[test]
fn of_a_refused_block_the_modes_count_for_what_follows() {
    let report = report("G0 X1\nG91 G20 G1 X5 F10 Q1\nX2\n");
    assert_eq!(listed(&report), ["2:19 unused-word"]);
    // Two inches from where the refused block began.
    assert!((report.final_position[0] - 51.8).abs() < 1e-12);
    assert_eq!((report.totals.rapids, report.totals.straight_feeds), (1, 1));
}

#[test]
fn diagnostics_are_capped_and_counted() {
    let report = report(&"@\n".repeat(50));
    assert_eq!((report.diagnostics.len(), report.more), (20, 30));
}

#[test]
fn a_program_for_motion_ends_at_the_first_diagnostic() {
    let text = "G0 X1\nG0 X--2\nG0 X3\n";
    let results: Vec<_> = Program::new(text.as_bytes(), Options::default()).collect();
    assert_eq!(results.len(), 2);
    assert!(results[0].is_ok() && results[1].is_err());
}

/// Blocks that are good by themselves; together they may leave the travel.
fn block() -> impl Strategy<Value = String> {
    let at = || -60.0..110.0_f64;
    let by = || -40.0..40.0_f64;
    prop_oneof![
        4 => (0..2, at(), at()).prop_map(|(g, x, y)| format!("G90 G{g} X{x:.3} Y{y:.3}")),
        2 => (by(), by()).prop_map(|(x, y)| format!("G91 G1 X{x:.3} Y{y:.3}")),
        2 => (2..4, by(), 0.1..30.0_f64).prop_map(|(g, i, j)| format!("G{g} I{i:.3} J{j:.3}")),
        2 => (2..4, by(), 0.1..30.0_f64, 30.0..90.0_f64)
            .prop_map(|(g, x, y, r)| format!("G91 G{g} X{x:.3} Y{y:.3} R{r:.3}")),
        1 => (by(), by()).prop_map(|(x, r)| format!("G10 L2 P1 X{x:.3} R{r:.3}")),
        1 => by().prop_map(|x| format!("G92 X{x:.3}")),
    ]
}

proptest! {
    #[test]
    fn moves_join_and_stay_inside_the_travel(
        blocks in proptest::collection::vec(block(), 1..30)
    ) {
        let mut options = mill();
        options.default_feed_mm_min = Some(1000.0);
        let mut end = options.start;
        for item in Program::new(blocks.join("\n").as_bytes(), options) {
            let Ok(Item { kind: ItemKind::Move { segment, rate, .. }, .. }) = item else {
                break;
            };
            prop_assert_eq!(segment.start(), end);
            end = segment.end();
            prop_assert!(segment.length() > 0.0);
            prop_assert!(matches!(rate, Rate::Rapid) || matches!(rate, Rate::Feed(v) if v > 0.0));
            // Sampled, not by the box that the interpreter itself looks at.
            for k in 0..=64 {
                let point = segment.jet(segment.length() * f64::from(k) / 64.0).position;
                for axis in 0..2 {
                    prop_assert!((-50.0001..=100.0001).contains(&point[axis]), "{}", point[axis]);
                }
            }
        }
    }

    #[test]
    fn any_bytes_are_judged_without_a_panic(
        bytes in proptest::collection::vec(any::<u8>(), 0..400)
    ) {
        let report = check(bytes.as_slice(), Options::default());
        prop_assert!(report.final_position.iter().all(|p| p.is_finite()));
    }

    #[test]
    fn any_words_are_judged_without_a_panic(
        text in "((G|g|M)[0-9]{1,3}(\\.[0-3])?|[A-Z][-+]?[0-9]{0,3}(\\.[0-9]{0,3})?|[ \n(;%/]){0,60}"
    ) {
        let mut options = mill();
        options.default_feed_mm_min = Some(1000.0);
        let report = check(text.as_bytes(), options);
        for axis in 0..2 {
            let p = report.final_position[axis];
            prop_assert!((-50.001..=100.001).contains(&p), "{p}");
        }
    }
}

#[test]
fn long_dwells_without_a_point_between_percent_lines_are_told() {
    let waits = |text: &str, dialect: Dialect| {
        let options = Options {
            dialect,
            ..Options::default()
        };
        check(text.as_bytes(), options).lacks.seconds
    };
    for text in [
        "%\nG4 P500\nM2",
        "%\nG4 P 11\nM2\n%",
        "%\nF100\nG82 X1 Z-1 R1 P50\nM2",
    ] {
        assert!(waits(text, Dialect::LinuxCnc), "{text}");
    }
    for text in [
        "G4 P500\nM2",
        "%\nG4 P500.\nM2",
        "%\nG4 P10\nM2",
        "%\n#1=500\nG4 P#1\nM2",
        "%\nG64 P20\nG0 X1\nM2",
    ] {
        assert!(!waits(text, Dialect::LinuxCnc), "{text}");
    }
    assert!(!waits("%\nG4 P500\nM30", Dialect::Fanuc));
}
