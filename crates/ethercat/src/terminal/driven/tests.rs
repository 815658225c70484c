//! Tests of terminals that are driven.

use super::*;
use crate::terminal::at::At;
use crate::terminal::bits::{bit, number};
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
            self.dropped += u32::from(self.outputs.obey(&mut self.commands, times, is_safe, image));
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
