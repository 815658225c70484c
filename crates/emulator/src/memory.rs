//! The memory of a device: registers below 0x1000, process data and mailboxes above.

/// Bytes of it.
const SIZE: usize = 0x3000;

pub(crate) const STATION_ADDRESS: u16 = 0x0010;
pub(crate) const DL_STATUS: u16 = 0x0110;
pub(crate) const AL_CONTROL: u16 = 0x0120;
pub(crate) const AL_STATUS: u16 = 0x0130;
pub(crate) const AL_CODE: u16 = 0x0134;
pub(crate) const WATCHDOG_DIVIDER: u16 = 0x0400;
pub(crate) const WATCHDOG_OUTPUTS: u16 = 0x0420;
/// Bit 0: the watchdog of outputs has not expired.
pub(crate) const WATCHDOG_STATUS: u16 = 0x0440;
/// How often it has.
pub(crate) const WATCHDOG_COUNT: u16 = 0x0442;
pub(crate) const EEPROM_CONTROL: u16 = 0x0502;
pub(crate) const EEPROM_ADDRESS: u16 = 0x0504;
pub(crate) const EEPROM_DATA: u16 = 0x0508;
pub(crate) const FMMU: u16 = 0x0600;
pub(crate) const SYNC_MANAGER: u16 = 0x0800;
pub(crate) const PORT_TIMES: u16 = 0x0900;
pub(crate) const SYSTEM_TIME: u16 = 0x0910;
pub(crate) const LATCHED_TIME: u16 = 0x0918;
pub(crate) const TIME_OFFSET: u16 = 0x0920;
pub(crate) const TIME_DELAY: u16 = 0x0928;
pub(crate) const TIME_DIFFERENCE: u16 = 0x092C;
/// Writing it has the control loop of the clock begin anew.
pub(crate) const SPEED_START: u16 = 0x0930;
pub(crate) const SYNC_ACTIVATION: u16 = 0x0981;
pub(crate) const SYNC_START: u16 = 0x0990;
pub(crate) const SYNC0_CYCLE: u16 = 0x09A0;
/// The registers of the clock, which a device without one does not have.
pub(crate) const CLOCK: core::ops::Range<u16> = 0x0900..0x0A00;

/// A sync manager: a window into the memory, with its own rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SyncManager {
    pub(crate) start: u16,
    pub(crate) length: u16,
    pub(crate) is_enabled: bool,
}

impl SyncManager {
    /// True for an access that touches the last byte, by which a mailbox is handed over.
    pub(crate) fn is_completed_by(self, address: u16, length: usize) -> bool {
        let Some(last) = (self.start + self.length).checked_sub(1) else {
            return false;
        };
        let end = usize::from(address) + length;
        self.is_enabled && self.length > 0 && address <= last && usize::from(last) < end
    }
}

/// A window of the logical address space onto the memory.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fmmu {
    pub(crate) logical: u32,
    pub(crate) length: u16,
    pub(crate) physical: u16,
    pub(crate) reads: bool,
    pub(crate) writes: bool,
}

/// The bytes of a device.
#[derive(Debug, Clone)]
pub(crate) struct Memory(Vec<u8>);

impl Memory {
    pub(crate) fn new() -> Self {
        Self(vec![0; SIZE])
    }

    /// Some bytes; `None` beyond the end.
    pub(crate) fn get(&self, address: u16, length: usize) -> Option<&[u8]> {
        let from = usize::from(address);
        self.0.get(from..from + length)
    }

    /// The same, to be written.
    pub(crate) fn get_mut(&mut self, address: u16, length: usize) -> Option<&mut [u8]> {
        let from = usize::from(address);
        self.0.get_mut(from..from + length)
    }

    pub(crate) fn put(&mut self, address: u16, bytes: &[u8]) {
        if let Some(place) = self.get_mut(address, bytes.len()) {
            place.copy_from_slice(bytes);
        }
    }

    /// A number of up to eight bytes, lowest first; 0 beyond the end.
    pub(crate) fn number(&self, address: u16, length: usize) -> u64 {
        let bytes = self.get(address, length).unwrap_or_default();
        bytes
            .iter()
            .rev()
            .fold(0, |n, byte| n << 8 | u64::from(*byte))
    }

    #[allow(clippy::cast_possible_truncation, reason = "two bytes were read")]
    pub(crate) fn word(&self, address: u16) -> u16 {
        self.number(address, 2) as u16
    }

    pub(crate) fn byte(&self, address: u16) -> u8 {
        self.get(address, 1).map_or(0, |bytes| bytes[0])
    }

    pub(crate) fn sync_manager(&self, index: u16) -> SyncManager {
        let at = SYNC_MANAGER + 8 * index;
        SyncManager {
            start: self.word(at),
            length: self.word(at + 2),
            is_enabled: self.byte(at + 6) & 1 != 0,
        }
    }

    /// The windows that are enabled.
    pub(crate) fn fmmus(&self) -> impl Iterator<Item = Fmmu> + '_ {
        (0..8).filter_map(|index| {
            let at = FMMU + 16 * index;
            (self.byte(at + 12) & 1 != 0).then(|| Fmmu {
                logical: u32::from(self.word(at)) | u32::from(self.word(at + 2)) << 16,
                length: self.word(at + 4),
                physical: self.word(at + 8),
                reads: self.byte(at + 11) & 1 != 0,
                writes: self.byte(at + 11) & 2 != 0,
            })
        })
    }
}
