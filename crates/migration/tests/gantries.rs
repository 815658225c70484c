//! Tests of axes that two motors move, of the block that LinuxCNC begins with, and of where grblHAL's zero is.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

mod support;

use glidepath_migration::{Conversion, from_grbl};
use support::{SAMPLES, convert, read};

fn sample(control: &str, file: &str) -> Conversion {
    assert!(
        SAMPLES
            .iter()
            .any(|(of, name, _)| (*of, *name) == (control, file))
    );
    convert(control, &read(control, file))
}

fn table(conversion: &Conversion) -> toml::Table {
    conversion.configuration.parse().expect("TOML")
}

fn number(conversion: &Conversion, table_of: &str, name: &str, key: &str) -> Option<f64> {
    let table = table(conversion);
    let value = table.get(table_of)?.get(name)?.get(key)?;
    value.as_float()
}

fn asks(conversion: &Conversion, key: &str) -> usize {
    conversion
        .asked
        .iter()
        .filter(|asked| asked.key == key)
        .count()
}

#[test]
fn the_weaker_joint_of_a_gantry_limits_its_axis() {
    let ini = |joints: &str| {
        let text = format!(
            "[TRAJ]\nCOORDINATES = XYYZ\nLINEAR_UNITS = mm\n[KINS]\nKINEMATICS = trivkins\n{joints}"
        );
        convert("linuxcnc", &text)
    };
    let of_y = |conversion: &Conversion, key| number(conversion, "axis", "Y", key);
    let first = "[JOINT_1]\nMAX_VELOCITY = 90\nMAX_ACCELERATION = 300\nMAX_JERK = 5000\nMIN_LIMIT = -1\nMAX_LIMIT = 900\n";
    let second = "[JOINT_2]\nMAX_VELOCITY = 50\nMAX_ACCELERATION = 400\nMAX_JERK = 4000\nMIN_LIMIT = 0\nMAX_LIMIT = 950\n";
    let axis = "[AXIS_Y]\nMAX_VELOCITY = 100\nMAX_ACCELERATION = 350\n";
    for joints in [format!("{first}{second}"), format!("{axis}{second}{first}")] {
        let conversion = ini(&joints);
        assert_eq!(of_y(&conversion, "max_velocity"), Some(50.0));
        assert_eq!(of_y(&conversion, "max_acceleration"), Some(300.0));
        assert_eq!(of_y(&conversion, "max_jerk"), Some(4000.0));
        assert_eq!(of_y(&conversion, "min_position"), Some(0.0));
        assert_eq!(of_y(&conversion, "max_position"), Some(900.0));
    }
    // That of the second joint alone counts, too.
    assert_eq!(
        of_y(&ini("[JOINT_2]\nMAX_VELOCITY = 50\n"), "max_velocity"),
        Some(50.0)
    );
}

#[test]
fn the_joints_are_those_of_trivkins() {
    let gantry = sample("linuxcnc", "gantry-mm.ini");
    assert_eq!(number(&gantry, "axis", "Y", "max_velocity"), Some(50.0));
    assert_eq!(number(&gantry, "axis", "Y", "min_position"), Some(-3.0));
    assert_eq!(number(&gantry, "axis", "Y", "max_jerk"), Some(7000.0));
    assert_eq!(number(&gantry, "axis", "Z", "max_velocity"), Some(30.0));
    assert_eq!(asks(&gantry, "axis.Y.gantry_difference"), 1);
    // The third joint of ours, the fourth one there.
    assert_eq!(
        number(&gantry, "compensation", "J2", "backlash"),
        Some(0.01)
    );
    // A lathe: Z is joint 2, as joint 1 is a Y that it does not have.
    let lathe = "[TRAJ]\nCOORDINATES = XZ\nLINEAR_UNITS = mm\n[KINS]\nKINEMATICS = trivkins\nJOINTS = 3\n\
                 [JOINT_1]\nMAX_VELOCITY = 1\n[JOINT_2]\nMAX_VELOCITY = 40\n";
    let lathe = convert("linuxcnc", lathe);
    assert_eq!(number(&lathe, "axis", "Z", "max_velocity"), Some(40.0));
}

#[test]
fn what_programs_begin_with_is_converted_as_far_as_it_can_be() {
    let of = |unit: &str, lines: &str| {
        let text = format!("[TRAJ]\nCOORDINATES = X\nLINEAR_UNITS = {unit}\n[RS274NGC]\n{lines}\n");
        convert("linuxcnc", &text)
    };
    let code = |unit: &str, code: &str| of(unit, &format!("RS274NGC_STARTUP_CODE = {code}"));
    let tolerance = |conversion: &Conversion| {
        let path = table(conversion).remove("path");
        path.and_then(|path| path.get("tolerance")?.as_float())
    };
    assert_eq!(tolerance(&code("mm", "G64 P0.05")), Some(0.05));
    assert_eq!(tolerance(&code("inch", "G64 P0.001")), Some(0.0254));
    assert_eq!(tolerance(&code("inch", "G21 G64 P0.05")), Some(0.05));
    assert_eq!(tolerance(&code("mm", "G20G64P0.001")), Some(0.0254));
    // No bound, or none that is allowed, is none here.
    for none in ["G64", "G64 P0", "G64 P100", "G4 P0.05", "o<begin> call"] {
        assert_eq!(tolerance(&code("mm", none)), None, "{none}");
    }
    // The stricter one of both.
    for (default, strictest) in [("0.01", 0.01), ("0.2", 0.05), ("0", 0.05)] {
        let lines = format!("G64_DEFAULT_TOLERANCE = {default}\nRS274NGC_STARTUP_CODE = G64 P0.05");
        assert_eq!(tolerance(&of("mm", &lines)), Some(strictest));
    }
    let gantry = sample("linuxcnc", "gantry-mm.ini");
    let note = |list: &[glidepath_migration::KeyVerdict]| {
        let is = |it: &&glidepath_migration::KeyVerdict| it.key.ends_with("STARTUP_CODE");
        list.iter().find(is).map(|it| it.note.clone())
    };
    let told = note(&gantry.changed).expect("a verdict");
    for words in [
        "P0.002",
        "F30 as path.default_feed",
        "G17 G40 G64 G90",
        "G20",
        "S1000",
        "Q0.001",
    ] {
        assert!(told.contains(words), "{told}");
    }
    assert!(gantry.configuration.contains("default_feed = 762.0"));
    assert!(note(&code("mm", "G17 G21 G64 P0.01").converted).is_some());
    assert!(note(&code("mm", "G20").no_counterpart).is_some());
}

#[test]
fn second_motors_of_a_printer_are_gantries() {
    let printer = sample("klipper", "gantry.cfg");
    for key in ["axis.Y.gantry_difference", "axis.Z.gantry_difference"] {
        assert_eq!(asks(&printer, key), 1, "{key}");
    }
    assert_eq!(asks(&printer, "axis.X.gantry_difference"), 0);
    let homes = table(&printer).remove("home").unwrap();
    let sequence = |joint: &str| {
        homes
            .get(joint)
            .and_then(|home| home.get("sequence")?.as_integer())
    };
    assert_eq!(
        ["J0", "J1", "J2", "J3", "J4"].map(sequence),
        [Some(1), Some(-2), Some(-3), Some(-2), None]
    );
    assert!(
        printer
            .configuration
            .contains("[stepper_z1] has no endstop_pin")
    );
    let third = printer
        .no_counterpart
        .iter()
        .any(|it| it.key == "[stepper_z2]step_pin" && it.note.contains("two joints here at most"));
    assert!(third, "{}", printer.configuration);
    // Only axes with drives of their own have second joints.
    let corexy = "[printer]\nkinematics: corexy\n[stepper_z]\nposition_max: 9\n[stepper_z1]\nstep_pin: PF1\n";
    let corexy = convert("klipper", corexy);
    assert_eq!(asks(&corexy, "axis.Z.gantry_difference"), 0);
    assert!(
        corexy.configuration.contains("servo"),
        "{}",
        corexy.configuration
    );
}

#[test]
fn ganged_axes_of_grblhal_are_asked_for() {
    let hal = sample("grbl", "gantry.txt");
    assert_eq!(asks(&hal, "axis.Y.gantry_difference"), 1);
    assert_eq!(asks(&hal, "axis.X.gantry_difference"), 0);
    let homes = table(&hal).remove("home").unwrap();
    let sequence = |joint: &str| {
        homes
            .get(joint)
            .and_then(|home| home.get("sequence")?.as_integer())
    };
    assert_eq!(
        ["J0", "J1", "J2", "J3"].map(sequence),
        [Some(2), Some(-2), Some(1), Some(-2)]
    );
    // By the second motor that is inverted; which one it is is not always said.
    let inverted = from_grbl("$8=1\n$110=600\n$111=600\n").unwrap();
    assert_eq!(asks(&inverted, "axis.X.gantry_difference"), 1);
    for text in ["$8=0\n$110=600\n", "[OPT:V2,15,128]\n$110=600\n"] {
        let conversion = from_grbl(text).unwrap();
        assert_eq!(asks(&conversion, "axis.X.gantry_difference"), 0);
        assert!(
            conversion.configuration.contains("which one is not said"),
            "{text}"
        );
    }
    let none = from_grbl("[OPT:V,15,128]\n$110=600\n").unwrap();
    assert!(!none.configuration.contains("which one is not said"));
}

#[test]
fn where_zero_is_follows_from_what_is_known() {
    let ends = |lines: &str| {
        let text = format!("$23=1\n$110=600\n$130=300\n{lines}");
        let conversion = from_grbl(&text).unwrap();
        let end = |key| number(&conversion, "axis", "X", key);
        end("min_position").zip(end("max_position"))
    };
    let (below, above) = (Some((-300.0, 0.0)), Some((0.0, 300.0)));
    for (lines, expected) in [
        // grblHAL by its name, its flags or its second line of options.
        ("$22=1\n[FIRMWARE:grblHAL]\n", below),
        ("$22=9\n", above),
        ("$22=1\n[NEWOPT:ENUMS,RT+,HOME]\n", below),
        // Others by what they were built with.
        ("$22=1\n[OPT:VZ,15,128]\n", above),
        ("$22=1\n[OPT:V,15,128]\n", below),
        ("$22=1\n[FIRMWARE:other]\n[OPT:VZ,15,128]\n", above),
        // Not said, or the letter and the flag are of different times.
        ("$22=1\n", None),
        ("$22=1\n[FIRMWARE:other]\n", None),
        ("$22=3\n[OPT:VNZ,35,1024,3,0]\n", None),
        // Off, whatever its flags.
        ("$22=8\n", None),
    ] {
        assert_eq!(ends(lines), expected, "{lines}");
    }
}
