//! The states of a device, and what each takes (EtherCAT state machine).

use crate::channels::Channels;
use crate::dictionary::{Dictionary, INPUTS_ASSIGNED, OUTPUTS_ASSIGNED, SYNC_OUTPUTS};
use crate::eeprom::{MAILBOX, MAILBOX_OUT};
use crate::memory::Memory;

pub(crate) const INIT: u8 = 1;
pub(crate) const PRE_OP: u8 = 2;
pub(crate) const SAFE_OP: u8 = 4;
pub(crate) const OP: u8 = 8;
/// Bit of the state: there is an error; of the control: it is taken note of.
pub(crate) const ERROR: u8 = 0x10;

/// Why a state is not possible for a device without a mailbox, by its AL status code; 0 if it is.
pub(crate) fn simple_objection(
    memory: &Memory,
    channels: Option<&Channels>,
    wanted: u8,
    present: u8,
) -> u16 {
    if let Some(code) = order(wanted, present) {
        return code;
    }
    let windows = channels.map(Channels::simple_windows).unwrap_or_default();
    let wrong = windows.iter().find(|(window, _)| {
        let manager = memory.sync_manager(window.manager.into());
        let is_right = (manager.start, manager.length) == (window.start, window.length);
        !(is_right && manager.is_enabled)
    });
    match (present, wanted, wrong) {
        (PRE_OP, SAFE_OP, Some((window, _))) if window.is_output => 0x1d,
        (PRE_OP, SAFE_OP, Some(_)) => 0x1e,
        _ => 0,
    }
}

/// What is wrong with the order of states, if anything is.
fn order(wanted: u8, present: u8) -> Option<u16> {
    let rank = |state: u8| [INIT, PRE_OP, SAFE_OP, OP].iter().position(|s| *s == state);
    let (Some(to), Some(from)) = (rank(wanted), rank(present)) else {
        return Some(0x12);
    };
    (to > from + 1).then_some(0x11)
}

/// Why a state is not possible, by its AL status code; 0 if it is.
pub(crate) fn objection(
    memory: &Memory,
    objects: &Dictionary,
    has_sync: bool,
    wanted: u8,
    present: u8,
) -> u16 {
    if let Some(code) = order(wanted, present) {
        return code;
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
