//! Tests of `probe` of a drive.

use super::super::parse;
use crate::config::{self, MachineConfig};

/// A machine whose probe is an input.
fn machine(input: u32) -> MachineConfig {
    let text = config::EMBEDDED.replacen("# input = 0\n", &format!("input = {input}\n"), 1);
    let text = text.replace("source = \"none\"", "source = \"drives\"");
    config::parse("machine.toml", &text).unwrap()
}

/// Three drives with this in their tables, and the probe's input.
fn file(probes: [&str; 3], input: u32) -> String {
    let drive = |(joint, probe): (usize, &str)| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
             quick_stop = 2000.0\n{probe}\n"
        )
    };
    let drives: String = probes.into_iter().enumerate().map(drive).collect();
    format!(
        "[bus]\ninterface = \"eth9\"\n{drives}[[device]]\nposition = 3\ninputs = [{{ bit = 1, number = {input} }}]\n"
    )
}

fn wrong(text: &str, machine: &MachineConfig) -> Vec<(usize, String)> {
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
fn every_drive_has_the_probe_or_none() {
    let probe = "probe = { number = 4 }";
    let other = "probe = { number = 4, unit = 2, source = 5, invert = true }";
    let drives = parse("drives.toml", &file([probe, probe, other], 4), &machine(4)).unwrap();
    let probes: Vec<_> = drives
        .drives
        .iter()
        .map(|drive| drive.probe.unwrap())
        .collect();
    assert_eq!(
        (probes[0].unit, probes[0].source, probes[0].is_inverted),
        (1, None, false)
    );
    assert_eq!(
        (probes[2].unit, probes[2].source, probes[2].is_inverted),
        (2, Some(5), true)
    );
    let told = wrong(&file([probe, "", probe], 4), &machine(4));
    assert_eq!(told, [(10, "J1 has no `probe`, and J0 has".to_owned())]);
}

#[test]
fn the_probe_is_an_input_of_the_file_and_that_of_the_machine() {
    let probe = "probe = { number = 4 }";
    let told = wrong(&file([probe; 3], 5), &machine(4));
    assert_eq!(
        told,
        [(3, "no input of this file has number = 4".to_owned())]
    );
    let told = wrong(&file([probe; 3], 4), &machine(5));
    assert_eq!(
        told,
        [(3, "input 4 is not the probe of the machine".to_owned())]
    );
    let other = "probe = { number = 6 }";
    let told = wrong(&file([probe, probe, other], 4), &machine(4));
    let message = "J2 has the probe of input 6, and J0 that of input 4".to_owned();
    assert_eq!(told, [(17, message)]);
    for (bad, message) in [
        (
            "probe = { number = 4, unit = 3 }",
            "drive.probe.unit = 3 is out of range",
        ),
        (
            "probe = { number = 64 }",
            "drive.probe.number = 64 is out of range",
        ),
        (
            "probe = { number = 4, source = 0 }",
            "drive.probe.source = 0 is out of range",
        ),
        ("probe = { number = 4, edge = 1 }", "unknown key `edge`"),
    ] {
        let told = wrong(&file([bad, probe, probe], 4), &machine(4));
        assert!(
            told.iter()
                .any(|(line, m)| *line == 9 && m.contains(message)),
            "{told:?}"
        );
    }
}

#[test]
fn the_index_pulse_is_kept_by_the_touch_probe_that_the_probe_has() {
    let plain = |index: &str| file([index, "", ""], 5);
    let drives = parse("drives.toml", &plain("index = 2"), &machine(4)).unwrap();
    let indices: Vec<_> = drives.drives.iter().map(|drive| drive.index).collect();
    assert_eq!(indices, [Some(2), None, None]);
    let both = "probe = { number = 4 }\nindex = 1";
    let drives = parse("drives.toml", &file([both; 3], 4), &machine(4)).unwrap();
    assert!(drives.drives.iter().all(|drive| drive.index == Some(1)));
    let told = wrong(&plain("index = 3"), &machine(4));
    assert!(
        told[0].0 == 9 && told[0].1.contains("drive.index = 3 is out of range"),
        "{told:?}"
    );
    let told = wrong(
        &file([both, both, "probe = { number = 4 }\nindex = 2"], 4),
        &machine(4),
    );
    let message =
        "the index pulse is kept by touch probe 2, and `probe` is touch probe 1".to_owned();
    assert_eq!(told, [(26, message)]);
}

#[test]
fn a_joint_that_comes_home_by_its_index_pulse_has_a_drive_that_keeps_it() {
    let homes: String = (0..3)
        .map(|joint| {
            format!(
                "[home.J{joint}]\nlatch_velocity = 2.0\nsearch_travel = 11.0\nindex = \"drive\"\n"
            )
        })
        .collect();
    let text = config::EMBEDDED.replace("source = \"none\"", "source = \"drives\"");
    let text = text.replace("homing = \"none\"", "homing = \"controller\"") + &homes;
    let machine = config::parse("machine.toml", &text).unwrap();
    let index = "index = 1";
    let told = wrong(&file([index, "", index], 5), &machine);
    let message =
        "[home.J1] of the machine has index = \"drive\", and the drive of J1 has no `index`"
            .to_owned();
    assert_eq!(told, [(10, message)]);
    assert!(parse("drives.toml", &file([index; 3], 5), &machine).is_ok());
}
