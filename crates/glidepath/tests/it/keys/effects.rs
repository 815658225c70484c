//! Tests that every key does something.

use super::{holder, last, load, machine_with, put, without};
use glidepath::config::keys::{self, Key, Takes};
use toml::{Table, Value};

/// Values that a key takes, if the rest of the machine lets it.
fn values_of(key: &Key) -> Vec<Value> {
    let float = |number: f64| Value::Float(number);
    let between = |min: f64, max: f64| {
        let least = min.max(1e-3);
        [
            min,
            max,
            (least * max.max(least)).sqrt(),
            0.25 * max,
            1e-3 * max,
        ]
    };
    match key.takes {
        Takes::Number { min, max, .. } => between(min, max).map(float).to_vec(),
        Takes::Numbers { min, max, .. } | Takes::ThreeNumbers { min, max, .. } => {
            let three = |number| Value::Array(vec![float(number); 3]);
            let apart = [0.1, 0.2, 0.3].map(|share| float(min + share * (max - min)));
            let mut values = between(min, max).map(three).to_vec();
            values.push(Value::Array(apart.to_vec()));
            values
        }
        Takes::Whole { min, max, .. } => [min, max, i64::midpoint(min, max)]
            .map(Value::Integer)
            .to_vec(),
        Takes::Choice { of } => of.iter().map(|one| Value::String((*one).into())).collect(),
        Takes::Flag => [true, false].map(Value::Boolean).to_vec(),
        Takes::Text { .. } => ["one", "two"]
            .map(|text| Value::String(text.into()))
            .to_vec(),
        Takes::Texts { .. } => ["one", "two"]
            .map(|text| Value::Array(vec![Value::String(text.into())]))
            .to_vec(),
    }
}

/// Keys whose values are taken only beside others that change with them.
const GO_TOGETHER: [&str; 8] = [
    "machine.kinematics",
    "machine.five-axis.tilt",
    "compensation.J0.positions",
    "compensation.J0.corrections",
    "compensation.J0.corrections_down",
    "straightness.ZX.positions",
    "spindle.axis",
    "m_codes.M6.done",
];

/// A machine on which a key can mean something: with what its table is about.
fn machine_for(key: &str) -> Table {
    let mut machine = machine_with(key);
    let table = key.split('.').next().expect("a name");
    if table == "superposition" {
        put(&mut machine, "superposition.enabled_by", Value::Integer(1));
    }
    if matches!(table, "probe" | "adaptive_feed" | "superposition") {
        put(
            &mut machine,
            "feedback.source",
            Value::String("drives".into()),
        );
        put(&mut machine, &format!("{table}.input"), Value::Integer(1));
    }
    if key.starts_with("spindle.gear_") && key != "spindle.gear_max" {
        let most = Value::Array(vec![Value::Float(1e6); 3]);
        put(&mut machine, "spindle.gear_max", most);
    }
    if table == "spindle" {
        put(&mut machine, "spindle.encoder", Value::Boolean(true));
    }
    machine
}

/// A key that is read and then forgotten would be taken, and do nothing.
#[test]
fn every_key_means_something() {
    for key in keys::all().filter(|key| !GO_TOGETHER.contains(&key.name)) {
        let machine = machine_for(key.name);
        let with = |value: Value| {
            let mut machine = machine.clone();
            put(&mut machine, key.name, value);
            machine
        };
        let mut left_out = machine.clone();
        without(&mut left_out, key.name);
        let mut present = machine.clone();
        let present = holder(&mut present, key.name).get(last(key.name)).cloned();
        // The ends of a range may not go with the rest of the machine.
        let near = present.and_then(|value| value.as_float());
        let near = near.map(|number| [0.9, 1.1].map(|share| with(Value::Float(share * number))));
        let tables = values_of(key)
            .into_iter()
            .map(with)
            .chain([left_out])
            .chain(near.into_iter().flatten());
        let mut machines = tables.filter_map(|table| load(&table).ok());
        let first = machines.next();
        let is_other = machines.any(|machine| Some(machine) != first);
        assert!(is_other, "{}: every value makes the same machine", key.name);
    }
}

#[test]
fn a_continuous_jog_ends_by_itself_after_dead_man_ms() {
    for time_ms in [50, 200] {
        let mut machine = machine_with("jog.dead_man_ms");
        put(&mut machine, "jog.dead_man_ms", Value::Integer(time_ms));
        let jog = load(&machine).expect("a machine").jog;
        assert_eq!(i64::from(jog.dead_man_ms), time_ms);
    }
}
