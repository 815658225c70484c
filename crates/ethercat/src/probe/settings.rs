//! The settings of the touch probe of a drive.

/// The touch probe of a drive, to whose input the machine's probe is wired.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TouchProbe {
    /// Which of the two units: 1 or 2.
    pub unit: u8,
    /// The input that is the probe: a bit of [`glidepath_link::Feedback::digital_in`]. The same of all drives.
    pub number: u8,
    /// The unit sees a falling edge where that input rises.
    pub is_inverted: bool,
    /// Its source by 0x60D0, as the drive's manual has it; `None` for the unit's own input.
    pub source: Option<u16>,
}

/// On; source by 0x60D0; rising and falling edges. Single shot, and the unit's own input, are 0.
const ON: u16 = 1;
const BY_OBJECT: u16 = 8;
const BOTH_EDGES: u16 = 0x30;

impl TouchProbe {
    /// How far the bits of its unit are shifted.
    const fn shift(self) -> u32 {
        if self.unit == 2 { 8 } else { 0 }
    }

    /// What 0x60B8 is to be: the bits of the other unit as they were.
    pub(crate) const fn function(self, before: u16, is_on: bool) -> u16 {
        let source = if self.source.is_some() { BY_OBJECT } else { 0 };
        let own = if is_on { ON | BOTH_EDGES | source } else { 0 };
        before & !(0xff << self.shift()) | own << self.shift()
    }

    /// The bits of its unit in 0x60B9: on, stored at a rising edge, at a falling one.
    pub(crate) const fn status(self, word: u16) -> u8 {
        (word >> self.shift() & 7) as u8
    }

    /// The objects of the places that it keeps, at a rising and at a falling edge.
    pub(crate) const fn places(self) -> [u16; 2] {
        if self.unit == 2 {
            [0x60bc, 0x60bd]
        } else {
            [0x60ba, 0x60bb]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_unit_has_its_own_bits() {
        let first = TouchProbe {
            unit: 1,
            number: 0,
            is_inverted: false,
            source: None,
        };
        let second = TouchProbe {
            unit: 2,
            source: Some(5),
            ..first
        };
        assert_eq!(first.function(0x3838, true), 0x3831);
        assert_eq!(first.function(0x3838, false), 0x3800);
        assert_eq!(second.function(0x3838, true), 0x3938);
        assert_eq!(second.function(0x3838, false), 0x0038);
        assert_eq!((first.status(0x0502), second.status(0x0502)), (2, 5));
    }
}
