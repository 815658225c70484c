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

/// The use of a unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ProbeUse {
    /// It is off, and keeps nothing.
    #[default]
    Off,
    /// It keeps both edges of the machine's probe.
    Contact,
    /// It keeps the rising edge of the encoder's zero impulse.
    Index,
}

/// On; zero impulse of the encoder, or source by 0x60D0; rising and falling edges. Single shot, and the unit's own
/// input, are 0.
const ON: u16 = 1;
const ZERO_IMPULSE: u16 = 4;
const RISING_EDGE: u16 = 0x10;
const BY_OBJECT: u16 = 8;
const BOTH_EDGES: u16 = 0x30;

impl TouchProbe {
    /// A unit that keeps the zero impulse alone.
    pub(crate) const fn of_index(unit: u8) -> Self {
        Self {
            unit,
            number: 0,
            is_inverted: false,
            source: None,
        }
    }

    /// How far the bits of its unit are shifted.
    const fn shift(self) -> u32 {
        if self.unit == 2 { 8 } else { 0 }
    }

    /// What 0x60B8 is to be: the bits of the other unit as they were.
    pub(crate) const fn function(self, before: u16, of: ProbeUse) -> u16 {
        let source = if self.source.is_some() { BY_OBJECT } else { 0 };
        let own = match of {
            ProbeUse::Off => 0,
            ProbeUse::Contact => ON | BOTH_EDGES | source,
            ProbeUse::Index => ON | ZERO_IMPULSE | RISING_EDGE,
        };
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
        assert_eq!(first.function(0x3838, ProbeUse::Contact), 0x3831);
        assert_eq!(first.function(0x3838, ProbeUse::Off), 0x3800);
        assert_eq!(first.function(0x3838, ProbeUse::Index), 0x3815);
        assert_eq!(second.function(0x3838, ProbeUse::Contact), 0x3938);
        assert_eq!(second.function(0x3838, ProbeUse::Off), 0x0038);
        assert_eq!(second.function(0x3838, ProbeUse::Index), 0x1538);
        assert_eq!((first.status(0x0502), second.status(0x0502)), (2, 5));
    }
}
