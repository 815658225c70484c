//! Tests of hostile numbers: whatever stands at a key of a configuration, it is accepted or
//! refused, and soon: nothing is computed with numbers that were not found to be in their range.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use glidepath::config;
use glidepath::config::keys::{self, Takes};
use std::collections::BTreeSet;
use std::sync::mpsc;
use std::time::Duration;

/// The shipped machines, between them with every mechanism that has lengths.
const MACHINES: [&str; 7] = [
    "mill",
    "hexapod",
    "translational-hexapod",
    "nutating-head",
    "scara",
    "five-bar",
    "rotary-delta",
];

/// Numbers that are in no range, at the end of many, or nearly zero.
const HOSTILE: [&str; 12] = [
    "nan", "inf", "-inf", "0.0", "-0.0", "1e-300", "-1e-300", "1e300", "-1e300", "1e15", "-1.0",
    "1e-3",
];

/// Machines that are not shipped, with their keys at plausible values.
const OTHERS: [(&str, &str); 2] = [
    (
        "linear-delta",
        "rod = 250.0\nradius = 120.0\ntower_angles = [90.0, 210.0, 330.0]\n",
    ),
    (
        "five-axis",
        "layout = \"table-table\"\ntilt = \"A\"\ntool = 50.0\ntilt_point = [0.0, 0.0, -50.0]\n\
         rotary_point = [0.0, 0.0, -70.0]\nrotary_to_tilt = [0.0, 0.0, 0.0]\n\
         tilt_to_spindle = [0.0, 0.0, -40.0]\n",
    ),
];

/// Far longer than any of them takes.
const PATIENCE: Duration = Duration::from_secs(120);

fn shipped(name: &str) -> String {
    let path = format!("{}/../../config/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).expect("a shipped machine")
}

/// A machine with three axes and joints, and the table of a mechanism.
fn other((name, table): (&str, &str)) -> String {
    let mut text = format!("[machine]\nkinematics = \"{name}\"\n[machine.{name}]\n{table}");
    for axis in ["X", "Y", "Z"] {
        text += &format!(
            "[axis.{axis}]\nmin_position = -20.0\nmax_position = 20.0\nmax_velocity = 100.0\n\
             max_acceleration = 1000.0\nmax_jerk = 10000.0\n"
        );
    }
    for joint in 0..3 {
        text += &format!(
            "[joint.J{joint}]\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = 10000.0\n"
        );
    }
    text
}

/// The text with another number at a place.
fn with(text: &str, at: core::ops::Range<usize>, number: &str) -> String {
    format!("{}{number}{}", &text[..at.start], &text[at.end..])
}

/// The places of all numbers that are values, those in lists too.
fn numbers(text: &str) -> Vec<core::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut offset = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or_default();
        if let Some(equals) = code.find('=') {
            let values = &code[equals + 1..];
            let is_number = |c: char| c.is_ascii_digit() || "+-.e_".contains(c);
            let mut rest = 0;
            while let Some(start) = values[rest..].find(|c: char| c.is_ascii_digit() || c == '-') {
                let start = rest + start;
                let length = values[start..].find(|c| !is_number(c));
                let end = length.map_or(values.len(), |length| start + length);
                if !values.contains('"') {
                    let base = offset + equals + 1;
                    found.push(base + start..base + end);
                }
                rest = end;
            }
        }
        offset += line.len();
    }
    found
}

#[test]
fn no_number_hangs_the_configuration() {
    let texts = MACHINES.iter().map(|name| shipped(name));
    let texts: Vec<String> = texts.chain(OTHERS.map(other)).collect();
    let (done, waiting) = mpsc::channel();
    let mut tried = 0;
    for text in texts {
        let places = numbers(&text);
        assert!(places.len() > 8, "{text}");
        for place in places {
            for number in HOSTILE {
                let changed = with(&text, place.clone(), number);
                let key = text[..place.start].lines().last().unwrap_or_default();
                let said = format!("{key} {number}");
                let done = done.clone();
                // A thread of its own: one that hangs must not hang the test.
                std::thread::spawn(move || {
                    let refused = config::parse("m.toml", &changed).is_err();
                    done.send(refused).ok();
                });
                let refused = waiting.recv_timeout(PATIENCE);
                let refused = refused.unwrap_or_else(|_| panic!("{said}: no end"));
                let is_finite = number.parse::<f64>().is_ok_and(f64::is_finite);
                assert!(refused || is_finite, "{said} was accepted");
                tried += 1;
            }
        }
    }
    assert!(tried > 1000, "{tried}");
}

#[test]
fn every_mechanism_is_tried() {
    let kinds = MACHINES.iter().map(|name| {
        let machine = config::parse("m.toml", &shipped(name)).expect("a shipped machine");
        machine.kinematics()
    });
    // It has no numbers.
    let all = kinds.chain(OTHERS.map(|(name, _)| name)).chain(["corexy"]);
    assert_eq!(
        all.collect::<BTreeSet<_>>(),
        keys::all()
            .filter_map(|key| match (key.name, &key.takes) {
                ("machine.kinematics", Takes::Choice { of }) => Some(of.iter().copied()),
                _ => None,
            })
            .flatten()
            .collect()
    );
}
