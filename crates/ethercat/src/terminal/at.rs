//! Where a value of a device is, as the file says it.

use core::fmt;

/// The place of a value in the process data of a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum At {
    /// Where this object is mapped.
    Object {
        /// Index.
        index: u16,
        /// Subindex.
        sub: u8,
    },
    /// So many bits after the beginning of its inputs or outputs.
    Bit(u32),
}

impl fmt::Display for At {
    /// As `drives.toml` has it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Object { index, sub } => write!(f, "0x{index:04x}:{sub:02x}"),
            Self::Bit(bit) => write!(f, "bit {bit}"),
        }
    }
}
