//! Tests of configurations of other controls: what comes of them is refused only where it asks, and
//! loads once that was written.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

#[allow(dead_code, reason = "what the tests of the conversion use, too")]
#[path = "../../../migration/tests/support/mod.rs"]
mod samples;

use glidepath::config::{self, MachineConfig};
use glidepath_migration::Conversion;
use samples::{SAMPLES, convert, read};

/// Loads a conversion; what is found has to be asked for.
fn loads_but_for_what_is_asked(name: &str, conversion: &Conversion) {
    let asked: Vec<&str> = conversion
        .asked
        .iter()
        .map(|asked| asked.key.as_str())
        .collect();
    match config::parse(name, &conversion.configuration) {
        Ok(_) => assert!(asked.is_empty(), "{name} loads without {asked:?}"),
        Err(error) => {
            let found: Vec<&str> = error.diagnostics().iter().map(|d| d.key.as_str()).collect();
            for key in &found {
                assert!(
                    asked.contains(key),
                    "{name}: {key} is not asked for: {error:?}"
                );
            }
            // A choice that was not made may hide what depends on it.
            let is_told = |key: &&&str| found.contains(*key) || key.ends_with("_position");
            let untold: Vec<_> = asked.iter().filter(|key| !is_told(key)).collect();
            assert!(untold.is_empty(), "{name} does not miss {untold:?}");
        }
    }
}

/// Writes what is asked for.
fn answered(conversion: &Conversion) -> Result<MachineConfig, String> {
    // Joints so strong that they leave the axes what they have.
    let answer = |table: &str, key: &str| match key {
        "max_velocity" if table.starts_with("[joint") => "10000.0",
        "max_acceleration" if table.starts_with("[joint") => "1e6",
        "max_jerk" if table.starts_with("[joint") => "1e7",
        "min_position" => "-100.0",
        "max_position" => "100.0",
        "max_velocity" => "100.0",
        "max_acceleration" => "1000.0",
        "max_jerk" => "20000.0",
        "rod" => "800.0",
        "radius" => "200.0",
        "tolerance" => "0.02",
        "gantry_difference" => "0.5",
        other => panic!("nobody answers {other}"),
    };
    let mut text = String::new();
    let mut table = "";
    for line in conversion.configuration.lines() {
        if line.starts_with('[') {
            table = line;
        }
        let commented = line
            .strip_prefix("# ")
            .and_then(|line| line.strip_suffix(" ="));
        let chosen = line.strip_suffix(" = \"to be chosen\"");
        match commented.filter(|key| !key.contains(' ')).or(chosen) {
            Some(key) => text.push_str(&format!("{key} = {}\n", answer(table, key))),
            None => text.push_str(&format!("{line}\n")),
        }
    }
    config::parse("answered", &text).map_err(|error| format!("{error:?}\n{text}"))
}

#[test]
fn what_comes_of_it_is_refused_only_where_it_asks_and_loads_once_answered() {
    for (control, file, _) in SAMPLES {
        let name = format!("{control}/{file}");
        let conversion = convert(control, &read(control, file));
        loads_but_for_what_is_asked(&name, &conversion);
        answered(&conversion).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

/// The name of a key that a line asks for: by a comment, or by the text in place of its value.
fn asked_for(line: &str) -> Option<&str> {
    let commented = line
        .strip_prefix("# ")
        .and_then(|line| line.strip_suffix(" ="));
    let commented = commented.filter(|key| !key.contains(' '));
    commented.or_else(|| line.strip_suffix(" = \"to be chosen\""))
}

/// A conversion with what `value` gives for each key that it asks for, by its table and name.
fn filled(conversion: &Conversion, value: impl Fn(&str, &str) -> String) -> String {
    let mut text = String::new();
    let mut table = "";
    for line in conversion.configuration.lines() {
        table = line
            .strip_prefix('[')
            .map_or(table, |name| name.trim_end_matches(']'));
        match asked_for(line) {
            Some(key) => text.push_str(&format!("{key} = {}\n", value(table, key))),
            None => text.push_str(&format!("{line}\n")),
        }
    }
    text
}

#[test]
fn a_conversion_loads_with_what_is_hinted() {
    for (control, file, _) in SAMPLES {
        let name = format!("{control}/{file}");
        let conversion = convert(control, &read(control, file));
        let asking = filled(&conversion, |_, _| "\"to be chosen\"".to_owned());
        let error = config::parse(&name, &asking).expect_err("nothing is chosen");
        let hint = |table: &str, key: &str| {
            let full = format!("{table}.{key}");
            let found = error.diagnostics().iter().find(|found| found.key == full);
            let help = found.and_then(|found| found.help.as_ref()).unwrap();
            match help.split_once(&format!("such as {key} = ")) {
                Some((_, value)) => value.to_owned(),
                // No length of a mechanism is harmless.
                None if table == "machine.linear-delta" => {
                    if key == "rod" { "800.0" } else { "200.0" }.to_owned()
                }
                // Nor is a weak joint below axes that are not.
                None if table.starts_with("joint.") => match key {
                    "max_velocity" => "10000.0",
                    "max_acceleration" => "1e6",
                    _ => "1e7",
                }
                .to_owned(),
                None => panic!("{name}: no hint for {full}: {help}"),
            }
        };
        let text = filled(&conversion, hint);
        if let Err(error) = config::parse(&name, &text) {
            panic!("{name}: {error:?}\n{text}");
        }
    }
}

/// What remarks say may be written is taken, each in its table.
#[test]
fn what_remarks_propose_is_taken() {
    let mut count = 0;
    for (control, file, _) in SAMPLES {
        let conversion = convert(control, &read(control, file));
        let whole = conversion
            .configuration
            .split("\n# Converted:")
            .next()
            .unwrap();
        let mut table = "";
        for line in whole.lines() {
            table = line
                .strip_prefix('[')
                .map_or(table, |name| name.trim_end_matches(']'));
            let words: Vec<&str> = line.split_whitespace().collect();
            let is_remark = line.starts_with('#') && asked_for(line).is_none();
            let proposed = words
                .windows(3)
                .filter(|three| is_remark && three[1] == "=");
            for three in proposed {
                let (key, value) = (three[0], three[2].trim_end_matches([';', ',']));
                let text = format!("[{table}]\n{key} = {value}\n");
                let Err(error) = config::parse("remark", &text) else {
                    panic!("a machine without an axis");
                };
                let full = format!("{table}.{key}");
                let found = error.diagnostics().iter().find(|found| found.key == full);
                assert!(found.is_none(), "{control}/{file}: {text}{found:?}");
                count += 1;
            }
        }
    }
    assert!(count > 10, "{count}");
}

#[test]
fn values_are_those_of_the_other_control_in_our_units() {
    let machine =
        |control: &str, file: &str| answered(&convert(control, &read(control, file))).unwrap();
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} {b}");

    let mill = machine("linuxcnc", "mill-mm.ini");
    // The stricter one of axis and joint.
    assert_eq!(mill.axes[0].travel, Some((-0.5, 419.5)));
    // Its play is taken up with what plans leave free of the drive's limits.
    let drive = *mill.compensation.joints()[0].unwrap().drive();
    near(drive.velocity, 95.0);
    near(drive.acceleration, 900.0);
    assert!(mill.axes[0].max_velocity < 95.0);
    assert_eq!(mill.program.subroutine_path.len(), 2);
    let home = mill.home_of_joints[0].unwrap();
    assert_eq!(
        (home.search_v, home.latch_v, home.offset),
        (-20.0, 1.5, -2.0)
    );
    assert_eq!(mill.jog.increments, [1.0, 0.1, 0.01]);

    // To the negative end with zero there, as its flags say; the tool axis first.
    let hal = machine("grbl", "grblhal.txt");
    let homes = |machine: &MachineConfig, joint: usize| machine.home_of_joints[joint].unwrap();
    assert_eq!([homes(&hal, 0).sequence, homes(&hal, 2).sequence], [2, 1]);
    let printer = machine("klipper", "cartesian.cfg");
    let home = homes(&printer, 0);
    assert_eq!((home.search_v, home.latch_v), (-50.0, -25.0));
    near(home.search_travel, 1.5 * 235.0);
    assert_eq!(homes(&printer, 2).home.to_bits(), 0.5_f64.to_bits());

    let gantry = machine("linuxcnc", "gantry-inch.ini");
    near(gantry.axes[0].travel.unwrap().1, 1219.2);
    near(gantry.axes[0].max_jerk, 400.0 * 25.4);
    near(gantry.axes[2].max_velocity, 4.0 * 25.4);
    assert_eq!(gantry.axes[3].travel, None);
    near(gantry.axes[3].max_velocity, 60.0);
    near(gantry.path.tolerance_mm, 0.0254);
    // The second joint of Y, J2 there, comes after those of all axes.
    assert_eq!(gantry.gantries.len(), 1);
    let sequence = |joint: usize| gantry.home_of_joints[joint].map(|home| home.sequence);
    assert_eq!([sequence(1), sequence(4)], [Some(-2), Some(-2)]);
    near(gantry.home_of_joints[0].unwrap().search_v, 0.5 * 25.4);

    let router = machine("grbl", "router.txt");
    near(router.axes[0].max_velocity, 5000.0 / 60.0);
    // $23 homes X and Y to their negative ends: where zero is depends on the build.
    assert_eq!(
        router.axes[0].travel,
        Some((-100.0, 100.0)),
        "answered by hand"
    );
    assert_eq!(router.axes[2].travel, Some((-90.0, 0.0)));
    near(router.path.tolerance_mm, 0.01);

    let forced = machine("grbl", "router-force-origin.txt");
    assert_eq!(forced.axes[0].travel, Some((0.0, 800.0)));
    assert_eq!(forced.axes[1].travel, Some((-400.0, 0.0)));
    let text = convert("grbl", &read("grbl", "router-force-origin.txt")).configuration;
    assert!(
        text.contains("# glidepath offsets set G54 X25.4 Y63.5 Z-2.54"),
        "{text}"
    );

    let hal = machine("grbl", "grblhal.txt");
    assert_eq!(hal.axes[0].travel, Some((0.0, 300.0)));
    near(hal.axes[0].max_jerk, 24_000.0);
    near(hal.axes[3].max_velocity, 120.0);

    let printer = machine("klipper", "cartesian.cfg");
    assert_eq!(printer.axes[1].travel, Some((-5.0, 235.0)));
    near(printer.axes[2].max_velocity, 5.0);
    near(printer.axes[0].max_acceleration, 3000.0);
}
