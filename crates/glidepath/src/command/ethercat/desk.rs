//! A device that no file describes, with inputs to play with.

use glidepath_ethercat::{AnalogInput, At, DigitalInput, TerminalSettings};

/// Digital and analog inputs of a device that no file names.
const INPUTS: usize = 16;
const ANALOG_INPUTS: usize = 4;

/// A device that has inputs of every kind, for a machine that no file describes.
pub(super) fn desk(position: usize, joints: usize) -> TerminalSettings {
    let object = |index: usize, sub| At::Object {
        index: u16::try_from(index).unwrap_or(u16::MAX),
        sub,
    };
    let blank = |at| DigitalInput {
        at,
        number: None,
        home: None,
        limit_low: None,
        limit_high: None,
        is_inverted: false,
    };
    let mut inputs: Vec<_> = (0..INPUTS)
        .map(|number| DigitalInput {
            number: Some(number),
            ..blank(object(0x6000 + 0x10 * number, 1))
        })
        .collect();
    for joint in 0..joints {
        let at = |sub| object(0x6400 + 0x10 * joint, sub);
        let (home, low, high) = (blank(at(1)), blank(at(2)), blank(at(3)));
        inputs.push(DigitalInput {
            home: Some(joint),
            ..home
        });
        inputs.push(DigitalInput {
            limit_low: Some(joint),
            ..low
        });
        inputs.push(DigitalInput {
            limit_high: Some(joint),
            ..high
        });
    }
    let analog = |number| AnalogInput {
        at: object(0x6800 + 0x10 * number, 0x11),
        number,
        scale: 0.001,
        offset: 0.0,
        is_signed: true,
    };
    TerminalSettings {
        position,
        inputs,
        analog_inputs: (0..ANALOG_INPUTS).map(analog).collect(),
        ..TerminalSettings::default()
    }
}
