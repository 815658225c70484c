//! Devices at work: their inputs as feedback has them, and their outputs.

use super::bits::{bit, number};
use super::commands::Commands;
use super::driven::DrivenOutputs;
use super::encoder::Encoder;
use super::joint_encoder::JointEncoder;
use super::settings::AnalogInput;
use super::spindle_drive::{SpindleCycle, SpindleDrive, SpindleLoss};
use super::wiring::{Wired, Wiring};
use crate::device_state::DeviceState;
use crate::event::Event;
use glidepath_link::{Auxiliary, Feedback, Setpoint};

/// The answers of all devices in one cycle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Answered<'a> {
    /// When the frame was sent, ns.
    pub(crate) sent_ns: u64,
    /// Whether all took part in the process data.
    pub(crate) is_whole: bool,
    /// Their inputs, as they came last.
    pub(crate) inputs: &'a [u8],
    /// Their states.
    pub(crate) states: &'a [DeviceState],
}

/// Devices at work.
#[derive(Debug)]
pub(crate) struct Terminals {
    commands: Commands,
    outputs: DrivenOutputs,
    spindle: Option<SpindleDrive>,
    encoder: Option<Encoder>,
    joint_encoders: Vec<JointEncoder>,
    /// By how much samples are stamped earlier, ns.
    delay_ns: u64,
    wiring: Wiring,
    inputs: Vec<u8>,
    /// Place in the line of each, and the state that was told last.
    told: Vec<(usize, DeviceState)>,
    /// Frames in a row in which not all took part.
    short: u32,
    most_short: u32,
    was_told_short: bool,
}

impl Terminals {
    /// Devices of which nothing is known yet; so many frames in a row may be without one of them, and samples
    /// are stamped earlier by `delay_ns`.
    pub(crate) fn new(most_short: u32, delay_ns: u64) -> Self {
        Self {
            commands: Commands::new(),
            outputs: DrivenOutputs::default(),
            spindle: None,
            encoder: None,
            joint_encoders: Vec::new(),
            delay_ns,
            wiring: Wiring::default(),
            inputs: Vec::new(),
            told: Vec::new(),
            short: 0,
            most_short,
            was_told_short: false,
        }
    }

    /// The bus has come up, with the devices at these places of the line.
    pub(crate) fn begin(&mut self, wiring: &Wiring, positions: impl Iterator<Item = usize>) {
        self.wiring = wiring.clone();
        self.outputs = DrivenOutputs::new(wiring);
        self.spindle = wiring.spindle.map(SpindleDrive::new);
        let encoder = |wired| Encoder::new(wired, self.delay_ns);
        self.encoder = wiring.encoder.map(encoder);
        let of_joints = wiring.joint_encoders.iter().copied();
        self.joint_encoders = of_joints.map(JointEncoder::new).collect();
        self.inputs = vec![0; wiring.sizes.1];
        let told = positions.map(|position| (position, DeviceState::in_op()));
        self.told = told.collect();
        (self.short, self.was_told_short) = (0, false);
    }

    /// A setpoint has come.
    pub(crate) fn note(&mut self, setpoint: &Setpoint) {
        self.commands.note(setpoint);
    }

    /// The auxiliary record has come.
    pub(crate) fn hear_record(&mut self, record: &Auxiliary, now_ns: u64) {
        self.commands.hear(record, now_ns);
    }

    /// Takes up what they answered. The inputs of before stay where one did not.
    pub(crate) fn hear(&mut self, answered: Answered<'_>, tell: &mut dyn FnMut(Event)) {
        if answered.is_whole {
            for (own, byte) in self.inputs.iter_mut().zip(answered.inputs) {
                *own = *byte;
            }
        }
        let inputs_of = |nth: usize| {
            let state = answered.states.get(nth);
            let is_there = answered.is_whole && state.is_some_and(|state| state.is_in_op());
            is_there.then_some(&self.inputs[..])
        };
        if let Some(encoder) = &mut self.encoder {
            encoder.hear(inputs_of(encoder.nth()), answered.sent_ns, tell);
        }
        for encoder in &mut self.joint_encoders {
            encoder.hear(inputs_of(encoder.nth()), answered.sent_ns);
        }
        self.short = if answered.is_whole {
            0
        } else {
            self.short.saturating_add(1)
        };
        for ((position, told), state) in self.told.iter_mut().zip(answered.states) {
            if told != state {
                *told = *state;
                if state.state == 0 {
                    tell(Event::TerminalGone(*position));
                } else if !state.is_in_op() {
                    tell(Event::TerminalLeftOp(*position, state.code));
                }
            }
        }
        let is_short = self.short >= self.most_short;
        if is_short && !self.was_told_short && self.missing().is_none() {
            tell(Event::TerminalsShort);
        }
        self.was_told_short = is_short;
    }

    /// The first device that is not in OP.
    pub(crate) fn missing(&self) -> Option<usize> {
        let mut told = self.told.iter();
        told.find(|(_, state)| !state.is_in_op())
            .map(|(position, _)| *position)
    }

    /// Whether a device is lost.
    pub(crate) fn has_lost(&self) -> bool {
        self.short >= self.most_short || self.missing().is_some()
    }

    /// Writes what the outputs are to be, for what is commanded until `meant_ns`; at rest where
    /// nobody is to be obeyed. Returns whether an output that was not at rest came to rest by that.
    pub(crate) fn obey(
        &mut self,
        (now_ns, meant_ns): (u64, u64),
        (is_safe, resets): (bool, bool),
        image: &mut [u8],
        tell: &mut dyn FnMut(Event),
    ) -> bool {
        let times = (now_ns, meant_ns);
        let has_dropped = self.outputs.obey(&mut self.commands, times, is_safe, image);
        if let Some(spindle) = &mut self.spindle {
            let device = self.told.get(spindle.nth());
            let is_in_op = device.is_some_and(|(_, state)| state.is_in_op());
            let cycle = SpindleCycle {
                now_ns,
                wanted_rpm: self.outputs.spindle_rpm(),
                programmed_rpm: self.outputs.programmed_rpm(),
                angle: self.outputs.spindle_angle(),
                gear: self.outputs.spindle_gear(),
                is_gear_asked: self.outputs.take_asked_gear(),
                inputs: self.wiring.numbered(&self.inputs),
                is_safe,
                is_present: is_in_op,
                is_heard: self.short == 0,
                resets,
                is_due: self.commands.has_due_of_spindle(),
            };
            spindle.cycle(cycle, &self.inputs, image, tell);
            if let Some(gear) = spindle.put_in() {
                self.outputs.put_gear_in(gear);
            }
        }
        if let Some(encoder) = &mut self.encoder {
            encoder.put(image, self.outputs.spindle_rpm() / 60.0);
        }
        has_dropped
    }

    /// Where the encoder of a joint says that this was at the moment of a sample, mm or degrees; `None` while it is
    /// not heard.
    pub(crate) fn joint_place(&self, joint: usize, sample_ns: u64) -> Option<f64> {
        let mut encoders = self.joint_encoders.iter();
        let encoder = encoders.find(|encoder| encoder.joint() == joint)?;
        encoder.place(sample_ns.saturating_add(self.delay_ns))
    }

    /// What is lost of the spindle; `None` if nothing is.
    pub(crate) fn spindle_fault(&self) -> Option<SpindleLoss> {
        self.spindle.as_ref()?.failed()
    }

    /// Whether the spindle stands without power, or nobody can take it.
    pub(crate) fn is_spindle_off(&self) -> bool {
        self.spindle.as_ref().is_none_or(SpindleDrive::is_off)
    }

    /// Adds what they know.
    pub(crate) fn tell(&mut self, feedback: &mut Feedback) {
        for wired in &self.wiring.inputs {
            wired.what.tell(bit(&self.inputs, wired.bit), feedback);
        }
        if let Some(spindle) = &self.spindle {
            spindle.tell(feedback);
        }
        if let Some(encoder) = &mut self.encoder {
            encoder.tell(feedback, self.spindle.is_some());
        }
        for wired in &self.wiring.analog_inputs {
            if let Some(place) = feedback.analog_in.get_mut(wired.what.number) {
                *place = value(&self.inputs, wired);
            }
        }
    }
}

/// The value of an analog input, in its unit.
#[allow(
    clippy::cast_possible_wrap,
    reason = "the bits of a number with a sign"
)]
fn value(inputs: &[u8], wired: &Wired<AnalogInput>) -> f64 {
    let what = &wired.what;
    let raw = number(inputs, wired.bit, wired.bits);
    let counts = if what.is_signed {
        let unused = 32 - wired.bits.clamp(1, 32);
        f64::from((raw << unused) as i32 >> unused)
    } else {
        f64::from(raw)
    };
    counts * what.scale + what.offset
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terminal::at::At;
    use crate::terminal::settings::DigitalInput;
    use bytemuck::Zeroable as _;

    fn switch(bit: usize, is_inverted: bool) -> Wired<DigitalInput> {
        Wired {
            bit,
            bits: 1,
            what: DigitalInput {
                at: At::Bit(0),
                number: Some(60 + bit),
                home: Some(bit),
                limit_low: None,
                limit_high: (bit == 1).then_some(2),
                is_inverted,
            },
        }
    }

    fn terminals() -> Terminals {
        let analog = Wired {
            bit: 8,
            bits: 16,
            what: AnalogInput {
                at: At::Bit(8),
                number: 3,
                scale: 0.5,
                offset: 1.0,
                is_signed: true,
            },
        };
        let wiring = Wiring {
            inputs: vec![switch(0, false), switch(1, true)],
            analog_inputs: vec![analog],
            sizes: (0, 3),
            ..Wiring::default()
        };
        let mut terminals = Terminals::new(3, 0);
        terminals.begin(&wiring, [4, 6].into_iter());
        terminals
    }

    fn told(terminals: &mut Terminals) -> Feedback {
        let mut feedback = Feedback {
            joints: 7,
            fault: 2,
            ..Feedback::zeroed()
        };
        feedback.fault_code[1] = 0x8611;
        terminals.tell(&mut feedback);
        feedback
    }

    #[test]
    fn inputs_are_all_that_they_are_said_to_be() {
        let mut terminals = terminals();
        let states = [DeviceState::in_op(); 2];
        let mut events = Vec::new();
        let inputs = &[0b01, 0xfe, 0xff];
        let whole = Answered {
            sent_ns: 0,
            is_whole: true,
            inputs,
            states: &states,
        };
        terminals.hear(whole, &mut |event| events.push(event));
        let said = told(&mut terminals);
        assert_eq!(said.digital_in, 0b11 << 60);
        let switches = (said.home_switch, said.limit_low, said.limit_high);
        assert_eq!(switches, (0b11, 0, 0b100));
        // −2 counts.
        assert!(said.analog_in[3].abs() < 1e-12, "{}", said.analog_in[3]);
        assert_eq!((said.fault, events.len()), (2, 0));
    }

    #[test]
    fn a_device_is_lost_when_it_says_so_or_frames_are_short() {
        let mut terminals = terminals();
        let mut events = Vec::new();
        let (op, gone) = (DeviceState::in_op(), DeviceState::default());
        let mut hear = |is_whole, states: [DeviceState; 2], inputs: &[u8]| {
            let answered = Answered {
                sent_ns: 0,
                is_whole,
                inputs,
                states: &states,
            };
            terminals.hear(answered, &mut |event| events.push(event));
            (
                told(&mut terminals).digital_in,
                terminals.has_lost(),
                terminals.missing(),
            )
        };
        let both = 0b11 << 60;
        assert_eq!(hear(true, [op; 2], &[1, 0, 0]), (both, false, None));
        // A frame or two without one of them is no loss, and its inputs stay.
        for _ in 0..2 {
            assert_eq!(hear(false, [op; 2], &[0, 0, 0]), (both, false, None));
        }
        assert_eq!(hear(false, [op; 2], &[0; 3]), (both, true, None));
        assert_eq!(hear(false, [op, gone], &[0; 3]), (both, true, Some(6)));
        assert!(!hear(true, [op; 2], &[0, 0, 0]).1);
        let left = DeviceState {
            state: 4,
            has_error: true,
            code: 0x1b,
        };
        assert_eq!(hear(true, [left, op], &[0, 0, 0]).2, Some(4));
        let expected = [
            Event::TerminalsShort,
            Event::TerminalGone(6),
            Event::TerminalLeftOp(4, 0x1b),
        ];
        assert_eq!(events, expected);
    }
}
