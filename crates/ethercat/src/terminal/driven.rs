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
use glidepath_program::Event;

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
        self.put(commands.now(), cycle, image)
    }

    fn command(&mut self, event: Event) {
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
        let is_on = wanted_rpm.abs() > 0.0;
        let rests = self.spindle.rests(is_on, (Of::Spindle, cycle));
        self.spindle_rpm = if rests { 0.0 } else { wanted_rpm };
        has_dropped | (self.has_spindle && self.spindle.drops(rests, !is_on, cycle))
    }

    /// The speed at which the drive of the spindle is to turn, rev/min.
    pub(super) const fn spindle_rpm(&self) -> f64 {
        self.spindle_rpm
    }
}

/// The outputs of all devices at rest.
pub(crate) fn at_rest(wiring: &Wiring) -> Vec<u8> {
    let mut image = wiring.unwired.clone();
    image.resize(wiring.sizes.0, 0);
    if let Some(spindle) = &wiring.spindle {
        spindle.put(&mut image, 0, 0);
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
mod tests {
    use super::*;
    use crate::terminal::bits::{bit, number};
    use crate::terminal::settings::At;
    use crate::terminal::signal::Signal;
    use bytemuck::Zeroable as _;
    use glidepath_link::{EventRecord, Setpoint};

    /// Bit 0 turns the spindle, bit 1 is output 5 and on at rest, bytes 1 and 2 are its speed.
    fn wiring() -> Wiring {
        let digital = |bit, from, rest| Wired {
            bit,
            bits: 1,
            what: DigitalOutput {
                at: At::Bit(0),
                from,
                is_inverted: false,
                rest,
            },
        };
        Wiring {
            outputs: vec![
                digital(0, Signal::SpindleForward, false),
                digital(1, Signal::Output(5), true),
            ],
            analog_outputs: vec![Wired {
                bit: 8,
                bits: 16,
                what: AnalogOutput {
                    at: At::Bit(8),
                    from: Quantity::SpindleVelocity,
                    full: 24_000.0,
                    full_counts: 32_767,
                    rest: 0.0,
                },
            }],
            sizes: (3, 0),
            ..Wiring::default()
        }
    }

    struct Desk {
        outputs: DrivenOutputs,
        commands: Commands,
        image: Vec<u8>,
        now_ns: u64,
        /// Cycles in which outputs came to rest.
        dropped: u32,
    }

    impl Desk {
        fn new() -> Self {
            let wiring = wiring();
            Self {
                outputs: DrivenOutputs::new(&wiring),
                commands: Commands::new(),
                image: at_rest(&wiring),
                now_ns: 1_000_000_000,
                dropped: 0,
            }
        }

        fn say(&mut self, events: &[Event]) {
            let mut setpoint = Setpoint {
                boot_id: 9,
                scheduled_ns: self.now_ns,
                ..Setpoint::zeroed()
            };
            for event in events {
                assert!(setpoint.tell(EventRecord::new(*event, 0)));
            }
            self.commands.note(&setpoint);
        }

        /// Some cycles; what comes out: spindle, output 5, counts of the speed.
        fn cycles(&mut self, cycles: u32, is_safe: bool) -> (bool, bool, u32) {
            for _ in 0..cycles {
                self.now_ns += 1_000_000;
                let times = (self.now_ns, self.now_ns);
                let image = &mut self.image;
                self.dropped +=
                    u32::from(self.outputs.obey(&mut self.commands, times, is_safe, image));
            }
            let image = &self.image;
            (bit(image, 0), bit(image, 1), number(image, 8, 16))
        }
    }

    const TURN: [Event; 3] = [
        Event::SpindleSpeed(12_000.0),
        Event::MCode(3),
        Event::DigitalOutput {
            number: 5,
            on: false,
        },
    ];
    /// 12 000 of 24 000 rev/min.
    const HALF: u32 = 16_384;

    #[test]
    fn the_spindle_comes_to_rest_before_all_others() {
        let mut desk = Desk::new();
        assert_eq!(desk.cycles(2, true), (false, true, 0));
        desk.say(&TURN);
        assert_eq!(desk.cycles(1, false), (true, false, HALF));
        assert_eq!(desk.dropped, 0);
        assert_eq!(desk.cycles(1, true), (false, false, 0));
        assert_eq!(desk.cycles(1, true), (false, true, 0));
        // One cycle for those of the spindle, one for all others.
        assert_eq!(desk.dropped, 2);
        desk.cycles(5, true);
        desk.cycles(5, false);
        assert_eq!(desk.dropped, 2);
    }

    #[test]
    fn outputs_that_are_as_they_are_at_rest_do_not_come_to_rest() {
        let mut desk = Desk::new();
        let lamp = |on| [Event::DigitalOutput { number: 5, on }];
        for _ in 0..3 {
            desk.say(&lamp(true));
            desk.cycles(5, false);
            desk.cycles(5, true);
            assert_eq!(desk.dropped, 0);
        }
        desk.say(&lamp(false));
        desk.cycles(5, false);
        // Commanded by the program, whatever it is at rest.
        desk.say(&lamp(true));
        desk.cycles(5, false);
        assert_eq!(desk.dropped, 0);
    }

    #[test]
    fn the_spindle_does_not_start_again_by_itself() {
        let mut desk = Desk::new();
        desk.say(&TURN);
        desk.cycles(1, false);
        desk.cycles(5, true);
        // Outputs of programs come back; the spindle is to be told anew.
        assert_eq!(desk.cycles(5, false), (false, false, 0));
        desk.say(&[Event::SpindleSpeed(6000.0)]);
        assert_eq!(desk.cycles(1, false), (false, false, 0));
        desk.say(&[Event::MCode(3)]);
        assert_eq!(desk.cycles(1, false), (true, false, HALF / 2));
        desk.cycles(5, true);
        // It was switched off meanwhile.
        desk.say(&[Event::MCode(5)]);
        assert_eq!(desk.cycles(1, true), (false, true, 0));
        desk.say(&[Event::MCode(4)]);
        assert_eq!(desk.cycles(1, false), (false, false, 0x1_0000 - HALF / 2));
    }

    #[test]
    fn a_record_of_before_does_not_start_the_spindle_and_a_later_one_does() {
        let mut desk = Desk::new();
        let mut record = Auxiliary {
            boot_id: 9,
            digital_out: 1 << 5,
            ..Auxiliary::default()
        };
        record.take(Event::SpindleSpeed(12_000.0));
        record.take(Event::MCode(3));
        desk.commands.hear(&record, desk.now_ns);
        desk.say(&[]);
        assert_eq!(desk.cycles(200, false), (false, true, 0));
        record.take(Event::MCode(5));
        record.digital_out = 0;
        desk.commands.hear(&record, desk.now_ns);
        assert_eq!(desk.cycles(200, false), (false, false, 0));
        // Its event was lost.
        record.take(Event::MCode(3));
        desk.commands.hear(&record, desk.now_ns);
        assert_eq!(desk.cycles(200, false), (true, false, HALF));
    }

    #[test]
    fn values_end_where_their_counts_do() {
        let mut image = [0; 3];
        let mut output = wiring().analog_outputs[0];
        let mut counts = |output: &Wired<AnalogOutput>, value| {
            put_value(&mut image, output, value);
            number(&image, 8, 16)
        };
        assert_eq!(counts(&output, 1e9), 32_767);
        assert_eq!(counts(&output, -1e9), 0x8001);
        assert_eq!(counts(&output, f64::NAN), 0);
        // No room for a sign.
        output.what.full_counts = 65_535;
        assert_eq!(counts(&output, 24_000.0), 65_535);
        assert_eq!(counts(&output, -5.0), 0);
    }
}
