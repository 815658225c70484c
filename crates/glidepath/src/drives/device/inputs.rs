//! The inputs of a device: numbers of programs, switches of joints.

use super::Devices;
use crate::config::{Judge, Range};
use crate::drives::raw_device::{RawAnalogInput, RawInput};
use core::ops::Range as Span;
use glidepath_ethercat::{ANALOG_INPUTS, AnalogInput, At, DIGITAL_INPUTS, DigitalInput};
use toml::Spanned;

/// Of its magnitude.
const SCALE: Range = Range {
    min: 1e-9,
    max: 1e9,
    unit: "a count",
    help: "what a count is in the unit that programs have, below 0 if it falls: 10.0 / 32768 for ± 10 V in \
           16 bits",
};
const OFFSET: Range = Range {
    min: -1e9,
    max: 1e9,
    unit: "units",
    help: "what the input is at 0 counts",
};

const DRIVE_BIT: &str = "give bit = 0 to 31: by CiA 402 the limit switches are 0 and 1 and the home switch is 2, \
                         and from 16 on they are the manufacturer's";

impl Devices<'_> {
    /// The number of something that there is once.
    fn claimed(
        &mut self,
        (key, what): (&str, &'static str),
        raw: Option<&Spanned<i64>>,
        most: usize,
    ) -> Option<usize> {
        let raw = raw?;
        let most = i64::try_from(most).unwrap_or(i64::MAX) - 1;
        let number = self.judge.whole(key, raw, (0, most), what)?;
        if !self.claims.take(what, number) {
            let message = format!("two inputs are {what} {number}");
            let help = "each is one input of one device";
            self.tell(key, message, help, raw.span());
        }
        Some(number)
    }

    /// A bit of the inputs of a drive.
    fn drive_bit(&mut self, raw: &RawInput, span: Span<usize>) -> Option<At> {
        if let (None, Some(bit)) = (&raw.at, &raw.bit) {
            let key = "drive.inputs.bit";
            return self.judge.whole(key, bit, (0, 31), DRIVE_BIT).map(At::Bit);
        }
        let message = "an input of a drive is a `bit` of its 0x60FD".to_owned();
        self.tell("drive.inputs", message, DRIVE_BIT, span);
        None
    }

    pub(super) fn input(&mut self, raw: Spanned<RawInput>, of_drive: bool) -> Option<DigitalInput> {
        let (span, key) = (raw.span(), "device.inputs");
        let raw = raw.into_inner();
        let at = if of_drive {
            self.drive_bit(&raw, span.clone())
        } else {
            self.at(key, (raw.at.as_ref(), raw.bit.as_ref()), span.clone())
        };
        let joints = self.joints;
        let number = ("device.inputs.number", "digital input");
        let number = self.claimed(number, raw.number.as_ref(), DIGITAL_INPUTS);
        let home = ("device.inputs.home", "home switch of joint");
        let home = self.claimed(home, raw.home.as_ref(), joints);
        let low = ("device.inputs.limit_low", "lower limit switch of joint");
        let limit_low = self.claimed(low, raw.limit_low.as_ref(), joints);
        let high = ("device.inputs.limit_high", "upper limit switch of joint");
        let limit_high = self.claimed(high, raw.limit_high.as_ref(), joints);
        let is_something = [&raw.number, &raw.home, &raw.limit_low, &raw.limit_high]
            .into_iter()
            .any(Option::is_some);
        if !is_something {
            let message = "nothing is said of what this input is".to_owned();
            let help = "give number, home, limit_low or limit_high, or several of them";
            self.tell(key, message, help, span);
        }
        Some(DigitalInput {
            at: at?,
            number,
            home,
            limit_low,
            limit_high,
            is_inverted: raw.invert,
        })
    }

    pub(super) fn analog_input(&mut self, raw: &RawAnalogInput) -> Option<AnalogInput> {
        let at = self.object("device.analog_inputs.at", &raw.at);
        let number = ("device.analog_inputs.number", "analog input");
        let number = self.claimed(number, Some(&raw.number), ANALOG_INPUTS);
        let judge = &mut *self.judge;
        let scale = signed_number(judge, "device.analog_inputs.scale", &raw.scale, &SCALE);
        let offset = judge.number_or("device.analog_inputs.offset", &raw.offset, &OFFSET, 0.0);
        let (index, sub) = at?;
        Some(AnalogInput {
            at: At::Object { index, sub },
            number: number?,
            scale,
            offset,
            is_signed: raw.signed,
        })
    }
}

/// A number whose magnitude is in a range, which 0 is not.
fn signed_number(judge: &mut Judge, key: &str, value: &Spanned<f64>, range: &Range) -> f64 {
    let number = *value.as_ref();
    if (range.min..=range.max).contains(&number.abs()) {
        return number;
    }
    judge.number(key, value, range)
}
