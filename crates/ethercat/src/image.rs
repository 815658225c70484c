//! Process data of one drive, as it is mapped.

/// The outputs of the master to a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outputs {
    /// Controlword, 0x6040.
    pub control: u16,
    /// Target position, 0x607A, counts.
    pub target: i32,
    /// Mode of operation, 0x6060.
    pub mode: i8,
}

/// The inputs of the master from a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    /// Statusword, 0x6041.
    pub status: u16,
    /// Actual position, 0x6064, counts.
    pub actual: i32,
    /// Mode that is in force, 0x6061.
    pub mode: i8,
    /// Error code, 0x603F.
    pub fault: u16,
}

/// Cyclic synchronous position.
pub(crate) const CYCLIC_POSITION: i8 = 8;
/// Homing by the drive.
pub(crate) const HOMING: i8 = 6;

impl Default for Outputs {
    /// No power, at zero.
    fn default() -> Self {
        Self {
            control: 0,
            target: 0,
            mode: CYCLIC_POSITION,
        }
    }
}

impl Outputs {
    /// No power, and the target where the drive stands.
    #[must_use]
    pub const fn standing(inputs: &Inputs) -> Self {
        Self {
            control: 0,
            target: inputs.actual,
            mode: CYCLIC_POSITION,
        }
    }

    /// Its bytes.
    #[must_use]
    pub const fn encode(self) -> [u8; 7] {
        let ([c0, c1], [a, b, c, d]) = (self.control.to_le_bytes(), self.target.to_le_bytes());
        let [mode] = self.mode.to_le_bytes();
        [c0, c1, a, b, c, d, mode]
    }
}

impl Inputs {
    /// From its bytes.
    #[must_use]
    pub const fn decode(bytes: [u8; 9]) -> Self {
        let [s0, s1, a, b, c, d, mode, f0, f1] = bytes;
        Self {
            status: u16::from_le_bytes([s0, s1]),
            actual: i32::from_le_bytes([a, b, c, d]),
            mode: i8::from_le_bytes([mode]),
            fault: u16::from_le_bytes([f0, f1]),
        }
    }
}
