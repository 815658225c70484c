//! What an output obeys: a bit or a number of the auxiliary record.

use glidepath_link::{Auxiliary, Coolant, SpindleState};
use glidepath_program::Event;

/// What a digital output obeys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// A digital output of programs (M62 to M65).
    Output(u32),
    /// The spindle is to turn, either way.
    SpindleOn,
    /// The spindle is to turn clockwise (M3).
    SpindleForward,
    /// The spindle is to turn counterclockwise (M4).
    SpindleReverse,
    /// The spindle is to stand at a known angle (M19).
    SpindleOrient,
    /// A gear of the spindle, 1 to 5, is to be in (M41 to M45).
    SpindleGear(u32),
    /// Mist (M7).
    Mist,
    /// Flood (M8).
    Flood,
}

/// What an analog output obeys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// An analog output of programs (M67, M68), in whatever unit it has.
    Output(u32),
    /// The speed of the spindle, rev/min, 0 where it is not to turn.
    SpindleSpeed,
    /// The same, negative where it is to turn counterclockwise.
    SpindleVelocity,
}

/// Whose an output is, by which it is told how it comes to rest and back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Of {
    /// The spindle's: at rest before all others, and obeyed again when it is commanded anew.
    Spindle,
    /// A gear's: it stays as it is where nobody is to be obeyed, as no gear is drawn out of a spindle that turns.
    Gear,
    /// Coolant: obeyed again when it is commanded anew.
    Coolant,
    /// A program's: obeyed whatever has been.
    Program,
}

impl Of {
    fn is_commanded_by(self, event: Event) -> bool {
        match self {
            Self::Spindle => is_code(event, &SPINDLE),
            Self::Coolant => is_code(event, &COOLANT),
            Self::Program | Self::Gear => false,
        }
    }
}

/// M codes of the spindle: on, off, at an angle, and the change of a tool, which stops it.
const SPINDLE: [u32; 5] = [3, 4, 5, 6, 19];
/// M codes of coolant.
const COOLANT: [u32; 3] = [7, 8, 9];

/// Whether an event says how the spindle is to turn.
pub(crate) fn is_of_spindle(event: Event) -> bool {
    matches!(
        event,
        Event::SpindleSpeed(_) | Event::SpindleAngle { .. } | Event::SpindleGear(_)
    ) || is_code(event, &SPINDLE)
}

fn turns(record: &Auxiliary, way: SpindleState) -> bool {
    record.spindle == way.code()
}

/// Whether an event is one of these M codes.
fn is_code(event: Event, codes: &[u32]) -> bool {
    matches!(event, Event::MCode(code) | Event::PassingCode(code) if codes.contains(&code))
}

impl Signal {
    /// Whether the record says that it is on.
    pub(crate) fn is_on(self, record: &Auxiliary) -> bool {
        match self {
            Self::Output(number) => record.digital_out >> (number & 63) & 1 == 1,
            Self::SpindleOn => {
                turns(record, SpindleState::Clockwise)
                    || turns(record, SpindleState::Counterclockwise)
            }
            Self::SpindleForward => turns(record, SpindleState::Clockwise),
            Self::SpindleReverse => turns(record, SpindleState::Counterclockwise),
            Self::SpindleOrient => turns(record, SpindleState::Oriented),
            Self::SpindleGear(gear) => record.spindle_gear == gear,
            Self::Mist => record.coolant().contains(Coolant::MIST),
            Self::Flood => record.coolant().contains(Coolant::FLOOD),
        }
    }

    /// Whose it is.
    pub(crate) const fn of(self) -> Of {
        match self {
            Self::Output(_) => Of::Program,
            Self::Mist | Self::Flood => Of::Coolant,
            Self::SpindleGear(_) => Of::Gear,
            _ => Of::Spindle,
        }
    }

    /// Whether an event commands it anew.
    pub(crate) fn is_commanded_by(self, event: Event) -> bool {
        self.of().is_commanded_by(event)
    }
}

impl Quantity {
    /// What the record says, in its unit.
    pub(crate) fn value(self, record: &Auxiliary) -> f64 {
        let backwards = turns(record, SpindleState::Counterclockwise);
        match self {
            Self::Output(number) => {
                let number = usize::try_from(number).ok();
                let output = number.and_then(|number| record.analog_out.get(number));
                output.copied().unwrap_or(0.0)
            }
            _ if !Signal::SpindleOn.is_on(record) => 0.0,
            Self::SpindleVelocity if backwards => -record.spindle_rpm().abs(),
            Self::SpindleSpeed | Self::SpindleVelocity => record.spindle_rpm().abs(),
        }
    }

    /// Whose it is.
    pub(crate) const fn of(self) -> Of {
        match self {
            Self::Output(_) => Of::Program,
            Self::SpindleSpeed | Self::SpindleVelocity => Of::Spindle,
        }
    }

    /// Whether an event commands it anew.
    pub(crate) fn is_commanded_by(self, event: Event) -> bool {
        self.of().is_commanded_by(event)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_turns_the_spindle_is_off_with_it() {
        let mut record = Auxiliary::default();
        record.take(Event::SpindleSpeed(8000.0));
        let seen = |record: &Auxiliary| {
            let bits = [
                Signal::SpindleOn,
                Signal::SpindleForward,
                Signal::SpindleReverse,
                Signal::SpindleOrient,
            ];
            (
                bits.map(|bit| bit.is_on(record)),
                Quantity::SpindleSpeed.value(record),
                Quantity::SpindleVelocity.value(record),
            )
        };
        assert_eq!(seen(&record), ([false; 4], 0.0, 0.0));
        record.take(Event::MCode(3));
        let forward = [true, true, false, false];
        assert_eq!(seen(&record), (forward, 8000.0, 8000.0));
        record.take(Event::MCode(4));
        let reverse = [true, false, true, false];
        assert_eq!(seen(&record), (reverse, 8000.0, -8000.0));
        record.take(Event::MCode(19));
        assert_eq!(seen(&record), ([false, false, false, true], 0.0, 0.0));
        // It is held while the tool is changed.
        record.take(Event::MCode(6));
        assert_eq!(seen(&record), ([false, false, false, true], 0.0, 0.0));
        record.take(Event::MCode(3));
        record.take(Event::MCode(6));
        assert_eq!(seen(&record), ([false; 4], 0.0, 0.0));
    }

    #[test]
    fn outputs_of_programs_are_those_of_their_numbers() {
        let mut record = Auxiliary::default();
        record.take(Event::DigitalOutput {
            number: 63,
            on: true,
        });
        record.take(Event::AnalogOutput {
            number: 2,
            value: -1.5,
        });
        record.take(Event::PassingCode(8));
        assert!(Signal::Output(63).is_on(&record) && !Signal::Output(62).is_on(&record));
        assert!(Signal::Flood.is_on(&record) && !Signal::Mist.is_on(&record));
        let value = |number| Quantity::Output(number).value(&record);
        assert_eq!((value(2), value(3), value(99)), (-1.5, 0.0, 0.0));
    }
}
