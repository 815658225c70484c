//! A spindle that is an axis: configuration, and taps from the program to the setpoints.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test that fails may panic"
)]

use glidepath::config;
use glidepath_geometry::AxisVector;
use std::path::Path;
use std::process::{Command, Output};

const MACHINE: &str = "
[axis.X]
min_position = -10.0
max_position = 300.0
max_velocity = 200.0
max_acceleration = 2000.0
max_jerk = 40000.0

[axis.Z]
min_position = -100.0
max_position = 50.0
max_velocity = 200.0
max_acceleration = 2000.0
max_jerk = 40000.0

[axis.C]
max_velocity = 18000.0
max_acceleration = 90000.0
max_jerk = 2000000.0

[spindle]
axis = \"C\"
rigid_tapping = true
";

/// Two holes by a cycle, one of them in depths by G33.1, to the left.
const HOLES: &str = "G21 G90 G17 G64 P0.05\nF1500 S1200 M3\nG0 X10 Z5\nG99 G84 Z-12 R2\nX30\nG80\n\
                     M5\nG0 X50 Z2\nG33.1 Z-10 K-0.8 Q4 R1 I1.5\nG0 Z20\nM2\n";

fn plan(program: &str, effort: &str, csv: &Path) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .arg("plan")
        .arg(file("holes.ngc", program))
        .arg("--config")
        .arg(file("machine.toml", MACHINE))
        .args(["--effort", effort, "--json", "--setpoints"])
        .arg(csv)
        .output()
        .unwrap()
}

/// X, Z and C at every setpoint.
fn positions(csv: &Path) -> Vec<[f64; 3]> {
    let text = std::fs::read_to_string(csv).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let columns = ["pos_X", "pos_Z", "pos_C"]
        .map(|wanted| names.iter().position(|name| *name == wanted).unwrap());
    lines
        .map(|line| {
            let words: Vec<&str> = line.split(',').collect();
            columns.map(|column| words[column].parse().unwrap())
        })
        .collect()
}

#[test]
fn the_pitch_is_exact_at_every_setpoint() {
    let folder = tempfile::tempdir().unwrap();
    for effort in ["optimal", "fast"] {
        let csv = folder.path().join(format!("{effort}.csv"));
        let output = plan(HOLES, effort, &csv);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{said}");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        for ratio in [
            "max_velocity_ratio",
            "max_acceleration_ratio",
            "max_jerk_ratio",
        ] {
            assert!(report[ratio].as_f64().unwrap() <= 1.0 + 1e-6, "{report:#}");
        }
        let rows = positions(&csv);
        // F over S is 1.25 mm to the right; 0.8 mm to the left is what the program says.
        for (x, pitch_mm, bottom) in [
            (10.0, 1.25, -12.0),
            (30.0, 1.25, -12.0),
            (50.0, -0.8, -10.0),
        ] {
            let hole = || rows.iter().filter(|[at, z, _]| *at == x && *z <= 2.0);
            let turning = hole().filter(|[.., c]| *c != 0.0).count();
            assert!(turning > 100, "{effort} {x}: {turning}");
            let off = |[_, z, c]: &[f64; 3]| (2.0 - z - c / 360.0 * pitch_mm).abs();
            let worst = hole().map(off).fold(0.0, f64::max);
            println!("{effort}, X{x}: {worst:.1e} mm off the pitch, {turning} setpoints");
            // Rounding: of 4000° it is 5e-13, which is 2e-15 mm of the pitch.
            assert!(worst < 2e-14, "{effort} {x}: {worst}");
            let deepest = hole().map(|row| row[1]).fold(f64::MAX, f64::min);
            assert!((deepest - bottom).abs() < 1e-9, "{effort} {x}: {deepest}");
        }
        // Nobody turns it elsewhere, and it ends where it began.
        assert!(rows.iter().all(|[_, z, c]| *z <= 2.0 || *c == 0.0));
    }
}

#[test]
fn what_the_spindle_cannot_do_is_told_with_the_speed_it_can() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("none.csv");
    let output = plan("G21 S3600 M3\nG33.1 Z-10 K1\nM2\n", "fast", &csv);
    let said = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(
        said.contains("3600 rev/min of C") && said.contains("S3000"),
        "{said}"
    );
}

#[test]
fn the_axis_of_a_spindle_is_judged() {
    let keys = |text: &str| -> Vec<String> {
        match config::parse("machine.toml", text) {
            Ok(_) => Vec::new(),
            Err(error) => error
                .diagnostics()
                .iter()
                .map(|found| found.key.clone())
                .collect(),
        }
    };
    assert_eq!(keys(MACHINE), Vec::<String>::new());
    let not_rotary = keys(&MACHINE.replace("\"C\"", "\"Z\""));
    assert_eq!(not_rotary, ["spindle.axis", "spindle.rigid_tapping"]);
    assert_eq!(keys(&MACHINE.replace("\"C\"", "\"A\"")), ["spindle.axis"]);
    // Drives take their time, so somebody has to say when the spindle stands, there and then.
    let driven = format!("{MACHINE}\n[feedback]\nsource = \"drives\"\n");
    assert_eq!(keys(&driven), ["spindle.axis"]);
    for (rule, is_enough) in [
        ("done = \"spindle-stopped\"", true),
        ("done = \"input 3 high\"", true),
        ("done = \"nothing\"", false),
        ("done = \"spindle-stopped\"\nat = \"next-feed\"", false),
    ] {
        let text = format!("{driven}\n[m_codes.M5]\n{rule}\n");
        let expected: &[&str] = if is_enough { &[] } else { &["spindle.axis"] };
        assert_eq!(keys(&text), expected, "{rule}");
    }
    // It taps rigidly without an encoder, and cuts no threads.
    let options = config::parse("machine.toml", MACHINE)
        .unwrap()
        .program_options(AxisVector::zeros());
    assert!(options.threading.is_none() && options.spindle_axis.is_some());
}
