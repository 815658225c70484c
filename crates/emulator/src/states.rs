//! The states of a device, and what each takes (EtherCAT state machine).

use crate::dictionary::{Dictionary, INPUTS_ASSIGNED, OUTPUTS_ASSIGNED, SYNC_OUTPUTS};
use crate::eeprom::{MAILBOX, MAILBOX_OUT};
use crate::memory::Memory;

pub(crate) const INIT: u8 = 1;
pub(crate) const PRE_OP: u8 = 2;
pub(crate) const SAFE_OP: u8 = 4;
pub(crate) const OP: u8 = 8;
/// Bit of the state: there is an error; of the control: it is taken note of.
pub(crate) const ERROR: u8 = 0x10;

/// Why a state is not possible, by its AL status code; 0 if it is.
pub(crate) fn objection(
    memory: &Memory,
    objects: &Dictionary,
    has_sync: bool,
    wanted: u8,
    present: u8,
) -> u16 {
    let rank = |state: u8| [INIT, PRE_OP, SAFE_OP, OP].iter().position(|s| *s == state);
    let (Some(to), Some(from)) = (rank(wanted), rank(present)) else {
        return 0x12;
    };
    if to > from + 1 {
        return 0x11;
    }
    match (present, wanted) {
        (INIT, PRE_OP) => {
            let mailbox = memory.sync_manager(0);
            let is_right = mailbox.start == MAILBOX_OUT && mailbox.length == MAILBOX;
            if is_right && mailbox.is_enabled {
                0
            } else {
                0x16
            }
        }
        (PRE_OP, SAFE_OP) => {
            let length = |nth| memory.sync_manager(nth).length;
            if length(2) != objects.mapped(OUTPUTS_ASSIGNED).1 {
                0x1d
            } else if length(3) != objects.mapped(INPUTS_ASSIGNED).1 {
                0x1e
            } else if objects.value(SYNC_OUTPUTS) == 2 && !has_sync {
                0x30
            } else {
                0
            }
        }
        _ => 0,
    }
}
