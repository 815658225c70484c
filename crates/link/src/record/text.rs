//! Text of fixed size.

use super::check::RecordError;
use crate::wording::in_one_line;
use iceoryx2::prelude::ZeroCopySend;
use std::borrow::Cow;

macro_rules! text {
    ($(#[$about:meta])* $name:ident, $capacity:literal, $shown:expr) => {
$(#[$about])*
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable, ZeroCopySend)]
pub struct $name {
    bytes: [u8; $capacity],
}

impl $name {
    /// Longest text, bytes.
    pub const CAPACITY: usize = $capacity;

    /// A text, cut at the last whole character that fits.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let shown: Cow<'_, str> = $shown(text);
        let text = &*shown;
        let mut end = text.len().min(Self::CAPACITY);
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        let mut bytes = [0; Self::CAPACITY];
        for (to, from) in bytes.iter_mut().zip(text.as_bytes().iter().take(end)) {
            *to = *from;
        }
        Self { bytes }
    }

    /// The text, up to its padding; empty if the bytes are not UTF-8.
    #[must_use]
    pub fn as_str(&self) -> &str {
        str::from_utf8(self.used()).unwrap_or_default()
    }

    fn used(&self) -> &[u8] {
        self.bytes
            .split(|&byte| byte == 0)
            .next()
            .unwrap_or_default()
    }

    pub(crate) fn check(
        &self,
        record: &'static str,
        field: &'static str,
    ) -> Result<(), RecordError> {
        match str::from_utf8(self.used()) {
            Ok(_) => Ok(()),
            Err(_) => Err(RecordError::NotText { record, field }),
        }
    }
}

impl Default for $name {
    fn default() -> Self {
        Self {
            bytes: [0; Self::CAPACITY],
        }
    }
}
    };
}

text!(
    /// Up to 128 bytes of UTF-8, padded with zeros: a line for people, of printable characters.
    Text,
    128,
    in_one_line
);
text!(
    /// Up to 1024 bytes of UTF-8, padded with zeros.
    LongText,
    1024,
    Cow::Borrowed
);
