//! The registers of a device that the master uses, by ETG.1000.4.

/// Which of its functions a device has.
pub(crate) const FEATURES: u16 = 0x0008;
pub(crate) const STATION_ADDRESS: u16 = 0x0010;
pub(crate) const ALIAS: u16 = 0x0012;
/// Which ports have a link, and in the second byte by which of them frames go, two bits each.
pub(crate) const PORTS: u16 = 0x0110;
pub(crate) const AL_CONTROL: u16 = 0x0120;
/// The state, and six bytes from here on with its code.
pub(crate) const AL_STATUS: u16 = 0x0130;
/// The unit of watchdogs: two more than this, of 40 ns.
pub(crate) const WATCHDOG_DIVIDER: u16 = 0x0400;
/// In those units: 100 µs as a rule.
pub(crate) const OUTPUT_WATCHDOG: u16 = 0x0420;
/// Bit 0: outputs did not stay away for so long.
pub(crate) const WATCHDOG_STATUS: u16 = 0x0440;
/// How often they did.
pub(crate) const WATCHDOG_COUNT: u16 = 0x0442;
pub(crate) const EEPROM_OWNER: u16 = 0x0500;
pub(crate) const EEPROM_CONTROL: u16 = 0x0502;
pub(crate) const EEPROM_DATA: u16 = 0x0508;
pub(crate) const FMMU: u16 = 0x0600;
pub(crate) const SYNC_MANAGER: u16 = 0x0800;
/// Status of the sync manager of the mailbox to the device, and of that from it.
pub(crate) const MAILBOX_OUT_STATUS: u16 = 0x0805;
pub(crate) const MAILBOX_IN_STATUS: u16 = 0x080d;
pub(crate) const PORT_TIMES: u16 = 0x0900;
pub(crate) const SYSTEM_TIME: u16 = 0x0910;
pub(crate) const LATCHED_TIME: u16 = 0x0918;
pub(crate) const TIME_OFFSET: u16 = 0x0920;
pub(crate) const TIME_DELAY: u16 = 0x0928;
pub(crate) const TIME_DIFFERENCE: u16 = 0x092c;
pub(crate) const CLOCK_LOOP: u16 = 0x0930;
pub(crate) const SYNC_ACTIVATION: u16 = 0x0981;
pub(crate) const SYNC_START: u16 = 0x0990;
pub(crate) const SYNC0_CYCLE: u16 = 0x09a0;
