//! A device on the bus, as its EEPROM tells.

use crate::entry::Entry;

/// The identity of a device: who made it, and which it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Identity {
    /// Number of the vendor, given by the EtherCAT Technology Group.
    pub vendor: u32,
    /// The vendor's number of the product.
    pub product: u32,
    /// Its revision.
    pub revision: u32,
    /// Serial number, 0 if the vendor tells none.
    pub serial: u32,
}

/// A window into the memory of a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SyncManager {
    /// Where it begins.
    pub start: u16,
    /// Its length, bytes.
    pub length: u16,
    /// How it works.
    pub control: u8,
}

/// What a device has of a distributed clock, as its registers answer: what its features say is not
/// always so.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ClockKind {
    /// Nothing.
    #[default]
    None,
    /// It notes when frames come by its ports, for the delays of the cable, and has no system time.
    ReceiveTimes,
    /// A clock of 32 bits, which begins anew every 4.3 s.
    Bits32,
    /// A clock of 64 bits.
    Bits64,
}

impl ClockKind {
    /// Whether it has a system time, by which SYNC0 comes.
    #[must_use]
    pub const fn is_clock(self) -> bool {
        matches!(self, Self::Bits32 | Self::Bits64)
    }

    /// Bytes of its registers of time. The others of the eight are not there, or zero.
    pub(crate) const fn bytes(self) -> usize {
        match self {
            Self::Bits32 => 4,
            _ => 8,
        }
    }

    /// Whether it notes when frames come by its ports.
    #[must_use]
    pub const fn notes_times(self) -> bool {
        !matches!(self, Self::None)
    }
}

/// A window of process data, and what its EEPROM says is in it.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Window {
    /// The number of its sync manager.
    pub number: u8,
    /// The sync manager. Its length is often said to be 0.
    pub manager: SyncManager,
    /// The master writes it.
    pub is_output: bool,
    /// The objects in it, in order. None of a device with CoE, which is asked for them.
    pub entries: Vec<Entry>,
}

/// How sync managers of process data work: three buffers, written by the master and watched, or read.
const OUTPUTS: u8 = 0x64;
const INPUTS: u8 = 0x20;

/// A device.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Device {
    /// Its place in the line, from the master on, from 0.
    pub position: usize,
    /// Who it is.
    pub identity: Identity,
    /// The number that was given it by hand, 0 for none.
    pub alias: u16,
    /// Its name.
    pub name: String,
    /// Mailboxes to and from it; `None` without.
    pub mailbox: Option<(SyncManager, SyncManager)>,
    /// Whether its mailbox speaks CoE.
    pub has_coe: bool,
    /// Process data to and from it; `None` without.
    pub process: Option<(SyncManager, SyncManager)>,
    /// All windows of its process data: a simple terminal has no mailbox, and any number of these.
    pub windows: Vec<Window>,
    /// Its EEPROM says how it works with SYNC0.
    pub has_sync_modes: bool,
    /// Whether it does not know the datagram that reads and writes process data in one (LRW).
    pub lacks_lrw: bool,
    /// Its distributed clock.
    pub clock: ClockKind,
    /// By which of its ports frames go: by port 0 to it, by the others on.
    pub open_ports: [bool; 4],
}

impl Device {
    /// Whether it can be a drive of this master, as far as its EEPROM tells. It has to say where its
    /// process data is, or the settings of the drive have to.
    #[must_use]
    pub const fn may_be_drive(&self) -> bool {
        self.mailbox.is_some() && self.has_coe
    }

    /// Its first window of outputs or of inputs.
    pub(crate) fn window(&self, is_output: bool) -> Option<&Window> {
        self.windows
            .iter()
            .find(|window| window.is_output == is_output)
    }

    /// Takes its process data to be where its EEPROM says, or else at these addresses.
    #[must_use]
    pub(crate) fn or_process_at(self, addresses: Option<(u16, u16)>) -> Self {
        let at = |start, control| SyncManager {
            start,
            length: 0,
            control,
        };
        let told = addresses.map(|(outputs, inputs)| (at(outputs, OUTPUTS), at(inputs, INPUTS)));
        Self {
            process: self.process.or(told),
            ..self
        }
    }
}
