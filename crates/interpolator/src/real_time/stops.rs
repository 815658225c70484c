//! The stop of spindle and coolant together with the motion, after an abort, a fault, or when the
//! drives lose their power.
//!
//! ```text
//!   abort, fault ──► the motion comes to rest ──► M5, M9, a setpoint each ──► idle, faulted
//!   power lost ─────────────────────────────────► likewise, at once
//!   setpoints, a device or the bus lost ────────► as a fault, whatever the configuration leaves on
//! ```
//!
//! The spindle turns until the motion rests: a tool that moves on in the material without it breaks. What
//! is to stop is told as any program tells it, by the events of setpoints, so whoever works spindle and
//! coolant needs to know nothing else; the record of what is latched follows from them. Nothing is told
//! that is off already. An interpolator that has just started does not know what one before it left on:
//! spindle and coolant count as on until something is told of them. No program begins before all is told.

use crate::shared::config::stops::{StopCause, StopSettings};
use glidepath_program::Event;

/// What is on, and what of it is still to be stopped.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stops {
    settings: StopSettings,
    spindle_on: bool,
    coolant_on: bool,
    stops_spindle: bool,
    stops_coolant: bool,
    is_due: bool,
}

impl Stops {
    pub(crate) const fn new(settings: StopSettings) -> Self {
        Self {
            settings,
            spindle_on: true,
            coolant_on: true,
            stops_spindle: false,
            stops_coolant: false,
            is_due: false,
        }
    }

    /// Takes note of an event that was told.
    pub(crate) const fn hear(&mut self, event: Event) {
        match event {
            Event::MCode(3 | 4 | 19) => self.spindle_on = true,
            Event::MCode(5 | 6) => self.spindle_on = false,
            Event::MCode(7 | 8) | Event::PassingCode(7 | 8) => self.coolant_on = true,
            Event::MCode(9) | Event::PassingCode(9) => self.coolant_on = false,
            _ => {}
        }
    }

    /// Things are to stop, as far as they are on.
    pub(crate) const fn ask(&mut self, cause: StopCause) {
        let stops = self.settings.is_by(cause);
        self.stops_spindle |= stops && self.spindle_on;
        self.stops_coolant |= stops && self.coolant_on;
        self.is_due = self.stops_spindle || self.stops_coolant;
    }

    /// Whether something is still to be stopped. Every tick asks.
    pub(crate) const fn is_due(&self) -> bool {
        self.is_due
    }

    /// What is to be told next.
    pub(crate) const fn take(&mut self) -> Option<Event> {
        let event = if self.stops_spindle {
            self.stops_spindle = false;
            Event::MCode(5)
        } else if self.stops_coolant {
            self.stops_coolant = false;
            Event::MCode(9)
        } else {
            return None;
        };
        self.is_due = self.stops_spindle || self.stops_coolant;
        Some(event)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a life that was killed has left on, the next one has not heard of.
    #[test]
    fn an_abort_stops_what_was_on_before_this_life_and_then_only_what_is_on() {
        let mut stops = Stops::new(StopSettings::default());
        stops.ask(StopCause::Abort);
        let all: Vec<_> = core::iter::from_fn(|| stops.take()).collect();
        assert_eq!(all, [Event::MCode(5), Event::MCode(9)]);
        for event in all {
            stops.hear(event);
        }
        stops.ask(StopCause::Abort);
        assert!(!stops.is_due());
        stops.hear(Event::MCode(3));
        stops.ask(StopCause::Fault);
        assert_eq!(stops.take(), Some(Event::MCode(5)));
        assert_eq!(stops.take(), None);
    }
}
