//! Tests of the gears of a spindle, beside those of the machine.

use super::super::parse;
use super::{three_drives, told};
use crate::config::{self, MachineConfig};
use glidepath_ethercat::{Signal, Swing};

/// The first table of the section of the manual, which has all of it.
fn example() -> &'static str {
    let page = include_str!("../../../docs/drives.md");
    let (_, section) = page.split_once("\n#### Gears\n").unwrap();
    let (_, example) = section.split_once("```toml\n").unwrap();
    example.split_once("```").unwrap().0
}

fn file(devices: &str) -> String {
    let drives = three_drives();
    format!("[bus]\ninterface = \"eth9\"\n{drives}{devices}")
}

/// A machine with the gears of the manual, or with others.
fn machine(spindle: &str) -> MachineConfig {
    let text = config::EMBEDDED.replace("[spindle]\n", &format!("[spindle]\n{spindle}\n"));
    config::parse("machine.toml", &text).unwrap()
}

const GEARS: &str = "gear_max = [800.0, 4000.0]\ngear_min = [20.0, 100.0]";

#[test]
fn the_gears_of_the_manual_are_read() {
    let drives = parse("drives.toml", &file(example()), &machine(GEARS)).unwrap();
    let spindle = drives.terminals[2].spindle.unwrap();
    let gears = spindle.gears.unwrap();
    let read: Vec<_> = gears
        .all()
        .map(|(number, gear)| (number, gear.input, gear.is_inverted))
        .collect();
    assert_eq!(read, [(1, 10, false), (2, 11, true)]);
    let of = |number| *gears.of(number).unwrap();
    let numbers = [of(1), of(2)].map(|gear| [gear.ratio, gear.max_rpm, gear.ramp_rpm_per_s]);
    let expected = [[4.0, 800.0, 800.0], [0.8, 4000.0, 2000.0]];
    assert!(numbers == expected, "{numbers:?}");
    let swing = Swing {
        rpm: 30.0,
        way_ns: 500_000_000,
    };
    assert_eq!(
        (gears.swing, gears.within_ns),
        (Some(swing), 10_000_000_000)
    );
    let from = drives.terminals[1].outputs.iter().map(|output| output.from);
    let signals = [1, 2].map(Signal::SpindleGear);
    assert!(from.eq(signals));
    // Without swing_rpm the motor stands.
    let still = example().replace("{ swing_rpm = 30.0 }", "{ within_s = 2.5 }");
    let drives = parse("drives.toml", &file(&still), &machine(GEARS)).unwrap();
    let gears = drives.terminals[2].spindle.unwrap().gears.unwrap();
    assert_eq!((gears.swing, gears.within_ns), (None, 2_500_000_000));
}

#[test]
fn what_is_wrong_with_gears_is_told() {
    for (from, to, message) in [
        (
            "ratio = 4.0",
            "ratio = 0.0",
            "device.spindle.gears.ratio = 0",
        ),
        (
            "input = 11",
            "input = 10",
            "input 10 says that two gears are in",
        ),
        (
            "input = 11",
            "input = 64",
            "device.spindle.gears.input = 64 is no number of an input",
        ),
        (
            "input = 11",
            "input = 12",
            "no device has input 12, which says that gear 2 is in",
        ),
        (
            "max_rpm = 800.0, ",
            "max_rpm = 5000.0, ",
            "is more than max_rpm of the spindle, 4000",
        ),
        (
            "max_rpm = 800.0, ",
            "max_rpm = 700.0, ",
            "gear 1 turns at 700 rev/min at most, and programs may turn it at 800",
        ),
        (
            "ratio = 0.8",
            "ratio = 10.0",
            "its motor turns at 40000 rev/min, which is more than its drive can be told",
        ),
        (
            "{ swing_rpm = 30.0 }",
            "{ swing_s = 0.2 }",
            "the motor does not turn while a gear is changed",
        ),
        (
            "], shift",
            "], orientation = { counts_per_rev = 4096, max_rpm = 60.0 }, shift",
            "a spindle with gears is not turned to an angle by its drive",
        ),
        (
            "\"spindle.gear 2\"",
            "\"spindle.gear 6\"",
            "\"spindle.gear 6\" is not known",
        ),
    ] {
        let text = example().replace(from, to);
        assert_ne!(text, example(), "{from}");
        let wrong = told(&file(&text), &machine(GEARS));
        assert!(
            wrong.iter().any(|(_, found)| found.contains(message)),
            "{message}: {wrong:?}"
        );
    }
    let none = told(&file(example()), &machine(""));
    assert_eq!(
        none[0].1,
        "the spindle has 2 gears here, and 0 in the machine's configuration"
    );
    let without = "[[device]]\nposition = 3\nspindle = { mode = \"velocity\", max_rpm = 4000.0, ramp = 2000.0, shift = {} }\n";
    assert_eq!(
        told(&file(without), &machine(""))[0].1,
        "a spindle without gears changes none"
    );
}

#[test]
fn the_machine_says_the_speeds_of_its_gears() {
    let gears = machine(GEARS).gears;
    assert_eq!(
        (gears.count(), gears.most_rpm(2), gears.most_rpm(3)),
        (2, Some(4000.0), None)
    );
    let told = |spindle: &str, others: &str| {
        let text = config::EMBEDDED.replace("[spindle]\n", &format!("[spindle]\n{spindle}\n"));
        let text = others
            .split('|')
            .fold(text, |text, change| match change.split_once("=>") {
                Some((from, to)) => text.replace(from, to),
                None => text,
            });
        let error = config::parse("machine.toml", &text).unwrap_err();
        format!("{error:?}")
    };
    for (spindle, others, message) in [
        (
            "gear_max = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]",
            "",
            "gear_max has 6 gears",
        ),
        (
            "gear_max = [800.0]\ngear_min = [1.0, 2.0]",
            "",
            "gear_min has 2 speeds, and gear_max 1",
        ),
        (
            "gear_max = [800.0]\ngear_min = [800.0]",
            "",
            "the lowest speed of gear 1, 800 rev/min, is not below its highest, 800",
        ),
        (
            "gear_min = [20.0]",
            "",
            "the spindle has no gears, whose speeds or choice are said here",
        ),
        (
            GEARS,
            "source = \"none\"=>source = \"drives\"",
            "nobody says when the gear of M41 is in",
        ),
    ] {
        let found = told(spindle, others);
        assert!(found.contains(message), "{message}: {found}");
    }
}
