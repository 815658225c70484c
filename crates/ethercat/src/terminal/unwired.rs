//! What is not where the file says, in words.

use super::at::At;
use crate::entry::Entry;
use core::fmt;

/// Why a device cannot be wired as the file says.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Unwired {
    /// Something is not where the file says.
    NotThere(NotThere),
    /// Two outputs are the same bits, named differently.
    Twice(At, At),
}

impl fmt::Display for Unwired {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotThere(it) => it.fmt(f),
            Self::Twice(one, other) => write!(
                f,
                "output {one} and output {other} are the same bits, and an output obeys one thing"
            ),
        }
    }
}

impl Unwired {
    /// Where the file says that it is, and whether it is an output.
    pub(crate) fn at(&self) -> (At, bool) {
        match self {
            Self::NotThere(it) => (it.at, it.what == "output"),
            Self::Twice(_, other) => (*other, true),
        }
    }
}

impl From<NotThere> for Unwired {
    fn from(it: NotThere) -> Self {
        Self::NotThere(it)
    }
}

/// Something that is not where the file says.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NotThere {
    /// "input" or "output".
    pub(super) what: &'static str,
    pub(super) at: At,
    /// What is there instead, bits.
    pub(super) found: Option<u32>,
    /// What could be meant.
    pub(super) known: Vec<Entry>,
}

impl fmt::Display for NotThere {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { what, at, .. } = self;
        match self.found {
            Some(bits) => write!(
                f,
                "{what} {at} is {bits} bits long, and cannot be what the file says"
            )?,
            None => write!(f, "there is no {what} {at} in its process data")?,
        }
        let known: Vec<String> = self
            .known
            .iter()
            .filter(|entry| entry.index != 0)
            .map(|entry| {
                let at = At::Object {
                    index: entry.index,
                    sub: entry.sub,
                };
                format!("{at} ({} bit)", entry.bits)
            })
            .collect();
        if known.is_empty() {
            write!(f, ", which has none that can be named")
        } else {
            write!(f, ", which has {}", known.join(", "))
        }
    }
}
