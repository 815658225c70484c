//! The direction of the tool from the configuration to the report: its tolerance, the pole, and the end of C.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::print_stderr,
    reason = "a test that fails may panic, and tells why"
)]

use super::support::{glidepath, object};
use core::fmt::Write as _;
use serde_json::Value;

/// Two tables, A and C, with a tool of 80 mm.
const MACHINE: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/data/bench/joints/machines/table-table-ac.toml"
));

/// The tool leans from one side to the other in a millimetre a block, by the pole, a hundredth of a degree beside it.
fn passage() -> String {
    let mut text = String::from("TRAORI\nG64\n");
    for k in -20..=20 {
        let lean = f64::from(k).to_radians();
        let (side, up) = (0.01_f64.to_radians().sin(), lean.cos());
        let code = if k == -20 { "G0" } else { "G1 F3000" };
        let y = 0.5 * f64::from(k);
        writeln!(
            text,
            "{code} X0 Y{y} A3={side:.12} B3={:.12} C3={up:.12}",
            lean.sin()
        )
        .unwrap();
    }
    text + "M30\n"
}

/// What `plan` says of a program, with keys of `[path]` and `[program]`.
fn planned(keys: &str, program: &str, more: &[&str]) -> std::process::Output {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let config = MACHINE.replace("[path]", keys).replace("720.0", "400.0");
    let (config, program) = (file("m.toml", &config), file("p.mpf", program));
    let args = ["plan", &program, "--config", &config, "--json"];
    glidepath(&[&args, more].concat())
}

const SIEMENS: &str = "[program]\ndialect = \"siemens\"\n";

#[test]
fn the_pole_is_passed_without_a_stop_where_the_tolerance_allows() {
    for effort in ["optimal", "fast"] {
        let report = |deg: f64| -> Value {
            let keys = format!("{SIEMENS}[path]\ndirection_tolerance = {deg}");
            let output = planned(&keys, &passage(), &["--effort", effort]);
            assert!(output.status.success(), "{output:?}");
            object(&output)
        };
        let of = |report: &Value, name: &str| report[name].as_f64().unwrap();
        // A twentieth of 0.3 degrees is more than what the program passes by; of 0.001 it is less.
        let [wide, narrow] = [0.3, 0.001].map(report);
        let [with, without] = [&wide, &narrow].map(|report| of(report, "cycle_time_s"));
        eprintln!(
            "{effort}: {with} s, to the letter {without} s; off {} and {}",
            wide["max_direction_deg"], narrow["max_direction_deg"]
        );
        // Half a round of C takes a second and a half.
        assert!(with + 1.0 < without, "{with} {without}");
        assert!(of(&wide, "max_direction_deg") <= 0.3);
        assert!(of(&narrow, "max_direction_deg") <= 0.001 * 1.001);
        assert_eq!(
            of(&narrow, "direction_tolerance_deg").to_bits(),
            0.001_f64.to_bits()
        );
    }
}

#[test]
fn c_that_has_wound_up_is_refused_before_anything_moves() {
    let mut text = String::from("TRAORI\nG0 X0 Y0 Z20 A45 C0 F600\n");
    for k in 1..=9 {
        let (sin, cos) = (45.0 * f64::from(k)).to_radians().sin_cos();
        let code = if k == 9 { "G0" } else { "G1" };
        writeln!(text, "{code} X{k} A3={sin:.9} B3={cos:.9} C3=1").unwrap();
    }
    let output = planned(&format!("{SIEMENS}[path]"), &text, &[]);
    assert!(!output.status.success(), "{output:?}");
    let told =
        String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
    for part in ["C would go to", "unwind = ", "\"line\": 11,"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let unwinding = format!("{SIEMENS}unwind = \"rapids\"\n[path]");
    let output = planned(&unwinding, &text, &[]);
    assert!(output.status.success(), "{output:?}");
    // From C 360 the direction of A 45 and C 45 is nearer with the other sign of A: by 135° of C, not by 315°.
    let end = &object(&output)["final_position"];
    let [a, c] = ["A", "C"].map(|axis| end[axis].as_f64().unwrap());
    assert!(
        (a + 45.0).abs() < 1e-6 && (c - 225.0).abs() < 1e-6,
        "{a} {c}"
    );
}

#[test]
fn a_machine_that_turns_nothing_has_no_such_tolerance() {
    let folder = tempfile::tempdir().unwrap();
    let config = folder.path().join("m.toml");
    let axis = "[axis.X]\nmin_position = 0\nmax_position = 100\nmax_velocity = 100\n\
                max_acceleration = 1000\nmax_jerk = 10000\n";
    let text = format!("{axis}[path]\ndirection_tolerance = 0.1\n");
    std::fs::write(&config, text).unwrap();
    let output = glidepath(&["config", "--check", config.to_str().unwrap()]);
    let told =
        String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success());
    assert!(
        told.contains("path.direction_tolerance on a machine without a rotary axis"),
        "{told}"
    );
}

#[test]
fn a_machine_without_five_axes_has_no_c_to_turn_back() {
    let folder = tempfile::tempdir().unwrap();
    let config = folder.path().join("m.toml");
    let axis = "[axis.X]\nmin_position = 0\nmax_position = 100\nmax_velocity = 100\n\
                max_acceleration = 1000\nmax_jerk = 10000\n";
    for (word, is_taken) in [("never", true), ("rapids", false)] {
        let text = format!("{axis}[program]\nunwind = \"{word}\"\n");
        std::fs::write(&config, text).unwrap();
        let output = glidepath(&["config", "--check", config.to_str().unwrap()]);
        let told =
            String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.success(), is_taken, "{told}");
        let words = "program.unwind = \"rapids\" on a machine without five axes";
        assert_eq!(told.contains(words), !is_taken, "{told}");
    }
}
