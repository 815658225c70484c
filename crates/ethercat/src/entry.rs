//! The entries of process data: which object, and how many bits; and who says which there are.

/// Who says what is in the process data of a drive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mapping {
    /// The master maps what it needs.
    #[default]
    Written,
    /// The drive's own maps stay as they are.
    Kept,
}

/// An entry of a map: an object, or a gap of index 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Entry {
    /// Index of the object, 0 for a gap.
    pub index: u16,
    /// Subindex.
    pub sub: u8,
    /// How long it is, bits.
    pub bits: u32,
}

impl Entry {
    /// As a map has it.
    #[allow(clippy::cast_possible_truncation, reason = "parts of an entry")]
    pub(crate) const fn new(entry: u32) -> Self {
        Self {
            index: (entry >> 16) as u16,
            sub: (entry >> 8) as u8,
            bits: entry & 0xff,
        }
    }

    /// Whether it is one that the master writes in every cycle, of any axis.
    pub(crate) const fn is_led(self) -> bool {
        let of_axes = matches!(self.index, 0x6000..0xa000);
        of_axes && matches!(self.index & 0x7ff, 0x40 | 0x7a | 0x60)
    }
}

/// How many bits entries have.
pub(crate) fn bits(entries: &[Entry]) -> u32 {
    entries.iter().map(|entry| entry.bits).sum()
}

/// How many bytes that is.
pub(crate) fn bytes(entries: &[Entry]) -> usize {
    bits(entries).div_ceil(8) as usize
}
