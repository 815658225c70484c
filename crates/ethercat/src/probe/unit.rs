//! A unit of a touch probe: switched off and on again, it keeps the next edge.

use super::settings::ProbeUse;
use crate::turns::Round;

/// The bits of a unit's status.
const IS_ON: u8 = 1;
pub(super) const RISING: u8 = 2;
pub(super) const FALLING: u8 = 4;

/// The answers of a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ProbeInputs {
    /// On, stored at a rising edge, at a falling one: bits 0 to 2.
    pub status: u8,
    /// The places that it keeps, counts: at a rising edge, and at a falling one.
    pub places: [i64; 2],
}

impl ProbeInputs {
    /// The same where the counter goes round: what it keeps is near what is counted now.
    pub(crate) fn near(self, round: Option<Round>, counts: i64) -> Self {
        let Some(round) = round else {
            return self;
        };
        #[allow(clippy::cast_possible_truncation, reason = "as the drive shows it")]
        let places = self.places.map(|place| round.counts(place as i32, counts));
        Self { places, ..self }
    }

    /// Whether it keeps an edge, of those of a mask.
    pub(crate) const fn has(&self, edges: u8) -> bool {
        self.status & edges != 0
    }

    /// What a unit that has not answered yet is taken to do: not what it is to.
    pub(crate) const fn unlike(wanted: ProbeUse) -> Self {
        Self {
            status: if matches!(wanted, ProbeUse::Off) {
                IS_ON
            } else {
                0
            },
            places: [0; 2],
        }
    }

    pub(super) const fn is_on(&self) -> bool {
        self.status & IS_ON != 0
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Phase {
    #[default]
    Off,
    Arming,
    Armed,
}

/// A unit, as it is led.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Unit(Phase);

impl Unit {
    /// Takes up what it answers.
    pub(super) const fn hear(&mut self, inputs: &ProbeInputs) {
        let is_on = inputs.status & IS_ON != 0;
        self.0 = match self.0 {
            Phase::Off if !is_on => Phase::Arming,
            Phase::Arming if is_on => Phase::Armed,
            // Its drive has begun anew.
            Phase::Armed if !is_on => Phase::Off,
            same => same,
        };
    }

    /// Forgets what it keeps.
    pub(super) const fn clear(&mut self) {
        self.0 = Phase::Off;
    }

    pub(super) const fn is_armed(self) -> bool {
        matches!(self.0, Phase::Armed)
    }

    /// Whether it is to be on.
    pub(super) const fn is_on(self) -> bool {
        !matches!(self.0, Phase::Off)
    }
}
