//! A machine with a coupler and terminals beside its drives: a whole life of it, and what is left of
//! it when a cable is pulled.
//!
//! ```text
//!  drives 0 1 2 ─── coupler 3 ─── inputs 4 ─── outputs 5 ─── analog outputs 6 ─── analog inputs 7
//! ```

mod cut_off;
mod shift;
mod whole_life;

use crate::machine::{Outcome, Setup};
use glidepath_emulator::{ClockKind, DriveSettings as Emulated, OutputRecord, Segment};
use glidepath_ethercat::{
    AnalogInput, AnalogOutput, At, DigitalInput, DigitalOutput, Event, Parameter, Quantity, Signal,
    TerminalSettings,
};
use glidepath_interpolator::{JointHoming, ProbeInput};

pub(crate) const INPUTS: usize = 4;
pub(crate) const OUTPUTS: usize = 5;
const SPEED: usize = 6;
pub(crate) const LEVEL: usize = 7;
/// Bits of the outputs: forward, reverse, flood, output 5, and one that is on at rest.
pub(crate) const FORWARD: u8 = 1;
pub(crate) const FLOOD: u8 = 4;
pub(crate) const FIFTH: u8 = 8;
pub(crate) const LAMP: u8 = 16;
/// Where the home switch of J0 closes and the part begins, as the drives count, mm.
const EDGE: f64 = -10.0;
const PART_Z: f64 = -7.25;

const fn object(index: u16, sub: u8) -> At {
    At::Object { index, sub }
}

const fn input(index: u16) -> DigitalInput {
    DigitalInput {
        at: object(index, 1),
        number: None,
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    }
}

const fn output(index: u16, from: Signal) -> DigitalOutput {
    DigitalOutput {
        at: object(index, 1),
        from,
        is_inverted: false,
        rest: false,
    }
}

fn terminals() -> Vec<TerminalSettings> {
    let at = |position| TerminalSettings {
        position,
        ..TerminalSettings::default()
    };
    vec![
        at(3),
        TerminalSettings {
            inputs: vec![
                DigitalInput {
                    home: Some(0),
                    ..input(0x6000)
                },
                DigitalInput {
                    number: Some(0),
                    ..input(0x6010)
                },
                // A switch that opens.
                DigitalInput {
                    limit_high: Some(1),
                    is_inverted: true,
                    ..input(0x6020)
                },
            ],
            ..at(INPUTS)
        },
        TerminalSettings {
            outputs: vec![
                output(0x7000, Signal::SpindleForward),
                output(0x7010, Signal::SpindleReverse),
                output(0x7020, Signal::Flood),
                output(0x7030, Signal::Output(5)),
                DigitalOutput {
                    rest: true,
                    ..output(0x7040, Signal::Output(6))
                },
            ],
            ..at(OUTPUTS)
        },
        TerminalSettings {
            analog_outputs: vec![AnalogOutput {
                at: object(0x7010, 1),
                from: Quantity::SpindleSpeed,
                full: 24_000.0,
                full_counts: 32_767,
                rest: 0.0,
            }],
            parameters: vec![Parameter {
                index: 0x8000,
                sub: 1,
                size: 2,
                value: 7,
            }],
            ..at(SPEED)
        },
        TerminalSettings {
            assign_inputs: Some(vec![0x1a00, 0x1a03]),
            analog_inputs: vec![AnalogInput {
                at: object(0x6010, 0x11),
                number: 2,
                scale: 10.0 / 32_768.0,
                offset: 0.0,
                is_signed: true,
            }],
            ..at(LEVEL)
        },
    ]
}

/// The probe at the first of the inputs, high where it touches.
pub(crate) const PROBE: ProbeInput = ProbeInput {
    number: 0,
    high: true,
    protects: false,
};

/// How a joint is brought home by a switch, whose edge is at a place.
pub(crate) const fn homing_by_a_switch(offset: f64) -> JointHoming {
    JointHoming {
        search_v: -20.0,
        latch_v: 1.0,
        final_v: 50.0,
        index: None,
        offset,
        home: 0.0,
        absolute: None,
        sequence: 0,
        is_shared: false,
        is_volatile: false,
        ignores_limits: false,
        search_travel: 60.0,
        clearance: 2.0,
    }
}

/// Outputs that were cut off fell by the watchdogs of their terminals, and what is told is that the device at a
/// position is gone: drives take part as before.
#[track_caller]
pub(crate) fn assert_fell_by_watchdogs(
    (setup, outcome): (&Setup, &Outcome),
    fell: &OutputRecord,
    (position, unplugged_ns): (usize, u64),
) {
    let late_ns = fell.at_ns - unplugged_ns;
    assert_eq!(fell.outputs, [0]);
    assert!(
        late_ns <= setup.bus.watchdog_ns + setup.bus.period_ns,
        "{late_ns}"
    );
    assert!(
        outcome.events.contains(&Event::TerminalGone(position)),
        "{:?}",
        outcome.events
    );
    let is_of_drive = |event: &Event| matches!(event, Event::Gone(_) | Event::LeftOp(..));
    assert!(
        !outcome.events.iter().any(is_of_drive),
        "{:?}",
        outcome.events
    );
    assert!(!outcome.events.contains(&Event::NobodyStops));
}

/// Three axes and the terminals; J0 is brought home by its switch.
pub(crate) fn setup() -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    setup.emulated.extend([
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::inputs(4),
        Emulated::outputs(8),
        Emulated::analog_outputs(2),
        Emulated::analog_inputs(4),
    ]);
    setup.terminals = terminals();
    setup.homing = Some(homing_by_a_switch(-10.5));
    setup.probe = Some(PROBE);
    setup
}

/// 6000 of 24 000 rev/min.
pub(crate) const QUARTER: u16 = 8192;

/// What outputs were when a part was over: digital ones, and counts of the speed.
pub(crate) type Pins = (u8, u16);

pub(crate) fn pins(segment: &Segment) -> Pins {
    let (bits, speed) = (segment.outputs(OUTPUTS), segment.outputs(SPEED));
    (bits[0], u16::from_le_bytes([speed[2], speed[3]]))
}
