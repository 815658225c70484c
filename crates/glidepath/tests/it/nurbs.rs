//! Tests of NURBS files and splines of programs on the command line.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use serde_json::Value;
use std::process::{Command, Output};

fn glidepath(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .args(arguments)
        .output()
        .expect("the binary runs")
}

fn object(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
        panic!("{error}: {}", String::from_utf8_lossy(&output.stderr));
    })
}

fn data(name: &str) -> String {
    format!(
        "{}/../../tests/data/method/{name}",
        env!("CARGO_MANIFEST_DIR")
    )
}

const BOUNDED: &str = "\
[axis.X]
max_velocity = 1000.0
max_acceleration = 20000.0
max_jerk = 1e7
min_position = -500.0
max_position = 500.0
[axis.Y]
max_velocity = 1000.0
max_acceleration = 20000.0
max_jerk = 1e7
min_position = -500.0
max_position = 500.0
[axis.Z]
max_velocity = 1000.0
max_acceleration = 20000.0
max_jerk = 1e7
min_position = -500.0
max_position = 500.0
[path]
tolerance = 0.001
max_tangential_acceleration = 1000.0
max_normal_acceleration = 1000.0
max_jerk = 20000.0
default_feed = 6000.0
[program]
dialect = \"linuxcnc\"
";

/// The butterfly as a program of G6.2, from its start.
fn program() -> String {
    let text = std::fs::read_to_string(data("butterfly.json")).expect("the butterfly");
    let curve: Value = serde_json::from_str(&text).expect("JSON");
    let list = |key: &str| curve[key].as_array().expect("a list").clone();
    let (points, weights, knots) = (list("control_points"), list("weights"), list("knots"));
    let mut program = format!("G0 X{} Y{}\nG4 P0.1\n", points[0][0], points[0][1]);
    for (i, knot) in knots.iter().enumerate() {
        let code = if i == 0 { "G6.2 P4 F6000 " } else { "" };
        let point = points.get(i).map_or(String::new(), |point| {
            format!(" X{} Y{} R{}", point[0], point[1], weights[i])
        });
        program += &format!("{code}K{knot}{point}\n");
    }
    program + "M2\n"
}

#[test]
fn the_butterfly_as_file_and_as_program_keeps_limits_along_the_path() {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        path.to_str().expect("UTF-8").to_owned()
    };
    let config = write("bounded.toml", BOUNDED);
    let file = data("butterfly.json");
    let by_program = write("butterfly.ngc", &program());
    let mut times = Vec::new();
    for path in [file, by_program] {
        let output = glidepath(&["plan", &path, "--config", &config, "--json"]);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let report = object(&output);
        assert!(report["max_deviation_mm"].as_f64().expect("a number") <= 0.001);
        times.push(report["cycle_time_s"].as_f64().expect("a number"));
    }
    // The program has a dwell of 0.1 s more.
    assert!((times[0] + 0.1 - times[1]).abs() < 0.02, "{times:?}");
}

#[test]
fn what_is_wrong_with_a_curve_file_has_its_place() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text, line, column, message) in [
        (
            "weights.json",
            "{\"degree\": 1,\n\"control_points\": [[0, 0], [1, 0]],\n\"weights\": [1, -2],\n\"knots\": [0, 0, 1, 1]}",
            3,
            16,
            "weight 1 is -2: weights are greater than zero",
        ),
        (
            "points.toml",
            "kind = \"nurbs\"\ndegree = 3\ncontrol_points = [[0.0, 0.0], [1.0, 0.0]]\nknots = [0.0, 1.0]\n",
            3,
            1,
            "2 control points",
        ),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("written");
        let path = path.to_str().expect("UTF-8");
        for command in ["check", "plan"] {
            let output = glidepath(&[command, path, "--json"]);
            assert_eq!(output.status.code(), Some(1), "{command} {name}");
            let report = object(&output);
            let list = match command {
                "check" => &report["programs"][0]["findings"],
                _ => &report["findings"],
            };
            let finding = &list[0];
            assert_eq!(finding["line"], line, "{report}");
            assert_eq!(finding["column"], column, "{report}");
            let said = finding["message"].as_str().expect("text");
            assert!(said.contains(message), "{said}");
        }
    }
}
