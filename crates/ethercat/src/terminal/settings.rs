//! The settings of a device that is no drive: what its inputs mean, and what its outputs obey.

use super::at::At;
use super::encoder_settings::EncoderSettings;
use super::joint_encoder::JointEncoderSettings;
use super::signal::{Quantity, Signal};
use super::spindle_settings::SpindleSettings;
use glidepath_link::Feedback;

/// Digital inputs that feedback has room for.
pub const DIGITAL_INPUTS: usize = 64;
/// Analog inputs that feedback has room for.
pub const ANALOG_INPUTS: usize = 8;

/// A digital input, and all that it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DigitalInput {
    /// Where it is.
    pub at: At,
    /// It is this input of programs, of the probe and of what waits for it.
    pub number: Option<usize>,
    /// It is the home switch of this joint.
    pub home: Option<usize>,
    /// It is the lower limit switch of this joint.
    pub limit_low: Option<usize>,
    /// It is the upper one.
    pub limit_high: Option<usize>,
    /// It means the other thing: a switch that opens.
    pub is_inverted: bool,
}

impl DigitalInput {
    /// The bit of its number, while it is on.
    pub(crate) fn numbered(&self, is_high: bool) -> u64 {
        match self.number {
            Some(number) if is_high != self.is_inverted => 1 << (number & 63),
            _ => 0,
        }
    }

    /// Adds what it is, while its level is high or low.
    pub(crate) fn tell(&self, is_high: bool, feedback: &mut Feedback) {
        feedback.digital_in |= self.numbered(is_high);
        if is_high == self.is_inverted {
            return;
        }
        let of_joint = |joint: Option<usize>| joint.map_or(0, |joint| 1 << (joint & 31));
        feedback.home_switch |= of_joint(self.home);
        feedback.limit_low |= of_joint(self.limit_low);
        feedback.limit_high |= of_joint(self.limit_high);
    }
}

/// An analog input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnalogInput {
    /// Where it is.
    pub at: At,
    /// Which one it is.
    pub number: usize,
    /// Its unit for each count.
    pub scale: f64,
    /// Added to that.
    pub offset: f64,
    /// Its counts have a sign.
    pub is_signed: bool,
}

/// A digital output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DigitalOutput {
    /// Where it is.
    pub at: At,
    /// What it obeys.
    pub from: Signal,
    /// It is on while that is off.
    pub is_inverted: bool,
    /// Whether it is on where nobody is to be obeyed.
    pub rest: bool,
}

/// An analog output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnalogOutput {
    /// Where it is.
    pub at: At,
    /// What it obeys.
    pub from: Quantity,
    /// The value of that at full counts, in its unit, > 0.
    pub full: f64,
    /// Counts at that value: more are not sent, and as many below zero.
    pub full_counts: u32,
    /// The value where nobody is to be obeyed.
    pub rest: f64,
}

/// An object that is written at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// Index.
    pub index: u16,
    /// Subindex.
    pub sub: u8,
    /// 1, 2, 4 or 8 bytes.
    pub size: u8,
    /// What is written, a negative number as its bits.
    pub value: u64,
}

/// A device that is no drive.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TerminalSettings {
    /// The place in the line, from 0.
    pub position: usize,
    /// What it is to be; nothing is compared with 0.
    pub vendor: u32,
    /// The vendor's number of the product.
    pub product: u32,
    /// The number given by hand.
    pub alias: u16,
    /// Objects that are written first.
    pub parameters: Vec<Parameter>,
    /// The maps of its outputs, if others than it has are to be assigned.
    pub assign_outputs: Option<Vec<u16>>,
    /// The maps of its inputs.
    pub assign_inputs: Option<Vec<u16>>,
    /// Its digital inputs.
    pub inputs: Vec<DigitalInput>,
    /// Its analog inputs.
    pub analog_inputs: Vec<AnalogInput>,
    /// Its digital outputs.
    pub outputs: Vec<DigitalOutput>,
    /// Its analog outputs.
    pub analog_outputs: Vec<AnalogOutput>,
    /// The spindle's encoder is wired to it: to one device at most.
    pub encoder: Option<EncoderSettings>,
    /// The encoders of joints that are wired to it: a joint has one at most.
    pub joint_encoders: Vec<JointEncoderSettings>,
    /// It is the drive of the spindle: of one device at most.
    pub spindle: Option<SpindleSettings>,
}
