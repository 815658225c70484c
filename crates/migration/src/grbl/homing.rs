//! The homing of joints, from grbl's settings.
//!
//! grbl seeks the switch, pulls off, finds it again more slowly, and pulls off: the place is the edge
//! as it is met at `$24`. `$23` turns the direction, which is the positive one without it.

use super::{Machine, bit};
use crate::draft::float;
use crate::inputs::Fate;

/// A search of grbl ends after so many times the travel.
const SEARCH_SCALAR: f64 = 1.5;
/// grblHAL's cycles: the axes of the first, of the second …
const CYCLES: core::ops::RangeInclusive<usize> = 44..=49;

impl Machine {
    /// `[home.J0]` and the others, where homing is on.
    pub(super) fn homing(&mut self) {
        let Some((at, homing)) = self.number(22).filter(|(_, homing)| bit(*homing, 0)) else {
            return;
        };
        let note = "source = \"drives\" and homing = \"controller\" in [feedback] bring the joints home as \
                    [home.J0] says, once each has its clearance, how far it may go past the edge of its \
                    switch; grbl has none";
        self.draft.remark("feedback", note);
        self.inputs.decide(at, Fate::Changed, note);
        let axes = self.axes.iter().map(|(number, _)| *number);
        let joints = axes.chain(self.gantries.iter().copied());
        for (joint, number) in joints.collect::<Vec<_>>().into_iter().enumerate() {
            self.home_of(joint, number, homing);
        }
        if let Some(at) = self
            .inputs
            .find("[", "OPT")
            .filter(|_| !self.is_hal(homing))
        {
            let note = "where machine coordinates are zero: Z is where an axis has come home to";
            self.inputs.decide(at, Fate::Converted, note);
        }
        let notes = [
            (
                23,
                Fate::Converted,
                "the signs of search_velocity and latch_velocity",
            ),
            (24, Fate::Converted, "latch_velocity of each joint, ÷ 60"),
            (25, Fate::Converted, "search_velocity of each joint, ÷ 60"),
            (
                26,
                Fate::NoCounterpart,
                "the edge is where the contact first changed: what it bounces is not waited for",
            ),
            (
                27,
                Fate::Changed,
                "position: how far off the edge the joint goes in the end; off its switch it backs as \
                 far as that takes",
            ),
            (43, Fate::NoCounterpart, "the edge is found once"),
        ];
        for (number, fate, note) in notes {
            if let Some(at) = self.find(number) {
                self.inputs.decide(at, fate, note);
            }
        }
        for number in CYCLES {
            if let Some(at) = self.find(number) {
                self.inputs
                    .decide(at, Fate::Converted, "sequence of the joints in it");
            }
        }
    }

    fn home_of(&mut self, joint: usize, number: usize, homing: f64) {
        let table = format!("home.J{joint}");
        let mask = self.number(23).map_or(0.0, |(_, value)| value);
        let to_minus = bit(mask, u32::try_from(number).unwrap_or(u32::MAX));
        let sign = if to_minus { -1.0 } else { 1.0 };
        for (of, key, from) in [
            (25, "search_velocity", "$25 and $23"),
            (24, "latch_velocity", "$24 and $23"),
        ] {
            if let Some((_, speed)) = self.number(of).filter(|(_, speed)| *speed > 0.0) {
                self.draft
                    .known(&table, key, float(sign * speed / 60.0), from);
            }
        }
        let travel = self.number(130 + number).filter(|(_, value)| *value > 0.0);
        if let Some((at, length)) = travel {
            let from = format!(
                "{SEARCH_SCALAR} times {}, as grbl does",
                self.inputs.name(at)
            );
            let most = float(SEARCH_SCALAR * length);
            self.draft.known(&table, "search_travel", most, &from);
        }
        let pull_off = self.number(27).map(|(_, value)| value);
        let zero_at_home = self.is_zero_at_home(homing);
        let length = travel.map(|(_, length)| length);
        match (edge(to_minus, zero_at_home, pull_off, length), pull_off) {
            (Some(edge), Some(pull_off)) => {
                let position = edge - sign * pull_off;
                let from = "of the edge: $23, $27, and where grbl's zero is";
                self.draft.known(&table, "offset", float(edge), from);
                self.draft
                    .known(&table, "position", float(position), "$27 off the edge");
            }
            _ => self.draft.remark(
                &table,
                "offset, the position of the edge, and position, where the joint goes in the end: it \
                 takes $27, the travel, and how grbl was built ($I, [OPT:…]) to know them",
            ),
        }
        let cycle = CYCLES.zip(1_u32..).find(|(cycle, _)| {
            let axes = self.number(*cycle).map_or(0.0, |(_, value)| value);
            bit(axes, u32::try_from(number).unwrap_or(u32::MAX))
        });
        match cycle {
            Some((cycle, place)) => {
                let is_gantry = self.gantries.contains(&number);
                let (sign, why) = if is_gantry {
                    ("-", "; both joints of the axis go together")
                } else {
                    ("", "")
                };
                let from = format!("${cycle}{why}");
                self.draft
                    .known(&table, "sequence", format!("{sign}{place}"), &from);
            }
            None if self.gantries.contains(&number) => self.draft.remark(
                &table,
                "sequence: in which order grbl's axes come home is built in; both joints of the axis need the \
                 same negative number",
            ),
            None => self.draft.remark(
                &table,
                "sequence: in which order grbl's axes come home is built in, Z before the others as a rule",
            ),
        }
    }
}

/// Where the edge of a switch is in grbl's machine coordinates; `None` if that is not known.
fn edge(
    to_minus: bool,
    zero_at_home: Option<bool>,
    pull_off: Option<f64>,
    length: Option<f64>,
) -> Option<f64> {
    Some(match (to_minus, zero_at_home?) {
        // Zero is where it has pulled off to.
        (false, true) => pull_off?,
        (true, true) => -pull_off?,
        // Zero is the switch at the positive end, wherever it homes to.
        (false, false) => 0.0,
        (true, false) => -length?,
    })
}

#[cfg(test)]
mod tests {
    use super::edge;

    #[test]
    fn the_edge_is_where_grbl_counts_it() {
        let (pull_off, length) = (Some(2.0), Some(400.0));
        assert_eq!(edge(false, Some(false), pull_off, length), Some(0.0));
        assert_eq!(edge(true, Some(false), pull_off, length), Some(-400.0));
        assert_eq!(edge(false, Some(true), pull_off, length), Some(2.0));
        assert_eq!(edge(true, Some(true), pull_off, length), Some(-2.0));
        assert_eq!(edge(true, None, pull_off, length), None);
        assert_eq!(edge(true, Some(false), pull_off, None), None);
    }
}
