//! Tests of `inputs` of a drive.

use super::super::parse;
use super::{machine, wrong};
use glidepath_ethercat::At;

/// Three drives, the last one with these inputs, and a terminal.
fn file(inputs: &str) -> String {
    let drive = |joint: usize| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 1000.0\nfollowing_error = 1.0\n\
             quick_stop = 2000.0\n"
        )
    };
    let drives: String = (0..3).map(drive).collect();
    format!(
        "[bus]\ninterface = \"eth9\"\n{drives}inputs = [{inputs}]\n[[device]]\nposition = 3\n\
         inputs = [{{ bit = 1, number = 3 }}]\n"
    )
}

#[test]
fn bits_of_a_drive_are_switches_and_inputs() {
    let text = file(
        "{ bit = 0, limit_low = 2 }, { bit = 1, limit_high = 2, invert = true }, { bit = 26, number = 0 }",
    );
    let drives = parse("drives.toml", &text, &machine("none")).unwrap();
    let reads: Vec<_> = drives.drives.iter().map(|drive| drive.has_inputs).collect();
    assert_eq!(reads, [false, false, true]);
    let inputs = &drives.drive_inputs;
    assert!(inputs.iter().all(|(drive, _)| *drive == 2));
    let bits: Vec<_> = inputs.iter().map(|(_, input)| input.at).collect();
    assert_eq!(bits, [At::Bit(0), At::Bit(1), At::Bit(26)]);
    let meant = (
        inputs[0].1.limit_low,
        inputs[1].1.limit_high,
        inputs[2].1.number,
    );
    assert_eq!(meant, (Some(2), Some(2), Some(0)));
    assert!(inputs[1].1.is_inverted && !inputs[0].1.is_inverted);
}

#[test]
fn what_is_wrong_with_an_input_of_a_drive_is_told_with_its_place() {
    for (input, message) in [
        (
            "{ bit = 32, number = 0 }",
            "drive.inputs.bit = 32 is out of range",
        ),
        (
            "{ at = \"0x60fd:00\", number = 0 }",
            "an input of a drive is a `bit` of its 0x60FD",
        ),
        (
            "{ number = 0 }",
            "an input of a drive is a `bit` of its 0x60FD",
        ),
        ("{ bit = 2 }", "nothing is said of what this input is"),
        // That of the terminal.
        ("{ bit = 2, number = 3 }", "two inputs are digital input 3"),
        ("{ bit = 2, home = 3 }", "home = 3 is out of range"),
    ] {
        let told = wrong(&file(input));
        let line = if input.contains("number = 3") { 24 } else { 21 };
        let is_told = |(at, told): &(usize, String)| *at == line && told.contains(message);
        assert!(told.iter().any(is_told), "{input}: {told:?}");
    }
}
