//! Straight feed moves behind short ones, and lines in pieces: programs found by chance in which the middle half lay up
//! to 90 µm beside its line, or the motion swung out of a corner by as much as the tolerance.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use super::support::{glidepath, object};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
/// How far a motion may be beside its line, mm.
const BESIDE_MM: f64 = 1e-3;

#[test]
fn a_straight_move_is_straight_whatever_comes_before_it() {
    for program in [
        "rest",
        "behind_a_cut",
        "leaning",
        "leaning_fast",
        "in_pieces",
    ] {
        for machine in ["mill", "seed"] {
            let file = format!("{ROOT}/tests/data/straight/{program}.ngc");
            let config = format!("{ROOT}/config/{machine}.toml");
            let output = glidepath(&["plan", &file, "--config", &config, "--json"]);
            assert!(output.status.success(), "{program}, {machine}");
            let report = object(&output);
            assert_eq!(report["violation_count"], 0, "{program}, {machine}");
            let shape = &report["shape"];
            assert!(shape["straight_moves"].as_u64().unwrap() >= 3, "{shape}");
            let beside = &shape["beside_straight"];
            let beside_mm = beside["mm"].as_f64().unwrap();
            assert!(beside_mm <= BESIDE_MM, "{program}, {machine}: {beside}");
        }
    }
}

/// At the crest of an arc in chords an axis turns round beside a joint of two of them; and a corner comes into sight when the
/// motion is behind the middle of the line to it. At both the motion swung by a micrometre or two.
#[test]
fn a_motion_does_not_tremble_at_a_crest_and_where_a_corner_comes_into_sight() {
    for program in ["crest", "over_to_another_corner"] {
        let file = format!("{ROOT}/tests/data/smooth/{program}.ngc");
        let output = glidepath(&["plan", &file, "--json"]);
        assert!(output.status.success(), "{program}");
        let report = object(&output);
        assert_eq!(report["violation_count"], 0, "{program}");
        let findings = &report["smoothness_findings"];
        assert_eq!(
            report["smoothness_finding_count"], 0,
            "{program}: {findings}"
        );
    }
}

/// Lines with corners, each in pieces whose ends are rounded to a micrometre, as a program of CAM has them.
fn in_pieces(seed: u64) -> String {
    // SplitMix64: Steele, Lea, Flood 2014.
    let mut state = seed;
    let mut below = |most: f64| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let share = f64::from(u32::try_from((z ^ (z >> 31)) >> 32).unwrap()) / 2_f64.powi(32);
        share * most
    };
    let tolerance_mm = 0.01 * 10_f64.powf(below(1.0));
    let mut program = format!(
        "G21 G90 G64 P{tolerance_mm:.3}\nF{:.0}\n",
        1500.0 + below(4500.0)
    );
    let mut at = [0.0; 3];
    for _ in 0..5 {
        let length_mm = 1.0 + below(24.0);
        let mut along = [(); 3].map(|()| below(2.0) - 1.0);
        if below(1.0) < 0.4 {
            along = [along[0].signum(), 0.0, 0.0];
        }
        let size = along.iter().map(|part| part * part).sum::<f64>().sqrt();
        let end: [f64; 3] = core::array::from_fn(|axis| at[axis] + along[axis] / size * length_mm);
        let mut cuts = [below(1.0), below(1.0), 1.0];
        cuts.sort_by(f64::total_cmp);
        for cut in cuts {
            let [x, y, z]: [f64; 3] =
                core::array::from_fn(|axis| at[axis] + (end[axis] - at[axis]) * cut);
            program += &format!("G1 X{x:.3} Y{y:.3} Z{z:.3}\n");
        }
        at = end;
    }
    program + "M2\n"
}

#[test]
fn a_line_in_pieces_is_straight_and_its_corners_are_passed_inside() {
    let folder = tempfile::tempdir().unwrap();
    for seed in 0..40 {
        let file = folder.path().join(format!("{seed}.ngc"));
        std::fs::write(&file, in_pieces(seed)).unwrap();
        let output = glidepath(&["plan", file.to_str().unwrap(), "--json"]);
        assert!(output.status.success(), "{seed}");
        let report = object(&output);
        assert_eq!(report["violation_count"], 0, "{seed}");
        let findings = &report["shape"]["findings"];
        assert_eq!(report["shape"]["finding_count"], 0, "{seed}: {findings}");
    }
}

#[test]
fn a_corner_between_a_line_and_an_arc_is_passed_inside() {
    for program in [
        "circle_behind_a_line",
        "line_behind_a_circle",
        "lines_and_arcs",
    ] {
        for machine in ["mill", "seed"] {
            let file = format!("{ROOT}/tests/data/corners/{program}.ngc");
            let config = format!("{ROOT}/config/{machine}.toml");
            let output = glidepath(&["plan", &file, "--config", &config, "--json"]);
            assert!(output.status.success(), "{program}, {machine}");
            let report = object(&output);
            assert_eq!(report["violation_count"], 0, "{program}, {machine}");
            let findings = &report["shape"]["findings"];
            let count = &report["shape"]["finding_count"];
            assert_eq!(*count, 0, "{program}, {machine}: {findings}");
        }
    }
}
