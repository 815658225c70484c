//! The table of keys against the loader: it says what the loader does, all of it, and nothing else.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

mod effects;
mod hints;
mod told;

use glidepath::config::keys::{self, Key, LeftOut, Takes};
use glidepath::config::{self, ConfigDiagnostic, MachineConfig};
use std::collections::{BTreeMap, BTreeSet};
use toml::{Table, Value};

fn shipped(name: &str) -> Table {
    let path = format!("{}/../../config/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a shipped machine");
    text.parse().expect("TOML")
}

fn parsed(text: &str) -> Table {
    text.parse().expect("TOML")
}

/// A machine that has the table a key is of, as the first part of its name says.
fn machine_with(key: &str) -> Table {
    let travel = "min_position = -100\nmax_position = 1000\n";
    let axes = |names: &str| {
        let limits = "max_velocity = 10\nmax_acceleration = 100\nmax_jerk = 1000\n";
        let axis = |name| format!("[axis.{name}]\n{travel}{limits}");
        names.chars().map(axis).collect::<String>()
    };
    // So strong that they leave the axes all of their limits.
    let joints = |count: usize| {
        let limits = "max_velocity = 1e5\nmax_acceleration = 1e7\nmax_jerk = 1e10\n";
        let joint = |j| format!("[joint.J{j}]\n{travel}{limits}");
        (0..count).map(joint).collect::<String>()
    };
    let layout = match key {
        "machine.five-axis.rotary_to_tilt" | "machine.five-axis.tilt_to_spindle" => "head-head",
        _ => "table-table",
    };
    if key.starts_with("machine.linear-delta") {
        let own = "[machine]\nkinematics = 'linear-delta'\n[machine.linear-delta]\nrod = 2000\nradius = 500\n";
        return parsed(&format!("{own}{}{}", axes("XYZ"), joints(3)));
    }
    let of_tools_that_turn = ["path.direction_tolerance", "program.unwind"];
    if key.starts_with("machine.five-axis") || of_tools_that_turn.contains(&key) {
        let own = format!(
            "[machine]\nkinematics = 'five-axis'\n[machine.five-axis]\nlayout = '{layout}'\n\
             tilt = 'A'\ntool = 100\n"
        );
        return parsed(&format!("{own}{}{}", axes("XYZAC"), joints(5)));
    }
    if key.starts_with("machine.translational-hexapod") {
        let own = "[machine]\nkinematics = 'translational-hexapod'\n\
                   [machine.translational-hexapod]\nradius_difference = 100\n";
        let mut machine = parsed(&format!("{own}{}{}", axes("XYZ"), joints(6)));
        put(&mut machine, "axis.Z.min_position", Value::Integer(500));
        return machine;
    }
    if key.starts_with("compensation.") {
        return shipped("mill");
    }
    if key.starts_with("straightness.") {
        let mut machine = shipped("mill");
        for (name, numbers) in [
            ("positions", [0.0, 100.0, 200.0]),
            ("corrections", [0.0, 0.01, 0.0]),
        ] {
            let numbers = numbers.map(Value::Float).to_vec();
            put(
                &mut machine,
                &format!("straightness.ZX.{name}"),
                Value::Array(numbers),
            );
        }
        return machine;
    }
    if key.starts_with("home.") {
        let mut machine = shipped("mill");
        put(&mut machine, "home.J0.shared", Value::Boolean(false));
        return machine;
    }
    if key.starts_with("superposition.") {
        let mut machine = shipped("mill");
        put(
            &mut machine,
            "superposition.axis",
            Value::String("Z".to_owned()),
        );
        put(&mut machine, "superposition.input", Value::Integer(0));
        put(
            &mut machine,
            "feedback.source",
            Value::String("drives".to_owned()),
        );
        return machine;
    }
    match key.split('.').nth(1) {
        Some(name @ ("scara" | "five-bar" | "rotary-delta" | "hexapod")) => shipped(name),
        Some("J0") => shipped("scara"),
        _ => shipped("mill"),
    }
}

/// The table that holds a key, made if there is none.
fn holder<'t>(root: &'t mut Table, key: &str) -> &'t mut Table {
    let (path, _) = key.rsplit_once('.').expect("a dotted name");
    path.split('.').fold(root, |table, name| {
        let entry = table.entry(name).or_insert_with(|| Table::new().into());
        entry.as_table_mut().expect("a table")
    })
}

fn last(key: &str) -> &str {
    key.rsplit('.').next().expect("a name")
}

fn put(root: &mut Table, key: &str, value: Value) {
    holder(root, key).insert(last(key).to_owned(), value);
}

fn without(root: &mut Table, key: &str) {
    holder(root, key).remove(last(key));
}

fn load(root: &Table) -> Result<MachineConfig, Vec<ConfigDiagnostic>> {
    config::parse("test", &root.to_string()).map_err(|error| error.diagnostics().to_vec())
}

/// What the loader finds wrong with the value of a key by itself.
fn finding(key: &Key, value: Value) -> Option<ConfigDiagnostic> {
    let mut machine = machine_with(key.name);
    put(&mut machine, key.name, value);
    let found = load(&machine).err().unwrap_or_default();
    found.into_iter().find(|found| {
        let by_itself = ["out of range", "is not known", "cannot name"];
        found.key == key.name && by_itself.iter().any(|words| found.message.contains(words))
    })
}

/// What the loader says the keys of each table are, asked for by one that does not exist.
fn known_to_the_loader() -> BTreeMap<String, BTreeSet<String>> {
    let mut tables: BTreeSet<String> = keys::all()
        .map(|key| {
            key.name
                .rsplit_once('.')
                .expect("a dotted name")
                .0
                .to_owned()
        })
        .collect();
    tables.insert(String::new());
    tables
        .into_iter()
        .map(|table| {
            let key = format!("{table}.nobody_has_such_a_key");
            let key = key.trim_start_matches('.').to_owned();
            let mut machine = machine_with(&key);
            if table.is_empty() {
                machine.insert(key.clone(), Value::Integer(1));
            } else {
                put(&mut machine, &key, Value::Integer(1));
            }
            let found = load(&machine).expect_err("an unknown key");
            let told = found
                .iter()
                .find(|found| found.message.contains("unknown key"));
            let help = told.and_then(|told| told.help.clone()).expect("the keys");
            let list = help.split_once(": ").expect("a list").1.to_owned();
            let list = list
                .rsplit_once("keys here are: ")
                .map_or(list.clone(), |(_, l)| l.to_owned());
            (table, list.split(", ").map(str::to_owned).collect())
        })
        .collect()
}

#[test]
fn the_table_has_every_key_of_the_loader_and_no_other() {
    let mut of_table: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for key in keys::all() {
        let mut path = String::new();
        for part in key.name.split('.') {
            let known = of_table.entry(path.clone()).or_default();
            known.insert(part.to_owned());
            path = format!("{path}.{part}").trim_start_matches('.').to_owned();
        }
    }
    for (table, of_loader) in known_to_the_loader() {
        assert_eq!(of_table.get(&table), Some(&of_loader), "[{table}]");
    }
    let mut names: Vec<_> = keys::all().map(|key| key.name).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count, "a key is in the table twice");
}

#[test]
fn ranges_units_and_names_are_those_of_the_loader() {
    for key in keys::all() {
        let name = key.name;
        let refused = |value: Value| {
            finding(key, value.clone()).unwrap_or_else(|| panic!("{name} = {value} is taken"))
        };
        let taken = |value: Value| {
            let found = finding(key, value.clone());
            assert_eq!(found, None, "{name} = {value}");
        };
        match key.takes {
            Takes::Number { min, max, unit } => {
                // The loader knows which axis it is.
                let is_axis = name.starts_with("axis.");
                let unit = unit
                    .split(" or ")
                    .next()
                    .filter(|_| is_axis)
                    .unwrap_or(unit);
                let wide = (max - min).max(1.0);
                let low = refused(Value::Float(min - 1e-9 * wide));
                let high = refused(Value::Float(max + 1e-9 * wide));
                taken(Value::Float(min));
                taken(Value::Float(max));
                for found in [low, high] {
                    said(name, &found, &format!("give {min} to {max} {unit}:"));
                }
            }
            Takes::ThreeNumbers { min, max, unit } | Takes::Numbers { min, max, unit } => {
                let three = |n: f64| Value::Array(vec![Value::Float(n); 3]);
                said(
                    name,
                    &refused(three(min - 0.1)),
                    &format!("give {min} to {max} {unit}:"),
                );
                said(
                    name,
                    &refused(three(max + 0.1)),
                    &format!("give {min} to {max} {unit}:"),
                );
                taken(three(min));
                taken(three(max));
            }
            Takes::Whole { min, max, .. } => {
                for beyond in [min - 1, max + 1] {
                    let found = refused(Value::Integer(beyond));
                    said(name, &found, &format!("give {min} to {max}:"));
                }
                taken(Value::Integer(min));
                taken(Value::Integer(max));
            }
            Takes::Choice { of } => {
                let found = refused(Value::String("no such name".into()));
                let names: Vec<_> = of.iter().map(|name| format!("\"{name}\"")).collect();
                said(name, &found, &format!("give {}", names.join(" or ")));
                for one in of {
                    taken(Value::String((*one).to_owned()));
                }
            }
            Takes::Flag | Takes::Text { .. } | Takes::Texts { .. } => {
                let mut machine = machine_with(name);
                put(&mut machine, name, Value::Integer(1));
                let found = load(&machine).expect_err("a value of the wrong type");
                let kind = match key.takes {
                    Takes::Flag => "true or false",
                    Takes::Text { .. } => "text in quotes",
                    _ => "a list",
                };
                let is_told = |found: &&ConfigDiagnostic| found.message.ends_with(kind);
                assert!(found.iter().any(|f| is_told(&f)), "{name}: {found:?}");
            }
        }
    }
}

/// Numbers that are in no range, or at the end of one that nothing can be computed with.
#[test]
fn no_key_takes_a_number_that_is_none() {
    for key in keys::all() {
        let (min, max) = match key.takes {
            Takes::Number { min, max, .. }
            | Takes::ThreeNumbers { min, max, .. }
            | Takes::Numbers { min, max, .. } => (min, max),
            _ => continue,
        };
        assert!(min.is_finite() && max.is_finite(), "{}", key.name);
        for number in [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            1e300,
            -1e300,
            1e15,
        ] {
            let is_list = !matches!(key.takes, Takes::Number { .. });
            let value = if is_list {
                Value::Array(vec![Value::Float(number); 3])
            } else {
                Value::Float(number)
            };
            let found = finding(key, value);
            assert!(found.is_some(), "{} = {number} is taken", key.name);
        }
    }
}

fn said(name: &str, found: &ConfigDiagnostic, begins: &str) {
    let help = found.help.clone().unwrap_or_default();
    assert!(help.starts_with(begins), "{name}: {help} / {begins}");
}

#[test]
fn what_is_left_out_is_what_the_table_says() {
    for key in keys::all() {
        let mut bare = machine_with(key.name);
        without(&mut bare, key.name);
        match key.left_out {
            LeftOut::Refused => {
                let found = load(&bare).err().unwrap_or_default();
                let is_missing = |f: &ConfigDiagnostic| {
                    f.message.contains("is missing") && f.key.ends_with(last(key.name))
                };
                assert!(found.iter().any(is_missing), "{}: {found:?}", key.name);
            }
            LeftOut::Value(value) => {
                let mut given = bare.clone();
                let value: Table = format!("v = {value}").parse().expect("TOML");
                put(&mut given, key.name, float(&key.takes, value["v"].clone()));
                let (bare, given) = (load(&bare), load(&given));
                assert_eq!(bare, given, "{}", key.name);
                // The choice of the mechanism is no default of a machine that has another.
                let may_fail = key.name == "machine.kinematics";
                assert!(bare.is_ok() || may_fail, "{}: {bare:?}", key.name);
            }
            LeftOut::Means(_) => {
                let found = load(&bare).err();
                assert_eq!(found, None, "{}", key.name);
            }
        }
    }
}

/// A default as the loader wants it: whole numbers stand for numbers.
fn float(takes: &Takes, value: Value) -> Value {
    match (takes, value) {
        #[allow(clippy::cast_precision_loss, reason = "small numbers")]
        (
            Takes::Number { .. } | Takes::ThreeNumbers { .. } | Takes::Numbers { .. },
            Value::Integer(number),
        ) => Value::Float(number as f64),
        (takes @ (Takes::ThreeNumbers { .. } | Takes::Numbers { .. }), Value::Array(list)) => {
            Value::Array(list.into_iter().map(|value| float(takes, value)).collect())
        }
        (_, value) => value,
    }
}

#[test]
fn keys_are_found_by_every_name_of_theirs() {
    let names = |asked: &str| {
        keys::asked(asked)
            .iter()
            .map(|key| key.name)
            .collect::<Vec<_>>()
    };
    assert_eq!(names("axis.Y.max_jerk"), ["axis.X.max_jerk"]);
    assert_eq!(names("joint.J4.max_jerk"), ["joint.J0.max_jerk"]);
    assert_eq!(names("path.tolerance"), ["path.tolerance"]);
    assert_eq!(names("path").len(), 9);
    assert_eq!(
        names("max_jerk"),
        ["axis.X.max_jerk", "joint.J0.max_jerk", "path.max_jerk"]
    );
    assert_eq!(names("axis.Q.max_jerk"), [""; 0]);
    assert_eq!(keys::nearest("path.tolerence"), Some("path.tolerance"));
    assert_eq!(keys::nearest("period"), Some("interpolator.period_us"));
}
