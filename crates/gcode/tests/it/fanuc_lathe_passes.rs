//! Tests of passes of FANUC's and Haas' lathes: tapers, ways out of threads, holes, the last cut. Values
//! are computed by hand; X is a radius here.

use std::sync::Arc;

use glidepath_gcode::{
    Connections, Dialect, FanucControl, FanucParameters, Machine, Options, Program, Threading,
    Tool, ToolTable, check,
};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Limits, Rate};

use crate::support::listed;

pub(crate) fn options() -> Options {
    let mut tools = ToolTable::new();
    tools.set(1, Tool::default());
    Options {
        dialect: Dialect::Fanuc,
        connections: Connections::Simulated,
        tools: Some(Arc::new(tools)),
        machine: Machine::new(&[Axis::X, Axis::Z]),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..Options::default()
    }
}

pub(crate) fn with(fanuc: FanucParameters) -> Options {
    Options { fanuc, ..options() }
}

pub(crate) fn ends_with(text: &str, options: Options) -> Vec<[f64; 2]> {
    Program::new(text.as_bytes(), options)
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, .. } => {
                let end = segment.end();
                Some([0, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0))
            }
            _ => None,
        })
        .collect()
}

fn ends(text: &str) -> Vec<[f64; 2]> {
    ends_with(text, options())
}

#[track_caller]
fn finds(text: &str, expected: &[&str]) {
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), expected, "{text}");
}

const HEAD: &str = "G98 G97 S600 M3\n";

#[test]
fn a_taper_may_be_i_or_k() {
    let pass = |words: &str| ends(&format!("{HEAD}G0 X62 Z2\n{words}"));
    let turned = [
        [31.0, 2.0],
        [23.0, 2.0],
        [25.0, -30.0],
        [31.0, -30.0],
        [31.0, 2.0],
    ];
    assert_eq!(pass("G90 X50 Z-30 R-2 F300"), turned);
    assert_eq!(pass("G90 X50 Z-30 I-2 F300"), turned);
    let faced = [
        [31.0, 2.0],
        [31.0, -8.0],
        [10.0, -5.0],
        [10.0, 2.0],
        [31.0, 2.0],
    ];
    assert_eq!(pass("G94 X20 Z-5 K-3 F300"), faced);
    let thread = |word: &str| ends(&format!("{HEAD}G0 X34 Z6\nG92 X30 Z-20 {word} F1.5"));
    assert_eq!(thread("I-2"), thread("R-2"));
    assert_eq!(thread("I-2")[1], [13.0, 6.0]);
    finds(
        &format!("{HEAD}G0 X62 Z2\nG90 X50 Z-30 I-2 R-2 F300"),
        &["3:14 ambiguous-word"],
    );
    finds(
        &format!("{HEAD}G0 X62 Z2\nG90 X50 Z-30 K-2 F300"),
        &["3:14 unused-word"],
    );
}

#[test]
fn m24_takes_the_way_out_of_threads_away() {
    let thread = |before: &str| ends(&format!("{HEAD}{before}\nG0 X34 Z6\nG92 X30 Z-20 F1.5"));
    let with_exit = [
        [17.0, 6.0],
        [15.0, 6.0],
        [15.0, -18.5],
        [16.5, -20.0],
        [17.0, -20.0],
        [17.0, 6.0],
    ];
    let straight = [
        [17.0, 6.0],
        [15.0, 6.0],
        [15.0, -20.0],
        [17.0, -20.0],
        [17.0, 6.0],
    ];
    assert_eq!(thread(""), with_exit);
    assert_eq!(thread("M24"), straight);
    assert_eq!(thread("M24\nM23"), with_exit);
    // The block of a cycle along a profile has no other code.
    finds(
        "G98\nG0 X62 Z2\nG71 P10 Q20 U0.6 D10. F300 M24\nN10 G0 X20\nN20 G1 Z-20",
        &["3:1 not-supported"],
    );
    // They are no codes of mills.
    let mill = FanucParameters {
        control: Some(FanucControl::Mill),
        ..FanucParameters::default()
    };
    let report = check(&b"M24"[..], with(mill));
    assert_eq!(listed(&report), ["1:1 unknown-m-code"]);
}

#[test]
fn a_place_of_the_machine_is_no_increment() {
    finds("G98\nG53 U5", &["2:1 machine-coordinates"]);
    finds("G98\nG53 X5 W1", &["2:1 machine-coordinates"]);
    assert_eq!(ends("G98\nG53 X10 Z1"), [[5.0, 1.0]]);
}

#[test]
fn a_last_cut_may_be_left_along_the_profile() {
    let cycle = |words: &str| {
        ends(&format!(
            "G98\nG0 X62 Z2\nG71 P10 Q50 U0.6 W0.3 {words} D10. F300\nN10 G0 X20\nN20 G1 Z-20 F100\nN30 X40\nN40 Z-40\nN50 X60"
        ))
    };
    let has = |all: &[[f64; 2]], right: [f64; 2]| all.contains(&right);
    let plain = cycle("");
    let cut = cycle("I0.5 K0.2");
    // X20 and 0.3 left to finish: radius 10.3; before the last cut 0.5 more, and 0.2 along Z.
    assert!(
        has(&plain, [10.3, -19.7]) && !has(&plain, [10.8, -19.5]),
        "{plain:?}"
    );
    assert!(
        has(&cut, [10.3, -19.7]) && has(&cut, [10.8, -19.5]),
        "{cut:?}"
    );
    let place = |right: [f64; 2]| cut.iter().position(|end| *end == right);
    assert!(place([10.8, -19.5]) < place([10.3, -19.7]));
    assert_eq!(cut.last(), Some(&[31.0, 2.0]));
    finds(
        "G98\nG0 X62 Z2\nG71 U2. R1.\nG71 P10 Q20 U0.6 I1. F300\nN10 G0 X20\nN20 G1 Z-20",
        &["4:18 unused-word"],
    );
}

/// Ends of the moves to which the tool goes at the feed of the cycle, or at rapid.
fn paced(text: &str) -> Vec<(bool, [f64; 2])> {
    Program::new(text.as_bytes(), options())
        .map(|item| item.unwrap_or_else(|d| panic!("{text}\n{d}")))
        .filter_map(|item| match item.kind {
            ItemKind::Move { segment, rate, .. } => {
                let end = segment.end();
                let end = [0, 2].map(|axis| (end[axis] * 1e6).round() / 1e6 + 0.0);
                Some((rate == Rate::Rapid, end))
            }
            _ => None,
        })
        .collect()
}

#[test]
fn the_way_down_is_as_the_first_block_of_the_profile_says() {
    // Levels of 5 from a radius of 26 down to 15; back at 45 degrees and above the pass at rapid.
    let turning = |first: &str| {
        paced(&format!(
            "G98\nG0 X52. Z2.\nG71 U5. R1.\nG71 P10 Q20 F300.\nN10 {first}\nN20 G1 Z-15. F100."
        ))
    };
    for (first, is_rapid) in [
        ("G0 X30.", true),
        ("G1 X30.", false),
        ("G1 X30. F50.", false),
    ] {
        let all = turning(first);
        for level in [21.0, 16.0, 15.0] {
            assert!(
                all.contains(&(is_rapid, [level, 2.0])),
                "{first} {level} {all:?}"
            );
            assert!(
                !all.contains(&(!is_rapid, [level, 2.0])),
                "{first} {level} {all:?}"
            );
        }
        for aside in [[22.0, -14.0], [22.0, 1.0]] {
            assert!(all.contains(&(true, aside)), "{first} {aside:?} {all:?}");
        }
        assert_eq!(all.last(), Some(&(true, [26.0, 2.0])));
    }
    let others = [
        // Facing; a bore; type II, whose first block has X and Z.
        (
            "G0 X52. Z2.\nG72 W5. R1.\nG72 P10 Q20 F300.\nN10 G1 Z-10.\nN20 X30.",
            [[26.0, -3.0], [26.0, -8.0], [26.0, -10.0]],
        ),
        (
            "G0 X20. Z2.\nG71 U5. R1.\nG71 P10 Q20 F300.\nN10 G1 X44.\nN20 Z-15.",
            [[15.0, 2.0], [20.0, 2.0], [22.0, 2.0]],
        ),
        (
            "G0 X52. Z2.\nG71 U5. R1.\nG71 P10 Q20 F300.\nN10 G1 X30. Z2.\nN20 Z-15.",
            [[21.0, 2.0], [16.0, 2.0], [15.0, 2.0]],
        ),
    ];
    for (text, downs) in others {
        for (code, is_rapid) in [("N10 G1", false), ("N10 G0", true)] {
            let text = text.replace("N10 G1", code).replace("N20 ", "N20 G1 ");
            let all = paced(&format!("G98\n{text}"));
            for down in downs {
                assert!(all.contains(&(is_rapid, down)), "{text} {down:?} {all:?}");
                assert!(!all.contains(&(!is_rapid, down)), "{text} {down:?} {all:?}");
            }
        }
    }
    // The last cut goes to the profile as the passes do.
    let cut = "G98\nG0 X52. Z2.\nG71 P10 Q20 I1. K0 D5. F300.\nN10 G1 X30.\nN20 Z-15.";
    assert!(paced(cut).contains(&(false, [15.0, 2.0])));
    let cut = cut.replace("N10 G1", "N10 G0").replace("N20 ", "N20 G1 ");
    assert!(paced(&cut).contains(&(true, [15.0, 2.0])));
}

#[test]
fn words_of_threads_without_a_point_count_increments() {
    let depths = |first: &str, second: &str| {
        let text =
            format!("{HEAD}G0 X22 Z6\nG76 P020060 Q100 {first}\nG76 {second} P920 Q300 F1.5");
        ends(&text)
    };
    let right = depths("R0.05", "X18.16 Z-20");
    assert_eq!(depths("R50", "X18.16 Z-20"), right);
    assert_eq!(depths("R50", "U-3.84 W-26"), right);
    assert_eq!(depths("R50", "X18.16 W-26"), right);
    assert_eq!(right.last(), Some(&[11.0, 6.0]));
    let grooves = |text: &str| {
        Program::new(text.as_bytes(), options())
            .filter(|item| {
                matches!(
                    item.as_ref().map(|item| &item.kind),
                    Ok(ItemKind::Event(Event::Synchronise { .. }))
                )
            })
            .count()
    };
    // 0.3·√n up to 0.87, 0.05 and two more: 0.3 0.424 0.52 0.6 0.671 0.735 0.794 0.849, 0.87.
    let text = format!("{HEAD}G0 X22 Z6\nG76 P020060 Q0 R50\nG76 X18.16 Z-20 P920 Q300 F1.5");
    assert_eq!(grooves(&text), 9 + 2);
    finds(
        &format!("{HEAD}G0 X22 Z6\nG76 P020060 Q100 R50\nG76 X18 U1 Z-20 P920 Q300 F1.5"),
        &["4:9 ambiguous-word"],
    );
}

/// Tool 1 has a radius of 1 mm, and its tip points to lower X and Z.
fn round_tip() -> Options {
    let mut tools = ToolTable::new();
    tools.set(
        1,
        Tool {
            diameter_mm: 2.0,
            orientation: 2,
            ..Tool::default()
        },
    );
    Options {
        tools: Some(Arc::new(tools)),
        ..options()
    }
}

#[test]
fn the_radius_of_the_tip_counts_in_g70() {
    let along = |first: &str, last: &str, before: &str| {
        let text = format!(
            "G98\nT0101\nG0 X62 Z2\nG71 U2. R1.\nG71 P10 Q40 U0.4 W0.1 F300\nN10 {first}G0 X20\nN20 G1 Z-10 F100\nN30 X40 Z-20\nN40 {last}X62\n{before}G70 P10 Q40\nG40\nG0 X70"
        );
        ends_with(&text, round_tip())
    };
    let rough = along("", "", "").len();
    // Beside the cylinder the centre is at X11, beside the chamfer at X + Z = √2: there Z is √2 − 11, and
    // the corner of the tip one lower.
    let back = 2.0 - 2.0_f64.sqrt();
    let places = |all: &[[f64; 2]], right: &[[f64; 2]]| {
        let mut left = all.iter();
        for place in right {
            let near = |end: &&[f64; 2]| {
                (end[0] - place[0]).abs() < 1e-5 && (end[1] - place[1]).abs() < 1e-5
            };
            assert!(left.any(|end| near(&end)), "never at {place:?}: {all:?}");
        }
    };
    let on = along("", "", "G42\n");
    places(
        &on,
        &[
            [10.0, -10.0 - back],
            [20.0 - back, -20.0],
            // Its centre is at X31.
            [30.0, -20.0],
            [31.0, 2.0],
            [35.0, 2.0],
        ],
    );
    assert!(on.len() >= rough);
    // In the blocks: roughing leaves it out, and G40 ends it on the way to X62.
    let within = along("G42 ", "G40 ", "");
    let side = 1.0 - 0.5_f64.sqrt();
    places(
        &within,
        &[
            [10.0, -10.0 - back],
            [20.0 - side, -20.0 - side],
            [31.0, -20.0],
            [31.0, 2.0],
        ],
    );
    let roughing = |all: &[[f64; 2]]| {
        let end = all.iter().rposition(|end| *end == [31.0, 2.0]);
        let start = all.iter().position(|end| *end == [31.0, 2.0]);
        assert!(start < end);
        let second = all.iter().skip(1).position(|end| *end == [31.0, 2.0]);
        all[..=second.expect("the end of G71")].to_vec()
    };
    assert_eq!(roughing(&within), roughing(&along("", "", "")));
    finds(
        "G98\nT0101\nG0 X62 Z2\nG42\nG71 U2. R1.\nG71 P10 Q20 U0.4 F300\nN10 G0 X20\nN20 G1 Z-10",
        &["6:1 canned-cycle"],
    );
}

#[test]
fn g70_takes_the_profile_that_was_cut() {
    // Two tools with the same numbers: down to Z-10 and to Z-20.
    let tool = |depth: u32| {
        format!(
            "G0 X42 Z2\nG71 U5. R1.\nG71 P10 Q20 F300\nN10 G0 X20\nG1 Z-{depth}\nN20 X40\nG70 P10 Q20\n"
        )
    };
    let text = format!("G98\n{}G0 Z90\n{}", tool(10), tool(20));
    let all = ends(&text);
    let between = all.iter().position(|[_, z]| *z == 90.0).expect("Z90");
    let depths = |part: &[[f64; 2]]| part.iter().map(|[_, z]| *z).fold(0.0, f64::min);
    assert_eq!(
        [depths(&all[..between]), depths(&all[between..])],
        [-10.0, -20.0]
    );
    // Without a cycle that has cut one of them it is not known which is meant.
    let profile = "N10 G0 X20\nG1 Z-10 F300\nN20 X40\n";
    finds(
        &format!("G98\n{profile}G70 P10 Q20\n{profile}"),
        &["5:5 ambiguous-word"],
    );
}

/// A profile whose last block goes back to its beginning, as hands write it, and words that G70 does not have.
#[test]
fn what_a_profile_cannot_have_says_how_to_mend_it() {
    let profile = "N10 G0 X10.\nG1 Z-20.\nX40.\nN20 G0 Z2.\nM30\n";
    let text = format!("{HEAD}G0 X42. Z2.\nG71 P10 Q20 U0.5 W0.1 D2. F300\n{profile}");
    let report = check(text.as_bytes(), options());
    assert_eq!(listed(&report), ["3:9 canned-cycle"]);
    let help = &report.diagnostics[0].help;
    assert!(help.contains("in front of its last element"), "{help}");
    let profile = "N10 G0 X10.\nG1 Z-20.\nN20 X40.\nM30\n";
    for word in ["U0.5", "W0.1", "D0.2"] {
        let text = format!("{HEAD}G0 X42. Z2.\nG70 P10 Q20 {word} F300\n{profile}");
        let report = check(text.as_bytes(), options());
        assert_eq!(listed(&report), ["3:13 unused-word"], "{word}");
        let reason = &report.diagnostics[0].reason;
        assert!(reason.contains("as it stands"), "{reason}");
    }
}

/// In systems B and C G90 and G91 say what X and Z of these cycles are, as of moves.
#[test]
fn cycles_of_one_block_go_by_increments_in_g91() {
    let of = |control| {
        with(FanucParameters {
            control: Some(control),
            ..FanucParameters::default()
        })
    };
    let head = "G94 G97 S600 M3\nM24\nG0 X62 Z2\n";
    let [b, c] = [FanucControl::LatheB, FanucControl::LatheC];
    let same = |incremental: &str, absolute: &str, control| {
        let text = format!("{head}G91 {incremental}\nG90 G0 X80");
        let expected = format!("{head}G90 {absolute}\nG90 G0 X80");
        let ways = ends_with(&text, of(control));
        assert_eq!(ways, ends_with(&expected, of(control)), "{text}");
        ways
    };
    let pass = |x: f64| [[x, 2.0], [x, -30.0], [31.0, -30.0], [31.0, 2.0]];
    let turned = [&[[31.0, 2.0]][..], &pass(28.0), &pass(26.0), &[[40.0, 2.0]]].concat();
    let ways = same("G77 X-6 Z-32 F300\nX-10", "G77 X56 Z-30 F300\nX52", b);
    assert_eq!(ways, turned);
    let ways = same("G20 X-6 Z-32 F300\nX-10", "G20 X56 Z-30 F300\nX52", c);
    assert_eq!(ways, turned);
    let faces = [
        [31.0, 2.0],
        [31.0, -8.0],
        [10.0, -5.0],
        [10.0, 2.0],
        [31.0, 2.0],
        [40.0, 2.0],
    ];
    for (code, control) in [("G79", b), ("G24", c)] {
        let ways = same(
            &format!("{code} X-42 Z-7 R-3 F300"),
            &format!("{code} X20 Z-5 R-3 F300"),
            control,
        );
        assert_eq!(ways, faces);
    }
    let thread = [
        [31.0, 2.0],
        [27.0, 2.0],
        [28.0, -20.0],
        [31.0, -20.0],
        [31.0, 2.0],
        [40.0, 2.0],
    ];
    for (code, control) in [("G78", b), ("G21", c)] {
        let ways = same(
            &format!("{code} X-6 Z-22 R-1 F1.5"),
            &format!("{code} X56 Z-20 R-1 F1.5"),
            control,
        );
        assert_eq!(ways, thread);
    }
    for (codes, control) in [(["G74", "G75"], b), (["G76", "G77"], c)] {
        for code in codes {
            let ways = same(
                &format!("{code} X-12 Z-6 P3000 Q3000 F300"),
                &format!("{code} X50 Z-4 P3000 Q3000 F300"),
                control,
            );
            assert!(ways.contains(&[25.0, -4.0]), "{ways:?}");
        }
    }
}
