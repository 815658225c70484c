//! The machine units of LinuxCNC.

use crate::inputs::{Fate, Inputs};

/// The size of each unit here; `None` where the file does not say it in a way that is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    pub(crate) linear_mm: Option<f64>,
    pub(crate) angular_deg: Option<f64>,
}

const LINEAR: [(&str, f64); 5] = [
    ("mm", 1.0),
    ("metric", 1.0),
    ("in", 25.4),
    ("inch", 25.4),
    ("imperial", 25.4),
];

const ANGULAR: [(&str, f64); 6] = [
    ("deg", 1.0),
    ("degree", 1.0),
    ("grad", 0.9),
    ("gon", 0.9),
    ("rad", 180.0 / core::f64::consts::PI),
    ("radian", 180.0 / core::f64::consts::PI),
];

impl Units {
    pub(crate) fn of(inputs: &mut Inputs) -> Self {
        let linear_mm = factor(inputs, "LINEAR_UNITS", &LINEAR, "mm");
        let has_angular = inputs.find("TRAJ", "ANGULAR_UNITS").is_some();
        let angular_deg = factor(inputs, "ANGULAR_UNITS", &ANGULAR, "°");
        Self {
            linear_mm,
            // LinuxCNC's default.
            angular_deg: if has_angular { angular_deg } else { Some(1.0) },
        }
    }

    /// What a unit of an axis is here.
    pub(crate) const fn of_letter(self, letter: char) -> Option<f64> {
        match letter {
            'A' | 'B' | 'C' => self.angular_deg,
            _ => self.linear_mm,
        }
    }
}

fn factor(inputs: &mut Inputs, key: &str, known: &[(&str, f64)], unit: &str) -> Option<f64> {
    let (at, text) = inputs.text("TRAJ", key)?;
    let name = text.split_whitespace().next().unwrap_or_default();
    let found = known
        .iter()
        .find(|(known, _)| known.eq_ignore_ascii_case(name));
    let factor = found.map(|(_, factor)| *factor);
    match factor {
        Some(factor) => {
            let note = format!("values are multiplied by {factor}, so that they are in {unit}");
            inputs.decide(at, Fate::Converted, note);
        }
        None => {
            let note = "not a unit that is known: no value that depends on it is converted";
            inputs.decide(at, Fate::NoCounterpart, note);
        }
    }
    factor
}
