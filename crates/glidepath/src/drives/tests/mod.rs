//! Tests of `drives.toml`, right and wrong.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod devices;
mod drive_inputs;
mod encoder;
mod feed_forward;
mod gears;
mod joint_encoders;
mod touch_probe;

use super::{Found, parse, written};
use crate::config::{self, MachineConfig};
use glidepath_ethercat::{ClockKind, Device, Identity, Mapping, SyncManager};

/// The drives of a machine with three joints, as far as a file has to tell of them.
fn three_drives() -> String {
    let drive = |joint: usize| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
             quick_stop = 2000.0\n"
        )
    };
    (0..3).map(drive).collect()
}

fn machine(homing: &str) -> MachineConfig {
    let text = config::EMBEDDED.replace("homing = \"none\"", &format!("homing = \"{homing}\""));
    config::parse("machine.toml", &text).unwrap()
}

fn found(position: usize) -> Found {
    let window = Some((SyncManager::default(), SyncManager::default()));
    Found {
        device: Device {
            position,
            identity: Identity {
                vendor: 0xe1e,
                product: 0x402,
                revision: 1,
                serial: 0,
            },
            name: format!("DRIVE {position}"),
            mailbox: window,
            has_coe: true,
            process: window,
            lacks_lrw: false,
            clock: ClockKind::Bits64,
            open_ports: [true, true, false, false],
            ..Device::default()
        },
        counts_per_revolution: Some(8_388_608.0),
        modes: Some((true, true)),
        axes: 1,
        probes: Vec::new(),
        windows: Vec::new(),
        watchdog: None,
    }
}

/// What is wrong with a text: line and message of each.
fn wrong(text: &str) -> Vec<(usize, String)> {
    told(text, &machine("none"))
}

/// The same on a machine.
fn told(text: &str, machine: &MachineConfig) -> Vec<(usize, String)> {
    let error = parse("drives.toml", text, machine).unwrap_err();
    let diagnostics = error.diagnostics().iter();
    diagnostics
        .map(|told| {
            let line = error.line_and_column(told).map_or(0, |(line, _)| line);
            (line, told.message.clone())
        })
        .collect()
}

#[test]
fn limits_of_torque_are_in_percent_and_of_each_direction() {
    let drive = |joint: usize, more: &str| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
             quick_stop = 2000.0\n{more}\n"
        )
    };
    let file = |more: &str| {
        let [first, second, third] = [drive(0, more), drive(1, ""), drive(2, "")];
        format!("[bus]\ninterface = \"eth9\"\n{first}{second}{third}")
    };
    let text = file("torque_positive = 80.0\ntorque_negative = 62.5");
    let drives = parse("drives.toml", &text, &machine("none"))
        .unwrap()
        .drives;
    assert_eq!(drives[0].torque_limits, [Some(800), Some(625)]);
    assert_eq!(drives[1].torque_limits, [None, None]);
    let told = wrong(&file("torque_positive = 0.0"));
    assert!(told[0].1.contains("drive.torque_positive"), "{told:?}");
}

#[test]
fn a_first_file_is_refused_until_somebody_says_how_far_a_turn_is() {
    let text = written("enp3s0", &[found(0), found(1), found(2)]);
    assert!(text.contains("8388608 counts of a revolution"), "{text}");
    let told = wrong(&text);
    assert_eq!(told.len(), 3, "{told:?}");
    assert!(
        told[0]
            .1
            .contains("drive.counts_per_mm = 0 counts is out of range"),
        "{told:?}"
    );
    let line = text
        .lines()
        .position(|line| line.starts_with("counts_per_mm"))
        .unwrap();
    assert_eq!(told[0].0, line + 1);
    let mended = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let drives = parse("drives.toml", &mended, &machine("none")).unwrap();
    assert_eq!(
        (drives.interface.as_str(), drives.bus.period_ns),
        ("enp3s0", 2_000_000)
    );
    assert_eq!(
        (drives.drives[2].joint, drives.drives[2].vendor),
        (2, 0xe1e)
    );
    assert!((drives.drives[1].max_v - 200.0).abs() < 1e-9);
    // What is written for machines without absolute encoders is right, too.
    let homes = mended.replace("# homing = {", "homing = {");
    let drives = parse("drives.toml", &homes, &machine("drive")).unwrap();
    assert_eq!(drives.drives[0].homing.unwrap().method, 17);
    assert!(
        wrong(&homes)[0]
            .1
            .contains("does not have drives find their home")
    );
}

#[test]
fn everything_that_is_wrong_is_told_with_its_place() {
    let text = "[bus]\ninterface = \"eth9\"\nperiod_us = 100\n[[drive]]\njoint = 7\nposition = 0\n\
                counts_per_mm = 1000.0\nfollowing_error = 1.0\nquick_stop = 1e99\ncolour = 3\n";
    let told = wrong(text);
    let has = |line: usize, words: &str| told.iter().any(|(l, m)| *l == line && m.contains(words));
    assert!(has(10, "unknown key `colour`"), "{told:?}");
    assert!(has(3, "bus.period_us = 100 is out of range"), "{told:?}");
    let drive = "[[drive]]\njoint = 0\nposition = 0\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
                 quick_stop = 2000.0\n";
    let twice = format!("[bus]\ninterface = \"eth9\"\n{drive}{drive}");
    let told = wrong(&twice);
    assert!(
        told.iter()
            .any(|(_, m)| m == "two drives have the same joint"),
        "{told:?}"
    );
    assert!(
        told.iter()
            .any(|(_, m)| m == "J1 of the machine has no drive"),
        "{told:?}"
    );
}

#[test]
fn what_is_no_drive_gets_no_table() {
    let mut other = found(1);
    other.modes = None;
    let text = written("eth1", &[found(0), other]);
    assert_eq!(text.matches("[[drive]]").count(), 1);
    assert!(
        text.contains("alias 0: no drive, without process data"),
        "{text}"
    );
}

#[test]
fn a_drive_may_keep_its_maps() {
    let text = written("enp3s0", &[found(0), found(1), found(2)]);
    let mended = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let kept = mended.replacen("invert = false\n", "invert = false\nmap = \"keep\"\n", 1);
    let drives = parse("drives.toml", &kept, &machine("none")).unwrap();
    let mappings: Vec<_> = drives.drives.iter().map(|drive| drive.mapping).collect();
    let (kept, written) = (Mapping::Kept, Mapping::Written);
    assert_eq!(mappings, [kept, written, written]);
    let other = mended.replacen("invert = false\n", "invert = false\nmap = \"kept\"\n", 1);
    let told = wrong(&other);
    let line = other
        .lines()
        .position(|line| line.starts_with("map"))
        .unwrap()
        + 1;
    let is_told = |(at, what): &(usize, String)| *at == line && what.contains("`keep`");
    assert!(told.iter().any(is_told), "{told:?}");
}

#[test]
fn a_drive_whose_eeprom_does_not_say_where_its_data_is_asks_for_it() {
    let mut silent = found(1);
    silent.device.process = None;
    let text = written("enp3s0", &[found(0), silent, found(2)]);
    let text = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let told = wrong(&text);
    let line = |key: &str| text.lines().position(|line| line.starts_with(key)).unwrap() + 1;
    let lines: Vec<_> = told.iter().map(|(line, _)| *line).collect();
    assert_eq!(lines, [line("outputs_at"), line("inputs_at")], "{told:?}");
    let mended = text.replace("outputs_at = 0x0", "outputs_at = 0x1100");
    let one = mended.replace("inputs_at = 0x0\n", "");
    assert!(wrong(&one)[0].1.contains("both outputs_at and inputs_at"));
    let mended = mended.replace("inputs_at = 0x0", "inputs_at = 0x1400");
    let drives = parse("drives.toml", &mended, &machine("none")).unwrap();
    let places: Vec<_> = drives.drives.iter().map(|drive| drive.process_at).collect();
    assert_eq!(places, [None, Some((0x1100, 0x1400)), None]);
}

#[test]
fn a_device_with_several_drives_has_a_table_for_each() {
    let mut both = found(0);
    both.axes = 2;
    let text = written("enp3s0", &[both, found(1)]);
    let text = text.replace("counts_per_mm = 0.0", "counts_per_mm = 1677721.6");
    let drives = parse("drives.toml", &text, &machine("none"))
        .unwrap()
        .drives;
    let places: Vec<_> = drives
        .iter()
        .map(|d| (d.joint, d.position, d.axis))
        .collect();
    assert_eq!(places, [(0, 0, 0), (1, 0, 1), (2, 1, 0)]);
    assert_eq!(drives[1].map_step, 0x10);
    let line = |text: &str, key: &str| text.lines().position(|l| l.starts_with(key)).unwrap() + 1;
    for (from, to, words) in [
        (
            "axis = 1\n",
            "axis = 0\n",
            "two drives have the same position",
        ),
        ("axis = 1\n", "axis = 8\n", "drive.axis = 8 is out of range"),
        (
            "axis = 1\n",
            "axis = 1\nmap_step = 1\n",
            "drives of one device differ in what is the",
        ),
        (
            "axis = 1\n",
            "axis = 1\nmap_step = 0\n",
            "drive.map_step = 0 is out of range",
        ),
    ] {
        let text = text.replace(from, to);
        let told = wrong(&text);
        let is_told = |(_, what): &(usize, String)| what.contains(words);
        let found = told.iter().find(|told| is_told(told));
        assert!(found.is_some(), "{to}: {told:?}");
        if to.contains('8') {
            assert_eq!(found.unwrap().0, line(&text, "axis = 8"));
        }
    }
}
