//! Tests of `joint_encoders` of a device.

use super::super::parse;
use super::{machine, three_drives, wrong};
use glidepath_ethercat::{At, EncoderUse};

fn file(devices: &str) -> String {
    let drives = three_drives();
    format!("[bus]\ninterface = \"eth9\"\n{drives}[[device]]\nposition = 3\n{devices}")
}

#[test]
fn a_device_has_encoders_of_joints() {
    let text = file(
        "joint_encoders = [\n{ joint = 2, use = \"position\", counts_per_mm = 2000.0, apart = 0.2, home_offset = -4.5 },\n\
         { joint = 0, use = \"watch\", at = \"0x6010:11\", counts_per_deg = 10.0, apart = 1.0, invert = true },\n]\n",
    );
    let drives = parse("drives.toml", &text, &machine("none")).unwrap();
    let [one, other] = drives.terminals[0].joint_encoders[..] else {
        panic!("{:?}", drives.terminals);
    };
    let at = |index, sub| At::Object { index, sub };
    assert_eq!((one.joint, one.used), (2, EncoderUse::Position));
    assert_eq!((one.at, one.home_offset), (at(0x6000, 0x11), Some(-4.5)));
    assert!(!one.is_inverted && other.is_inverted);
    assert_eq!((other.joint, other.used), (0, EncoderUse::Watch));
    assert_eq!((other.at, other.home_offset), (at(0x6010, 0x11), None));
    let bits = |numbers: [f64; 2]| numbers.map(f64::to_bits);
    assert_eq!(bits([one.counts_per_unit, one.apart]), bits([2000.0, 0.2]));
    assert_eq!(
        bits([other.counts_per_unit, other.apart]),
        bits([10.0, 1.0])
    );
}

#[test]
fn what_is_wrong_with_an_encoder_of_a_joint_is_told_with_its_place() {
    let good = "joint = 0, use = \"position\", counts_per_mm = 2000.0, apart = 0.2";
    for (from, to, message) in [
        (
            "joint = 0",
            "joint = 3",
            "device.joint_encoders.joint = 3 is out of range",
        ),
        (
            "\"position\"",
            "\"both\"",
            "device.joint_encoders.use = \"both\" is not known",
        ),
        (
            "counts_per_mm = 2000.0, ",
            "",
            "an encoder has counts_per_mm, or counts_per_deg",
        ),
        (
            "apart = 0.2",
            "apart = 0.0",
            "device.joint_encoders.apart = 0",
        ),
        ("apart = 0.2", "apart = 0.2, at = \"6000\"", "is no object"),
        (
            "apart = 0.2",
            "apart = 0.2, lines = 1",
            "unknown key `lines`",
        ),
        (
            "\"position\"",
            "\"watch\", home_offset = 1.0",
            "home_offset is for an encoder with use = \"position\"",
        ),
        (
            "apart = 0.2",
            "apart = 0.2, signed = false",
            "signed is for an absolute encoder, with home_offset",
        ),
    ] {
        let encoder = good.replace(from, to);
        let told = wrong(&file(&format!("joint_encoders = [{{ {encoder} }}]\n")));
        let is_told = |(line, told): &(usize, String)| *line == 23 && told.contains(message);
        assert!(told.iter().any(is_told), "{message}: {told:?}");
    }
    let absolute = format!("joint_encoders = [{{ {good}, home_offset = 1.0, signed = false }}]\n");
    let drives = parse("drives.toml", &file(&absolute), &machine("none")).unwrap();
    assert!(drives.terminals[0].joint_encoders[0].is_unsigned);
    let turning = file(&absolute).replacen(
        "quick_stop = 2000.0",
        "quick_stop = 2000.0\nmodulo = true",
        1,
    );
    let told = wrong(&turning);
    let says =
        |(line, told): &(usize, String)| *line == 24 && told.starts_with("J0 turns on and on");
    assert!(told.iter().any(says), "{told:?}");
    let twice = format!("joint_encoders = [{{ {good} }},\n{{ {good} }}]\n");
    let told = wrong(&file(&twice));
    assert_eq!(told, [(24, "J0 has two encoders at terminals".to_owned())]);
}
