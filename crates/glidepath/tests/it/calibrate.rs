//! Tests of `calibrate`: points that are made by formulas of the test's own in, lines of a configuration out.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    reason = "a test that fails may panic"
)]

use glidepath::config;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

const ROTARY_DELTA: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/rotary-delta.toml"
));
const HEXAPOD: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../config/hexapod.toml"
));
/// The folder of the points that the manual has, and of what the command prints of them.
const KEPT: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/data/calibration/rotary-delta"
);

/// The text against the file of that ending, which it becomes with `GLIDEPATH_BLESS=1`.
fn is_kept(ending: &str, text: &str) {
    let path = format!("{KEPT}.{ending}");
    if std::env::var_os("GLIDEPATH_BLESS").is_some() {
        std::fs::write(&path, text).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text, "{path}");
}

fn calibrate(folder: &Path, points: &str, config: &str, more: &[&str]) -> Output {
    std::fs::write(folder.join("points.csv"), points).unwrap();
    std::fs::write(folder.join("m.toml"), config).unwrap();
    Command::new(env!("CARGO_BIN_EXE_glidepath"))
        .current_dir(folder)
        .args(["calibrate", "points.csv", "--config", "m.toml"])
        .args(more)
        .env("NO_COLOR", "1")
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Points of the shipped rotary delta with other dimensions: base radius 91.2, upper arms 119.6, forearms 260.5, the
/// second arm at 210.3°, the first one .4° lower than it says. The angle of an arm is that at which its knee is a
/// forearm from the platform, found by halving.
fn delta_points() -> String {
    let (base, platform, upper, fore) = (91.2, 40.0, 119.6, 260.5_f64);
    let (arms, zeros) = ([90.0, 210.3, 330.0], [0.4, 0.0, 0.0]);
    let mut text = "# laser tracker, frame of the base\nJ0,J1,J2,X,Y,Z\n".to_owned();
    let mut number = 0_u32;
    // A few micrometres that repeat with no pattern in the grid.
    let mut noise = || {
        number += 1;
        f64::from(number * 7919 % 101) * 2e-4 - 0.01
    };
    for z in [-205.0, -240.0, -275.0] {
        for x in [-60.0, 0.0, 60.0] {
            for y in [-60.0, 0.0, 60.0] {
                let joint = |i: usize| {
                    let (sin, cos) = f64::to_radians(arms[i]).sin_cos();
                    let too_far = |angle: f64| {
                        let (s, c) = angle.to_radians().sin_cos();
                        let radius = base - platform + upper * c;
                        let off = [x - radius * cos, y - radius * sin, z + upper * s];
                        off.iter().map(|part: &f64| part * part).sum::<f64>() > fore * fore
                    };
                    let (mut low, mut high) = (-60.0, 85.0);
                    for _ in 0..60 {
                        let middle = 0.5 * (low + high);
                        *if too_far(middle) { &mut low } else { &mut high } = middle;
                    }
                    low - zeros[i]
                };
                let joints = [joint(0), joint(1), joint(2)];
                let [a, b, c] = joints;
                let tip = [x + noise(), y + noise(), z + noise()];
                let [x, y, z] = tip;
                writeln!(text, "{a:.6},{b:.6},{c:.6},{x:.4},{y:.4},{z:.4}").unwrap();
            }
        }
    }
    text
}

/// The configuration with what the command printed in place of the mechanism's table.
fn with_lines(config: &str, printed: &str, table: &str) -> String {
    let (before, rest) = config.split_once(table).unwrap();
    let (_, after) = rest.split_once("\n\n").unwrap();
    format!("{before}{printed}\n{after}")
}

#[test]
fn the_lines_are_a_configuration_that_fits() {
    let folder = tempfile::tempdir().unwrap();
    let points = delta_points();
    is_kept("csv", &points);
    let output = calibrate(folder.path(), &points, ROTARY_DELTA, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    is_kept("txt", &printed);
    let table: toml::Table = printed.parse().unwrap();
    let delta = &table["machine"]["rotary-delta"];
    let value = |key: &str| delta[key].as_float().unwrap();
    for (key, truth) in [
        ("base_radius", 91.2),
        ("platform_radius", 40.0),
        ("upper_arm", 119.6),
        ("forearm", 260.5),
    ] {
        assert!((value(key) - truth).abs() < 0.1, "{key}: {}", value(key));
    }
    let lines = with_lines(ROTARY_DELTA, &printed, "[machine.rotary-delta]");
    let machine = config::parse("m.toml", &lines).expect("the lines belong there");
    assert_eq!(machine.kinematics(), "rotary-delta");
    // With these there is nothing left to find but the zeros, which are no lines of this table.
    let again = calibrate(folder.path(), &points, &lines, &["--json"]);
    let report: Value = serde_json::from_slice(&again.stdout).unwrap();
    let zero = &report["dimensions"][7];
    assert_eq!(zero["name"], "zero of J0");
    assert!(
        (zero["value"].as_f64().unwrap() - 0.4).abs() < 0.05,
        "{zero}"
    );
    let rod = &report["dimensions"][3];
    let moved = rod["value"].as_f64().unwrap() - rod["before"].as_f64().unwrap();
    assert!(moved.abs() < 1e-4, "{rod}");
}

#[test]
fn json_has_all_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let output = calibrate(folder.path(), &delta_points(), ROTARY_DELTA, &["--json"]);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["point_count"], 27);
    assert_eq!(report["numbers"], 81);
    assert_eq!(report["dimensions"].as_array().unwrap().len(), 10);
    let rms = |when: &str| report[when]["position_mm"]["rms"].as_f64().unwrap();
    assert!(
        rms("before") > 0.5 && rms("after") < 0.015,
        "{} {}",
        rms("before"),
        rms("after")
    );
    assert!(
        report["before"]["position_mm"]["worst_line"]
            .as_u64()
            .unwrap()
            > 2
    );
    assert_eq!(report["before"]["angle_deg"], Value::Null);
    let untold = &report["untold"][0];
    assert_eq!(untold["deviation"], Value::Null, "nothing tells");
    assert_eq!(untold["parts"][0]["dimension"], "platform_radius");
    assert_eq!(untold["parts"][1]["dimension"], "base_radius");
    let platform = &report["dimensions"][1];
    assert_eq!(platform["deviation"], Value::Null);
    assert_eq!(platform["value"], 40.0);
    let toml: toml::Table = report["toml"].as_str().unwrap().parse().unwrap();
    assert!(toml["machine"]["rotary-delta"]["forearm"].is_float());
}

#[test]
fn what_is_to_be_kept_is() {
    let folder = tempfile::tempdir().unwrap();
    let keep = [
        "--keep",
        "base_radius",
        "--keep",
        "arm_angles",
        "--keep",
        "J0",
        "--json",
    ];
    let output = calibrate(folder.path(), &delta_points(), ROTARY_DELTA, &keep);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let kept: Vec<&str> = report["dimensions"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|dimension| dimension["deviation"].is_null())
        .map(|dimension| dimension["name"].as_str().unwrap())
        .collect();
    let wanted = [
        "base_radius",
        "arm_angles[0]",
        "arm_angles[1]",
        "arm_angles[2]",
        "zero of J0",
    ];
    assert_eq!(kept, wanted);
    let unknown = calibrate(
        folder.path(),
        &delta_points(),
        ROTARY_DELTA,
        &["--keep", "rod"],
    );
    assert_eq!(unknown.status.code(), Some(2));
    let told = text(&unknown.stderr);
    assert!(
        told.contains("no dimension `rod`; it has: base_radius, platform_radius, upper_arm, forearm, arm_angles, J0"),
        "{told}"
    );
}

#[test]
fn rows_that_are_wrong_are_told_with_their_places() {
    let folder = tempfile::tempdir().unwrap();
    let points = "J0;J1;J2;X;Y;Z\n10;20;30;1;2;3\n\n10;20;30;1;2\n10;2O;30;1;2,5;3\n10;;30;1;2;3\n10;20;30;;;\n\
                  10;20;1e9;1;2;3\n";
    let output = calibrate(folder.path(), points, ROTARY_DELTA, &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let found: Vec<String> = report["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|row| {
            format!(
                "{}:{}:{} {}",
                row["program"].as_str().unwrap(),
                row["line"],
                row["column"],
                row["message"].as_str().unwrap()
            )
        })
        .collect();
    assert_eq!(
        found,
        [
            "points.csv:4:1 5 cells, where the header has 6",
            "points.csv:5:4 `2O` is no number",
            "points.csv:5:12 `2,5` is no number",
            "points.csv:6:1 J1 has no number",
            "points.csv:7:1 nothing was measured at this point",
            "points.csv:8:7 1e9 is out of range",
        ]
    );
    let output = calibrate(folder.path(), points, ROTARY_DELTA, &[]);
    let told = text(&output.stderr);
    assert!(told.contains("points.csv:5:4"), "{told}");
    assert!(
        told.contains("error: the points have 6 places to mend"),
        "{told}"
    );
}

#[test]
fn headers_that_are_wrong_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for (header, place, message) in [
        ("", "1:1", "there are no points"),
        ("# nothing\n", "1:1", "there are no points"),
        ("J0,J1,X,Y,Z", "1:1", "there is no column J2"),
        ("J0,J1,J2", "1:1", "there is no column of what was measured"),
        ("J0,J1,J2,X,J1", "1:12", "there are two columns J1"),
        ("J0,J1,J2,x,height", "1:12", "there is no column `height`"),
        (
            "J0,J1,J2,J3,X",
            "1:10",
            "no dimension has to do with a joint J3: those that have are J0 to J2",
        ),
        ("J0,J1,J2,X,A", "1:12", "the machine has no axis A"),
        ("1,2,3,4,5,6", "1:1", "there is no column `1`"),
    ] {
        let output = calibrate(folder.path(), header, ROTARY_DELTA, &["--json"]);
        assert_eq!(output.status.code(), Some(1), "{header}");
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        let first = &report["findings"][0];
        assert_eq!(first["message"], message);
        assert_eq!(
            format!("{}:{}", first["line"], first["column"]),
            place,
            "{header}"
        );
    }
}

#[test]
fn points_that_tell_too_little_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let few: String = delta_points()
        .lines()
        .take(5)
        .map(|line| format!("{line}\n"))
        .collect();
    let output = calibrate(folder.path(), &few, ROTARY_DELTA, &[]);
    assert_eq!(output.status.code(), Some(1));
    let told = text(&output.stderr);
    assert!(
        told.contains("9 measured numbers cannot tell 10 dimensions; measure more points"),
        "{told}"
    );

    // The same place again and again.
    let header = "J0,J1,J2,X,Y,Z\n";
    let points = delta_points();
    let row = points.lines().nth(9).unwrap();
    let same = format!("{header}{}", format!("{row}\n").repeat(12));
    let output = calibrate(folder.path(), &same, ROTARY_DELTA, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    assert!(printed.contains("3 of 10 dimensions found"), "{printed}");
    assert!(printed.contains("# The points do not tell"), "{printed}");

    let far = format!("{header}{}", "10,20,30,0,0,-220\n".repeat(10)) + "500,-60,85,0,0,-220\n";
    let output = calibrate(folder.path(), &far, ROTARY_DELTA, &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["findings"][0]["line"], 12, "{report}");

    let mill = calibrate(folder.path(), &delta_points(), config::EMBEDDED, &[]);
    assert_eq!(mill.status.code(), Some(1));
    let told = text(&mill.stderr);
    assert!(
        told.contains("no dimensions that points could tell; where joints are the axes"),
        "{told}"
    );
}

/// Struts that are longer than they say, of a platform that was measured with its angles; then without.
#[test]
fn a_hexapod_finds_its_zeros() {
    let folder = tempfile::tempdir().unwrap();
    let zeros = [0.2, -0.15, 0.3, 0.1, -0.25, 0.05];
    let at = |radius: f64, degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        [radius * c, radius * s, 0.0]
    };
    let mut points = "J0,J1,J2,J3,J4,J5,X,Y,Z,A,B,C\n".to_owned();
    for i in 0..40_u32 {
        let part = |k: u32| f64::from(i * k % 41) / 20.0 - 1.0;
        let (x, y, z) = (100.0 * part(7), 100.0 * part(11), 500.0 + 70.0 * part(17));
        let (a, b, c) = (12.0 * part(5), 12.0 * part(19), 20.0 * part(29));
        let [(sa, ca), (sb, cb), (sc, cc)] =
            [a, b, c].map(|angle: f64| angle.to_radians().sin_cos());
        let turn = [
            [cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa],
            [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa],
            [-sb, cb * sa, cb * ca],
        ];
        let on_base = [-15.0, 15.0, 105.0, 135.0, 225.0, 255.0];
        let on_platform = [315.0, 45.0, 75.0, 165.0, 195.0, 285.0];
        for k in 0..6 {
            let (foot, head) = (at(400.0, on_base[k]), at(150.0, on_platform[k]));
            let along = |row: usize, tip: f64| {
                let turned: f64 = (0..3).map(|i| turn[row][i] * head[i]).sum();
                tip + turned - foot[row]
            };
            let length = along(0, x).hypot(along(1, y)).hypot(along(2, z));
            write!(points, "{:.6},", length - zeros[k]).unwrap();
        }
        writeln!(points, "{x:.5},{y:.5},{z:.5},{a:.5},{b:.5},{c:.5}").unwrap();
    }
    let output = calibrate(folder.path(), &points, HEXAPOD, &["--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let dimensions = report["dimensions"].as_array().unwrap();
    for (dimension, zero) in dimensions[7..].iter().zip(zeros) {
        let value = dimension["value"].as_f64().unwrap();
        assert!((value - zero).abs() < 1e-3, "{dimension}");
    }
    assert!(report["after"]["angle_deg"]["worst"].as_f64().unwrap() < 1e-4);
    let tip_alone: String = points
        .lines()
        .map(|line| line.rsplitn(4, ',').last().unwrap().to_owned() + "\n")
        .collect();
    let output = calibrate(folder.path(), &tip_alone, HEXAPOD, &["--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(report["after"]["position_mm"]["worst"].as_f64().unwrap() < 1e-3);
}
