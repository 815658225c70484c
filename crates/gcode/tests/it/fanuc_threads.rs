//! Tests of FANUC's G76 in its two forms, and the lead of G33.

use crate::support::listed;
use glidepath_gcode::{
    Dialect, FanucControl, FanucParameters, OffsetMemory, Options, PointInput, Program, Threading,
    check,
};
use glidepath_program::{Event, ItemKind, Limits, PHASE_STEPS, PathMode};

fn options() -> Options {
    Options {
        dialect: Dialect::Fanuc,
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..Options::default()
    }
}

/// A lathe, whose X words are diameters.
fn lathe() -> Options {
    Options {
        fanuc: FanucParameters {
            control: Some(FanucControl::LatheA),
            ..FanucParameters::default()
        },
        ..options()
    }
}

/// What is cut: the pitch of every pass, and the ends of its moves in X and Z, to the micrometre.
fn cuts(text: &str) -> Vec<String> {
    cuts_with(text, lathe())
}

fn cuts_with(text: &str, options: Options) -> Vec<String> {
    let mut cuts: Vec<String> = Vec::new();
    let rounded = |mm: f64| (mm * 1e3).round() / 1e3;
    for item in Program::new(text.as_bytes(), options) {
        match item.unwrap_or_else(|found| panic!("{text}\n{found}")).kind {
            ItemKind::Event(Event::Synchronise { pitch_mm, phase }) => {
                cuts.push(format!("{}@{phase}", rounded(pitch_mm)));
            }
            ItemKind::Move { segment, rate, .. } if rate.is_synchronised() => {
                let [x, z] = [0, 2].map(|axis| rounded(segment.end()[axis]));
                let last = cuts.last_mut().expect("a pass");
                *last = format!("{last} {x},{z}");
            }
            _ => {}
        }
    }
    cuts
}

#[track_caller]
fn finds(text: &str, expected: &str) {
    let report = check(text.as_bytes(), lathe());
    assert_eq!(listed(&report), [expected], "{text}");
}

#[test]
fn a_thread_in_two_blocks() {
    // Two finishing passes, no way out, cut with both flanks; at least 0.2 deeper each.
    let text =
        "S600 M3\nG0 X24 Z4\nG76 P020000 Q200 R0.1\nG76 X18 Z-20 P900 Q400 F1.5\nG98 G1 X40 F10";
    let passes = |depths: &[f64]| -> Vec<String> {
        let shown = |depth: &f64| format!("1.5@0 {},-20", ((9.9 - depth) * 1e3).round() / 1e3);
        depths.iter().map(shown).collect()
    };
    assert_eq!(cuts(text), passes(&[0.4, 0.6, 0.8, 0.9, 0.9]));
    // From where it stood, and back there.
    let report = check(text.as_bytes(), lathe());
    assert_eq!(report.final_position[2], 4.0);
}

/// R of the first block is a length, unlike P and Q: without a point it is what `point` says of lengths.
#[test]
fn the_finishing_allowance_is_a_length() {
    let last = |allowance: &str, point: PointInput| {
        let options = Options {
            fanuc: FanucParameters {
                point,
                ..lathe().fanuc
            },
            ..lathe()
        };
        let text = format!(
            "S600 M3\nG0 X24. Z4.\nG76 P010000 Q0 {allowance}\nG76 X18. Z-20. P1500 Q1500 F1.5"
        );
        cuts_with(&text, options)
    };
    let passes = |first: f64| [format!("1.5@0 {first},-20"), "1.5@0 9,-20".to_owned()];
    use PointInput::{Calculator, Increment, Unsaid};
    for (allowance, point, first) in [
        ("R0.2", Unsaid, 9.2),
        ("R200", Unsaid, 9.2),
        ("R200", Increment, 9.2),
        ("R0.2", Calculator, 9.2),
        ("R1", Calculator, 10.0),
    ] {
        assert_eq!(
            last(allowance, point),
            passes(first),
            "{allowance} {point:?}"
        );
    }
}

#[test]
fn the_way_out_the_angle_and_the_taper() {
    let text = "S600 M3\nG0 X24 Z4\nG76 P011060 Q50 R0\nG76 X18 Z-20 R-0.5 P900 Q900 F1.5";
    // The pass at full depth, and the finishing one: out of it over a lead, to the peak.
    let tan = 30.0_f64.to_radians().tan();
    let slope = -0.5 / 24.0;
    let at = |x: f64, z: f64| format!("{},{}", (x * 1e3).round() / 1e3, (z * 1e3).round() / 1e3);
    let straight = at(9.0 + 1.5 * slope, -18.5);
    let along = (1.0 + slope * slope).sqrt();
    let pitch = (1.5 * along * 1e3).round() / 1e3;
    let pass = format!("{pitch}@0 {straight} {}", at(9.9, -20.0));
    assert_eq!(cuts(text), [pass.clone(), pass]);
    // A shallow pass is shifted back by what it is less deep, times the tangent of half the angle.
    let text = "S600 M3\nG0 X24 Z4\nG76 P010060 Q50 R0\nG76 X18 Z-20 P900 Q500 F1.5";
    let deep = (0.5_f64 * 2.0_f64.sqrt(), 0.5_f64 * 3.0_f64.sqrt());
    let shown = |depth: f64| format!("1.5@0 {}", at(9.9 - depth, -20.0 + (0.9 - depth) * tan));
    assert_eq!(
        cuts(text),
        [
            shown(0.5),
            shown(deep.0),
            shown(deep.1),
            shown(0.9),
            shown(0.9)
        ]
    );
}

#[test]
fn a_thread_in_one_block() {
    // Inside, towards higher Z, with the depths of areas alike, then with depths alike.
    let text = "S600 M3\nG0 X18 Z-20\nG76 X22 Z4 K1 D500 F1.5 A60\n";
    let at = |depth: f64| {
        let tan = 30.0_f64.to_radians().tan();
        let z = 4.0 - (1.0 - depth) * tan;
        format!(
            "1.5@0 {},{}",
            ((10.0 + depth) * 1e3).round() / 1e3,
            (z * 1e3).round() / 1e3
        )
    };
    let root = |n: f64| at(0.5 * n.sqrt());
    assert_eq!(cuts(text), [root(1.0), root(2.0), root(3.0), at(1.0)]);
    let text = "S600 M3\nG0 X18 Z-20\nG76 X22 Z4 K1 D0.4 F1.5 P3 Q90000\n";
    let quarter = (1 << 24) / 4;
    let shown = |x: f64| format!("1.5@{quarter} {x},4");
    assert_eq!(cuts(text), [shown(10.4), shown(10.8), shown(11.0)]);
}

#[test]
fn inches_and_what_is_refused() {
    let text = "G20 S600 M3\nG0 X1 Z0.2\nG76 P010000 Q0 R0\nG76 X0.8 Z-1 P500 Q500 F0.05";
    assert_eq!(cuts(text)[0], "1.27@0 10.16,-25.4");
    let begin = "S600 M3\nG0 X24 Z4\nG76 P010060 Q100 R0\n";
    for (words, expected) in [
        ("G76 X18 Z-20 P900 F1.5", "4:1 missing-word"),
        ("G76 X18 Z-20 P0.9 Q100 F1.5", "4:14 not-an-integer"),
        ("G76 X23 Z-20 P900 Q100 F1.5", "4:5 invalid-value"),
        ("G76 X18 Z-20 P900 Q1000 F1.5", "4:19 invalid-value"),
        ("G76 X18 Z-20 P900 Q100 F1.5 I1", "4:29 unused-word"),
        ("G76 X18 Z-20 K0.9 D100 F1.5 P2", "4:29 not-supported"),
        ("G76 X18 Z-20 K0.9 D100 F1.5 A150", "4:29 invalid-value"),
        ("G76 X18 Z-20 P900 Q100 F3000", "4:1 invalid-value"),
    ] {
        finds(&format!("{begin}{words}"), expected);
    }
    // Without its first block it may be meant as fine boring of a mill.
    finds("S600 M3\nG76 X18 Z-20 P900 Q100 F1.5", "2:1 not-supported");
}

#[test]
fn the_lead_of_a_taper_is_that_of_the_longer_axis() {
    let cut = cuts_with("S600 M3\nG33 X-10 Z-20 F1.5", options());
    let along = (500.0_f64).sqrt() / 20.0;
    assert_eq!(
        cut,
        [format!("{}@0 -10,-20", (1.5 * along * 1e3).round() / 1e3)]
    );
}

#[test]
fn blocks_of_a_thread_are_one_pass() {
    // Along Z, and out at 45 degrees.
    let text = "S600 M3\nG0 X20 Z4\nG32 Z-20 F1.5\nU8 W-4\nG0 X40";
    assert_eq!(cuts(text), ["1.5@0 10,-20 14,-24"]);
    let text = "S600 M3\nG0 X20 Z4\nG32 Z-20 F1.5 Q90000\nG32 Z-30 X24 F1.5\n(ON)\n\nZ-40\nM30";
    let phase = PHASE_STEPS / 4;
    assert_eq!(
        cuts(text),
        [format!("1.5@{phase} 10,-20 12,-30 12,-40").as_str()]
    );
    // At 16.5 mm/s X sets out with 16.5: with a jerk of 40 m/s³ that takes 40.6 ms, and a quarter of
    // 16.5 · 0.0406 is left to the corner.
    let items: Vec<_> = Program::new(
        &b"S600 M3\nG0 X20 Z4\nG32 Z-20 F1.5\nU8 W-4\nG0 X40"[..],
        lathe(),
    )
    .map(|item| item.expect("a sound program"))
    .filter(|item| matches!(item.kind, ItemKind::Move { rate, .. } if rate.is_synchronised()))
    .collect();
    let lines: Vec<u32> = items.iter().map(|item| item.line).collect();
    assert_eq!(lines, [3, 4]);
    for item in &items {
        let ItemKind::Move { mode, .. } = item.kind else {
            continue;
        };
        let PathMode::Continuous {
            tolerance_mm: Some(tolerance_mm),
        } = mode
        else {
            panic!("{mode:?}");
        };
        assert!((tolerance_mm - 0.1676).abs() < 1e-4, "{tolerance_mm}");
    }
    // Each block alone where the tool goes back in between, and at the end of the program.
    let text = "S600 M3\nG0 X20 Z4\nG32 Z-20 F1.5\nG0 X24\nZ4\nX20\nG32 Z-20 F1.5";
    assert_eq!(cuts(text), ["1.5@0 10,-20", "1.5@0 10,-20"]);
    finds(
        "S600 M3\nG0 X20 Z4\nG32 Z-20 F1.5\nU0.5 W-0.25",
        "4:1 invalid-value",
    );
    finds(
        "S600 M3\nG0 X20 Z4\nG32 Z-20 F1.5\nW-9 Q90000",
        "4:1 not-supported",
    );
}

/// The example of FANUC's manual for a straight thread (G32, metric, diameters): the second cut has no F.
#[test]
fn the_lead_stays_in_force_behind_rapids() {
    let text = "S60 M3\nG0 X100. Z80.\nG00 U-62.0\nG32 W-74.5 F4.0\nG00 U62.0\nW74.5\nU-64.0\nG32 W-74.5\nG00 U64.0\nW74.5";
    assert_eq!(cuts(text), ["4@0 19,5.5", "4@0 18,5.5"]);
    // In G98, too, and in G92 and G76 behind it.
    let text = "G98 S60 M3\nG0 X100 Z80\nG32 X98 Z5 F4\nG0 X102\nZ80\nG92 X97 Z5\nG76 P010000 Q0 R0\nG76 X96 Z5 P1000 Q1000";
    let leads: Vec<String> = cuts(text)
        .iter()
        .map(|cut| cut.split('@').next().unwrap_or_default().to_owned())
        .collect();
    assert_eq!(leads, ["4", "4", "4", "4"]);
}

/// F is one word of the control: in G99 the feed in force is the lead, and the lead the feed.
#[test]
fn lead_and_feed_are_one_word() {
    let text = "G99 S60 M3\nG0 X20 Z10\nG1 Z9 F1.25\nG32 Z-20\nG0 X24\nZ4";
    assert_eq!(cuts(text), ["1.25@0 10,-20"]);
    // Not the lead of the thread before: F was written since.
    let text = "G99 S60 M3\nG0 X20 Z10\nG92 X18 Z-20 F2\nG1 X19 F1.5\nG0 X20\nG92 X17.5 Z-20";
    let leads = cuts(text);
    assert!(
        leads[0].starts_with("2@0") && leads[1].starts_with("1.5@0"),
        "{leads:?}"
    );
    // 60 turns a minute, 2 mm each.
    let feeds: Vec<f64> = Program::new(
        &b"G99 S60 M3\nG0 X20 Z10\nG32 Z-20 F2\nG0 X24\nG1 Z-10\nM30"[..],
        lathe(),
    )
    .filter_map(|item| match item.expect("a sound program").kind {
        ItemKind::Move { rate, .. } if !rate.is_synchronised() => rate.feed_v(),
        _ => None,
    })
    .collect();
    assert_eq!(feeds, [2.0]);
}

#[test]
fn an_f_per_minute_is_no_lead() {
    finds(
        "G98 S60 M3\nG0 X20 Z10\nG1 Z9 F100\nG32 Z-20",
        "4:1 missing-word",
    );
    finds(
        "G98 S60 M3\nG0 X20 Z10\nG1 Z9 F100\nG32 Z-20 F2\nG0 X24\nG1 Z-10",
        "6:1 missing-feed",
    );
    finds(
        "G98 S60 M3\nG0 X20 Z10\nG32 Z-20 F2\nG0 X24\nG1 X23 F100\nG0 Z10\nX20\nG32 Z-20",
        "8:1 missing-word",
    );
    // The message has the code that was written, and Haas' manual asks for G99.
    let said = |text: &str, options: Options| {
        let report = check(text.as_bytes(), options);
        report
            .diagnostics
            .first()
            .map(|found| found.message.clone())
    };
    let g32 = Some("G32 without F".to_owned());
    assert_eq!(said("G99 S60 M3\nG0 X20 Z10\nG32 Z-20", lathe()), g32);
    let haas = Options {
        fanuc: FanucParameters {
            offset_memory: OffsetMemory::Haas,
            ..lathe().fanuc
        },
        ..lathe()
    };
    let text = "G98 S60 M3\nG0 X20 Z10\nG32 Z-20 F2";
    let in_g98 = "G32 of a Haas with a feed per minute (G98)".to_owned();
    assert_eq!(said(text, haas), Some(in_g98));
}

/// Two threads beside each other: Q is the angle at which a pass begins, in thousandths of a degree, and is of its
/// block alone, as FANUC's manual says.
#[test]
fn g92_begins_at_an_angle() {
    let text =
        "S60 M3\nG0 X24 Z4\nG92 X19 Z-20 F4\nX18\nG92 X19 Z-20 F4 Q180000\nX18 Q180000\nX17.5";
    let phases: Vec<u32> = cuts(text)
        .iter()
        .filter_map(|cut| cut.split(['@', ' ']).nth(1)?.parse().ok())
        .collect();
    let half = PHASE_STEPS / 2;
    assert_eq!(phases, [0, 0, half, half, 0]);
    finds(
        "S60 M3\nG0 X24 Z4\nG92 X19 Z-20 F4 Q180.",
        "3:17 ambiguous-word",
    );
    finds(
        "S60 M3\nG0 X24 Z4\nG90 X19 Z-20 F4 Q180",
        "3:17 unused-word",
    );
}
