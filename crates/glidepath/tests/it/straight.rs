//! Straight feed moves behind short ones: programs found by chance in which the middle half lay up to 19 µm beside its
//! line.

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
    for program in ["rest", "behind_a_cut", "leaning", "leaning_fast"] {
        for machine in ["mill", "seed"] {
            let file = format!("{ROOT}/tests/data/straight/{program}.ngc");
            let config = format!("{ROOT}/config/{machine}.toml");
            let output = glidepath(&["plan", &file, "--config", &config, "--json"]);
            assert!(output.status.success(), "{program}, {machine}");
            let report = object(&output);
            assert_eq!(report["violation_count"], 0, "{program}, {machine}");
            let shape = &report["shape"];
            assert!(shape["straight_moves"].as_u64().unwrap() >= 4, "{shape}");
            let beside = &shape["beside_straight"];
            let beside_mm = beside["mm"].as_f64().unwrap();
            assert!(beside_mm <= BESIDE_MM, "{program}, {machine}: {beside}");
        }
    }
}
