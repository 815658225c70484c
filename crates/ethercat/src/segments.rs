//! Objects of any length by the mailbox of a device: SDO as a whole or in segments (ETG.1000.6, CoE).
//!
//! ```text
//! upload     0x40 ──►            download   0x21, length, data ──►
//!            ◄── 0x41, length, data         ◄── 0x60
//!            0x60 ──► ◄── 0x00, data        0x00, data ──► ◄── 0x20
//!            0x70 ──► ◄── 0x11, data        0x11, data ──► ◄── 0x30
//! ```
//!
//! Bit 4 changes with every segment, bit 0 is the last one, and bits 1 to 3 are how many of seven bytes are none.
//! A segment that is not answered ends a transfer, which then begins anew: asked again, a device could not tell
//! whether the same one is meant.

use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::mail;
use crate::transfer_trouble::TransferTrouble;
use crate::wire::Wire;

/// Bytes of the head of a message, and those up to the command.
const HEAD: usize = 6;
const COMMAND: usize = 8;
/// Where data begins behind the length of an object, and in a segment.
const FIRST: usize = 16;
const SEGMENT: usize = 9;
/// Data of a segment that is filled up.
const LEAST: usize = 7;

const TOGGLE: u8 = 0x10;
const LAST: u8 = 1;

/// The codes that a device is told when a transfer is given up.
const WRONG_TOGGLE: u32 = 0x0503_0000;
const NO_ROOM: u32 = 0x0504_0005;
const WRONG_LENGTH: u32 = 0x0607_0010;

/// Index and subindex.
pub(crate) type At = (u16, u8);

/// An answer to the beginning of a transfer, or to a segment.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Heard {
    /// The object as a whole.
    Whole(Vec<u8>),
    /// It has so many bytes, and these are the first.
    Part(usize, Vec<u8>),
    /// A segment, or that it was taken: its toggle bit, data, whether it is the last one.
    Segment(u8, Vec<u8>, bool),
    /// The beginning was taken.
    Begun,
    /// The code of a refusal.
    Abort(u32),
}

/// What comes of a try.
type Tried<T> = Result<Option<T>, BusError>;

/// Reads an object of `most` bytes at most.
pub(crate) fn read<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    at: At,
    most: usize,
) -> Result<Vec<u8>, BusError> {
    for _ in 0..mail::TRIES {
        if let Some(bytes) = upload(bus, device, at, most)? {
            return Ok(bytes);
        }
    }
    Err(mail::silent(device))
}

/// Writes an object of any length.
pub(crate) fn write<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    at: At,
    bytes: &[u8],
) -> Result<(), BusError> {
    for _ in 0..mail::TRIES {
        if download(bus, device, at, bytes)?.is_some() {
            return Ok(());
        }
    }
    Err(mail::silent(device))
}

/// `None` if the device falls silent.
fn upload<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    at: At,
    most: usize,
) -> Tried<Vec<u8>> {
    let asked = message(&begin(0x40, at));
    let heard = mail::ask(bus, device, &asked, &mut |message| first(message, at))?;
    let (told, mut bytes) = match heard {
        None => return Ok(None),
        Some(Heard::Part(told, bytes)) => (told, bytes),
        Some(Heard::Abort(code)) => return Err(refused(device, at, code)),
        Some(Heard::Whole(bytes)) if bytes.len() <= most => return Ok(Some(bytes)),
        Some(Heard::Whole(bytes)) => (bytes.len(), bytes),
        Some(Heard::Begun | Heard::Segment(..)) => return Ok(None),
    };
    if told > most {
        let trouble = TransferTrouble::TooLong { told, most };
        return give_up(bus, device, at, NO_ROOM, trouble);
    }
    let mut toggle = 0;
    loop {
        let asked = message(&[0x60 | toggle, 0, 0, 0, 0, 0, 0, 0]);
        let heard = mail::ask(bus, device, &asked, &mut segment)?;
        let (seen, data, is_last) = match heard {
            Some(Heard::Segment(seen, data, is_last)) => (seen, data, is_last),
            Some(Heard::Abort(code)) => return Err(refused(device, at, code)),
            _ => return Ok(None),
        };
        let trouble = if seen != toggle {
            Some((WRONG_TOGGLE, TransferTrouble::Toggle))
        } else if data.is_empty() && !is_last {
            Some((WRONG_LENGTH, TransferTrouble::Empty))
        } else {
            bytes.extend_from_slice(&data);
            let given = bytes.len();
            let is_wrong = given > told || (is_last && given < told);
            is_wrong.then_some((WRONG_LENGTH, TransferTrouble::Length { told, given }))
        };
        if let Some((code, trouble)) = trouble {
            return give_up(bus, device, at, code, trouble);
        }
        if is_last {
            return Ok(Some(bytes));
        }
        toggle ^= TOGGLE;
    }
}

/// `None` if the device falls silent.
fn download<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    at: At,
    bytes: &[u8],
) -> Tried<()> {
    let room = device.mailbox.map_or(0, |(out, _)| usize::from(out.length));
    let length = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
    let (now, rest) = bytes.split_at(bytes.len().min(room.saturating_sub(FIRST)));
    let body = match bytes.len() {
        count @ 1..=4 => {
            let unused = u8::try_from(4 - count).unwrap_or(0);
            let mut body = begin(0x23 | unused << 2, at).to_vec();
            body[4..4 + count].copy_from_slice(bytes);
            body
        }
        _ => {
            let mut body = begin(0x21, at).to_vec();
            body[4..].copy_from_slice(&length.to_le_bytes());
            body.extend_from_slice(now);
            body
        }
    };
    let heard = mail::ask(bus, device, &message(&body), &mut |heard| begun(heard, at))?;
    match heard {
        Some(Heard::Begun) => {}
        Some(Heard::Abort(code)) => return Err(refused(device, at, code)),
        _ => return Ok(None),
    }
    let most = room.saturating_sub(SEGMENT).max(LEAST);
    let count = rest.chunks(most).count();
    let mut toggle = 0;
    for (nth, data) in rest.chunks(most).enumerate() {
        let unused = u8::try_from(LEAST.saturating_sub(data.len())).unwrap_or(0);
        let last = if nth + 1 == count { LAST } else { 0 };
        let mut body = vec![toggle | unused << 1 | last];
        body.extend_from_slice(data);
        body.resize(1 + data.len() + usize::from(unused), 0);
        match mail::ask(bus, device, &message(&body), &mut taken)? {
            Some(Heard::Segment(seen, ..)) if seen == toggle => {}
            Some(Heard::Segment(..)) => {
                return give_up(bus, device, at, WRONG_TOGGLE, TransferTrouble::Toggle);
            }
            Some(Heard::Abort(code)) => return Err(refused(device, at, code)),
            _ => return Ok(None),
        }
        toggle ^= TOGGLE;
    }
    Ok(Some(()))
}

/// Tells the device that a transfer is given up.
fn give_up<W: Wire, T>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    at: At,
    code: u32,
    trouble: TransferTrouble,
) -> Tried<T> {
    let mut body = begin(0x80, at);
    body[4..].copy_from_slice(&code.to_le_bytes());
    mail::post(bus, device, &message(&body))?;
    Err(BusError::Transfer {
        device: device.position,
        name: device.name.clone(),
        index: at.0,
        sub: at.1,
        trouble,
    })
}

fn refused(device: &Device, (index, sub): At, code: u32) -> BusError {
    BusError::Object {
        device: device.position,
        name: device.name.clone(),
        index,
        sub,
        code,
    }
}

/// A command about an object.
const fn begin(command: u8, (index, sub): At) -> [u8; 8] {
    let [low, high] = index.to_le_bytes();
    [command, low, high, sub, 0, 0, 0, 0]
}

/// The message of a request, from its command on; its number is still to come.
fn message(body: &[u8]) -> Vec<u8> {
    let length = u16::try_from(2 + body.len()).unwrap_or(u16::MAX);
    let mut message = length.to_le_bytes().to_vec();
    message.extend_from_slice(&[0, 0, 0, 3, 0, 0x20]);
    message.extend_from_slice(body);
    message
}

/// What a message of CoE says from its command on, as long as it says it is, and whether it is a response;
/// `None` for other messages.
fn said(message: &[u8]) -> Option<(bool, &[u8])> {
    let [low, high, _, _, _, kind, _, service] = message.first_chunk().copied()?;
    let end = HEAD + usize::from(u16::from_le_bytes([low, high]));
    let said = message.get(COMMAND..end)?;
    let is_ours = kind & 15 == 3 && matches!(service >> 4, 2 | 3);
    is_ours.then_some((service >> 4 == 3, said))
}

/// The code of an abort, if that is what is said.
fn abort(said: &[u8]) -> Option<Heard> {
    let &[command, _, _, _, a, b, c, d] = said.first_chunk()?;
    (command >> 5 == 4).then(|| Heard::Abort(u32::from_le_bytes([a, b, c, d])))
}

/// An abort of what is about this object.
fn abort_of(said: &[u8], at: At) -> Option<Heard> {
    abort(said).filter(|_| is_about(said, at))
}

fn is_about(said: &[u8], (index, sub): At) -> bool {
    matches!(said, [_, low, high, of, ..] if (u16::from_le_bytes([*low, *high]), *of) == (index, sub))
}

/// The answer to the beginning of an upload.
fn first(message: &[u8], at: At) -> Option<Heard> {
    let (is_response, said) = said(message)?;
    if let Some(abort) = abort_of(said, at) {
        return Some(abort);
    }
    let &[command, _, _, _, a, b, c, d] = said.first_chunk()?;
    if !is_response || command >> 5 != 2 || !is_about(said, at) {
        return None;
    }
    if command & 2 != 0 {
        let unused = if command & 1 != 0 {
            command >> 2 & 3
        } else {
            0
        };
        let bytes = [a, b, c, d];
        return Some(Heard::Whole(bytes[..4 - usize::from(unused)].to_vec()));
    }
    let data = &said[COMMAND..];
    let told = u32::from_le_bytes([a, b, c, d]) as usize;
    Some(match data.get(..told) {
        Some(whole) => Heard::Whole(whole.to_vec()),
        None => Heard::Part(told, data.to_vec()),
    })
}

/// The answer to the question for a segment.
fn segment(message: &[u8]) -> Option<Heard> {
    let (is_response, said) = said(message)?;
    if let Some(abort) = abort(said) {
        return Some(abort);
    }
    let (command, data) = said.split_first()?;
    if !is_response || command >> 5 != 0 {
        return None;
    }
    // What is filled up is of seven bytes.
    let unused = if data.len() <= LEAST {
        command >> 1 & 7
    } else {
        0
    };
    let data = &data[..data.len().saturating_sub(unused.into())];
    Some(Heard::Segment(
        command & TOGGLE,
        data.to_vec(),
        command & LAST != 0,
    ))
}

/// The answer to the beginning of a download.
fn begun(message: &[u8], at: At) -> Option<Heard> {
    let (is_response, said) = said(message)?;
    if let Some(abort) = abort_of(said, at) {
        return Some(abort);
    }
    let is_begun = is_response && said.first()? >> 5 == 3 && is_about(said, at);
    is_begun.then_some(Heard::Begun)
}

/// The answer to a segment that was written.
fn taken(message: &[u8]) -> Option<Heard> {
    let (is_response, said) = said(message)?;
    if let Some(abort) = abort(said) {
        return Some(abort);
    }
    let command = said.first()?;
    let is_taken = is_response && command >> 5 == 1;
    is_taken.then(|| Heard::Segment(command & TOGGLE, Vec::new(), false))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAME: At = (0x1008, 0);

    /// A message with this behind its head.
    fn of(service: u8, body: &[u8]) -> Vec<u8> {
        let mut sent = message(body);
        sent[7] = service << 4;
        sent.resize(64, 0);
        sent
    }

    #[test]
    fn an_object_comes_as_a_whole_or_in_part() {
        // As an EK1914 has its name.
        let whole = of(3, b"\x41\x08\x10\x00\x06\x00\x00\x00EK1914");
        assert_eq!(first(&whole, NAME), Some(Heard::Whole(b"EK1914".to_vec())));
        let part = of(3, b"\x41\x08\x10\x00\x09\x00\x00\x00EK1914");
        assert_eq!(first(&part, NAME), Some(Heard::Part(9, b"EK1914".to_vec())));
        let short = of(3, b"\x4b\x08\x10\x00ab\x00\x00");
        assert_eq!(first(&short, NAME), Some(Heard::Whole(b"ab".to_vec())));
        assert_eq!(first(&whole, (0x1009, 0)), None);
        let refused = of(2, b"\x80\x08\x10\x00\x00\x00\x02\x06");
        assert_eq!(first(&refused, NAME), Some(Heard::Abort(0x0602_0000)));
        // What ends before it says it does is no answer.
        assert_eq!(first(&whole[..20], NAME), None);
        assert_eq!(first(&[], NAME), None);
    }

    #[test]
    fn segments_tell_what_of_seven_bytes_is_none() {
        let full = of(3, b"\x10abcdefg");
        assert_eq!(
            segment(&full),
            Some(Heard::Segment(0x10, b"abcdefg".to_vec(), false))
        );
        let last = of(3, b"\x0babcdefg");
        assert_eq!(
            segment(&last),
            Some(Heard::Segment(0, b"ab".to_vec(), true))
        );
        // Longer ones have nothing to fill up.
        let long = of(3, b"\x0dabcdefgh");
        assert_eq!(
            segment(&long),
            Some(Heard::Segment(0, b"abcdefgh".to_vec(), true))
        );
        let emergency = of(1, b"\x80\x73\x20\x00\x00\x00\x00\x00");
        assert_eq!(segment(&emergency), None);
    }
}
