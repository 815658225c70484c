//! The words of an M code that has a meaning of the machine's own.

use super::check::{Fields, RecordError};
use glidepath_program::CodeWord;
use iceoryx2::prelude::ZeroCopySend;

/// The P and the Q word of an M code, as far as it has them.
#[repr(C)]
#[derive(
    Debug, Clone, Copy, PartialEq, Default, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend,
)]
pub struct CodeWords {
    /// P; zero where there is none.
    pub p: f64,
    /// Q; zero where there is none.
    pub q: f64,
    /// 1 with a P word, 2 with a Q word, 3 with both.
    pub given: u32,
    /// Must be zero.
    pub reserved: u32,
}

impl CodeWords {
    const P: u32 = 1;
    const Q: u32 = 1 << 1;

    /// A word, if there is one.
    #[must_use]
    pub const fn get(&self, word: CodeWord) -> Option<f64> {
        let (bit, value) = match word {
            CodeWord::P => (Self::P, self.p),
            CodeWord::Q => (Self::Q, self.q),
        };
        if self.given & bit == 0 {
            return None;
        }
        Some(value)
    }

    /// Adds a word.
    pub const fn set(&mut self, word: CodeWord, value: f64) {
        match word {
            CodeWord::P => (self.p, self.given) = (value, self.given | Self::P),
            CodeWord::Q => (self.q, self.given) = (value, self.given | Self::Q),
        }
    }

    pub(super) fn check(&self, record: &'static str) -> Result<(), RecordError> {
        let fields = Fields(record);
        fields.all_finite("awaited_words", &[self.p, self.q])?;
        fields.flags("awaited_words", self.given, Self::P | Self::Q)?;
        fields.zero("awaited_words", self.reserved)
    }
}
