//! Numbers as the page reads them: little-endian, each column at a multiple of eight bytes.

/// Bytes as they grow.
#[derive(Debug)]
pub(super) struct Bytes(Vec<u8>);

impl Bytes {
    pub(super) fn new(mark: &[u8; 4]) -> Self {
        Self(mark.to_vec())
    }

    pub(super) fn word(&mut self, value: u32) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    pub(super) fn double(&mut self, value: f64) {
        self.0.extend_from_slice(&value.to_le_bytes());
    }

    /// A column of numbers of `N` bytes each.
    pub(super) fn column<const N: usize>(&mut self, values: impl Iterator<Item = [u8; N]>) {
        values.for_each(|value| self.0.extend_from_slice(&value));
        self.0.resize(self.0.len().next_multiple_of(8), 0);
    }

    pub(super) fn finish(self) -> Vec<u8> {
        self.0
    }
}
