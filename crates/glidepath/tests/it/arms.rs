//! Tests of machines whose joints turn in place of their axes, SCARA arms, five-bar linkages and rotary deltas:
//! configuration, plans inside the limits of the joints, and what is refused.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::float_cmp,
    reason = "a test that fails may panic"
)]

use glidepath::config;
use std::path::Path;
use std::process::{Command, Output};

const SCARA: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/scara.toml"
));
const ROTARY_DELTA: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/rotary-delta.toml"
));
const FIVE_BAR: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/five-bar.toml"
));
const PERIOD_T: f64 = 0.004;

/// A program with corners, an arc and rapids that a SCARA of the shipped size can run.
const BESIDE_THE_SHOULDER: &str = "G21 G90 G64\nG0 X300 Y-100 Z50\nG1 X400 F9000\nY100 C90\n\
                                   G3 X300 Y200 I-100\nG1 X250 Y0 Z20\nG0 Z100\nM2\n";
/// The same of a rotary delta.
const BELOW_THE_BASE: &str = "G21 G90 G64\nG0 X-60 Y-40 Z-240\nG1 X60 F9000\nY20\n\
                              G3 X20 Y60 I-40\nG1 X-50 Y0 Z-210\nG0 X0 Y0\nM2\n";

/// The same of a five-bar linkage.
const BEYOND_THE_KNEES: &str = "G21 G90 G64\nG0 X-80 Y300\nG1 X80 F9000\nY420 Z10\n\
                                G3 X20 Y480 I-60\nG1 X-100 Y350 Z-20\nG0 X0 Y300\nM2\n";

/// Runs a command on a program and a configuration.
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

/// Positions of some axes and of the joints at every setpoint of a plan.
fn planned(program: &str, config: &str, axes: &[&str]) -> Vec<(Vec<f64>, Vec<f64>)> {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("out.csv");
    let more = ["--setpoints", csv.to_str().unwrap()];
    let output = glidepath("plan", program, config, &more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    read(&csv, axes)
}

fn read(csv: &Path, axes: &[&str]) -> Vec<(Vec<f64>, Vec<f64>)> {
    let text = std::fs::read_to_string(csv).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let of_axes: Vec<usize> = axes
        .iter()
        .map(|axis| {
            let name = format!("pos_{axis}");
            names.iter().position(|known| **known == name).unwrap()
        })
        .collect();
    let of_joints: Vec<usize> = (0..names.len())
        .filter(|column| names[*column].starts_with("joint_"))
        .collect();
    lines
        .map(|line| {
            let words: Vec<&str> = line.split(',').collect();
            let number = |column: &usize| words[*column].parse().unwrap();
            (
                of_axes.iter().map(number).collect(),
                of_joints.iter().map(number).collect(),
            )
        })
        .collect()
}

/// Largest velocity, acceleration and jerk of a joint, by differences of its positions.
fn fastest(rows: &[(Vec<f64>, Vec<f64>)], joint: usize) -> [f64; 3] {
    let mut most = [0.0_f64; 3];
    for four in rows.windows(4) {
        let [d, c, b, a] = [0, 1, 2, 3].map(|i| four[i].1[joint]);
        let differences = [a - b, a - 2.0 * b + c, a - 3.0 * b + 3.0 * c - d];
        for (k, (most, difference)) in (1..).zip(most.iter_mut().zip(differences)) {
            *most = most.max(difference.abs() / PERIOD_T.powi(k));
        }
    }
    most
}

/// Every joint of a plan is inside its range and its limits.
fn assert_inside_limits(rows: &[(Vec<f64>, Vec<f64>)], config: &str) {
    let config = config::parse("m.toml", config).unwrap();
    for joint in 0..config.joints() {
        let limit = &config.joint_limits.0[joint];
        for (_, joints) in rows {
            let range = limit.min_position..=limit.max_position;
            assert!(range.contains(&joints[joint]), "J{joint} {joints:?}");
        }
        let most = fastest(rows, joint);
        let limits = [limit.velocity, limit.acceleration, limit.jerk];
        for (most, limit) in most.into_iter().zip(limits) {
            // Rounding of the text, by the third power of the period.
            assert!(most <= limit * (1.0 + 1e-4), "J{joint} {most} {limit}");
        }
    }
}

#[test]
fn a_scara_is_where_its_arms_say() {
    let rows = planned(BESIDE_THE_SHOULDER, SCARA, &["X", "Y", "Z", "C"]);
    for (axes, joints) in &rows {
        let [upper, fore] = [joints[0], joints[0] + joints[1]].map(f64::to_radians);
        let x = 340.0 * upper.cos() + 250.0 * fore.cos();
        let y = 340.0 * upper.sin() + 250.0 * fore.sin();
        let c = joints[0] + joints[1] + joints[3];
        let forward = [x, y, 200.0 - joints[2], c];
        for (got, want) in forward.iter().zip(axes) {
            assert!((got - want).abs() < 1e-9, "{got} {want}");
        }
    }
    assert_inside_limits(&rows, SCARA);
}

#[test]
fn a_rotary_delta_is_where_its_arms_say() {
    let rows = planned(BELOW_THE_BASE, ROTARY_DELTA, &["X", "Y", "Z"]);
    for (axes, joints) in &rows {
        for (joint, direction) in joints.iter().zip([90.0_f64, 210.0, 330.0]) {
            // From the knee to the platform it is one forearm.
            let (sin, cos) = direction.to_radians().sin_cos();
            let radius = 90.0 + 120.0 * joint.to_radians().cos() - 40.0;
            let knee = [
                radius * cos,
                radius * sin,
                -120.0 * joint.to_radians().sin(),
            ];
            let away: f64 = (0..3).map(|i| (axes[i] - knee[i]).powi(2)).sum();
            assert!((away.sqrt() - 260.0).abs() < 1e-9, "{away}");
        }
    }
    assert_inside_limits(&rows, ROTARY_DELTA);
}

#[test]
fn a_five_bar_is_where_its_arms_say() {
    let rows = planned(BEYOND_THE_KNEES, FIVE_BAR, &["X", "Y", "Z"]);
    for (axes, joints) in &rows {
        for (joint, shoulder) in joints.iter().zip([-100.0, 100.0]) {
            // From each knee to the tool it is one forearm.
            let (sin, cos) = joint.to_radians().sin_cos();
            let away = (axes[0] - shoulder - 250.0 * cos).hypot(axes[1] - 250.0 * sin);
            assert!((away - 350.0).abs() < 1e-9, "{away}");
        }
        assert!((axes[2] - joints[2]).abs() < 1e-12);
    }
    assert_inside_limits(&rows, FIVE_BAR);
}

#[test]
fn motion_is_as_slow_as_its_arms() {
    for (program, config, velocity, acceleration, jerk) in [
        (BEYOND_THE_KNEES, FIVE_BAR, "300.0", "3000.0", "60000.0"),
        (BESIDE_THE_SHOULDER, SCARA, "300.0", "3000.0", "60000.0"),
        (BELOW_THE_BASE, ROTARY_DELTA, "400.0", "4000.0", "80000.0"),
    ] {
        let usual = planned(program, config, &["X"]);
        // The first joint is slow, as it is first in the file.
        let from = config.find("[joint.J0]").unwrap();
        let weak = config[from..]
            .replacen(velocity, "10.0", 1)
            .replacen(acceleration, "1500.0", 1)
            .replacen(jerk, "30000.0", 1);
        let weak = format!("{}{weak}", &config[..from]);
        let slow = planned(program, &weak, &["X"]);
        assert_inside_limits(&slow, &weak);
        // Only where the joint has to move much.
        assert!(
            2 * slow.len() > 3 * usual.len(),
            "{} {}",
            slow.len(),
            usual.len()
        );
    }
}

/// What is said about a program that is refused, by every command that could run it.
fn refused(program: &str, config: &str) -> String {
    let mut said = String::new();
    for command in ["check", "plan", "run"] {
        let output = glidepath(command, program, config, &[]);
        said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{command}: {said}");
    }
    said
}

#[test]
fn places_out_of_reach_are_refused_with_line_and_reason() {
    // The travel reaches further than the arm.
    let far = SCARA.replace("max_position = 450.0", "max_position = 700.0");
    let free = far.replace("min_position = 5.0", "min_position = -180.0");
    let said = refused("G21 G90\nG0 X300\nG1 X650 F6000\nM2\n", &free);
    assert!(said.contains("p.ngc:3:1"), "{said}");
    assert!(
        said.contains("joint J1 cannot reach the position, at X590.000"),
        "{said}"
    );
    // An elbow that may not be stretched ends the motion before.
    let said = refused("G21 G90\nG0 X300\nG1 X650 F6000\nM2\n", &far);
    assert!(
        said.contains("joint J1: lowest position 5.000 is exceeded"),
        "{said}"
    );
    // Where the machine stands at first.
    let away = far.replace("min_position = 200.0", "min_position = 600.0");
    let said = refused("G21 G90\nG1 X650 F6000\nM2\n", &away);
    assert!(
        said.contains("p.ngc:1:1") && said.contains("joint J1 cannot reach the position"),
        "{said}"
    );

    // Both arms are stretched at a reach of 600 mm, Y = 591.6.
    let far = FIVE_BAR.replace("max_position = 500.0", "max_position = 600.0");
    let said = refused("G21 G90\nG0 Y300\nG1 Y591.6 F6000\nM2\n", &far);
    assert!(
        said.contains("p.ngc:3:1") && said.contains("near a singularity"),
        "{said}"
    );
    let said = refused("G21 G90\nG0 Y300\nG0 Y595\nM2\n", &far);
    assert!(said.contains("p.ngc:3:1"), "{said}");

    let deep = ROTARY_DELTA.replace("min_position = -280.0", "min_position = -500.0");
    let said = refused("G21 G90\nG1 Z-240 F6000\nZ-450\nM2\n", &deep);
    assert!(said.contains("p.ngc:3:1"), "{said}");
    assert!(
        said.contains("joint J0: highest position 85.000 is exceeded"),
        "{said}"
    );
    let away = deep.replace("max_position = -200.0", "max_position = -450.0");
    let said = refused("G21 G90\nG1 Z-460 F6000\nM2\n", &away);
    assert!(
        said.contains("p.ngc:1:1") && said.contains("joint J0 cannot reach the position"),
        "{said}"
    );
}

/// What is said about a configuration that is refused.
fn told(text: &str) -> Vec<String> {
    let error = config::parse("m.toml", text).expect_err("refused");
    let diagnostics = error.diagnostics().iter();
    diagnostics.map(|found| found.message.clone()).collect()
}

fn without(text: &str, from: &str, to: &str) -> String {
    let (start, end) = (text.find(from).unwrap(), text.find(to).unwrap());
    format!("{}{}", &text[..start], &text[end..])
}

#[test]
fn a_scara_is_described_completely_or_refused() {
    let config = config::parse("scara.toml", SCARA).unwrap();
    assert_eq!(config.joints(), 4);
    assert_eq!(config.home()[0], 200.0);

    let short = SCARA.replace("forearm = 250.0", "forearm = 0.0");
    assert_eq!(
        told(&short),
        ["machine.scara.forearm = 0 mm is out of range"]
    );
    let elbow = SCARA.replace("\"positive\"           #", "\"left\" #");
    assert_eq!(
        told(&elbow),
        ["machine.scara.elbow = \"left\" is not known"]
    );
    let tool = SCARA.replace("tool = 0.0", "tool = nan");
    assert_eq!(told(&tool), ["machine.scara.tool = NaN mm is out of range"]);
    assert_eq!(
        told(&without(SCARA, "[axis.C]", "[path]")),
        ["the axis C of this mechanism is missing"]
    );
    assert_eq!(
        told(&SCARA.replace("[axis.C]", "[axis.A]")),
        ["the axis C of this mechanism is missing"]
    );
    assert_eq!(
        told(&without(SCARA, "[machine.scara]", "# The arm reaches")),
        [
            "the table [machine.scara] is missing",
            "the machine has no joint J0 of its own",
            "the machine has no joint J1 of its own",
            "the machine has no joint J2 of its own",
            "the machine has no joint J3 of its own"
        ]
    );
    assert_eq!(
        told(&SCARA.replace("[joint.J3]", "[joint.J4]")),
        [
            "the machine has no joint J4 of its own",
            "the table [joint.J3] is missing"
        ]
    );
}

#[test]
fn a_five_bar_is_described_completely_or_refused() {
    let config = config::parse("five-bar.toml", FIVE_BAR).unwrap();
    assert_eq!(config.joints(), 3);
    assert_eq!(config.home()[1], 280.0);
    assert_eq!(
        told(&FIVE_BAR.replace("shoulder_distance = 200.0", "shoulder_distance = 1200.0")),
        ["arms of 600 mm do not meet, with shoulders 1200 mm apart"]
    );
    let bare = without(FIVE_BAR, "[machine.five-bar]", "# The knees are outside");
    assert_eq!(told(&bare)[0], "the table [machine.five-bar] is missing");
    let other = FIVE_BAR.replace("= \"five-bar\"", "= \"corexy\"");
    assert_eq!(
        told(&other),
        ["[machine.five-bar] describes another machine"]
    );
    assert_eq!(
        told(&FIVE_BAR.replace("forearm = 350.0", "forearm = 0.0")),
        ["machine.five-bar.forearm = 0 mm is out of range"]
    );
    assert_eq!(
        told(&FIVE_BAR.replace("[axis.X]", "[axis.U]")),
        [
            "the axis X of this mechanism is missing",
            "the table [joint.J3] is missing"
        ]
    );
}

#[test]
fn a_rotary_delta_is_described_completely_or_refused() {
    let config = config::parse("rotary-delta.toml", ROTARY_DELTA).unwrap();
    assert_eq!(config.joints(), 3);
    assert_eq!(config.home()[2], -200.0);
    let usual = ROTARY_DELTA.replace("arm_angles = [90.0, 210.0, 330.0]", "");
    assert_eq!(config::parse("m.toml", &usual).unwrap(), config);

    let short = ROTARY_DELTA
        .replace("upper_arm = 120.0", "upper_arm = 20.0")
        .replace("forearm = 260.0", "forearm = 30.0");
    assert_eq!(
        told(&short),
        [
            "upper_arm = 20 mm and forearm = 30 mm together are too short for platform and base, whose \
          radii differ by 50 mm"
        ]
    );
    for angles in ["[90.0, 90.0, 330.0]", "[5.0, 356.0, 120.0]"] {
        let told = told(&ROTARY_DELTA.replace("[90.0, 210.0, 330.0]", angles));
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].ends_with("are not three directions"), "{told:?}");
    }
    assert_eq!(
        told(&ROTARY_DELTA.replace("[90.0, 210.0, 330.0]", "[nan, 1.0, 99.0]")),
        ["machine.rotary-delta.arm_angles = NaN ° is out of range"]
    );
    let other = ROTARY_DELTA.replace("= \"rotary-delta\"", "= \"linear-delta\"");
    assert_eq!(
        told(&other)[..2],
        [
            "the table [machine.linear-delta] is missing",
            "[machine.rotary-delta] describes another machine"
        ]
    );
    let more = ROTARY_DELTA.replace(
        "[path]",
        "[axis.C]\nmax_velocity = 90\nmax_acceleration = 900\nmax_jerk = 9000\n[path]",
    );
    assert_eq!(told(&more), ["the mechanism does not move the axis C"]);
}
