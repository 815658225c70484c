//! Tests of machines whose joints are not their axes: configuration, columns, and what is refused.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::float_cmp,
    reason = "a test that fails may panic"
)]

use glidepath::config;
use glidepath::config::keys::{self, Takes};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const HEXAPOD: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/hexapod.toml"
));
const PROGRAM: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/hexapod.ngc"));

fn file(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path
}

/// Runs a command on a program and a configuration.
fn glidepath(command: &str, program: &str, config: &str, more: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let program = file(folder.path(), "p.ngc", program);
    let config = file(folder.path(), "m.toml", config);
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .arg(command)
        .arg(program)
        .arg("--config")
        .arg(config)
        .args(more)
        .output()
        .unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Strut lengths of the shipped hexapod, from the text-book formula.
fn struts(axes: &[f64; 6]) -> [f64; 6] {
    let [x, y, z] = [axes[0], axes[1], axes[2]];
    let rotation = nalgebra::Rotation3::from_euler_angles(
        axes[3].to_radians(),
        axes[4].to_radians(),
        axes[5].to_radians(),
    );
    let on = |radius: f64, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        nalgebra::Vector3::new(radius * cos, radius * sin, 0.0)
    };
    let base = [-15.0, 15.0, 105.0, 135.0, 225.0, 255.0];
    let platform = [315.0, 45.0, 75.0, 165.0, 195.0, 285.0];
    core::array::from_fn(|i| {
        let tip = nalgebra::Vector3::new(x, y, z);
        (tip + rotation * on(150.0, platform[i]) - on(400.0, base[i])).norm()
    })
}

#[test]
fn setpoints_have_a_column_for_every_joint() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("out.csv");
    let more = ["--json", "--setpoints", csv.to_str().unwrap()];
    let output = glidepath("plan", PROGRAM, HEXAPOD, &more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(report["max_deviation_mm"].as_f64().unwrap() <= 0.02);
    let text = std::fs::read_to_string(csv).unwrap();
    let mut lines = text.lines();
    let header = lines.next().unwrap();
    assert!(
        header.ends_with(",acc_C,joint_0,joint_1,joint_2,joint_3,joint_4,joint_5"),
        "{header}"
    );
    let mut moved = 0.0_f64;
    for line in lines {
        let numbers: Vec<f64> = line
            .split(',')
            .map(|n| n.parse().unwrap_or(f64::NAN))
            .collect();
        let axes: [f64; 6] = core::array::from_fn(|i| numbers[6 + 3 * i]);
        for (got, want) in numbers[24..].iter().zip(struts(&axes)) {
            assert!((got - want).abs() < 1e-9, "{got} {want}");
            moved = moved.max((got - 505.0).abs());
        }
    }
    assert!(moved > 50.0, "{moved}");
}

#[test]
fn what_joints_cannot_do_is_refused_with_line_and_reason() {
    // Inside the travel of every axis, beyond that of a strut.
    let far = "G21 G90\nG0 Z500\nG1 X115 Y115 Z575 F600\nM2\n";
    for command in ["check", "plan", "run"] {
        let output = glidepath(command, far, HEXAPOD, &[]);
        assert_eq!(
            output.status.code(),
            Some(1),
            "{command}: {}",
            stderr(&output)
        );
        let said = stderr(&output);
        assert!(said.contains("p.ngc:3:1"), "{said}");
        assert!(
            said.contains("joint J")
                && said.contains("highest position")
                && said.contains(", at X"),
            "{said}"
        );
    }
    // A singular place: the platform turned until the struts hold it no more.
    let wide = HEXAPOD
        .replace(
            "min_position = -30.0\nmax_position = 30.0",
            "min_position = -100.0\nmax_position = 100.0",
        )
        .replace("min_position = 430.0", "min_position = 1.0")
        .replace("max_base_angle = 50.0", "max_base_angle = 90.0")
        .replace("max_platform_angle = 60.0", "max_platform_angle = 90.0")
        .replace("min_strut_distance = 60.0", "min_strut_distance = 0.001");
    let turned = "G21 G90\nG0 Z500\nG1 C89.8 F300\nM2\n";
    let output = glidepath("check", turned, &wide, &[]);
    assert!(
        stderr(&output).contains("near a singularity") && stderr(&output).contains("Z500.000"),
        "{}",
        stderr(&output)
    );
    assert_eq!(output.status.code(), Some(1));
}

/// The platform of the shipped machine hangs below its base: struts are as long as from there, in every setpoint.
#[test]
fn the_shipped_translational_hexapod_hangs() {
    let path = "/../../config/translational-hexapod.toml";
    let text = std::fs::read_to_string(format!("{}{path}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("out.csv");
    let program = "G21 G90 G64\nG0 X-80 Y-80 Z110\nG1 X80 F9000\nY80 Z0\nG3 X0 Y0 I0 J-80\nG1 X-80 Y80\nG0 X0 Y0\nM2\n";
    let more = ["--effort", "fast", "--setpoints", csv.to_str().unwrap()];
    let output = glidepath("plan", program, &text, &more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let mut ends = [f64::INFINITY, 0.0];
    let rows = std::fs::read_to_string(&csv).unwrap();
    for line in rows.lines().skip(1) {
        let numbers: Vec<f64> = line
            .split(',')
            .map(|n| n.parse().unwrap_or(f64::NAN))
            .collect();
        let [x, y, z] = [6, 9, 12].map(|column| numbers[column]);
        for (k, joint) in numbers[15..].iter().enumerate() {
            let (sin, cos) = (60.0 * f64::from(u8::try_from(k).unwrap()))
                .to_radians()
                .sin_cos();
            let length = (x - 250.0 * cos).hypot(y - 250.0 * sin).hypot(560.0 - z);
            assert!((joint - length).abs() < 1e-9, "J{k}: {joint} {length}");
            ends = [ends[0].min(length), ends[1].max(length)];
        }
        assert_eq!(numbers.len(), 21);
    }
    // The corners of the travel are in the range of the struts.
    assert!(ends[0] < 473.0 && ends[1] > 665.0, "{ends:?}");
    let [fast, hard, jerky] = fastest(&csv, 15);
    assert!(
        fast <= 200.0 * 1.000_001 && hard <= 2000.0 * 1.000_001 && jerky <= 50_000.0 * 1.000_001
    );
}

/// Largest first, second and third difference of the joints in a file of setpoints, per s, s², s³, behind so many
/// columns.
fn fastest(csv: &Path, before: usize) -> [f64; 3] {
    let text = std::fs::read_to_string(csv).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .skip(1)
        .map(|line| {
            line.split(',')
                .skip(before)
                .map(|n| n.parse().unwrap())
                .collect()
        })
        .collect();
    let mut most = [0.0_f64; 3];
    for rows in rows.windows(4) {
        let joints = rows[3].iter().zip(&rows[2]).zip(&rows[1]).zip(&rows[0]);
        for (((a, b), c), d) in joints {
            let differences = [a - b, a - 2.0 * b + c, a - 3.0 * b + 3.0 * c - d];
            for (k, (most, difference)) in (1..).zip(most.iter_mut().zip(differences)) {
                *most = most.max(difference.abs() / 0.004_f64.powi(k));
            }
        }
    }
    most
}

#[test]
fn motion_is_as_slow_as_its_joints() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("out.csv");
    let more = ["--json", "--setpoints", csv.to_str().unwrap()];
    let across = "G21 G90\nG0 Z500\nG1 X80 F3000\nG1 Y40\nM2\n";
    let plan = |config: &str| {
        let output = glidepath("plan", across, config, &more);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        (
            report["cycle_time_s"].as_f64().unwrap(),
            fastest(&csv, 24),
            stderr(&output),
        )
    };
    let (quick_t, quick, _) = plan(HEXAPOD);
    assert!(quick[0] > 20.0, "{quick:?}");

    // One strut of six is slow.
    let slow = HEXAPOD.replacen("max_velocity = 120.0", "max_velocity = 5.0", 1);
    let (slow_t, _, _) = plan(&slow);
    assert!(slow_t > 2.0 * quick_t, "{slow_t} {quick_t}");
    let slow = HEXAPOD.replace("max_velocity = 120.0", "max_velocity = 5.0");
    let (_, most, _) = plan(&slow);
    assert!(most[0] <= 5.0 && most[0] > 4.5, "{most:?}");

    // All are weak.
    let weak = HEXAPOD
        .replace("max_acceleration = 1500.0", "max_acceleration = 400.0")
        .replace("max_jerk = 40000.0", "max_jerk = 6000.0");
    let (_, most, said) = plan(&weak);
    assert!(most[1] <= 400.0 && most[2] <= 6000.0, "{most:?}");
    assert!(
        said.contains("% of the axes' acceleration: joint J"),
        "{said}"
    );
}

#[test]
fn axes_need_no_limits_where_joints_have_theirs() {
    // The shipped machine without what its axes can do.
    let (mut table, mut bare) = ("", String::new());
    for line in HEXAPOD.lines() {
        if line.starts_with('[') {
            table = line;
        }
        let is_limit = line.starts_with("max_") && !line.contains("_position");
        if !(table.starts_with("[axis.") && is_limit) {
            bare.push_str(line);
            bare.push('\n');
        }
    }
    assert!(bare.len() + 200 < HEXAPOD.len());
    let config = config::parse("hexapod.toml", &bare).unwrap();
    // By hand an axis does what joints let it do alone: along Z a strut moves by less than that does.
    let (alone, joint) = (
        config.limits().velocity[2],
        config.joint_limits.0[0].velocity,
    );
    assert!(alone > joint && alone < 2.0 * joint, "{alone}");

    let across = "G21 G90\nG0 Z500\nG1 X80 F60000\nG1 Y40\nG0 X0 Y0 Z480 A5\nM2\n";
    let [with, without] = [HEXAPOD, &bare].map(|config| {
        let output = glidepath("plan", across, config, &["--json"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let number = |key: &str| report[key].as_f64().unwrap();
        for key in ["velocity", "acceleration", "jerk"] {
            let used = number(&format!("max_joint_{key}_ratio"));
            assert!(used > 0.0 && used <= 1.0 + 1e-6, "{key}: {report}");
        }
        (number("cycle_time_s"), number("max_joint_jerk_ratio"))
    });
    assert!(without.0 < with.0, "{with:?} {without:?}");
    assert!(without.1 > 0.95, "{without:?}");
}

#[test]
fn struts_are_straight_enough_between_setpoints() {
    // 100 mm/s at the edge of the workspace, where the struts bend most.
    let fast = HEXAPOD.replace("max_velocity = 60.0", "max_velocity = 120.0");
    let across = "G21 G90\nG0 X-100 Y-60 Z430\nG1 X100 F6000\nM2\n";
    let output = glidepath("plan", across, &fast, &["--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(
        report["max_feed_ratio"].as_f64().unwrap() > 0.999,
        "{report}"
    );
    let error_mm = report["max_joint_line_error"].as_f64().unwrap();
    assert!(error_mm > 1e-6 && error_mm <= 1e-4, "{error_mm}");
}

#[test]
fn a_plot_shows_joints_beside_their_limits() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("out.svg");
    let more = ["--plot", svg.to_str().unwrap()];
    let output = glidepath("plan", PROGRAM, HEXAPOD, &more);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = std::fs::read_to_string(svg).unwrap();
    for joint in 0..6 {
        for quantity in ["velocity", "acceleration", "jerk"] {
            assert!(
                text.contains(&format!(">J{joint} {quantity}<")),
                "J{joint} {quantity}"
            );
        }
    }
}

fn findings(text: &str) -> Vec<String> {
    let error = config::parse("m.toml", text).expect_err("refused");
    error
        .diagnostics()
        .iter()
        .map(|f| f.message.clone())
        .collect()
}

#[test]
fn machines_are_described_completely_or_refused() {
    let config = config::parse("hexapod.toml", HEXAPOD).unwrap();
    assert_eq!(config.joints(), 6);
    assert_eq!(config.home()[2], 420.0);
    assert_eq!(config::load(None).unwrap().joints(), 0);

    let told = findings(&HEXAPOD.replace("[joint.J3]", "[joint.J7]"));
    assert_eq!(
        told,
        [
            "the machine has no joint J7 of its own",
            "the table [joint.J3] is missing"
        ]
    );
    let told = findings(&HEXAPOD.replace("half_angle = 15.0", "half_angle = 30.0"));
    assert_eq!(told, ["machine.hexapod.half_angle = 30 ° is out of range"]);
    let told = findings(&HEXAPOD.replace("kinematics = \"hexapod\"", "kinematics = \"corexy\""));
    assert!(
        told[0].contains("[machine.hexapod] describes another machine"),
        "{told:?}"
    );
    let start = HEXAPOD.find("[axis.C]").unwrap();
    let end = HEXAPOD.find("[path]").unwrap();
    let told = findings(&format!("{}{}", &HEXAPOD[..start], &HEXAPOD[end..]));
    assert_eq!(told, ["the axis C of this mechanism is missing"]);
}

#[test]
fn every_mechanism_can_be_configured() {
    let axis = |name: &str| {
        format!(
            "[axis.{name}]\nmin_position = -100\nmax_position = 100\nmax_velocity = 50\n\
             max_acceleration = 500\nmax_jerk = 5000\n"
        )
    };
    let joints = |count: usize| -> String {
        (0..count)
            .map(|j| {
                format!(
                    "[joint.J{j}]\nmax_velocity = 500\nmax_acceleration = 5000\nmax_jerk = 500000\n"
                )
            })
            .collect()
    };
    let machines = [
        ("corexy", "", "XYZ", 3),
        (
            "linear-delta",
            "[machine.linear-delta]\nrod = 269\nradius = 130.25\n",
            "XYZ",
            3,
        ),
        (
            "five-axis",
            "[machine.five-axis]\nlayout = \"table-table\"\ntilt = \"A\"\ntool = 80\n\
             tilt_point = [0, 0, -50]\nrotary_point = [0, 20, 0]\n",
            "XYZAC",
            5,
        ),
    ];
    let texts = machines.map(|(kind, table, axes, count)| {
        let axes: String = axes.chars().map(|c| axis(&c.to_string())).collect();
        let joints = joints(count);
        let text = format!("[machine]\nkinematics = \"{kind}\"\n{table}{axes}{joints}");
        (kind, text, count)
    });
    // Machines that are shipped.
    let shipped = [
        ("hexapod", 6),
        ("translational-hexapod", 6),
        ("scara", 4),
        ("five-bar", 3),
        ("rotary-delta", 3),
    ];
    let shipped = shipped.map(|(kind, count)| {
        let path = format!("{}/../../config/{kind}.toml", env!("CARGO_MANIFEST_DIR"));
        (kind, std::fs::read_to_string(path).unwrap(), count)
    });
    let mut seen = vec!["trivial"];
    for (kind, text, count) in texts.into_iter().chain(shipped) {
        let config = config::parse("m.toml", &text).expect(kind);
        assert_eq!((config.kinematics(), config.joints()), (kind, count));
        let output = glidepath(
            "plan",
            "G21 G91\nG1 X20 Y10 F600\nG0 X-20 Y-10\nM2\n",
            &text,
            &["--json"],
        );
        assert_eq!(output.status.code(), Some(0), "{kind}: {}", stderr(&output));
        seen.push(kind);
    }
    let key = keys::all().find(|key| key.name == "machine.kinematics");
    let Some(Takes::Choice { of }) = key.map(|key| &key.takes) else {
        panic!("a choice")
    };
    let (mut seen, mut all) = (seen, of.to_vec());
    seen.sort_unstable();
    all.sort_unstable();
    assert_eq!(seen, all, "a mechanism is missing here");
}
