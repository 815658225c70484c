//! The errors of a bus, as an operator is told.

use crate::terminal::At;
use crate::transfer_trouble::TransferTrouble;
use crate::{abort_text, al_status};
use std::io;

/// The reason why a bus does not come, or does not stay, in operation.
#[derive(Debug, thiserror::Error)]
pub enum BusError {
    /// The port does not work.
    #[error("the network interface fails while {action}: {source}")]
    Wire {
        /// What was done.
        action: &'static str,
        /// What the system said.
        source: io::Error,
    },
    /// Nothing answers.
    #[error(
        "nothing answers on the wire: is the cable in the first drive's IN port, and its logic supply on?"
    )]
    Nobody,
    /// A question was not answered.
    #[error(
        "device {device}: no answer {action} ({tries} tries): a cable is loose, or the device was switched off"
    )]
    NoAnswer {
        /// Counted from the master, from 0.
        device: usize,
        /// What was asked.
        action: &'static str,
        /// How often.
        tries: u32,
    },
    /// There are other devices than the file says.
    #[error(
        "drives.toml wants a device at position {position}, and {found} devices are there: \
         `glidepath ethercat scan INTERFACE` lists them"
    )]
    Missing {
        /// Where it is wanted.
        position: usize,
        /// Devices there are.
        found: usize,
    },
    /// There is another device than the file says.
    #[error(
        "position {position}: drives.toml wants {what} {wanted:#x}, the device there has {found:#x}: \
         `glidepath ethercat scan INTERFACE` lists what is there"
    )]
    Other {
        /// Where.
        position: usize,
        /// "vendor", "product" or "alias".
        what: &'static str,
        /// By the file.
        wanted: u32,
        /// By the device.
        found: u32,
    },
    /// A device without what is needed.
    #[error("device {device} ({name}): {what}")]
    Unfit {
        /// Counted from the master, from 0.
        device: usize,
        /// Its name.
        name: String,
        /// What it lacks, and what to do.
        what: String,
    },
    /// An input or output is not where the file says.
    #[error("device {device} ({name}): {what}")]
    Unwired {
        /// Counted from the master, from 0.
        device: usize,
        /// Its name.
        name: String,
        /// Where it is said to be.
        at: At,
        /// Whether it is an output.
        is_output: bool,
        /// What is there.
        what: String,
    },
    /// All that is to be exchanged in a cycle is too long.
    #[error(
        "what is exchanged in a cycle takes {needed} bytes, and a frame has {most}: leave devices out of \
         drives.toml that nothing obeys and nothing waits for"
    )]
    Room {
        /// Bytes.
        needed: usize,
        /// Bytes of a frame.
        most: usize,
    },
    /// A device does not change its state.
    #[error("device {device} ({name}) does not go to {wanted}: {}", al_status::text(*code))]
    State {
        /// Counted from the master, from 0.
        device: usize,
        /// Its name.
        name: String,
        /// The state.
        wanted: &'static str,
        /// AL status code.
        code: u16,
    },
    /// A device does not take or give a parameter.
    #[error("device {device} ({name}): object {index:#06x}:{sub} was refused: {}", abort_text::text(*code))]
    Object {
        /// Counted from the master, from 0.
        device: usize,
        /// Its name.
        name: String,
        /// Index.
        index: u16,
        /// Subindex.
        sub: u8,
        /// SDO abort code.
        code: u32,
    },
    /// A parameter did not come, or was not taken, as a whole.
    #[error("device {device} ({name}): object {index:#06x}:{sub} did not go as a whole: {trouble}")]
    Transfer {
        /// Counted from the master, from 0.
        device: usize,
        /// Its name.
        name: String,
        /// Index.
        index: u16,
        /// Subindex.
        sub: u8,
        /// What is wrong.
        trouble: TransferTrouble,
    },
    /// The clocks do not agree.
    #[error(
        "the clocks of the drives are still {worst_ns} ns apart after {waited_s} s: is every drive \
         between the first and the last one able to do distributed clocks?"
    )]
    Clocks {
        /// The largest difference, ns.
        worst_ns: u32,
        /// How long it was waited, s.
        waited_s: u64,
    },
    /// It was asked to end.
    #[error("ended while the bus came up")]
    Ended,
}

/// What of `drives.toml` is refused: a device, or one of its inputs or outputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RefusedPart {
    /// The place in the line, from 0.
    pub position: usize,
    /// The input or output, and whether it is an output; `None` for the whole device.
    pub at: Option<(At, bool)>,
}

impl RefusedPart {
    /// The device that it is of.
    #[must_use]
    pub const fn of_device(self) -> Self {
        Self { at: None, ..self }
    }
}

impl BusError {
    /// What of the file it is about; `None` where the file is not what has to be mended.
    #[must_use]
    pub const fn refused_part(&self) -> Option<RefusedPart> {
        let (position, at) = match self {
            Self::Missing { position, .. } | Self::Other { position, .. } => (*position, None),
            Self::Unfit { device, .. }
            | Self::Object { device, .. }
            | Self::Transfer { device, .. } => (*device, None),
            Self::Unwired {
                device,
                at,
                is_output,
                ..
            } => (*device, Some((*at, *is_output))),
            Self::Wire { .. }
            | Self::Nobody
            | Self::NoAnswer { .. }
            | Self::Room { .. }
            | Self::State { .. }
            | Self::Clocks { .. }
            | Self::Ended => return None,
        };
        Some(RefusedPart { position, at })
    }
}
