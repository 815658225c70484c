//! Tests of which joint binds: motions of one weak joint, whose times follow from its limits in closed form.

#![allow(clippy::unwrap_used, reason = "a test that fails may panic")]

use serde_json::Value;
use std::fmt::Write as _;
use std::process::{Command, Output};

/// Velocity, acceleration and jerk of the joint that is meant.
const WEAK: [f64; 3] = [50.0, 2000.0, 50_000.0];

fn plan(program: &str, config: &str, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let output = Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .arg("plan")
        .arg(file("p.ngc", program))
        .arg("--config")
        .arg(file("m.toml", config))
        .args(more)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    output
}

/// The shares of time by what binds, and the names of what binds where most time is lost.
fn bound_by(program: &str, config: &str, effort: &str) -> (Value, Vec<String>) {
    let output = plan(program, config, &["--json", "--effort", effort]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let slowest = report["slowest"].as_array().unwrap().iter();
    let limits = slowest.map(|place| place["limit"].as_str().unwrap().to_owned());
    (report["binding"].clone(), limits.collect())
}

/// Joints of which all but one are strong.
fn joints(count: usize, weak: usize) -> String {
    let mut text = String::new();
    for joint in 0..count {
        let [v, a, j] = if joint == weak {
            WEAK
        } else {
            [2000.0, 80_000.0, 2_000_000.0]
        };
        write!(
            text,
            "[joint.J{joint}]\nmax_velocity = {v:.1}\nmax_acceleration = {a:.1}\nmax_jerk = {j:.1}\n"
        )
        .unwrap();
    }
    text
}

fn axes(ends: &[(&str, f64, f64)]) -> String {
    let axis = |(name, low, high): &(&str, f64, f64)| {
        format!("[axis.{name}]\nmin_position = {low:.1}\nmax_position = {high:.1}\n")
    };
    ends.iter().map(axis).collect()
}

fn delta(weak: usize) -> String {
    format!(
        "[machine]\nkinematics = \"linear-delta\"\n[machine.linear-delta]\nrod = 269.0\nradius = 130.25\n{}{}",
        axes(&[("X", -50.0, 50.0), ("Y", -50.0, 50.0), ("Z", 0.0, 150.0)]),
        joints(3, weak)
    )
}

fn scara(weak: usize) -> String {
    format!(
        "[machine]\nkinematics = \"scara\"\n[machine.scara]\nupper_arm = 340.0\nforearm = 250.0\n{}{}",
        axes(&[
            ("X", 200.0, 420.0),
            ("Y", -320.0, 320.0),
            ("Z", -150.0, 0.0),
            ("C", -180.0, 180.0)
        ]),
        joints(4, weak)
    )
}

/// The share of the time for which the weak joint runs at its velocity on a way from rest to rest: an S-curve.
fn cruise_share(way: f64) -> f64 {
    let [v, a, j] = WEAK;
    let ramp_t = v / a + a / j;
    (way / v - ramp_t) / (way / v + ramp_t)
}

fn share(bound: &Value, limit: &str) -> f64 {
    bound[limit].as_f64().unwrap_or(0.0)
}

/// Straight up all carriages do what the tool does.
#[test]
fn the_weak_carriage_of_a_delta_binds() {
    let up = "G21 G90 G64\nG1 Z120 F60000\nM2\n";
    for weak in 0..3 {
        for effort in ["optimal", "fast"] {
            let (bound, slowest) = bound_by(up, &delta(weak), effort);
            let found = share(&bound, &format!("velocity J{weak}"));
            let wanted = cruise_share(120.0);
            // It counts as used fully a little before it is.
            assert!(
                (wanted - 0.01..wanted + 0.03).contains(&found),
                "{effort} J{weak}: {bound}"
            );
            let by_another = bound
                .as_object()
                .unwrap()
                .keys()
                .find(|limit| limit.contains('J') && !limit.ends_with(&format!("J{weak}")));
            assert_eq!(by_another, None, "{bound}");
            assert_eq!(slowest.first().unwrap(), &format!("velocity J{weak}"));
        }
    }
    // So short that only jerk counts: a way of 32 d = j t³.
    let (bound, _) = bound_by("G21 G90 G64\nG1 Z2 F60000\nM2\n", &delta(1), "optimal");
    assert!(share(&bound, "jerk J1") > 0.6, "{bound}");
    assert!(share(&bound, "velocity J1") < 0.01, "{bound}");
}

/// On a circle about the shoulder the elbow stands, and shoulder and wrist turn; a turn of C alone is the wrist's, and
/// a way down the lift's.
#[test]
fn the_weak_joint_of_a_scara_binds() {
    let (x, y) = (
        300.0 * 40.0_f64.to_radians().cos(),
        300.0 * 40.0_f64.to_radians().sin(),
    );
    let about = format!(
        "G21 G90 G64\nG0 X{x:.6} Y{:.6}\nG4 P0.1\nG3 X{x:.6} Y{y:.6} R300 F600000\nM2\n",
        -y
    );
    let output = plan(&about, &scara(0), &["--json", "--effort", "fast"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let bound = &report["binding"];
    let found_t = share(bound, "velocity J0") * report["cycle_time_s"].as_f64().unwrap();
    // The way to the start of the circle, and 80° on it: with the elbow bent by e, the shoulder is behind the
    // direction of the tool by what the forearm adds.
    let behind = |reach: f64| {
        let (a, b) = (340.0_f64, 250.0);
        let cos = (reach * reach - a * a - b * b) / (2.0 * a * b);
        let sin = (1.0 - cos * cos).sqrt();
        (b * sin).atan2(a + b * cos).to_degrees()
    };
    let way = (-40.0 - behind(300.0)) - (0.0 - behind(200.0));
    let [v, a, j] = WEAK;
    let wanted_t = (way.abs() + 80.0) / v - 2.0 * (v / a + a / j);
    // Each of the four ramps counts a little before its end.
    assert!(
        (wanted_t - 0.01..wanted_t + 0.06).contains(&found_t),
        "{found_t} {wanted_t} {bound}"
    );
    assert!(share(bound, "velocity J1") <= 0.0, "{bound}");
    for (weak, word, way) in [(3, "C90", 90.0), (2, "Z-120", 120.0)] {
        let text = format!("G21 G90 G64\nG1 {word} F60000\nM2\n");
        let (bound, slowest) = bound_by(&text, &scara(weak), "optimal");
        let found = share(&bound, &format!("velocity J{weak}"));
        let wanted = cruise_share(way);
        assert!(
            (wanted - 0.01..wanted + 0.03).contains(&found),
            "J{weak}: {bound}"
        );
        assert_eq!(slowest.first().unwrap(), &format!("velocity J{weak}"));
    }
}

/// Joints are told in words, and where axes are joints nothing is.
#[test]
fn the_report_names_joints_where_they_are_no_axes() {
    let up = "G21 G90 G64\nG1 Z120 F60000\nM2\n";
    let output = plan(up, &delta(2), &[]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("bound by      velocity J2"), "{text}");
    assert!(text.contains("bound by velocity J2\n"), "{text}");
    let mill = include_str!(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../config/mill.toml"
    ));
    let output = plan("G21 G90 G64\nG1 X20 F600\nM2\n", mill, &["--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let names = report["binding"].as_object().unwrap().keys();
    assert!(
        names.into_iter().all(|name| !name.contains('J')),
        "{}",
        report["binding"]
    );
}
