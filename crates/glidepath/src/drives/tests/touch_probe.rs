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
