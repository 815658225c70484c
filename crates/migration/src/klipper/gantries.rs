//! Axes that several motors move: Klipper's `[stepper_z1]`, `[stepper_z2]` …

use super::{LETTERS, Machine};
use crate::inputs::Fate;

/// As many as Klipper looks for.
const MOST_MOTORS: usize = 98;

impl Machine {
    /// Asks for the gantries, and says what cannot be one. Klipper's limits are those of the head, so that both
    /// joints have the same.
    pub(super) fn gantries(&mut self, kinematics: Option<&str>) {
        for letter in LETTERS {
            let motors = self.further_motors(letter);
            let table = format!("axis.{}", letter.to_ascii_uppercase());
            for (number, section) in motors.iter().enumerate() {
                let told = match (kinematics, number) {
                    (Some("trivial"), 0) => {
                        let why = format!(
                            "the axis has two joints, as [{section}] says: by how much may they differ before \
                             the motion stops"
                        );
                        self.draft.choose(&table, "gantry_difference", &why);
                        let note =
                            "the second joint of its axis: it comes after those of all axes here";
                        (Fate::Changed, note.to_owned())
                    }
                    (Some("trivial"), _) => {
                        let note = format!(
                            "an axis has two joints here at most: the servo stack has to lead the motor of \
                             [{section}] with one of them"
                        );
                        (Fate::NoCounterpart, note)
                    }
                    _ => {
                        let note = format!(
                            "only machines whose axes have drives of their own have second joints: the servo \
                             stack has to lead the motor of [{section}] with the first"
                        );
                        (Fate::NoCounterpart, note)
                    }
                };
                let (fate, note) = told;
                if fate == Fate::NoCounterpart {
                    self.draft.remark(&table, &note);
                }
                if let Some(at) = self.inputs.find(section, "step_pin") {
                    self.inputs.decide(at, fate, note);
                }
            }
        }
    }

    /// The section of the second joint of an axis, if it has one.
    pub(super) fn second_joint(&self, letter: char) -> Option<String> {
        self.further_motors(letter).into_iter().next()
    }

    fn further_motors(&self, letter: char) -> Vec<String> {
        let sections = (1..=MOST_MOTORS).map(|number| format!("stepper_{letter}{number}"));
        sections
            .take_while(|section| self.inputs.has_section(section))
            .collect()
    }
}
