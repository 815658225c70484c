//! Outputs as they are driven: by what is commanded, or at rest.
//!
//! ```text
//!  obeyed ──(nobody is to be obeyed)──► spindle at rest ──a cycle──► all at rest
//!    ▲                                                                   │
//!    └── outputs of programs: when somebody is to be again ──────────────┤
//!    └── spindle and coolant: when they were switched off, or anew ──────┘
//! ```

use super::bits::{put_bit, put_number};
use super::commands::Commands;
use super::settings::{AnalogOutput, DigitalOutput};
use super::signal::{Of, Quantity};
use super::wiring::{Wired, Wiring};
use glidepath_link::Auxiliary;
use glidepath_program::{Event, OrientWay};

/// An output.
#[derive(Debug, Clone, Copy)]
struct Driven<T> {
    wired: Wired<T>,
    gate: Gate,
}

/// Whether an output is obeyed, or is to be commanded anew before it is.
#[derive(Debug, Clone, Copy, Default)]
struct Gate {
    waits: bool,
    /// What it obeys was on in the cycle before.
    was_on: bool,
    /// It was obeyed in the cycle before, and was not as it is at rest.
    was_away: bool,
}

impl<T> Driven<T> {
    const fn new(wired: Wired<T>) -> Self {
        Self {
            wired,
            gate: Gate {
                waits: false,
                was_on: false,
                was_away: false,
            },
        }
    }
}

impl Gate {
    /// What it obeys is on or off now; returns whether it is to be at rest all the same. An output of
    /// programs is obeyed whatever has been.
    const fn rests(&mut self, is_on: bool, (of, cycle): (Of, Cycle)) -> bool {
        if matches!(of, Of::Gear) {
            return false;
        }
        let is_safe = cycle.safe > 1 || (cycle.safe == 1 && matches!(of, Of::Spindle));
        let begins = is_on && !self.was_on;
        self.waits |= is_safe || (cycle.is_old_news && begins);
        self.waits &= is_on && !matches!(of, Of::Program);
        self.was_on = is_on;
        self.waits || is_safe
    }
}

impl Gate {
    /// What it is now: at rest or not, and as it is at rest or not. Returns whether it came to rest because
    /// nobody is to be obeyed.
    const fn drops(&mut self, rests: bool, is_as_at_rest: bool, cycle: Cycle) -> bool {
        let drops = self.was_away && rests && cycle.safe > 0;
        self.was_away = !rests && !is_as_at_rest;
        drops
    }
}

/// One cycle, as all outputs see it.
#[derive(Debug, Clone, Copy)]
struct Cycle {
    /// For how many cycles nobody is to be obeyed.
    safe: u32,
    /// What is commanded was so before anybody was obeyed.
    is_old_news: bool,
}

/// All outputs.
#[derive(Debug, Default)]
pub(super) struct DrivenOutputs {
    digital: Vec<Driven<DigitalOutput>>,
    analog: Vec<Driven<AnalogOutput>>,
    /// The drive of the spindle, and the speed at which it is to turn, rev/min.
    spindle: Gate,
    spindle_rpm: f64,
    /// The same as the program gave it, without the operator's override and a direction.
    programmed_rpm: f64,
    /// The angle at which it is to stand.
    spindle_angle: Option<(f64, OrientWay)>,
    /// The gear that is to be in, 0 where nobody said one.
    spindle_gear: u32,
    /// It was commanded since that was asked last.
    is_gear_asked: bool,
    /// The gear whose output is on; `None`: the one that is to be in.
    put_in: Option<u32>,
    has_spindle: bool,
    safe: u32,
    /// Nothing was heard of the record since nobody was to be obeyed.
    is_fresh: bool,
}

impl DrivenOutputs {
    /// Outputs of a bus that has just come up: at rest.
    pub(super) fn new(wiring: &Wiring) -> Self {
        Self {
            digital: wiring.outputs.iter().copied().map(Driven::new).collect(),
            analog: wiring
                .analog_outputs
                .iter()
                .copied()
                .map(Driven::new)
                .collect(),
            // They come to rest when somebody has been obeyed, and are so before.
            safe: 1,
            is_fresh: true,
            has_spindle: wiring.spindle.is_some(),
            ..Self::default()
        }
    }

    /// Takes up what is commanded until `meant_ns`, and writes what outputs are to be. Returns whether one
    /// that was not at rest came to rest because nobody is to be obeyed.
    pub(super) fn obey(
        &mut self,
        commands: &mut Commands,
        (now_ns, meant_ns): (u64, u64),
        is_safe: bool,
        image: &mut [u8],
    ) -> bool {
        let is_news = commands.advance(now_ns, meant_ns, &mut |event| self.command(event));
        self.safe = if is_safe {
            self.safe.saturating_add(1)
        } else {
            0
        };
        let cycle = Cycle {
            safe: self.safe,
            is_old_news: is_news && self.is_fresh,
        };
        self.is_fresh = is_safe || (self.is_fresh && !is_news);
        self.spindle_gear = commands.now().spindle_gear;
        match self.put_in {
            None => self.put(commands.now(), cycle, image),
            Some(spindle_gear) => {
                let record = Auxiliary {
                    spindle_gear,
                    ..*commands.now()
                };
                self.put(&record, cycle, image)
            }
        }
    }

    fn command(&mut self, event: Event) {
        self.is_gear_asked |= matches!(event, Event::SpindleGear(_));
        for output in &mut self.digital {
            output.gate.waits &= !output.wired.what.from.is_commanded_by(event);
        }
        for output in &mut self.analog {
            output.gate.waits &= !output.wired.what.from.is_commanded_by(event);
        }
        self.spindle.waits &= !Quantity::SpindleVelocity.is_commanded_by(event);
    }

    fn put(&mut self, record: &Auxiliary, cycle: Cycle, image: &mut [u8]) -> bool {
        let mut has_dropped = false;
        for output in &mut self.digital {
            let what = output.wired.what;
            let is_on = what.from.is_on(record);
            let rests = output.gate.rests(is_on, (what.from.of(), cycle));
            let level = if rests {
                what.rest
            } else {
                is_on != what.is_inverted
            };
            has_dropped |= output.gate.drops(rests, level == what.rest, cycle);
            put_bit(image, output.wired.bit, level);
        }
        for output in &mut self.analog {
            let what = output.wired.what;
            let mut value = what.from.value(record);
            let rests = output
                .gate
                .rests(value.abs() > 0.0, (what.from.of(), cycle));
            if rests {
                value = what.rest;
            }
            let is_as_at_rest = (value - what.rest).abs() <= 0.0;
            has_dropped |= output.gate.drops(rests, is_as_at_rest, cycle);
            put_value(image, &output.wired, value);
        }
        let wanted_rpm = Quantity::SpindleVelocity.value(record);
        let angle = record.orientation();
        let is_on = wanted_rpm.abs() > 0.0 || angle.is_some();
        let rests = self.spindle.rests(is_on, (Of::Spindle, cycle));
        self.spindle_rpm = if rests { 0.0 } else { wanted_rpm };
        self.programmed_rpm = record.spindle_speed.abs();
        self.spindle_angle = angle.filter(|_| !rests);
        has_dropped | (self.has_spindle && self.spindle.drops(rests, !is_on, cycle))
    }

    /// The speed at which the drive of the spindle is to turn, rev/min.
    pub(super) const fn spindle_rpm(&self) -> f64 {
        self.spindle_rpm
    }

    /// The gear in which it is to turn, 0 where nobody said one.
    pub(super) const fn spindle_gear(&self) -> u32 {
        self.spindle_gear
    }

    /// Whether that was commanded since this was asked last.
    pub(super) const fn take_asked_gear(&mut self) -> bool {
        core::mem::replace(&mut self.is_gear_asked, false)
    }

    /// The gear whose output is on from the next cycle on, as the spindle's drive leads the change.
    pub(super) const fn put_gear_in(&mut self, gear: u32) {
        self.put_in = Some(gear);
    }

    /// The speed that the program gave it, rev/min.
    pub(super) const fn programmed_rpm(&self) -> f64 {
        self.programmed_rpm
    }

    /// The angle at which it is to stand instead, degrees, and the way there.
    pub(super) const fn spindle_angle(&self) -> Option<(f64, OrientWay)> {
        self.spindle_angle
    }
}

/// The outputs of all devices at rest.
pub(crate) fn at_rest(wiring: &Wiring) -> Vec<u8> {
    let mut image = wiring.unwired.clone();
    image.resize(wiring.sizes.0, 0);
    if let Some(spindle) = &wiring.spindle {
        spindle.put(&mut image, &spindle.at_rest());
    }
    for output in &wiring.outputs {
        put_bit(&mut image, output.bit, output.what.rest);
    }
    for output in &wiring.analog_outputs {
        put_value(&mut image, output, output.what.rest);
    }
    image
}

/// Writes a value in counts: at most the full ones, and as many below zero where a sign has room.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "it is inside the type, and a negative number is written as its bits"
)]
fn put_value(image: &mut [u8], output: &Wired<AnalogOutput>, value: f64) {
    let what = &output.what;
    let most = f64::from(what.full_counts);
    let has_sign = u64::from(what.full_counts) < 1 << (output.bits - 1);
    let least = if has_sign { -most } else { 0.0 };
    let counts = (value / what.full * most).round().clamp(least, most);
    put_number(image, output.bit, output.bits, counts as i64 as u32);
}

#[cfg(test)]
mod tests;
