//! Tests of `feed_forward` of a drive.

use super::super::parse;
use crate::config::{self, MachineConfig};
use glidepath_ethercat::FeedForward;

/// A machine with 2000 mm/s² and 200 mm/s in every axis.
fn machine() -> MachineConfig {
    let text = config::EMBEDDED.replace("source = \"none\"", "source = \"drives\"");
    config::parse("machine.toml", &text).unwrap()
}

fn file(feed_forward: &str) -> String {
    let drive = |joint: usize| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
             quick_stop = 2000.0\n"
        )
    };
    let [first, second, third] = [0, 1, 2].map(drive);
    format!(
        "[bus]\ninterface = \"eth9\"\n{first}feed_forward = {{ {feed_forward} }}\n{second}{third}"
    )
}

fn read(feed_forward: &str) -> FeedForward {
    let drives = parse("drives.toml", &file(feed_forward), &machine()).unwrap();
    assert_eq!(drives.drives[1].feed_forward, None);
    drives.drives[0].feed_forward.unwrap()
}

fn wrong(feed_forward: &str) -> String {
    let error = parse("drives.toml", &file(feed_forward), &machine()).unwrap_err();
    let told = error.diagnostics().iter().map(|told| {
        let help = told.help.as_deref().unwrap_or_default();
        format!("{}: {} ({help})", told.key, told.message)
    });
    told.collect::<Vec<_>>().join("\n")
}

#[test]
fn velocity_is_in_counts_unless_the_drive_has_another_unit() {
    let told = read("velocity = true");
    assert_eq!((told.velocity_units, told.torque), (Some(1000.0), None));
    let told = read("velocity = true, velocity_units = 120000.0");
    assert_eq!(told.velocity_units, Some(120_000.0));
}

#[test]
fn inertia_is_what_an_acceleration_takes() {
    // 2.4 kg·cm² by 2π/5 rad/s² a mm/s²: 3.0159e-4 N·m, of 1.27 N·m .2374747 thousandths.
    let told = read("inertia = 2.4, rated_torque = 1.27, revolution = 5.0, coulomb = 1.5");
    assert_eq!(told.velocity_units, None);
    let model = told.torque.unwrap();
    assert!(
        (model.per_acceleration - 0.237_474_72).abs() < 1e-8,
        "{model:?}"
    );
    assert_eq!((model.per_velocity, model.coulomb), (0.0, 15.0));
    assert_eq!((model.coulomb_v, model.most), (1.0, 500.0));
    let told = read(
        "acceleration_torque = 0.02, viscous = 0.03, coulomb = 4.0, friction_from = 0.5, most = 80.0",
    );
    let model = told.torque.unwrap();
    assert!((model.per_acceleration - 0.2).abs() < 1e-12);
    assert!((model.per_velocity - 0.3).abs() < 1e-12);
    assert_eq!(
        (model.coulomb, model.coulomb_v, model.most),
        (40.0, 0.5, 800.0)
    );
}

#[test]
fn what_does_not_go_together_is_told() {
    let none = wrong("velocity = false");
    assert!(none.contains("tells the drive nothing"), "{none}");
    let alone = wrong("inertia = 2.4");
    assert!(
        alone.contains("give all three, or that one alone"),
        "{alone}"
    );
    let both = wrong("acceleration_torque = 0.02, rated_torque = 1.0");
    assert!(both.contains("give all three, or that one alone"), "{both}");
    let unused = wrong("coulomb = 4.0, velocity_units = 3.0");
    assert!(
        unused.contains("counts for nothing without velocity = true"),
        "{unused}"
    );
    let range = wrong("coulomb = -1.0");
    assert!(range.contains("drive.feed_forward.coulomb"), "{range}");
}

#[test]
fn a_joint_that_takes_more_than_is_told_is_refused_with_what_it_takes() {
    let machine = machine();
    let axis = machine.axes[0];
    let takes = 0.03 * axis.max_acceleration + 4.0;
    let told = wrong("acceleration_torque = 0.03, coulomb = 4.0, most = 5.0");
    let wanted = format!("take {takes:.1} % of the rated torque, and 5 % are told at most");
    assert!(told.contains(&wanted), "{told}\n{wanted}");
    let told = read(&format!(
        "acceleration_torque = 0.03, coulomb = 4.0, most = {takes:?}"
    ));
    assert!(told.torque.is_some());
}
