//! Tests that a number which a hint shows is allowed, and gentle.

use super::{finding, last, load, machine_with, put};
use glidepath::config::keys::{self, Takes};
use toml::Value;

#[test]
fn a_hint_shows_a_number_that_loads() {
    let mut count = 0;
    for key in keys::all() {
        if !matches!(key.takes, Takes::Number { .. } | Takes::Whole { .. }) {
            continue;
        }
        let mut machine = machine_with(key.name);
        put(
            &mut machine,
            key.name,
            Value::String("to be chosen".to_owned()),
        );
        let found = load(&machine).expect_err("text");
        let found = found.iter().find(|found| found.key == key.name);
        let help = found.and_then(|found| found.help.clone()).expect("a help");
        let Some((_, hint)) = help.split_once(&format!("such as {} = ", last(key.name))) else {
            assert_eq!(
                keys::example(key.name, |_| None),
                None,
                "{}: {help}",
                key.name
            );
            continue;
        };
        count += 1;
        let hint: toml::Table = format!("hint = {hint}").parse().expect("a value");
        let hint = hint.get("hint").cloned().expect("a value");
        assert_eq!(finding(key, hint.clone()), None, "{} = {hint}", key.name);
        put(&mut machine, key.name, hint.clone());
        let found = load(&machine).err().unwrap_or_default();
        let is_refused = found.iter().any(|found| found.key == key.name);
        assert!(!is_refused, "{} = {hint}: {found:?}", key.name);
    }
    assert!(count > 20, "{count} hints");
}

#[test]
fn hints_are_gentle_and_go_with_what_stands_beside_them() {
    let example = |name: &str, beside: &[(&str, f64)]| {
        keys::example(name, |key| {
            let found = beside.iter().find(|(of, _)| *of == key);
            found.map(|(_, number)| *number)
        })
    };
    for (name, beside, shown) in [
        ("path.tolerance", &[][..], "0.02"),
        ("axis.Y.gantry_difference", &[], "0.1"),
        ("axis.C.max_velocity", &[], "10.0"),
        ("axis.C.max_velocity", &[("max_acceleration", 4.0)], "2.0"),
        ("axis.Z.max_acceleration", &[], "100.0"),
        (
            "axis.Z.max_acceleration",
            &[("max_velocity", 300.0)],
            "600.0",
        ),
        ("axis.X.max_jerk", &[], "1000.0"),
        ("axis.X.max_jerk", &[("max_acceleration", 900.0)], "9000.0"),
        ("axis.X.max_position", &[], "1.0"),
        ("axis.X.min_position", &[("max_position", -5.0)], "-7.0"),
    ] {
        assert_eq!(example(name, beside).as_deref(), Some(shown), "{name}");
    }
    for name in [
        "machine.linear-delta.rod",
        "home.J0.clearance",
        "joint.J3.max_jerk",
        "axis",
        "nothing.here",
    ] {
        assert_eq!(example(name, &[]), None, "{name}");
    }
}
