//! The settings of the machine as senders read them: `$0` to `$132`.

use crate::AXES;
use crate::numbers::plain;

/// The settings of the machine. Senders read them, and change none of them.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineSettings {
    /// The axes that the machine has, by index.
    pub axes: Vec<usize>,
    /// Least place of each axis, mm or degrees.
    pub least: [f64; AXES],
    /// Largest place of each axis.
    pub most: [f64; AXES],
    /// Highest velocity of each axis, mm/s or °/s.
    pub velocity: [f64; AXES],
    /// Highest acceleration of each axis, mm/s² or °/s².
    pub acceleration: [f64; AXES],
    /// Highest velocity of each axis by hand.
    pub jog_velocity: [f64; AXES],
    /// How far the motion may be from its path, mm.
    pub tolerance_mm: f64,
    /// Whether there are homes to be found.
    pub has_homing: bool,
    /// Highest speed of the spindle, revolutions a minute.
    pub most_rpm: f64,
    /// The least and the highest override of the spindle, percent.
    pub spindle_override: (i32, i32),
    /// Bytes that a sender may have unanswered.
    pub rx_bytes: usize,
    /// Motion that is planned ahead at most, s.
    pub ahead_t: f64,
    /// Version of the program.
    pub version: String,
}

impl Default for MachineSettings {
    fn default() -> Self {
        Self {
            axes: vec![0, 1, 2],
            least: [-500.0; AXES],
            most: [500.0; AXES],
            velocity: [200.0; AXES],
            acceleration: [2000.0; AXES],
            jog_velocity: [100.0; AXES],
            tolerance_mm: 0.02,
            has_homing: false,
            most_rpm: 24_000.0,
            spindle_override: (10, 200),
            rx_bytes: 128,
            ahead_t: 3.0,
            version: String::new(),
        }
    }
}

impl MachineSettings {
    /// All of them, in the order in which senders read them.
    pub(crate) fn lines(&self, mask: u32, is_inch: bool) -> Vec<String> {
        let whole = |number: u16, value: u32| format!("${number}={value}");
        let mut lines = vec![
            whole(0, 10),
            whole(1, 255),
            whole(2, 0),
            whole(3, 0),
            whole(4, 0),
            whole(5, 0),
            whole(6, 0),
            whole(10, mask),
            "$11=0.010".to_owned(),
            format!("$12={}", plain(self.tolerance_mm, 3)),
            whole(13, is_inch.into()),
            whole(20, 1),
            whole(21, 1),
            whole(22, self.has_homing.into()),
            whole(23, 0),
            "$24=25.000".to_owned(),
            "$25=500.000".to_owned(),
            whole(26, 250),
            "$27=1.000".to_owned(),
            format!("$30={}", plain(self.most_rpm, 0)),
            "$31=0".to_owned(),
            whole(32, 0),
        ];
        let travel = |axis: usize| self.most(axis) - self.least(axis);
        let groups: [(u16, &dyn Fn(usize) -> f64); 4] = [
            (100, &|_| 1000.0),
            (110, &|axis| of(&self.velocity, axis) * 60.0),
            (120, &|axis| of(&self.acceleration, axis)),
            (130, &travel),
        ];
        for (first, value) in groups {
            for (number, axis) in (first..).zip(&self.axes) {
                lines.push(format!("${number}={}", plain(value(*axis), 3)));
            }
        }
        lines
    }

    pub(crate) fn least(&self, axis: usize) -> f64 {
        of(&self.least, axis)
    }

    pub(crate) fn most(&self, axis: usize) -> f64 {
        of(&self.most, axis)
    }
}

fn of(vector: &[f64; AXES], axis: usize) -> f64 {
    vector.get(axis).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn senders_find_what_they_look_for_in_its_order() {
        let lines = MachineSettings::default().lines(3, false);
        let numbers: Vec<u16> = lines
            .iter()
            .filter_map(|line| line.strip_prefix('$')?.split('=').next()?.parse().ok())
            .collect();
        let expected: Vec<u16> = [0..=6, 10..=13, 20..=27, 30..=32, 100..=102, 110..=112]
            .into_iter()
            .chain([120..=122, 130..=132])
            .flatten()
            .collect();
        assert_eq!(numbers, expected);
        assert!(lines.contains(&"$110=12000.000".to_owned()));
        assert!(lines.contains(&"$132=1000.000".to_owned()));
    }
}
