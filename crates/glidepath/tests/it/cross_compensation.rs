//! Tests of the configuration of squareness and straightness: what they leave for programs, and what is refused.

#![allow(clippy::unwrap_used, reason = "a test")]

use glidepath::config::{self, MachineConfig};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::Kinematics as _;

const AXES: &str = "[axis.X]\nmin_position = 0.0\nmax_position = 300.0\nmax_velocity = 100.0\n\
                    max_acceleration = 1000.0\nmax_jerk = 20000.0\n\
                    [axis.Y]\nmin_position = -100.0\nmax_position = 400.0\nmax_velocity = 200.0\n\
                    max_acceleration = 3000.0\nmax_jerk = 50000.0\n\
                    [axis.Z]\nmin_position = -60.0\nmax_position = 0.0\nmax_velocity = 50.0\n\
                    max_acceleration = 1000.0\nmax_jerk = 20000.0\n\
                    [axis.C]\nmax_velocity = 50.0\nmax_acceleration = 1000.0\nmax_jerk = 20000.0\n";

/// The machine with tables, or what is wrong with them: place, key, message.
fn machine(tables: &str) -> Result<MachineConfig, String> {
    config::parse("machine.toml", &format!("{AXES}{tables}")).map_err(|error| error.to_string())
}

/// The same, with the line that a report names.
fn refused(tables: &str) -> String {
    let text = format!("{AXES}{tables}");
    let error = config::parse("machine.toml", &text).unwrap_err();
    let found = error.diagnostics().iter();
    let told = found.map(|found| {
        let (line, _) = error.line_and_column(found).unwrap_or_default();
        let help = found.help.clone().unwrap_or_default();
        format!("{line}: {}: {}; {help}\n", found.key, found.message)
    });
    told.collect()
}

#[test]
fn programs_have_what_the_corrections_leave_of_limits_and_travel() {
    let machine = machine("[squareness]\nXY = -0.2\n").unwrap();
    let x = &machine.axes[0];
    // Y adds a five-thousandth of what it may do: −0.08 to 0.02 mm.
    let (low, high) = x.travel.unwrap();
    assert!((low - 0.08).abs() < 1e-12 && (high - 299.98).abs() < 1e-12);
    for (left, joint, other) in [
        (x.max_velocity, 100.0, 200.0),
        (x.max_acceleration, 1000.0, 3000.0),
        (x.max_jerk, 20_000.0, 50_000.0),
    ] {
        let most = joint - 2e-4 * other;
        assert!(left <= most && left > most - 2e-4 * joint, "{left}");
    }
    let y = &machine.axes[1];
    assert_eq!((y.travel, y.max_velocity), (Some((-100.0, 400.0)), 200.0));
}

#[test]
fn corrections_add_up_and_are_added_to_the_axis_that_the_name_begins_with() {
    let tables = "[squareness]\nXZ = 0.5\n[straightness.ZX]\npositions = [0.0, 300.0]\ncorrections = [0.0, 0.03]\n\
                  [straightness.ZY]\npositions = [-100.0, 400.0]\ncorrections = [0.01, 0.01]\n";
    let machine = machine(tables).unwrap();
    let mut axes = AxisVector::zeros();
    (axes[0], axes[1], axes[2]) = (100.0, 200.0, -40.0);
    let joints = machine.mechanism.inverse(&axes).unwrap();
    let told = [joints[0] - 99.98, joints[1] - 200.0, joints[2] + 39.98];
    assert!(told.iter().all(|off| off.abs() < 1e-12), "{told:?}");
    let back = machine.mechanism.forward(&joints, &axes).unwrap();
    assert!((back - axes).amax() < 1e-12);
}

#[test]
fn what_is_no_correction_is_refused_with_its_line_and_its_reason() {
    let table = |name: &str, positions: &str, corrections: &str| {
        format!("[straightness.{name}]\npositions = [{positions}]\ncorrections = [{corrections}]\n")
    };
    let first = 1 + AXES.matches('\n').count();
    let cases = [
        ("[squareness]\nXY = 20.0\n".to_owned(), 1, "out of range"),
        ("[squareness]\nYX = 0.1\n".to_owned(), 1, "unknown key"),
        (
            table("ZX", "0.0, 100.0", "0.0"),
            0,
            "2 positions have 1 corrections",
        ),
        (
            table("ZX", "0.0", "0.1"),
            0,
            "a table has two points at least",
        ),
        (table("ZX", "0.0, 0.0", "0.0, 0.1"), 0, "positions ascend"),
        (table("ZX", "0.0, 100.0", "0.0, 1.5"), 0, "a wrong unit"),
        (
            table("ZX", "0.0, 1.0, 2.0", "0.0, 0.006, 0.0"),
            0,
            "they are rough",
        ),
        (table("ZZ", "0.0, 1.0", "0.0, 0.0"), 0, "along itself"),
        (
            table("ZQ", "0.0, 1.0", "0.0, 0.0"),
            0,
            "ZQ is no pair of axes",
        ),
        (
            table("XYZ", "0.0, 1.0", "0.0, 0.0"),
            0,
            "XYZ is no pair of axes",
        ),
        (
            table("ZA", "0.0, 1.0", "0.0, 0.0"),
            0,
            "the machine has no axis A",
        ),
        (
            table("ZC", "0.0, 1.0", "0.0, 0.0"),
            0,
            "C turns without end",
        ),
        (table("ZX", "0.0, 300.0", "10.0, 10.0"), 0, ""),
    ];
    for (tables, line, words) in cases {
        if words.is_empty() {
            assert!(machine(&tables).is_ok());
            continue;
        }
        let told = refused(&tables);
        let place = format!("{}: ", first + line);
        assert!(
            told.starts_with(&place) && told.contains(words),
            "{tables}: {told}"
        );
    }
    // Neither is too steep, and both together are.
    let both = format!(
        "[squareness]\nXY = 6.0\n{}",
        table("XZ", "0.0, 100.0", "0.0, -0.6")
    );
    let told = refused(&both);
    assert!(
        told.contains("straightness.XZ: the corrections change by 0.0120"),
        "{told}"
    );
}

#[test]
fn where_joints_are_not_axes_and_where_the_home_is_cut_off_is_told() {
    let core = format!(
        "[machine]\nkinematics = \"corexy\"\n[joint.J0]\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = \
         20000.0\n[joint.J1]\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = 20000.0\n{}",
        "[squareness]\nXY = 0.1\n"
    );
    let told = refused(&core);
    assert!(told.contains("only joints that are axes"), "{told}");
    let home = "[feedback]\nsource = \"drives\"\nhoming = \"controller\"\n[home.J0]\nsearch_velocity = -20.0\n\
                latch_velocity = 1.0\nsearch_travel = 400.0\nclearance = 5.0\nposition = 0.0\n[squareness]\nXY = -0.2\n";
    let told = refused(home);
    let words = "the home of J0, 0, is outside of the travel; give a position of 0.08";
    assert!(
        told.contains(words) && told.contains("[squareness]"),
        "{told}"
    );
}
