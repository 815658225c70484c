//! Values for hints: such as are allowed beside the others of their table, and gentle to any machine.

use super::{LeftOut, Takes, known};

/// For keys without a default, whatever stands beside them.
const EXAMPLES: [(&str, &str); 7] = [
    ("axis.X.jog_velocity", "1.0"),
    ("axis.X.gantry_difference", "0.1"),
    ("home.J0.final_velocity", "1.0"),
    ("path.default_feed", "100.0"),
    ("path.max_tangential_acceleration", "100.0"),
    ("path.max_normal_acceleration", "100.0"),
    ("path.max_jerk", "1000.0"),
];

/// A travel that is too short to do harm, mm or °.
const TRAVEL: f64 = 2.0;
/// A limit of a slow machine, mm/s or °/s.
const SLOW_V: f64 = 10.0;
/// The same, mm/s² or °/s².
const SLOW_A: f64 = 100.0;
/// Full speed is reached in so long, s: the motion that is published ahead covers three stops.
const GENTLE_T: f64 = 0.5;
/// The full acceleration is built up in so long, s.
const SMOOTH_T: f64 = 0.1;

/// A value of a number's key, as TOML: what holds without it, or one that is gentle. `beside` gives the numbers of
/// other keys in its table, as far as they stand there. `None`: no value does for any machine, as with the lengths
/// of a mechanism, and with the limits of joints, which the axes have to go with.
#[must_use]
pub fn example(name: &str, beside: impl Fn(&str) -> Option<f64>) -> Option<String> {
    let key = known(name)?;
    let is_number = matches!(key.takes, Takes::Number { .. } | Takes::Whole { .. });
    match key.left_out {
        LeftOut::Value(value) if is_number => Some(value.to_owned()),
        _ => {
            let mut examples = EXAMPLES.iter();
            let found = examples.find(|(of, _)| *of == key.name);
            found.map(|(_, value)| (*value).to_owned()).or_else(|| {
                gentle(key.name, beside).map(|value| toml::Value::Float(value).to_string())
            })
        }
    }
}

/// A limit or an end of travel.
fn gentle(name: &str, beside: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let acceleration = || {
        let by_v = beside("max_velocity").map_or(SLOW_A, |v| v / GENTLE_T);
        by_v.max(SLOW_A)
    };
    match name {
        "axis.X.min_position" => {
            Some(beside("max_position").map_or(-TRAVEL / 2.0, |max| max - TRAVEL))
        }
        "axis.X.max_position" => {
            Some(beside("min_position").map_or(TRAVEL / 2.0, |min| min + TRAVEL))
        }
        "axis.X.max_velocity" => {
            Some(beside("max_acceleration").map_or(SLOW_V, |a| SLOW_V.min(a * GENTLE_T)))
        }
        "axis.X.max_acceleration" => Some(acceleration()),
        "axis.X.max_jerk" => {
            Some(beside("max_acceleration").unwrap_or_else(acceleration) / SMOOTH_T)
        }
        _ => None,
    }
}
