//! Where in the process data the values of an encoder are (as EL5101 and EL5151 have them).

use super::encoder::{WiredEncoder, WiredIndex};
use super::encoder_settings::EncoderSettings;

/// An object, and whether it is among the outputs.
pub(super) type Missing = ((u16, u8), bool);

/// The counter, and what it was at the index; whether that is so; and what arms it.
const COUNTER: (u16, u8) = (0x6000, 0x11);
const LATCH: (u16, u8) = (0x6000, 0x12);
const VALID: (u16, u8) = (0x6000, 0x01);
const ARM: (u16, u8) = (0x7000, 0x01);

impl WiredEncoder {
    /// Finds them: `outputs` and `inputs` give where an object is, and how many bits it has there.
    ///
    /// # Errors
    /// The object that is missing, or not of the size that it is to have.
    pub(super) fn find(
        (settings, nth): (EncoderSettings, usize),
        outputs: impl Fn((u16, u8)) -> Option<(usize, u32)>,
        inputs: impl Fn((u16, u8)) -> Option<(usize, u32)>,
    ) -> Result<Self, Missing> {
        let is_number =
            |(bit, bits): &(usize, u32)| bit.is_multiple_of(8) && matches!(bits, 16 | 32);
        let counter = inputs(COUNTER).filter(is_number);
        let counter = counter.ok_or((COUNTER, false))?;
        let index = if settings.has_index {
            let is_same = |found: &(usize, u32)| is_number(found) && found.1 == counter.1;
            let latch = inputs(LATCH).filter(is_same).ok_or((LATCH, false))?;
            let is_bit = |(_, bits): &(usize, u32)| *bits == 1;
            let valid = inputs(VALID).filter(is_bit).ok_or((VALID, false))?;
            let arm = outputs(ARM).filter(is_bit).ok_or((ARM, true))?;
            Some(WiredIndex {
                latch: latch.0,
                valid: valid.0,
                arm: arm.0,
            })
        } else {
            None
        };
        Ok(Self {
            settings,
            nth,
            counter,
            index,
        })
    }
}
