//! Tests of what a user is told about a configuration that has to be mended, word for word.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]
#![allow(clippy::float_cmp, reason = "values are read, not computed")]

use glidepath::config::{self, ConfigDiagnostic};
use glidepath_geometry::Axis;
use glidepath_program::{Effort, Limits, Smoothing};

const AXIS: &str = "[axis.X]\nmin_position = -10\nmax_position = 10\nmax_velocity = 100\n\
                    max_acceleration = 1000\nmax_jerk = 10000\n";

/// Message, line and column, help.
type Told = (String, Option<(usize, usize)>, Option<String>);

fn findings(text: &str) -> Vec<Told> {
    let error = config::parse("m.toml", text).expect_err("the text has to be refused");
    let describe =
        |f: &ConfigDiagnostic| (f.message.clone(), error.line_and_column(f), f.help.clone());
    error.diagnostics().iter().map(describe).collect()
}

fn only(text: &str) -> (String, Option<(usize, usize)>, String) {
    let mut found = findings(text);
    assert_eq!(found.len(), 1, "{found:?}");
    let (message, place, help) = found.remove(0);
    (message, place, help.unwrap_or_default())
}

#[test]
fn the_embedded_machine_is_the_mill() {
    let config = config::load(None).unwrap();
    assert_eq!(
        config.axes.iter().map(|a| a.axis).collect::<Vec<_>>(),
        [Axis::X, Axis::Y, Axis::Z]
    );
    for axis in &config.axes {
        assert_eq!(axis.travel, Some((-500.0, 500.0)));
        assert_eq!(
            (axis.max_velocity, axis.max_acceleration, axis.max_jerk),
            (200.0, 2000.0, 40000.0)
        );
    }
    let settings = config.settings();
    assert_eq!(settings.tolerance_mm, 0.02);
    assert_eq!(settings.period_t, 0.004);
    assert_eq!(settings.smoothing, Smoothing::default());
    assert_eq!(settings.effort, Effort::Optimal);
    assert_eq!(settings.limits.jerk[Axis::A.index()], Limits::UNLIMITED);
    assert_eq!(config.instance, None);
}

#[test]
fn the_published_machine_is_shipped() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/seed.toml");
    let config = config::load(Some(path.as_ref())).unwrap();
    for axis in &config.axes {
        assert_eq!(
            (axis.max_velocity, axis.max_acceleration, axis.max_jerk),
            (100.0, 10000.0, 1e6)
        );
    }
    assert_eq!(config.path.tolerance_mm, 0.05);
    assert_eq!(config.path.default_feed, Some(5000.0));
}

#[test]
fn a_machine_needs_only_its_axes() {
    let config = config::parse("m.toml", AXIS).unwrap();
    assert_eq!(config.path.tolerance_mm, 0.02);
    assert_eq!(config.path.default_feed, None);
    assert_eq!(config.interpolator.period_us, 4000);
    assert_eq!(config.interpolator.cpu, None);
}

#[test]
fn a_misspelt_key_is_refused_with_the_right_one() {
    assert_eq!(
        only(&AXIS.replace("max_velocity", "max_velocty")),
        (
            "unknown key `max_velocty`".to_owned(),
            Some((4, 1)),
            "did you mean `max_velocity`? The keys here are: min_position, max_position, \
             max_velocity, max_acceleration, max_jerk, jog_velocity, gantry_difference"
                .to_owned()
        )
    );
    let (message, _, help) = only(&format!("{AXIS}[interpolater]\nperiod_us = 1000\n"));
    assert_eq!(message, "unknown key `interpolater`");
    assert!(help.starts_with("did you mean `interpolator`?"), "{help}");
    let (message, place, help) = only(&AXIS.replace("axis.X", "axis.x"));
    assert_eq!((message.as_str(), place), ("unknown key `x`", Some((1, 7))));
    assert!(help.starts_with("did you mean `X`?"), "{help}");
    let (message, _, help) = only(&format!("{AXIS}[path]\nqqqq = 1\n"));
    assert_eq!(message, "unknown key `qqqq`");
    assert_eq!(
        help,
        "the keys here are: tolerance, direction_tolerance, smoothing, corners, effort, default_feed, \
         max_tangential_acceleration, max_normal_acceleration, max_jerk"
    );
}

#[test]
fn a_missing_key_is_named() {
    let (message, place, help) = only(&AXIS.replace("max_jerk = 10000\n", ""));
    assert_eq!(message, "the key `max_jerk` is missing");
    assert_eq!(place, Some((1, 1)));
    assert!(help.starts_with("add `max_jerk = …`"), "{help}");
    assert_eq!(only("[machine]\n").0, "the key `axis` is missing");
    assert_eq!(only("[axis]\n").0, "the machine has no axis");
    let (message, _, help) = only(&AXIS.replace("max_position = 10\n", ""));
    assert_eq!(message, "the key `max_position` of axis X is missing");
    assert!(
        help.starts_with("add `max_position = …` (mm) to [axis.X]"),
        "{help}"
    );
}

#[test]
fn a_value_out_of_range_is_given_with_unit_and_range() {
    assert_eq!(
        only(&AXIS.replace("max_jerk = 10000", "max_jerk = -3.5")),
        (
            "axis.X.max_jerk = -3.5 mm/s³ is out of range".to_owned(),
            Some((6, 12)),
            "give 0.001 to 10000000000 mm/s³: a limit of the drive, in any direction of motion"
                .to_owned()
        )
    );
    for bad in ["nan", "inf", "0", "0.0"] {
        let (message, ..) =
            only(&AXIS.replace("max_velocity = 100", &format!("max_velocity = {bad}")));
        assert!(message.starts_with("axis.X.max_velocity = "), "{message}");
    }
    let (message, place, help) = only(&format!("{AXIS}[interpolator]\nperiod_us = 50\n"));
    assert_eq!(message, "interpolator.period_us = 50 is out of range");
    assert_eq!(place, Some((8, 13)));
    assert_eq!(help, "give 250 to 20000: µs between two setpoints");
    let (message, _, help) = only(&format!("{AXIS}[path]\nsmoothing = \"spline\"\n"));
    assert_eq!(message, "path.smoothing = \"spline\" is not known");
    assert_eq!(
        help,
        "give \"auto\" or \"sextic\" or \"bezier-pair\" or \"exact-stop\""
    );
    let (message, ..) = only(&format!("{AXIS}[link]\ninstance = \"../x\"\n"));
    assert_eq!(message, "link.instance = \"../x\" cannot name a machine");
    let (message, ..) = only(&AXIS.replace("max_position = 10", "max_position = -10"));
    assert_eq!(
        message,
        "axis X has no travel: min_position = -10 mm is not below max_position = -10 mm"
    );
}

#[test]
fn the_horizon_covers_the_stops_of_the_machine() {
    // 100/1000 + 1000/10000 s to stop.
    let (message, place, help) = only(&format!("{AXIS}[interpolator]\nhorizon_s = 0.5\n"));
    assert_eq!(
        message,
        "interpolator.horizon_s = 0.5 s is too short for this machine"
    );
    assert_eq!(place, Some((8, 13)));
    assert_eq!(
        help,
        "give at least 0.600 s, three stops from full speed of the slowest axis"
    );
    let (message, place, help) = only(&format!("{AXIS}[interpolator]\nperiod_us = 1000\n"));
    assert_eq!(
        message,
        "interpolator.period_us = 1000 is too short for this machine"
    );
    assert_eq!(place, Some((8, 13)));
    assert!(help.starts_with("give at least 1172: 512 frames"), "{help}");
    let config = config::parse("m.toml", AXIS).unwrap();
    assert!((config.interpolator.horizon_t - 0.6).abs() < 1e-12);
}

#[test]
fn every_finding_is_listed_at_once() {
    let text = AXIS.replace("100\n", "-100\n").replace("1000\n", "-1000\n");
    let keys: Vec<String> = findings(&text)
        .into_iter()
        .map(|(message, ..)| message)
        .collect();
    assert_eq!(
        keys,
        [
            "axis.X.max_velocity = -100 mm/s is out of range",
            "axis.X.max_acceleration = -1000 mm/s² is out of range",
        ]
    );
}

#[test]
fn syntax_and_types_are_refused_with_their_place() {
    let (_, place, _) = only("[axis.X\n");
    assert_eq!(place.map(|(line, _)| line), Some(1));
    let (message, place, _) = only(&AXIS.replace("max_jerk = 10000", "max_jerk = \"fast\""));
    assert_eq!(message, "axis.X.max_jerk is text, not a number");
    assert_eq!(place, Some((6, 12)));
    for (line, told) in [
        (
            "path.tolerance = true",
            "path.tolerance is true or false, not a number",
        ),
        (
            "interpolator.period_us = 4000.0",
            "interpolator.period_us is a number with a decimal point, not a whole number",
        ),
        (
            "interpolator.cpu = \"1\"",
            "interpolator.cpu is text, not a whole number",
        ),
        (
            "path.effort = 1",
            "path.effort is a whole number, not text in quotes",
        ),
        ("path = 5", "path is a whole number, not a table"),
        ("[[path]]", "path is a list of tables, not a table"),
        (
            "[[spindle]]\nx = 1",
            "spindle is a list of tables, not a table",
        ),
        (
            "program.subroutine_path = \"lib\"",
            "program.subroutine_path is text, not a list",
        ),
        ("axis.X = 3", "axis.X is a whole number, not a table"),
    ] {
        let rest = if line.starts_with("axis") { "" } else { AXIS };
        let (message, place, help) = only(&format!("{line}\n{rest}"));
        assert_eq!(message, told);
        assert_eq!(place.map(|(line, _)| line), Some(1), "{line}");
        assert!(!help.is_empty(), "{line}");
    }
}

#[test]
fn what_is_wrong_is_told_at_once_whatever_it_is() {
    let text = AXIS
        .replace("max_velocity", "max_velocty")
        .replace("max_jerk = 10000", "max_jerk = -1");
    let text = format!(
        "{text}[path]\ntolerance = \"0.02\"\neffort = \"best\"\nqqqq = 1\n[interpolator]\n\
         horizon_s = 99\npriority = 200\n"
    );
    let mut told: Vec<String> = findings(&text).into_iter().map(|found| found.0).collect();
    told.sort();
    assert_eq!(
        told,
        [
            "axis.X.max_jerk = -1 mm/s³ is out of range",
            "interpolator.horizon_s = 99 s is out of range",
            "interpolator.priority = 200 is out of range",
            "path.effort = \"best\" is not known",
            "path.tolerance is text, not a number",
            "unknown key `max_velocty`",
            "unknown key `qqqq`",
        ]
    );
}

#[test]
fn a_velocity_per_minute_is_called_that() {
    // The settings of grbl, in mm/min, on the machine that is shipped.
    let text = config::EMBEDDED.replace("max_velocity = 200.0", "max_velocity = 12000.0");
    let found = findings(&text);
    assert_eq!(found.len(), 3, "{found:?}");
    for (axis, (message, place, help)) in ["X", "Y", "Z"].into_iter().zip(found) {
        assert_eq!(
            message,
            format!(
                "axis.{axis}.max_velocity = 12000 mm/s is 720 m/min, and 6.0 s to stop: mm/min?"
            )
        );
        let (line, column) = place.expect("a place");
        let line = text.lines().nth(line - 1).expect("a line");
        assert!(line.starts_with("max_velocity = 12000"), "{line}");
        assert_eq!(column, 16);
        let help = help.expect("a remedy");
        assert!(
            help.contains("12000 mm/min is max_velocity = 200.0"),
            "{help}"
        );
    }
    // The defaults of grbl; and a jerk that is none.
    let slow = AXIS.replace("max_velocity = 100", "max_velocity = 500");
    let (message, ..) = only(&slow.replace("1000\n", "10\n"));
    assert!(
        message.ends_with("is 30 m/min, and 50.0 s to stop: mm/min?"),
        "{message}"
    );
    let (message, ..) = only(&AXIS.replace("max_jerk = 10000", "max_jerk = 10"));
    assert_eq!(
        message,
        "axis.X.max_jerk = 10 mm/s³ takes 100.0 s to build up max_acceleration = 1000 mm/s²"
    );
}

#[test]
fn no_more_is_read_of_a_file_than_it_may_have() {
    let error = config::load(Some("/dev/zero".as_ref())).expect_err("no configuration");
    assert!(
        error.to_string().contains("more than 1048576 bytes"),
        "{error}"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("m.toml");
    std::fs::write(&path, AXIS.to_owned() + &"#\n".repeat(1 << 19)).expect("written");
    assert!(config::load(Some(&path)).is_err());
    std::fs::write(&path, AXIS.to_owned() + &"#\n".repeat(1 << 18)).expect("written");
    assert!(config::load(Some(&path)).is_ok());
}

#[test]
fn a_rotary_axis_may_turn_without_end() {
    let rotary = "[axis.A]\nmax_velocity = 90\nmax_acceleration = 900\nmax_jerk = 9000\n";
    let config = config::parse("m.toml", &format!("{AXIS}{rotary}")).unwrap();
    assert_eq!(
        config.axes.last().map(|a| (a.axis, a.travel)),
        Some((Axis::A, None))
    );
}

/// A machine of one axis that the controller brings home, with these lines in the table of its
/// joint.
fn brought_home(lines: &str) -> String {
    format!("{AXIS}[feedback]\nsource = 'drives'\nhoming = 'controller'\n[home.J0]\n{lines}")
}

#[test]
fn a_way_home_is_judged_as_a_whole() {
    let switch = "search_velocity = -20\nlatch_velocity = 1\nsearch_travel = 30\n";
    let fits = brought_home(&format!("{switch}clearance = 1.2\noffset = -9\n"));
    let config = config::parse("m.toml", &fits).expect("it fits");
    let home = config.home_of_joints[0].expect("a table");
    assert_eq!(
        (home.search_v, home.latch_v, home.offset),
        (-20.0, 1.0, -9.0)
    );
    assert_eq!((home.final_v, home.home, home.clearance), (100.0, 0.0, 1.2));
    // Three periods and the stop from 20 mm/s: 0.24 + 0.894 mm.
    let (message, ..) = only(&brought_home(&format!("{switch}clearance = 1.1\n")));
    assert_eq!(
        message,
        "J0 cannot come home: at 20 mm/s it goes 1.134 mm past the edge of its switch, and there is \
         room for 1.1 mm"
    );
    for (lines, why) in [
        (switch, "clearance has to be more than 0"),
        (
            "search_velocity = 5\n",
            "has no velocity to find its edge at",
        ),
        (
            "latch_velocity = 5\n",
            "neither for a switch nor for an index pulse",
        ),
        ("index_input = 3\n", "no velocity to find it at"),
        ("index = 'drive'\n", "no velocity to find it at"),
        (
            "latch_velocity = 5\nsearch_travel = 9\nindex = 'drive'\nindex_input = 3\n",
            "has its index pulse by an input, and by its drive",
        ),
        ("position = 11\n", "is outside of the travel"),
    ] {
        let (message, ..) = only(&brought_home(lines));
        assert!(message.contains(why), "{lines}: {message}");
    }
    let none = brought_home("").replace("[home.J0]", "");
    assert_eq!(only(&none).0, "the table [home.J0] is missing");
    let far = brought_home("[home.J1]\n");
    assert_eq!(only(&far).0, "there is no such joint to bring home");
}

#[test]
fn two_joints_of_an_axis_come_home_together() {
    let gantry = brought_home("sequence = -1\n[home.J1]\nsequence = -1\n").replace(
        "max_jerk = 10000\n",
        "max_jerk = 10000\ngantry_difference = 0.5\n",
    );
    let config = config::parse("m.toml", &gantry).expect("a gantry");
    assert_eq!(config.gantries, [(Axis::X, 0.5)]);
    assert_eq!((config.drives(), config.axes.len()), (2, 1));
    for other in ["sequence = -2", "sequence = 1", ""] {
        let apart = gantry.replacen(
            "[home.J1]\nsequence = -1",
            &format!("[home.J1]\n{other}"),
            1,
        );
        let (message, ..) = only(&apart);
        assert!(message.contains("does not go with the first"), "{message}");
    }
    let by_drive = gantry.replace("'controller'", "'drive'");
    assert!(only(&by_drive).0.contains("squared by the controller"));
}
