//! A message of a device's diagnosis history (0x10F3, ETG.1020).

use crate::fault_text;
use core::fmt;

/// The low half of a code that says that the high one is the number of a fault of CiA 402.
const FAULT: u16 = 0xe800;
/// The low halves of codes whose high ones are numbers of the manufacturer.
const OWN: core::ops::RangeInclusive<u16> = 0xe000..=0xe7ff;
/// Bits of the flags that say how bad it is.
const KIND: u16 = 0x0f;
/// Bytes in front of parameters: code, flags, text, time.
const HEAD: usize = 16;

/// A message. Its texts and parameters are the manufacturer's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Diagnosis {
    /// What it is about.
    pub code: u32,
    /// Bits 0 to 3: 0 information, 1 warning, 2 error.
    pub flags: u16,
    /// The number of its text in the manufacturer's files, 0 for none.
    pub text: u16,
    /// When it was, ns; by the time of the bus where the device has that.
    pub time_ns: u64,
}

impl Diagnosis {
    /// From the bytes of its object; `None` if there are too few.
    pub(crate) fn read(bytes: &[u8]) -> Option<Self> {
        let head: &[u8; HEAD] = bytes.first_chunk()?;
        let &[a, b, c, d, flag, flags, low, high, ref time @ ..] = head;
        Some(Self {
            code: u32::from_le_bytes([a, b, c, d]),
            flags: u16::from_le_bytes([flag, flags]),
            text: u16::from_le_bytes([low, high]),
            time_ns: u64::from_le_bytes(*time),
        })
    }
}

impl fmt::Display for Diagnosis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = match self.flags & KIND {
            0 => "information",
            1 => "a warning",
            2 => "an error",
            _ => "a message",
        };
        #[allow(clippy::cast_possible_truncation, reason = "two halves")]
        let (low, high) = (self.code as u16, (self.code >> 16) as u16);
        match low {
            FAULT => write!(f, "{kind}, {}", fault_text::text(high))?,
            low if OWN.contains(&low) => {
                write!(f, "{kind}, number {high:#06x} of its manufacturer")?;
            }
            _ => write!(f, "{kind}, code {:#010x}", self.code)?,
        }
        if self.text != 0 {
            write!(f, ", text {:#06x} in its manual or ESI file", self.text)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests")]

    use super::*;

    #[test]
    fn a_message_is_told_with_the_words_of_its_fault() {
        let bytes = [
            0x00, 0xe8, 0x11, 0x86, 0x02, 0x00, 0x34, 0x12, 1, 2, 0, 0, 0, 0, 0, 0, 9, 9,
        ];
        let told = Diagnosis::read(&bytes).unwrap();
        assert_eq!((told.text, told.time_ns), (0x1234, 0x0201));
        assert_eq!(
            told.to_string(),
            "an error, 0x8611, following error: blocked, too heavy, or the window is too small, text 0x1234 in \
             its manual or ESI file"
        );
        let own = Diagnosis {
            code: 0x0042_e001,
            flags: 0x0001,
            text: 0,
            ..told
        };
        assert_eq!(
            own.to_string(),
            "a warning, number 0x0042 of its manufacturer"
        );
        assert_eq!(Diagnosis::read(&bytes[..15]), None);
    }
}
