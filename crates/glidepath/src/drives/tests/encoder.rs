//! Tests of `encoder` of a device.

use super::super::parse;
use super::{machine, three_drives, wrong};

fn file(devices: &str) -> String {
    let drives = three_drives();
    format!("[bus]\ninterface = \"eth9\"\n{drives}{devices}")
}

#[test]
fn a_device_has_the_encoder_of_the_spindle() {
    let text = file(
        "[[device]]\nposition = 3\nencoder = { counts_per_rev = 4096 }\n[[device]]\nposition = 4\n",
    );
    let drives = parse("drives.toml", &text, &machine("none")).unwrap();
    let encoder = drives.terminals[0].encoder.unwrap();
    let (counts, near_r) = (encoder.counts_per_rev, encoder.near_r);
    assert_eq!(
        (counts, encoder.has_index, encoder.is_inverted),
        (4096, true, false)
    );
    assert!((near_r - 0.03).abs() < 1e-12);
    assert_eq!(drives.terminals[1].encoder, None);
    let other = text.replace("4096", "360, index = false, invert = true, at_speed = 0.1");
    let drives = parse("drives.toml", &other, &machine("none")).unwrap();
    let encoder = drives.terminals[0].encoder.unwrap();
    assert!(!encoder.has_index && encoder.is_inverted && encoder.near_r > 0.09);
}

#[test]
fn what_is_wrong_with_an_encoder_is_told_with_its_place() {
    for (encoder, message) in [
        (
            "{ counts_per_rev = 3 }",
            "device.encoder.counts_per_rev = 3 is out of range",
        ),
        (
            "{ counts_per_rev = 4096, at_speed = 0.9 }",
            "device.encoder.at_speed = 0.9",
        ),
        (
            "{ counts_per_rev = 4096, lines = 1 }",
            "unknown key `lines`",
        ),
    ] {
        let told = wrong(&file(&format!(
            "[[device]]\nposition = 3\nencoder = {encoder}\n"
        )));
        let is_told = |(line, told): &(usize, String)| *line == 23 && told.contains(message);
        assert!(told.iter().any(is_told), "{told:?}");
    }
    let one = "[[device]]\nposition = 3\nencoder = { counts_per_rev = 4096 }\n";
    let told = wrong(&file(&format!("{one}{}", one.replace('3', "4"))));
    assert_eq!(
        told,
        [(26, "two devices have the encoder of the spindle".to_owned())]
    );
}
