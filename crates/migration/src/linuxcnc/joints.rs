//! The conversion of `[JOINT_n]`: the joints of mechanisms, and what belongs to the drives.

use super::Machine;
use crate::draft::float;
use crate::inputs::Fate;

impl Machine {
    pub(crate) fn joints(&mut self) {
        let count = match self.kinematics {
            Some("corexy") => self.letters.len(),
            Some("linear-delta") => self.letters.len().max(3),
            Some("hexapod") => 6,
            _ => return,
        };
        for joint in 0..count {
            let section = format!("JOINT_{joint}");
            let table = format!("joint.J{joint}");
            let is_angular = self
                .inputs
                .text(&section, "TYPE")
                .is_some_and(|(_, text)| text.eq_ignore_ascii_case("ANGULAR"));
            if let Some(at) = self.inputs.find(&section, "TYPE") {
                let note = "joints have the units of the mechanism here";
                self.inputs.decide(at, Fate::Converted, note);
            }
            let factor = if is_angular {
                self.units.angular_deg
            } else {
                self.units.linear_mm
            };
            for (theirs, ours) in [
                ("MIN_LIMIT", "min_position"),
                ("MAX_LIMIT", "max_position"),
                ("MAX_VELOCITY", "max_velocity"),
                ("MAX_ACCELERATION", "max_acceleration"),
                ("MAX_JERK", "max_jerk"),
            ] {
                self.joint_limit(&section, &table, (theirs, ours), factor);
            }
        }
    }

    fn joint_limit(
        &mut self,
        section: &str,
        table: &str,
        (theirs, ours): (&str, &str),
        factor: Option<f64>,
    ) {
        let is_end = ours.ends_with("_position");
        if let Some((at, value)) = self.inputs.number(section, theirs) {
            let usable = |value: &f64| value.abs() < 1e9 && (is_end || *value > 0.0);
            match (value.ok().filter(usable), factor) {
                (Some(value), Some(factor)) => {
                    let from = self.inputs.name(at);
                    self.draft.known(table, ours, float(value * factor), &from);
                    self.inputs
                        .decide(at, Fate::Converted, format!("{table}.{ours}"));
                    return;
                }
                _ => {
                    let note = "no limit there, or not in a unit that is known";
                    self.inputs.decide(at, Fate::Changed, note);
                }
            }
        }
        if !is_end {
            self.draft.ask(table, ours, "what the joint's drive can do");
        }
    }
}
