//! The outputs that a program has commanded (spindle, coolant and tool) up to where it was left.

use glidepath_link::Auxiliary;
use glidepath_program::{Event, Item, ItemKind};

use crate::source::restoring::restoring;

/// The commands of a program to spindle, coolant and tool changer.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SaidOutputs {
    said: Auxiliary,
    has_told_spindle: bool,
    has_told_coolant: bool,
    has_selected_tool: bool,
    has_changed_tool: bool,
    has_changed_gear: bool,
}

impl SaidOutputs {
    /// Takes note of an item that was executed.
    pub(crate) fn take(&mut self, item: &Item) {
        let ItemKind::Event(event) = item.kind else {
            return;
        };
        self.said.take(event);
        self.has_told_spindle |= matches!(
            event,
            Event::SpindleSpeed(_) | Event::MCode(3 | 4 | 5 | 6 | 19)
        );
        self.has_told_coolant |= matches!(event, Event::MCode(7..=9) | Event::PassingCode(7..=9));
        self.has_selected_tool |= matches!(event, Event::SelectTool(_));
        self.has_changed_tool |= event == Event::MCode(6);
        self.has_changed_gear |= matches!(event, Event::SpindleGear(_));
    }

    /// The tool that it has put into the spindle, if it has changed it.
    pub(crate) const fn tool(&self) -> Option<u32> {
        if self.has_changed_tool {
            Some(self.said.tool)
        } else {
            None
        }
    }

    /// The events that make spindle, coolant and the selected tool what the program has made them, from
    /// what they are `now`. What it has said nothing of stays as it is.
    pub(crate) fn restoring(&self, now: &Auxiliary) -> Vec<Event> {
        let mut wanted = *now;
        if self.has_told_spindle {
            wanted.spindle = self.said.spindle;
            wanted.spindle_speed = self.said.spindle_speed;
            wanted.spindle_angle = self.said.spindle_angle;
            wanted.spindle_turn = self.said.spindle_turn;
        }
        if self.has_changed_gear {
            wanted.spindle_gear = self.said.spindle_gear;
        }
        if self.has_told_coolant {
            wanted.coolant = self.said.coolant;
        }
        if self.has_selected_tool {
            wanted.prepared_tool = self.said.prepared_tool;
        }
        restoring(now, &wanted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::SpindleState;
    use glidepath_program::OrientWay;

    fn said(events: &[Event]) -> SaidOutputs {
        let mut said = SaidOutputs::default();
        for event in events {
            said.take(&Item {
                block: 0,
                line: 1,
                kind: ItemKind::Event(*event),
            });
        }
        said
    }

    #[test]
    fn a_spindle_that_stood_at_an_angle_stands_there_again() {
        let angle = |deg| Event::SpindleAngle {
            deg,
            way: OrientWay::Clockwise,
        };
        let there = [angle(90.0), Event::MCode(19)];
        let mut now = Auxiliary::default();
        assert_eq!(said(&there).restoring(&now), there);
        for event in there {
            now.take(event);
        }
        assert_eq!(said(&there).restoring(&now), []);
        // At another angle it is turned anew.
        let elsewhere = [angle(30.0), Event::MCode(19)];
        assert_eq!(said(&elsewhere).restoring(&now), elsewhere);
    }

    #[test]
    fn a_gear_is_put_in_again_where_another_one_is() {
        let words = [Event::SpindleGear(2), Event::MCode(42)];
        let mut now = Auxiliary::default();
        assert_eq!(said(&words).restoring(&now), words);
        now.take(words[0]);
        assert_eq!(said(&words).restoring(&now), []);
        // In front of the speed.
        now.spindle_gear = 1;
        let turning = [words[0], words[1], Event::SpindleSpeed(3000.0)];
        assert_eq!(said(&turning).restoring(&now), turning);
        // A code of the machine is no gear.
        assert_eq!(said(&[Event::MCode(41)]).restoring(&now), []);
    }

    #[test]
    fn what_was_stopped_is_turned_on_again_and_nothing_else() {
        let events = [
            Event::SpindleSpeed(8000.0),
            Event::MCode(3),
            Event::PassingCode(8),
            Event::MCode(7),
        ];
        let mut now = Auxiliary::default();
        for event in events {
            now.take(event);
        }
        assert_eq!(said(&events).restoring(&now), []);
        (now.spindle, now.coolant) = (SpindleState::Stopped.code(), 0);
        assert_eq!(
            said(&events).restoring(&now),
            [Event::MCode(3), Event::MCode(7), Event::MCode(8)]
        );
        // An order that the program has given itself since then.
        let stopped = [events[0], events[1], events[2], Event::MCode(5)];
        assert_eq!(said(&stopped).restoring(&now), [Event::MCode(8)]);
        // What it says nothing of is left alone.
        now.take(Event::MCode(4));
        assert_eq!(said(&[Event::MCode(100)]).restoring(&now), []);
        now.spindle_speed = 100.0;
        assert_eq!(
            said(&events[..2]).restoring(&now),
            [Event::SpindleSpeed(8000.0), Event::MCode(3)]
        );
    }
}
