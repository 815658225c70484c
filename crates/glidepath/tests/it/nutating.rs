//! Tests of machines with a skewed tilt axis: the shipped one from its configuration to the setpoints, and what is
//! refused.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use glidepath::config;
use nalgebra::{Matrix3, Vector3};
use std::process::{Command, Output};

const NUTATING: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/nutating-head.toml"
));

fn glidepath(command: &str, program: &str, config: &str, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .arg(command)
        .arg(file("p.ngc", program))
        .arg("--config")
        .arg(file("m.toml", config))
        .args(more)
        .output()
        .unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Right-handed about x, y or z.
fn about(axis: usize, degrees: f64) -> Matrix3<f64> {
    let (s, c) = degrees.to_radians().sin_cos();
    match axis {
        0 => Matrix3::new(1., 0., 0., 0., c, -s, 0., s, c),
        1 => Matrix3::new(c, 0., s, 0., 1., 0., -s, 0., c),
        _ => Matrix3::new(c, -s, 0., s, c, 0., 0., 0., 1.),
    }
}

/// B about (0, 1, 1): z turned down to it by −45° about x, then about itself, and back.
fn head(degrees: f64) -> Matrix3<f64> {
    about(0, -45.0) * about(2, degrees) * about(0, 45.0)
}

/// Rows of a plan: X Y Z B C, then the joints.
fn planned(program: &str) -> Vec<Vec<f64>> {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("out.csv");
    let more = ["--effort", "fast", "--setpoints", csv.to_str().unwrap()];
    let output = glidepath("plan", program, NUTATING, &more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = std::fs::read_to_string(csv).unwrap();
    let row = |line: &str| -> Vec<f64> {
        let numbers: Vec<f64> = line
            .split(',')
            .map(|n| n.parse().unwrap_or(f64::NAN))
            .collect();
        let positions = [6, 9, 12, 15, 18].map(|column| numbers[column]);
        positions
            .into_iter()
            .chain(numbers[21..].iter().copied())
            .collect()
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn joints_of_every_setpoint_are_those_of_matrices() {
    let program = "G21 G90 G64\nM428\nG0 X50 Y20 Z30\nG1 X80 B60 C40 F4000\nY-60 B120 C-100\n\
                   G1 X0 Y0 Z60 B180 C30\nB-90 C200\nG0 X50 Y20 Z100 B0 C0\nM2\n";
    let rows = planned(program);
    let mut turned = [0.0_f64; 2];
    for row in &rows {
        assert_eq!(row.len(), 10);
        let (tip, b, c) = (Vector3::new(row[0], row[1], row[2]), row[3], row[4]);
        let up = Vector3::new(0.0, 0.0, 220.0);
        let linear = about(2, c) * tip + head(b) * up - up;
        let joints = [linear.x, linear.y, linear.z, b, c];
        for (joint, (found, other)) in row[5..].iter().zip(joints).enumerate() {
            assert!((found - other).abs() < 1e-8, "J{joint}: {found} {other}");
        }
        turned = [turned[0].max(b.abs()), turned[1].max(c.abs())];
    }
    assert!(turned[0] > 179.9 && turned[1] > 199.9, "{turned:?}");
    // Limits of every joint, by differences at 4 ms.
    let limits = |joint: usize| {
        if joint < 3 {
            [500.0, 4e3, 8e4]
        } else {
            [120.0, 1e3, 2e4]
        }
    };
    for four in rows.windows(4) {
        for joint in 0..5 {
            let [d, c, b, a] = [0, 1, 2, 3].map(|k| four[k][5 + joint]);
            let differences = [a - b, a - 2.0 * b + c, a - 3.0 * b + 3.0 * c - d];
            for (order, (difference, limit)) in (1..).zip(differences.iter().zip(limits(joint))) {
                let used = difference.abs() / 0.004_f64.powi(order) / limit;
                assert!(used < 1.000_01, "J{joint}, {order}: {used}");
            }
        }
    }
}

/// A plane by SINUMERIK's TRAORI and a direction: the head and the table turn so that the tool stands along it.
#[test]
fn the_tool_stands_along_directions_that_are_in_reach() {
    for way in [[1.0, 0.0, 1.0], [-0.3, 0.8, 0.4], [0.2, -0.9, 0.01]] {
        let [x, y, z] = way;
        let program = format!("TRAORI\nG0 X0 Y0 Z50 A3={x} B3={y} C3={z}\nM2\n");
        let siemens = ["--dialect", "siemens", "--effort", "fast"];
        let folder = tempfile::tempdir().unwrap();
        let csv = folder.path().join("out.csv");
        let more = [&siemens[..], &["--setpoints", csv.to_str().unwrap()]].concat();
        let output = glidepath("plan", &program, NUTATING, &more);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let text = std::fs::read_to_string(csv).unwrap();
        let last: Vec<f64> = text
            .lines()
            .last()
            .unwrap()
            .split(',')
            .map(|n| n.parse().unwrap_or(0.0))
            .collect();
        let tool = about(2, last[18]).transpose() * head(last[15]) * Vector3::z();
        assert!(
            (tool - Vector3::from(way).normalize()).norm() < 1e-6,
            "{tool}"
        );
    }
    let below = "TRAORI\nG0 X0 Y0 Z50 A3=1 B3=0 C3=-0.01\nM2\n";
    let output = glidepath("check", below, NUTATING, &["--dialect", "siemens"]);
    assert_eq!(output.status.code(), Some(1));
    let told = stderr(&output);
    assert!(
        told.contains("a direction that the tool cannot stand along"),
        "{told}"
    );
    assert!(told.contains("does not lean the tool so far"), "{told}");
}

#[test]
fn directions_that_are_none_are_refused() {
    let with = |value: &str| NUTATING.replace("[0.0, 1.0, 1.0]", value);
    let told = |text: &str| {
        let error = config::parse("m.toml", text).expect_err("refused");
        let first = &error.diagnostics()[0];
        (first.key.clone(), first.message.clone())
    };
    const KEY: &str = "machine.five-axis.tilt_direction";
    for value in ["[0, 0, 1]", "[0, 0, 0]", "[0.01, 0, -1]"] {
        let (key, message) = told(&with(value));
        assert_eq!(key, KEY);
        assert!(message.ends_with("tilts nothing"), "{message}");
    }
    let (key, message) = told(&with("[0, nan, 1]"));
    assert!(key == KEY && message.contains("out of range"), "{message}");
    // Along its own axis it is the machine without the key.
    let plain = config::parse("m.toml", &with("[0, 7, 0]")).unwrap();
    let without = NUTATING
        .lines()
        .filter(|line| !line.starts_with("tilt_direction"));
    let without: String = without.map(|line| format!("{line}\n")).collect();
    assert_eq!(plain, config::parse("m.toml", &without).unwrap());
    assert_ne!(plain, config::parse("m.toml", NUTATING).unwrap());
}
