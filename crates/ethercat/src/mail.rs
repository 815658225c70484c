//! A message to the mailbox of a device, and the answer that is waited for.

use crate::device::Device;
use crate::error::BusError;
use crate::exchange::{Exchange, station};
use crate::frame::{Address, Command};
use crate::registers::{MAILBOX_IN_STATUS, MAILBOX_OUT_STATUS};
use crate::wire::Wire;

/// How long a device may take to answer.
const PATIENCE_NS: u64 = 1_000_000_000;
/// Between two looks for the answer.
const POLL_NS: u64 = 500_000;
/// How often somebody asks, because a message can be lost on its way back.
pub(crate) const TRIES: u32 = 3;
/// Messages of other kinds that are passed over in waiting for an answer.
const MOST_OTHERS: usize = 16;
/// Bit of a mailbox' status.
const FULL: u8 = 8;
/// Where in a message its number is, and the place of that in the byte.
const NUMBER_AT: usize = 5;
const NUMBER_SHIFT: u8 = 4;

/// That a device does not answer.
pub(crate) const fn silent(device: &Device) -> BusError {
    BusError::NoAnswer {
        device: device.position,
        action: "to a parameter",
        tries: TRIES,
    }
}

/// Sends a message once, and waits for one that is its answer; others are passed over: an emergency, or the
/// answer to a question that was given up. `None` if none comes.
pub(crate) fn ask<W: Wire, T>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    message: &[u8],
    answer: &mut dyn FnMut(&[u8]) -> Option<T>,
) -> Result<Option<T>, BusError> {
    let nth = device.position;
    let (_, back) = device.mailbox.ok_or_else(|| silent(device))?;
    // What is left of a question before.
    while take(bus, nth, back.start, back.length)?.is_some() {}
    post(bus, device, message)?;
    let until_ns = bus.wire.now_ns() + PATIENCE_NS;
    let mut others = 0;
    while bus.wire.now_ns() < until_ns && others < MOST_OTHERS {
        let Some(message) = take(bus, nth, back.start, back.length)? else {
            let next_ns = bus.wire.now_ns() + POLL_NS;
            bus.wire.sleep_until(next_ns);
            continue;
        };
        if let Some(answer) = answer(&message) {
            return Ok(Some(answer));
        }
        others += 1;
    }
    Ok(None)
}

/// Sends a message that nobody answers, or whose answer is not waited for.
pub(crate) fn post<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    message: &[u8],
) -> Result<(), BusError> {
    let nth = device.position;
    let (out, _) = device.mailbox.ok_or_else(|| silent(device))?;
    let mut sent = vec![0; out.length.into()];
    for (place, byte) in sent.iter_mut().zip(message) {
        *place = *byte;
    }
    if let Some(kind) = sent.get_mut(NUMBER_AT) {
        *kind = *kind & 15 | bus.next_number(nth) << NUMBER_SHIFT;
    }
    wait_until_free(bus, nth)?;
    bus.write(nth, out.start, &sent, "to a message")
}

/// Waits until the device has taken the message before.
fn wait_until_free<W: Wire>(bus: &mut Exchange<'_, W>, nth: usize) -> Result<(), BusError> {
    let until_ns = bus.wire.now_ns() + PATIENCE_NS;
    loop {
        let [status] = bus.read(nth, MAILBOX_OUT_STATUS, "about its mailbox")?;
        if status & FULL == 0 || bus.wire.now_ns() > until_ns {
            return Ok(());
        }
        let next_ns = bus.wire.now_ns() + POLL_NS;
        bus.wire.sleep_until(next_ns);
    }
}

/// Takes the message that waits, if one does.
fn take<W: Wire>(
    bus: &mut Exchange<'_, W>,
    nth: usize,
    start: u16,
    length: u16,
) -> Result<Option<Vec<u8>>, BusError> {
    let [status] = bus.read(nth, MAILBOX_IN_STATUS, "about its mailbox")?;
    if status & FULL == 0 {
        return Ok(None);
    }
    let mut message = vec![0; length.into()];
    let address = Address::station(station(nth), start);
    let asked = bus.ask(Command::Fprd, address, &mut message, 1)?;
    Ok(asked.filter(|(counter, _)| *counter == 1).map(|_| message))
}
