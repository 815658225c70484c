//! Tests of FANUC's and Haas' lathes: grooves side by side, passes along a profile that is there,
//! corners, offsets that programs set. Values are computed by hand; X is a radius here.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, FanucControl, FanucParameters, FeedAtStart, Machine, OffsetMemory,
    Options, Program, Tool, ToolTable, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{ItemKind, Rate};

use crate::support::listed;

fn options() -> Options {
    let mut tools = ToolTable::new();
    for number in 1..=4 {
        tools.set(number, Tool::default());
    }
    Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Z]),
        ..Options::default()
    }
}

/// Ends of moves in X and Z, with whether each is at rapid.
fn ways(text: &str) -> Vec<([f64; 2], bool)> {
    ways_with(text, options())
}

fn ways_with(text: &str, options: Options) -> Vec<([f64; 2], bool)> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                let place = [0, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0);
                Some((place, matches!(rate, Rate::Rapid)))
            }
            _ => None,
        })
        .collect()
}

fn ends(text: &str) -> Vec<[f64; 2]> {
    ways(text).into_iter().map(|(end, _)| end).collect()
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
}

const HEAD: &str = "G98\nG0 X52 Z-10\n";

#[test]
fn grooves_are_made_side_by_side() {
    let (cut, rapid) = (false, true);
    let groove = |z: f64| {
        [
            ([23.0, z], cut),
            ([23.5, z], rapid),
            ([20.0, z], cut),
            ([26.0, z], rapid),
        ]
    };
    let mut expected = vec![([26.0, -10.0], rapid)];
    expected.extend(groove(-10.0));
    for z in [-13.0, -16.0, -17.0] {
        expected.push(([26.0, z], rapid));
        expected.extend(groove(z));
    }
    expected.push(([26.0, -10.0], rapid));
    let fanuc = format!("{HEAD}G75 R0.5\nG75 X40 Z-17 P3000 Q3000 F100");
    assert_eq!(ways(&fanuc), expected);
    // Haas says the same by I and K, which have points.
    let haas = format!("{HEAD}G75 R0.5\nG75 X40. Z-17. I3. K3. F100");
    assert_eq!(ways(&haas), expected);
    // By increments of the start.
    let increments = format!("{HEAD}G75 R0.5\nG75 U-12 W-7 P3000 Q3000 F100");
    assert_eq!(ways(&increments), expected);
    // A single groove has no steps aside: Q0 is none.
    let single = |words: &str| ends(&format!("{HEAD}G75 R0.5\nG75 X40 P3000 {words}F100"));
    assert_eq!(single("Q0 "), single(""));
    // R beside X and Z leads aside at the bottom, but not in the first place.
    let aside = format!("{HEAD}G75 X40 Z-13 P6000 Q3000 R0.2 F100");
    assert_eq!(
        ends(&aside)[1..],
        [
            [20.0, -10.0],
            [26.0, -10.0],
            [26.0, -13.0],
            [20.0, -13.0],
            [20.0, -12.8],
            [26.0, -12.8],
            [26.0, -10.0]
        ]
    );
    // G74: depths along Z, places along X.
    let face = "G98\nG0 X40 Z2\nG74 R1\nG74 X30 Z-8 P5000 Q5000 F100";
    assert_eq!(
        ends(face)[1..],
        [
            [20.0, -3.0],
            [20.0, -2.0],
            [20.0, -8.0],
            [20.0, 2.0],
            [15.0, 2.0],
            [15.0, -3.0],
            [15.0, -2.0],
            [15.0, -8.0],
            [15.0, 2.0],
            [20.0, 2.0]
        ]
    );
    finds(
        &format!("{HEAD}G75 X40 Z-30 Q1 F100"),
        &["3:14 invalid-value"],
    );
    finds(
        &format!("{HEAD}G75 X40 Z-17 P3000 I3. F100"),
        &["3:20 unused-word"],
    );
    finds(
        &format!("{HEAD}G75 X40 Z-13 Q1000 R1.5 F100"),
        &["3:20 invalid-value"],
    );
    // Beside the bottom no more is free than the way to the second place, which may be shorter than Q.
    finds(
        &format!("{HEAD}G75 X40 Z-12 Q5000 R3. F100"),
        &["3:20 invalid-value"],
    );
    // A single groove or hole has no room aside.
    finds(
        &format!("{HEAD}G75 X40 P3000 R0.5 F100"),
        &["3:15 invalid-value"],
    );
    finds(
        "G98\nG0 X0 Z2\nG74 Z-10 Q5000 R1. F300",
        &["3:16 invalid-value"],
    );
    assert_eq!(ways(&format!("{HEAD}G75 X40 P9000 R0 F100")).len(), 3);
}

const PROFILE: &str = "N10 G0 X20 Z2\nG1 Z-20 F100\nX40 Z-30\nN20 X60\n";

#[test]
fn a_profile_is_repeated_nearer_and_nearer() {
    // 10 and 2 away, in three passes; 0.2 (of a diameter of 0.4) and 0.1 stay.
    let pass = |x: f64, z: f64| {
        [
            ([40.0 + x, 10.0 + z], true),
            ([10.0 + x, 2.0 + z], true),
            ([10.0 + x, z - 20.0], false),
            ([20.0 + x, z - 30.0], false),
            ([30.0 + x, z - 30.0], false),
        ]
    };
    let mut expected = vec![([40.0, 10.0], true)];
    for (x, z) in [(10.2, 2.1), (5.2, 1.1), (0.2, 0.1)] {
        expected.extend(pass(x, z));
    }
    expected.push(([40.0, 10.0], true));
    let round = |ways: Vec<([f64; 2], bool)>| -> Vec<([f64; 2], bool)> {
        ways.into_iter()
            .map(|(end, rapid)| (end.map(|it| (it * 1e6).round() / 1e6), rapid))
            .collect()
    };
    let head = "G98\nG0 X80 Z10\n";
    let fanuc = format!("{head}G73 U10 W2 R3\nG73 P10 Q20 U0.4 W0.1 F300\n{PROFILE}");
    assert_eq!(ways(&fanuc), round(expected.clone()));
    let haas = format!("{head}G73 P10 Q20 U0.4 W0.1 I10. K2. D3 F300\n{PROFILE}");
    assert_eq!(ways(&haas), round(expected));
    // It may turn back, which G71 refuses.
    let back = "N10 G0 X20 Z2\nG1 Z-20 F100\nX16 Z-15\nN20 X60\n";
    let text = format!("{head}G73 U10 W2 R2\nG73 P10 Q20 U0 W0 F300\n{back}");
    assert!(ends(&text).contains(&[8.0, -15.0]));
    finds(
        &format!("{head}G73 P10 Q20 U0.4 F300\n{PROFILE}"),
        &["3:1 missing-word"],
    );
    finds(
        &format!("{head}G73 U10 W2\nG73 P10 Q20 U0 F300\n{PROFILE}"),
        &["3:1 missing-word", "4:1 missing-word"],
    );
}

#[test]
fn the_first_pass_is_a_depth_below_the_start() {
    let text =
        "G98\nG0 X60 Z2\nG71 U2 R1\nG71 P10 Q20 U0 W0 F300\nN10 G0 X40\nG1 Z-20 F100\nN20 X60\n";
    let cuts: Vec<f64> = ways(text)
        .into_iter()
        .filter(|([_, z], rapid)| !rapid && *z < -19.0)
        .map(|([x, _], _)| x)
        .collect();
    // 28, 26, 24, 22, 20: at 30 nothing would be cut.
    assert_eq!(cuts[..5], [28.0, 26.0, 24.0, 22.0, 20.0]);
}

#[test]
fn corners_are_broken_without_a_comma() {
    let with_commas = "G98\nG0 X0 Z0\nG1 X20 ,C1 F100\nZ-20 ,R2\nX40";
    for text in [
        "G98\nG0 X0 Z0\nG1 X20 C1 F100\nZ-20 R2\nX40",
        "G98\nG0 X0 Z0\nG1 X20 K-1 F100\nZ-20 R2\nX40",
        "G98\nG0 X0 Z0\nG1 X20. C1. F100\nZ-20. R-2.\nX40.",
    ] {
        assert_eq!(ends(text), ends(with_commas), "{text}");
    }
    assert_eq!(
        ends(with_commas),
        [
            [9.0, 0.0],
            [10.0, -1.0],
            [10.0, -18.0],
            [12.0, -20.0],
            [20.0, -20.0]
        ]
    );
    // A counts from +Z.
    assert_eq!(
        ends("G98\nG0 X20 Z0\nG1 X40 A135 F100").last(),
        Some(&[20.0, -10.0])
    );
    // In the profile of a cycle they are what they are in the blocks of G70.
    let text = "G98\nG0 X60 Z2\nG71 U7 R1\nG71 P10 Q20 U0 W0 F300\nN10 G0 X20\nG1 Z-20 ,R2 F100\nX40 C1\nZ-30\nN20 X60\nG70 P10 Q20";
    let ends = ends(text);
    let corners = [[10.0, -18.0], [12.0, -20.0], [19.0, -20.0], [20.0, -21.0]];
    for corner in corners {
        let count = ends.iter().filter(|end| **end == corner).count();
        assert_eq!(count, 2, "{corner:?}: {ends:?}");
    }
    // An angle is refused there: the end would be another one.
    finds(
        "G98\nG0 X60 Z2\nG71 U5 R1\nG71 P10 Q20 U0 W0 F300\nN10 G0 X20\nG1 X40 ,A135 F100\nN20 X60\n",
        &["6:8 not-supported"],
    );
}

#[test]
fn offsets_are_set_by_the_program() {
    // X is a diameter; wear is added to the offset of the table.
    let text = "G10 P10003 X4. Z5. R0.8 Q3\nG10 P3 X0.2 W-0.1\nT0303\nG0 X20. Z0.";
    assert_eq!(ends(text), [[12.1, 4.9]]);
    let text = "G10 P10003 X4. Z5.\nG10 P10003 U1. W1.\nT0303\nG0 X20. Z0.";
    assert_eq!(ends(text), [[12.5, 6.0]]);
    finds("G10 P3", &["1:1 missing-word"]);
    finds("G10 P200 X1.", &["1:5 invalid-value"]);
    finds("G10 P3 Q3", &[]);
    finds("G10 P3 Y3", &["1:8 axis-not-configured"]);
}

#[test]
fn systems_b_and_c_have_codes_of_their_own() {
    let of = |control: FanucControl| Options {
        fanuc: FanucParameters {
            control: Some(control),
            ..FanucParameters::default()
        },
        ..options()
    };
    let (b, c) = (of(FanucControl::LatheB), of(FanucControl::LatheC));
    let head = "G0 X62 Z2\n";
    let roughing = "71 U5 R1\nG71 P10 Q20 U0.4 W0.1 F300\nN10 G0 X20\nG1 Z-20 F100\nN20 X60\n";
    let roughing_c = roughing.replace("71", "73");
    for (in_a, in_b, in_c) in [
        (
            "90 X56 Z-30 F300\nX52",
            "77 X56 Z-30 F300\nX52",
            "20 X56 Z-30 F300\nX52",
        ),
        (
            "94 X20 Z-5 R-3 F300",
            "79 X20 Z-5 R-3 F300",
            "24 X20 Z-5 R-3 F300",
        ),
        (
            "50 X100 Z50\nG0 X80 Z40",
            "92 X100 Z50\nG0 X80 Z40",
            "92 X100 Z50\nG0 X80 Z40",
        ),
        (roughing, roughing, roughing_c.as_str()),
        ("1 U-4 W-5 F300", "91 G1 X-4 Z-5 F300", "91 G1 X-4 Z-5 F300"),
    ] {
        let ways_a = ways(&format!("G98\n{head}G{in_a}"));
        for (text, options) in [(in_b, &b), (in_c, &c)] {
            let text = format!("G94\n{head}G{text}");
            assert_eq!(ways_with(&text, options.clone()), ways_a, "{text}");
        }
    }
    assert_eq!(ways_with("G70 G0 X1", c.clone()), [([12.7, 0.0], true)]);
    assert_eq!(ways_with("G20 G0 X1", b.clone()), [([12.7, 0.0], true)]);
    let refused = |text: &str, options: Options, expected: &str| {
        let report = check(text.as_bytes(), options);
        assert_eq!(listed(&report), [expected], "{text}");
    };
    refused("G0 U5", b.clone(), "1:4 axis-not-configured");
    refused("G50 S2000", b, "1:1 unknown-g-code");
    refused("G32 Z-5 F1", c.clone(), "1:1 unknown-g-code");
    refused("G79 X20", c, "1:1 unknown-g-code");
}

#[test]
fn the_feed_at_start_may_be_said() {
    let of = |feed_at_start: FeedAtStart| Options {
        fanuc: FanucParameters {
            feed_at_start,
            ..FanucParameters::default()
        },
        ..options()
    };
    let rate = |at_start: FeedAtStart| {
        let text = "S600 M3\nG1 Z-5 F0.2";
        let found = Program::new(text.as_bytes(), of(at_start)).find_map(|item| {
            match item.expect("a sound program").kind {
                ItemKind::Move { rate, .. } => Some(rate),
                _ => None,
            }
        });
        match found {
            Some(Rate::Feed(feed_v)) => (feed_v * 60.0 * 1e6).round() / 1e6,
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(rate(FeedAtStart::PerRevolution), 120.0);
    assert_eq!(rate(FeedAtStart::PerMinute), 0.2);
}

/// X of a work offset is a diameter, and so is that of G54.1.
#[test]
fn work_offsets_beyond_g59() {
    let set = "G10 L20 P1 X10. Z5.\nG10 L20 P27 X-4. Z1.\nG0 X100. Z80.\n";
    for code in ["G54.1 P1", "G54 P1", "G154 P1", "G110"] {
        let at = ends(&format!("{set}{code}\nG0 X20. Z3."));
        assert_eq!(at.last(), Some(&[15.0, 8.0]), "{code}");
    }
    let at = ends(&format!("{set}G54.1 P27\nG0 X20. Z3.\nG54\nX20. Z3."));
    assert_eq!(at[1..], [[8.0, 4.0], [10.0, 3.0]]);
    finds("G154 P2", &["1:1 not-supported"]);
}

/// A control has the depth in a block of its own, or in D: two that differ are refused, and what a Haas lacks is D.
#[test]
fn a_depth_of_roughing_is_said_once() {
    let profile = "N1 G0 X20.\nG1 Z-10.\nN2 X60.\nM30";
    let cycle = |words: &str| format!("G97 G99 S600 M3\nG0 X60. Z2.\n{words} F0.2\n{profile}");
    finds(
        &cycle("G71 U3. R1.\nG71 P1 Q2 U0 W0 D2."),
        &["4:17 ambiguous-word"],
    );
    finds(&cycle("G71 U2. R1.\nG71 P1 Q2 U0 W0 D2."), &[]);
    let haas = Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..options().fanuc
        },
        ..options()
    };
    let report = check(cycle("G71 P1 Q2 U0 W0").as_bytes(), haas);
    assert_eq!(report.diagnostics[0].message, "the cycle without D");
}

/// Z of a profile does not change its direction, in the form for pockets either: FANUC's alarm 064, and Haas' manual.
#[test]
fn a_profile_that_turns_back_along_z_says_whose_rule_that_is() {
    let text = "G97 G99 S600 M3\nG0 X60. Z2.\nG71 U2. R1.\nG71 P1 Q2 U0 W0 F0.2\nN1 G0 X20. Z2.\nG1 Z-10.\nX60.\nN2 Z2.\nM30";
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), ["4:8 canned-cycle"]);
    assert!(report.diagnostics[0].reason.contains("alarm 064"));
}

#[test]
fn a_feed_per_revolution_needs_a_spindle_that_was_not_stopped() {
    let found = |text: &str| listed(&check(text.as_bytes(), options()));
    let start = "G99 G97 S500 M3\nG0 X50. Z2.\nG1 Z-5. F.2\nM5\n";
    assert_eq!(found(&format!("{start}G1 X52.\nM30")), ["5:1 spindle"]);
    for text in ["M3\nG1 X52.", "G0 X52.", "G98 G1 X52. F100.", "G1 X52. M3"] {
        assert_eq!(
            found(&format!("{start}{text}\nM30")),
            Vec::<String>::new(),
            "{text}"
        );
    }
}
