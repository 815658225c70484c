//! LinuxCNC's parameter file (`.var`): lines of a number and a value, the numbers ascending, the
//! values in the units of LinuxCNC's machine (`[TRAJ] LINEAR_UNITS` and `ANGULAR_UNITS`).
//!
//! | numbers | what |
//! |---|---|
//! | 5161–5169, 5181–5189 | G28, G30; X Y Z A B C U V W |
//! | 5210; 5211–5219 | whether the offset of G92 is in force; the offset |
//! | 5220 | coordinate system in force, 1 for G54 to 9 for G59.3 |
//! | 5221–5230, 20 more for each next one | G54 … G59.3: nine axes, and the rotation in degrees |
//!
//! A number that is missing is zero, as LinuxCNC reads it. What else is in a file (parameters 31 to
//! 5000, results of probing) is no part of how a machine is set up; it is listed, not taken.

use crate::state::{AXES, Offsets};
use core::fmt::Write as _;
use thiserror::Error;

/// The units of LinuxCNC's machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Units {
    /// Length of a linear unit, mm: 1, or 25.4 for an inch.
    pub linear_mm: f64,
    /// An angular unit in degrees: 1, 180/π for a radian, 0.9 for a gon.
    pub angular_deg: f64,
}

/// A parameter file that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// Coordinates, in mm and degrees.
    pub offsets: Offsets,
    /// Whether LinuxCNC had the offset of G92 in force.
    pub g92_was_in_force: bool,
    /// Parameters that are not taken, and are not zero.
    pub others: Vec<(u32, f64)>,
}

/// An error in a parameter file.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("line {line}: {reason}")]
pub struct VarError {
    /// The line, from 1.
    pub line: u32,
    /// What is wrong, and what is wanted.
    pub reason: String,
}

impl Units {
    /// Axes A, B and C turn.
    fn of_axis(self, axis: usize) -> f64 {
        if (3..6).contains(&axis) {
            self.angular_deg
        } else {
            self.linear_mm
        }
    }
}

/// Where a number belongs.
enum Place {
    Axis(Vector, usize),
    G92InForce,
    Active,
    Rotation(usize),
    Other,
}

enum Vector {
    G28,
    G30,
    G92,
    System(usize),
}

impl Place {
    fn of(number: u32) -> Self {
        let axis = |first: u32| usize::try_from(number - first).unwrap_or(usize::MAX);
        match number {
            5161..=5169 => Self::Axis(Vector::G28, axis(5161)),
            5181..=5189 => Self::Axis(Vector::G30, axis(5181)),
            5210 => Self::G92InForce,
            5211..=5219 => Self::Axis(Vector::G92, axis(5211)),
            5220 => Self::Active,
            5221..=5390 => {
                let (system, part) = (axis(5221) / 20, axis(5221) % 20);
                match part {
                    0..AXES => Self::Axis(Vector::System(system), part),
                    AXES => Self::Rotation(system),
                    _ => Self::Other,
                }
            }
            _ => Self::Other,
        }
    }
}

/// Reads a parameter file.
///
/// # Errors
/// The first line that is not a number and a value, or whose number does not ascend, and a
/// coordinate system that does not exist.
pub fn import(text: &str, units: Units) -> Result<Imported, VarError> {
    let mut imported = Imported {
        offsets: Offsets::default(),
        g92_was_in_force: false,
        others: Vec::new(),
    };
    let mut last = 0;
    for (index, line) in text.lines().enumerate() {
        let fault = |reason: String| VarError {
            line: u32::try_from(index + 1).unwrap_or(u32::MAX),
            reason,
        };
        let mut words = line.split_whitespace();
        let (number, value) = match (words.next(), words.next(), words.next()) {
            (None, ..) => continue,
            (Some(number), Some(value), None) => (number.parse(), value.parse::<f64>()),
            _ => {
                return Err(fault(
                    "give a number and a value, and nothing else".to_owned(),
                ));
            }
        };
        let (Ok(number), Ok(value)) = (number, value) else {
            return Err(fault("give a whole number and a value".to_owned()));
        };
        if !value.is_finite() {
            return Err(fault(format!(
                "the value of parameter {number} is no number"
            )));
        }
        if number <= last {
            return Err(fault(format!(
                "parameter {number} stands behind {last}: the numbers have to ascend"
            )));
        }
        last = number;
        imported.take(number, value, units).map_err(fault)?;
    }
    Ok(imported)
}

impl Imported {
    fn take(&mut self, number: u32, value: f64, units: Units) -> Result<(), String> {
        let offsets = &mut self.offsets;
        match Place::of(number) {
            Place::Axis(vector, axis) => {
                let vector = match vector {
                    Vector::G28 => &mut offsets.g28,
                    Vector::G30 => &mut offsets.g30,
                    Vector::G92 => &mut offsets.g92,
                    Vector::System(system) => &mut offsets.systems[system].origin,
                };
                vector[axis] = value * units.of_axis(axis);
                if !vector[axis].is_finite() {
                    return Err(format!("parameter {number} is too large: {value}"));
                }
            }
            Place::G92InForce => self.g92_was_in_force = value != 0.0,
            Place::Active => {
                let is_system = |n: &u8| f64::from(*n).to_bits() == value.to_bits();
                offsets.active = (1..=9).find(is_system).ok_or_else(|| {
                    format!(
                        "parameter 5220 is {value}: coordinate systems are 1 (G54) to 9 (G59.3)"
                    )
                })?;
            }
            Place::Rotation(system) => offsets.systems[system].rotation_deg = value,
            Place::Other if value != 0.0 => self.others.push((number, value)),
            Place::Other => {}
        }
        Ok(())
    }
}

/// Writes a parameter file that LinuxCNC reads: everything it needs to be there, and the offset of
/// G92 not in force.
#[must_use]
pub fn export(offsets: &Offsets, units: Units) -> String {
    let mut text = String::new();
    let axes = |text: &mut String, first: u32, vector: &[f64; AXES]| {
        for ((number, axis), value) in (first..).zip(0..).zip(vector) {
            let _ = writeln!(text, "{number}\t{}", value / units.of_axis(axis));
        }
    };
    axes(&mut text, 5161, &offsets.g28);
    axes(&mut text, 5181, &offsets.g30);
    text.push_str("5210\t0\n");
    axes(&mut text, 5211, &offsets.g92);
    let _ = writeln!(text, "5220\t{}", offsets.active);
    for (first, system) in (5221_u32..).step_by(20).zip(&offsets.systems) {
        axes(&mut text, first, &system.origin);
        let _ = writeln!(text, "{}\t{}", first + 9, system.rotation_deg);
    }
    text
}
