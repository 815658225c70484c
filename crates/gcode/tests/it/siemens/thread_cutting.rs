//! Tests of CYCLE97 and CYCLE98. Values are computed by hand.

use glidepath_gcode::{Machine, Options, Program, Threading, check};
use glidepath_geometry::Axis;
use glidepath_program::{Event, ItemKind, Limits, PHASE_STEPS, Rate};

use crate::support::listed;

fn lathe() -> Options {
    Options {
        machine: Machine::new(&[Axis::X, Axis::Z]),
        threading: Some(Threading::new(
            Limits::uniform(200.0, 2_000.0, 40_000.0),
            0.004,
        )),
        ..super::options()
    }
}

const HEAD: &str = "G18 G90 DIAMON\nS500 M3\nG0 X60 Z10\n";

/// The moves in X (a radius) and Z, `r` behind rapids; in front of a pass its pitch and its angle in degrees.
fn ways(cycle: &str) -> Vec<String> {
    let text = format!("{HEAD}{cycle}");
    let mut ways = Vec::new();
    let round = |mm: f64| (mm * 1e4).round() / 1e4 + 0.0;
    for item in Program::new(text.as_bytes(), lathe()) {
        match item.unwrap_or_else(|found| panic!("{text}\n{found}")).kind {
            ItemKind::Event(Event::Synchronise { pitch_mm, phase }) => {
                let angle = round(360.0 * f64::from(phase) / f64::from(PHASE_STEPS));
                ways.push(format!("{}@{angle}", round(pitch_mm)));
            }
            ItemKind::Move { segment, rate, .. } => {
                let [x, z] = [0, 2].map(|axis| round(segment.end()[axis]));
                let mark = if rate.is_synchronised() { "" } else { "r" };
                ways.push(format!("{x} {z}{mark}"));
            }
            _ => {}
        }
    }
    ways
}

/// Where the passes begin and end: X and Z.
fn passes(cycle: &str) -> Vec<String> {
    let ways = ways(cycle);
    let is_pass = |index: &usize| ways[*index].contains('@');
    let all = (0..ways.len()).filter(is_pass);
    all.map(|at| format!("{} > {}", ways[at - 1].trim_end_matches('r'), ways[at + 1]))
        .collect()
}

#[test]
fn a_thread_outside_in_even_passes() {
    // M20 x 1.5 from Z0 to Z-20, 5 run-in and 2 run-out, 0.9 deep: two passes of 0.4, one of 0.1, one empty.
    let cycle = "CYCLE97(1.5,,0,-20,20,20,5,2,0.9,0.1,0,90,2,1,1,1)\nG0 X60";
    assert_eq!(
        ways(cycle),
        [
            "30 10r", "11 5r", "9.6 5r", "1.5@90", "9.6 -22", "11 -22r", "11 5r", "9.2 5r",
            "1.5@90", "9.2 -22", "11 -22r", "11 5r", "9.1 5r", "1.5@90", "9.1 -22", "11 -22r",
            "11 5r", "9.1 5r", "1.5@90", "9.1 -22", "11 -22r", "11 5r", "30 5r",
        ]
    );
    // Diameters are diameters with DIAMOF, too; the pitch of M20 is 2.5.
    let radii = format!("DIAMOF\n{}", cycle.replace("1.5,,", ",20,"));
    assert_eq!(passes(&radii)[0], "9.6 5 > 9.6 -22");
    assert_eq!(ways(&radii)[3], "2.5@90");
}

#[test]
fn passes_of_one_cross_section_inside() {
    // Four passes to 0.8 deep: the roots of 1/4, 2/4, 3/4.
    let cycle = "CYCLE97(1,,0,-20,20,20,5,2,0.8,0,0,0,4,0,4,1)";
    assert_eq!(
        passes(cycle),
        [
            "10.4 5 > 10.4 -22",
            "10.5657 5 > 10.5657 -22",
            "10.6928 5 > 10.6928 -22",
            "10.8 5 > 10.8 -22"
        ]
    );
    // Back 1 mm off, towards the axis; or by _VRT.
    assert_eq!(ways(cycle)[1], "9 5r");
    let further = cycle.replace("4,1)", "4,1,2.5)");
    assert_eq!(ways(&further)[1], "7.5 5r");
}

#[test]
fn threads_beside_each_other_on_a_cone() {
    // From 20 to 24 over 20 mm: 0.1 a millimetre, which goes on over 5 before it and 2 behind it.
    let cycle = "CYCLE97(3,,0,-20,20,24,5,2,1,0,0,30,1,0,3,3)";
    assert_eq!(passes(cycle), ["8.5 5 > 11.2 -22"; 3]);
    let angles: Vec<String> = ways(cycle)
        .into_iter()
        .filter(|way| way.contains('@'))
        .collect();
    // The pitch counts along Z: along the cone it is longer.
    let along = 3.0 * f64::hypot(27.0, 2.7) / 27.0;
    let along = (along * 1e4).round() / 1e4;
    assert_eq!(
        angles,
        [30, 150, 270].map(|angle| format!("{along}@{angle}"))
    );
    assert_eq!(ways(cycle)[1], "13.2 5r");
}

#[test]
fn the_infeed_along_flanks() {
    // tan 45 is 1: the pass 0.5 deep is shifted by 0.5, that of 1 by 1, into the thread.
    let one = "CYCLE97(2,,0,-20,20,20,5,2,1,0,45,0,2,0,1,1)";
    assert_eq!(passes(one), ["9.5 4.5 > 9.5 -22", "9 4 > 9 -22"]);
    // On both flanks: 1 less 0.5, 1 more 0.25, then 1.
    let both = "CYCLE97(2,,0,-20,20,20,5,2,1,0,-45,0,2,1,1,1)";
    assert_eq!(
        passes(both),
        ["9.5 4.5 > 9.5 -22", "9 4 > 9 -22", "9 4 > 9 -22"]
    );
    let both = both.replace("2,1,1,1)", "4,0,1,1)");
    assert_eq!(
        passes(&both),
        [
            "9.75 4.75 > 9.75 -22",
            "9.5 3.5 > 9.5 -22",
            "9.25 4.25 > 9.25 -22",
            "9 4 > 9 -22"
        ]
    );
}

#[test]
fn threads_that_are_refused() {
    let good = "CYCLE97(1.5,,0,-20,20,20,5,2,0.9,0.1,0,0,2,1,1,1)";
    assert_eq!(passes(good).len(), 4);
    for (from, to) in [
        ("(1.5,,", "(,7.5,"),
        // M20 has a pitch of 2.5, and M60 none that is known.
        ("(1.5,,", "(1.5,20,"),
        ("(1.5,,", "(5.5,60,"),
        ("20,20,5", "20,70,5"),
        (",0,-20,", ",0,0,"),
        ("0.9,0.1", "0.9,0.9"),
        ("0.9,0.1", "0,0"),
        ("0.9,0.1", "11,0.1"),
        ("0,0,2,1,1,1", "70,0,2,1,1,1"),
        ("0,0,2,1,1,1", "0,360,2,1,1,1"),
        ("0,0,2,1,1,1", "0,0,0,1,1,1"),
        ("0,0,2,1,1,1", "0,0,2.5,1,1,1"),
        ("0,0,2,1,1,1", "0,0,2,1,5,1"),
        ("0,0,2,1,1,1", "0,0,900,900,1,900"),
        ("2,1,1,1)", "2,1,2,1,10)"),
        ("1,1)", "1,1,1,7)"),
    ] {
        let call = good.replace(from, to);
        assert_ne!(call, good);
        let report = check(format!("{HEAD}{call}").as_bytes(), lathe());
        assert_eq!(report.diagnostics.len(), 1, "{call}");
        assert!(listed(&report)[0].starts_with("4:1 "), "{call}");
    }
    // Another plane, and a spindle that stands.
    for head in ["G17\nS500 M3\n", "G18\n"] {
        let report = check(format!("{head}{good}").as_bytes(), lathe());
        assert_eq!(report.diagnostics.len(), 1, "{head}");
    }
}

#[test]
fn a_pitch_that_agrees_with_the_size_of_the_thread() {
    let cycle = "CYCLE97(2.5,20,0,-20,20,20,5,2,0.9,0,0,0,1,0,1,1)";
    assert_eq!(ways(cycle)[3], "2.5@0");
}

/// Every pass of a chain: its lead and angle, where it begins, and the ends of its parts.
fn chains(cycle: &str) -> Vec<String> {
    let ways = ways(cycle);
    let starts = (0..ways.len()).filter(|at| ways[*at].contains('@'));
    starts
        .map(|at| {
            format!(
                "{} {} > {}",
                ways[at],
                ways[at - 1],
                ways[at + 1..at + 4].join(" > ")
            )
        })
        .collect()
}

#[test]
fn three_threads_that_follow_each_other() {
    // From 30 to 30, to 36, to 50 over 30, 30 and 20 mm; the last cone is 0.35 a millimetre, so 10 mm more are 3.5.
    // Two passes to 0.9 deep, one of 0.1, one more.
    let cycle = "CYCLE98(0,30,-30,30,-60,36,-80,50,10,10,1,0.1,,90,2,1,1.5,2,2,1,1)\nG0 X100";
    assert_eq!(
        chains(cycle),
        [
            "1.5@90 14.55 10r > 14.55 -30 > 17.55 -60 > 28.05 -90",
            "1.5@90 14.1 10r > 14.1 -30 > 17.1 -60 > 27.6 -90",
            "1.5@90 14 10r > 14 -30 > 17 -60 > 27.5 -90",
            "1.5@90 14 10r > 14 -30 > 17 -60 > 27.5 -90",
        ]
    );
    // Back 1 mm off the widest place, and along it.
    let all = ways(cycle);
    assert_eq!(all[1], "29.5 10r");
    assert_eq!(all[7..10], ["29.5 -90r", "29.5 10r", "14.1 10r"]);
    assert_eq!(all.last().map(String::as_str), Some("50 10r"));
    // The lead counts along Z: 1.5 mm a turn there are 1.5 of the way, 2 mm on the cones more.
    let text = format!("{HEAD}{cycle}");
    let speeds: Vec<f64> = Program::new(text.as_bytes(), lathe())
        .filter_map(|item| match item.expect("a good item").kind {
            ItemKind::Move {
                rate: Rate::Synchronised(speed_v),
                ..
            } => Some(speed_v / 1.5),
            _ => None,
        })
        .collect();
    for (speed, lead) in
        speeds
            .iter()
            .zip([1.5, 2.0 * 0.1_f64.hypot(1.0), 2.0 * 0.35_f64.hypot(1.0)])
    {
        assert!(
            (1.5 * speed / speeds[0] - lead).abs() < 1e-9,
            "{speed} {lead}"
        );
    }
}

#[test]
fn a_chain_inside_and_others_that_are_refused() {
    let good = "CYCLE98(0,30,-30,30,-60,24,-80,20,10,10,1,0,,0,1,0,1.5,2,2.5,2,2)";
    assert_eq!(
        chains(good),
        [
            "1.5@0 16 10r > 16 -30 > 13 -60 > 10 -90",
            "1.5@180 16 10r > 16 -30 > 13 -60 > 10 -90",
        ]
    );
    assert_eq!(ways(good)[1], "8 10r");
    for (from, to) in [
        ("-60,24", "-20,24"),
        ("-60,24", "-60,100"),
        (",30,-30", ",0,-30"),
        ("1,0,,0", "1,0,30,0"),
        ("1,0,,0", "1,1,,0"),
        ("1.5,2,2.5", "1.5,,2.5"),
        ("2.5,2,2)", "2.5,5,2)"),
        ("2.5,2,2)", "2.5,2,2,9)"),
        ("2.5,2,2)", "2.5,2,2,,1)"),
    ] {
        let call = good.replace(from, to);
        assert_ne!(call, good);
        let report = check(format!("{HEAD}{call}").as_bytes(), lathe());
        assert_eq!(report.diagnostics.len(), 1, "{call}");
        assert!(listed(&report)[0].starts_with("4:1 "), "{call}");
    }
}
