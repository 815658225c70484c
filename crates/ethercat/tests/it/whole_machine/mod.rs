//! A whole machine on one line: a coupler with terminals of every kind and a cable onwards, a junction, drives with
//! touch probes, and the drive of a spindle.
//!
//! ```text
//!  coupler 0 ┬ port 3 ─ inputs 1 ─ outputs 2 ─ analog outputs 3 ─ analog inputs 4 ─ encoder 5
//!            └ port 2 ─ junction 6 ┬ port 3 ─ drive 7
//!                                  ├ port 1 ─ drive 8
//!                                  └ port 2 ─ drive 9 ─ spindle 10
//! ```

mod life;
mod odd;
mod work;

use crate::machine::{COUNTS, START_NS, Setup};
use crate::terminals::{PROBE, homing_by_a_switch};
use core::time::Duration;
use glidepath_emulator::{
    Cable, ClockKind, DriveSettings as Emulated, Encoder, Probe, Segment, SpindleMotor,
    TouchProbe as Emulates,
};
use glidepath_ethercat::{
    AnalogInput, AnalogOutput, At, DigitalInput, DigitalOutput, EncoderSettings, Mapping, Quantity,
    Signal, SpindleMode, SpindleSettings, TerminalSettings, TouchProbe,
};
use glidepath_interpolator::{AnswerSource, MCodeWait};

const INPUTS: usize = 1;
const OUTPUTS: usize = 2;
const LEVEL: usize = 3;
const GAUGE: usize = 4;
const ENCODER: usize = 5;
const DRIVES: [usize; 3] = [7, 8, 9];
const SPINDLE: usize = 10;

/// Bits of the outputs: the spindle's enabling, coolant, output 5, and a lamp that is on at rest.
const FORWARD: u8 = 1;
const FLOOD: u8 = 2;
const FIFTH: u8 = 4;
const LAMP: u8 = 8;

/// Where the home switch of each joint closes and the part begins, as drives count, mm.
const EDGES: [f64; 3] = [-10.0, -8.0, -12.0];
const PART_Z: f64 = -7.250_31;
/// Where the edge of a switch is, as the machine counts, mm.
const HOME_EDGE: f64 = -10.5;
/// Of the encoder, and where in a revolution its index is.
const COUNTS_PER_REV: u32 = 4096;
const INDEX_AT: f64 = 0.3;
/// How fast the spindle is led, rev/min in a second, and how near it has to be to its speed.
const RAMP: f64 = 10_000.0;
const NEAR: f64 = 0.02;

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

const fn output(index: u16, from: Signal, rest: bool) -> DigitalOutput {
    DigitalOutput {
        at: object(index, 1),
        from,
        is_inverted: false,
        rest,
    }
}

fn at(position: usize) -> TerminalSettings {
    TerminalSettings {
        position,
        ..TerminalSettings::default()
    }
}

fn terminals() -> Vec<TerminalSettings> {
    let home = |joint: u16| DigitalInput {
        home: Some(usize::from(joint)),
        ..input(0x6000 + 0x10 * joint)
    };
    vec![
        at(0),
        TerminalSettings {
            inputs: vec![
                home(0),
                home(1),
                home(2),
                DigitalInput {
                    number: Some(0),
                    ..input(0x6030)
                },
            ],
            ..at(INPUTS)
        },
        TerminalSettings {
            outputs: vec![
                output(0x7000, Signal::SpindleForward, false),
                output(0x7010, Signal::Flood, false),
                output(0x7020, Signal::Output(5), false),
                output(0x7030, Signal::Output(6), true),
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
            ..at(LEVEL)
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
            ..at(GAUGE)
        },
        TerminalSettings {
            encoder: Some(EncoderSettings {
                counts_per_rev: COUNTS_PER_REV,
                has_index: true,
                is_inverted: false,
                near_r: 0.03,
            }),
            ..at(ENCODER)
        },
        at(6),
        TerminalSettings {
            spindle: Some(SpindleSettings {
                mode: SpindleMode::Velocity,
                units_per_rpm: 1.0,
                is_inverted: false,
                max_rpm: 8000.0,
                ramp_rpm_per_s: RAMP,
                at_speed_r: NEAR,
                gears: None,
                orientation: None,
                tells_load: false,
                mapping: Mapping::Written,
            }),
            ..at(SPINDLE)
        },
    ]
}

fn line() -> Vec<Emulated> {
    let drive = Emulated {
        touch_probe: Some(Emulates::default()),
        ..Emulated::default()
    };
    vec![
        Emulated::terminal("COUPLER", ClockKind::Bits64),
        Emulated::inputs(4),
        Emulated::outputs(4),
        Emulated::analog_outputs(2),
        Emulated::analog_inputs(4),
        Emulated::encoder(16),
        Emulated::terminal("JUNCTION", ClockKind::ReceiveTimes),
        drive.clone(),
        drive.clone(),
        drive,
        Emulated {
            spindle: Some(SpindleMotor {
                counts_per_rev: 60_000.0,
                torque_rpm_per_s: 20_000.0,
                coast_t: 4.0,
            }),
            // An inverter has no clock.
            clock: ClockKind::ReceiveTimes,
            ..Emulated::default()
        },
    ]
}

fn cables() -> [Cable; 10] {
    let cable = |from, port, way_ns| Cable {
        from,
        port,
        into: 0,
        way_ns,
    };
    [
        cable(0, 3, 150),
        cable(1, 1, 150),
        cable(2, 1, 150),
        cable(3, 1, 150),
        cable(4, 1, 150),
        cable(0, 2, 9_000),
        cable(6, 3, 2_000),
        cable(6, 1, 12_000),
        cable(6, 2, 700),
        cable(9, 1, 25_000),
    ]
}

/// Three axes that come home by switches at a terminal, with everything on the line.
fn setup() -> Setup {
    let mut setup = Setup::absolute(2_000_000);
    for (drive, position) in setup.drives.iter_mut().zip(DRIVES) {
        drive.position = position;
        drive.probe = Some(TouchProbe {
            unit: 1,
            number: 0,
            is_inverted: false,
            source: None,
        });
    }
    setup.emulated = line();
    setup.terminals = terminals();
    setup.homed = 3;
    setup.homing = Some(homing_by_a_switch(HOME_EDGE));
    setup.probe = Some(PROBE);
    // M3 and M4 are done at speed.
    setup.waits = vec![MCodeWait {
        first: 3,
        last: 4,
        answer: AnswerSource::SpindleAtSpeed,
        within: Some(Duration::from_secs(10)),
        is_late: false,
    }];
    setup
}

/// The line as it was switched on a while ago, with what is wired to it.
fn segment(setup: &Setup) -> Segment {
    let mut segment =
        Segment::branched(&setup.emulated, &cables(), START_NS - 3_000_000_000).unwrap();
    segment.keep_records();
    segment.add_encoder(Encoder {
        device: ENCODER,
        spindle: (SPINDLE, 0),
        counts_per_rev: f64::from(COUNTS_PER_REV),
        index_at: INDEX_AT,
    });
    segment.add_probe(Probe {
        drive: (DRIVES[2], 0),
        at_counts: PART_Z * COUNTS,
        is_closed_above: false,
        inputs: vec![(INPUTS, 3)],
        filter_ns: 3_000_000,
        drive_inputs: Vec::new(),
    });
    segment
}
