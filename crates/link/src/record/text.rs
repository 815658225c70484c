//! Text of fixed size.

use super::check::RecordError;
use crate::wording::in_one_line;
use iceoryx2::prelude::ZeroCopySend;
use std::borrow::Cow;

/// The end of a text that was cut.
const CUT: &str = "…";

/// The beginning of a text that is so many bytes long at most, in whole characters.
fn fitting(text: &str, bytes: usize) -> &str {
    let ends = (0..=text.len().min(bytes)).rev();
    let end = ends.into_iter().find(|end| text.is_char_boundary(*end));
    text.get(..end.unwrap_or(0)).unwrap_or_default()
}

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

    /// A text; one that does not fit is cut at the last whole character, and ends in `…`.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let shown: Cow<'_, str> = $shown(text);
        let text = &*shown;
        let (text, sign) = match fitting(text, Self::CAPACITY) {
            whole if whole.len() == text.len() => (whole, ""),
            _ => (fitting(text, Self::CAPACITY - CUT.len()), CUT),
        };
        let mut bytes = [0; Self::CAPACITY];
        for (to, from) in bytes.iter_mut().zip(text.bytes().chain(sign.bytes())) {
            *to = from;
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
