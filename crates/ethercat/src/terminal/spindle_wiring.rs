//! Where in the process data the objects of a spindle's drive are.

use super::bits::{number, put_number};
use super::spindle_settings::SpindleSettings;

/// The image of a spindle's drive: bits from the beginning of the outputs or inputs of all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WiredSpindle {
    pub(crate) settings: SpindleSettings,
    /// Which of the devices that are no drives it is.
    pub(crate) nth: usize,
    control: usize,
    target: usize,
    /// Where the mode is; `None` if it is not mapped, and was set as a parameter.
    mode: Option<usize>,
    status: usize,
    actual: usize,
    fault: Option<usize>,
    place: Option<WiredPlace>,
    torque: Option<usize>,
}

/// Where the objects of its position are, if it is turned to an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
struct WiredPlace {
    target: usize,
    actual: usize,
    /// The mode that the drive is in.
    shown: usize,
}

/// What the drive of a spindle is told.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SpindleOutputs {
    pub(crate) control: u16,
    /// As 0x6060 has it.
    pub(crate) mode: i8,
    /// In its unit of velocity.
    pub(crate) velocity: i32,
    /// Counts.
    pub(crate) place: i32,
}

/// What the drive of a spindle tells.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct SpindleInputs {
    pub(crate) status: u16,
    pub(crate) actual: i32,
    /// Its error code, if it tells one.
    pub(crate) fault: Option<u16>,
    /// Where it is, counts, and the mode it is in, if it is turned to an angle.
    pub(crate) place: i32,
    pub(crate) mode: i8,
    /// Thousandths of its rated torque, if it tells that.
    pub(crate) torque: Option<i16>,
}

impl SpindleInputs {
    /// Nothing was told yet.
    pub(super) const REST: Self = Self {
        status: 0,
        actual: 0,
        fault: None,
        place: 0,
        mode: 0,
        torque: None,
    };
}

impl WiredSpindle {
    /// Finds its objects: `outputs` and `inputs` give where one is, and how many bits it has there.
    ///
    /// # Errors
    /// The object that is missing, or not where a byte begins.
    pub(super) fn find(
        (settings, nth): (SpindleSettings, usize),
        outputs: impl Fn(u16) -> Option<(usize, u32)>,
        inputs: impl Fn(u16) -> Option<(usize, u32)>,
    ) -> Result<Self, (u16, bool)> {
        let place = |found: Option<(usize, u32)>, bits: u32| {
            let found = found.filter(|(bit, found)| bit.is_multiple_of(8) && *found == bits);
            found.map(|(bit, _)| bit)
        };
        let output = |index, bits| place(outputs(index), bits);
        let input = |index, bits| place(inputs(index), bits);
        let (target, actual) = (settings.mode.target(), settings.mode.actual());
        let mode = output(0x6060, 8);
        let place = match settings.orientation {
            None => None,
            Some(_) if mode.is_none() => return Err((0x6060, true)),
            Some(_) => Some(WiredPlace {
                target: output(0x607a, 32).ok_or((0x607a, true))?,
                actual: input(0x6064, 32).ok_or((0x6064, false))?,
                shown: input(0x6061, 8).ok_or((0x6061, false))?,
            }),
        };
        let torque = settings
            .tells_load
            .then(|| input(0x6077, 16).ok_or((0x6077, false)))
            .transpose()?;
        Ok(Self {
            torque,
            place,
            settings,
            nth,
            control: output(0x6040, 16).ok_or((0x6040, true))?,
            target: output(target.0, target.1).ok_or((target.0, true))?,
            mode,
            status: input(0x6041, 16).ok_or((0x6041, false))?,
            actual: input(actual.0, actual.1).ok_or((actual.0, false))?,
            fault: input(0x603f, 16),
        })
    }

    /// What it tells.
    #[allow(
        clippy::cast_possible_wrap,
        clippy::cast_possible_truncation,
        reason = "the bits of numbers of that size"
    )]
    pub(super) fn take(&self, image: &[u8]) -> SpindleInputs {
        let word = |bit| number(image, bit, 16) as u16;
        let bits = self.settings.mode.actual().1;
        let unused = 32 - bits;
        SpindleInputs {
            status: word(self.status),
            actual: (number(image, self.actual, bits) << unused) as i32 >> unused,
            fault: self.fault.map(word),
            torque: self.torque.map(|bit| word(bit) as i16),
            place: self.place.map_or(0, |p| number(image, p.actual, 32) as i32),
            mode: self
                .place
                .map_or(0, |p| number(image, p.shown, 8) as u8 as i8),
        }
    }

    /// Writes what it is told.
    #[allow(
        clippy::cast_sign_loss,
        reason = "a negative number is written as its bits"
    )]
    pub(super) fn put(&self, image: &mut [u8], outputs: &SpindleOutputs) {
        put_number(image, self.control, 16, outputs.control.into());
        let bits = self.settings.mode.target().1;
        put_number(image, self.target, bits, outputs.velocity as u32);
        if let Some(mode) = self.mode {
            put_number(image, mode, 8, outputs.mode as u8 as u32);
        }
        if let Some(place) = self.place {
            put_number(image, place.target, 32, outputs.place as u32);
        }
    }

    /// Without power and at rest.
    pub(super) const fn at_rest(&self) -> SpindleOutputs {
        SpindleOutputs {
            control: 0,
            mode: self.settings.mode.code(),
            velocity: 0,
            place: 0,
        }
    }
}
