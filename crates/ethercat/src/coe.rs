//! Parameters of a device by its mailbox: SDO of up to four bytes (ETG.1000.6, CoE). Longer ones go in
//! segments.

use crate::device::Device;
use crate::error::BusError;
use crate::exchange::Exchange;
use crate::mail;
use crate::transfer_trouble::TransferTrouble;
use crate::wire::Wire;

/// An object, and how many bytes it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Object {
    /// Index.
    pub index: u16,
    /// Subindex.
    pub sub: u8,
    /// 1, 2 or 4.
    pub size: u8,
}

/// An object of the dictionary.
#[must_use]
pub const fn object(index: u16, sub: u8, size: u8) -> Object {
    Object { index, sub, size }
}

/// What a message from a device is, to whom has asked for a parameter.
pub(crate) enum Reply {
    /// The parameter, or that it was written.
    Value(u32),
    /// The code of the refusal.
    Abort(u32),
    /// The parameter has so many bytes, more than four.
    Longer(u32),
    /// Something else.
    Other,
}

/// The message that reads an object, or writes it.
pub(crate) fn message(object: Object, value: Option<u32>, number: u8) -> [u8; 16] {
    let [low, high] = object.index.to_le_bytes();
    let kind = 3 | (number & 7) << 4;
    let command = value.map_or(0x40, |_| 0x23 | (4 - object.size.clamp(1, 4)) << 2);
    let [a, b, c, d] = value.unwrap_or(0).to_le_bytes();
    [
        10, 0, 0, 0, 0, kind, 0, 0x20, command, low, high, object.sub, a, b, c, d,
    ]
}

/// What a message is, where an object was asked for.
pub(crate) fn reply(message: &[u8], object: Object) -> Reply {
    let Some(
        &[
            _,
            _,
            _,
            _,
            _,
            kind,
            _,
            service,
            command,
            low,
            high,
            sub,
            a,
            b,
            c,
            d,
        ],
    ) = message.first_chunk::<16>()
    else {
        return Reply::Other;
    };
    let is_asked = u16::from_le_bytes([low, high]) == object.index && sub == object.sub;
    let value = u32::from_le_bytes([a, b, c, d]);
    match (kind & 15, service >> 4, command >> 5) {
        (3, 2 | 3, 4) if is_asked => Reply::Abort(value),
        // Expedited, with the size in the command.
        (3, 3, 2) if is_asked && command & 2 != 0 => {
            let unused = if command & 1 != 0 {
                command >> 2 & 3
            } else {
                4 - object.size.min(4)
            };
            Reply::Value(value & (u32::MAX >> (8 * u32::from(unused))))
        }
        // As a whole, behind its length.
        (3, 3, 2) if is_asked && value > 4 => Reply::Longer(value),
        (3, 3, 2) if is_asked => message
            .get(16..)
            .and_then(|data| data.get(..value as usize))
            .map_or(Reply::Other, |data| {
                let bytes = data.iter().rev();
                Reply::Value(bytes.fold(0, |number, byte| number << 8 | u32::from(*byte)))
            }),
        (3, 3, 3) if is_asked => Reply::Value(0),
        _ => Reply::Other,
    }
}

/// Reads a parameter.
pub(crate) fn read<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    object: Object,
) -> Result<u32, BusError> {
    transfer(bus, device, object, None)
}

/// Writes a parameter.
pub(crate) fn write<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    object: Object,
    value: u32,
) -> Result<(), BusError> {
    transfer(bus, device, object, Some(value)).map(|_| ())
}

fn transfer<W: Wire>(
    bus: &mut Exchange<'_, W>,
    device: &Device,
    object: Object,
    value: Option<u32>,
) -> Result<u32, BusError> {
    let asked = message(object, value, 0);
    let mut answer = |message: &[u8]| match reply(message, object) {
        // An emergency, or the answer to a question that was given up.
        Reply::Other => None,
        reply => Some(reply),
    };
    for _ in 0..mail::TRIES {
        match mail::ask(bus, device, &asked, &mut answer)? {
            Some(Reply::Value(value)) => return Ok(value),
            Some(Reply::Abort(code)) => {
                return Err(BusError::Object {
                    device: device.position,
                    name: device.name.clone(),
                    index: object.index,
                    sub: object.sub,
                    code,
                });
            }
            Some(Reply::Longer(told)) => {
                return Err(BusError::Transfer {
                    device: device.position,
                    name: device.name.clone(),
                    index: object.index,
                    sub: object.sub,
                    trouble: TransferTrouble::TooLong {
                        told: told as usize,
                        most: object.size.into(),
                    },
                });
            }
            Some(Reply::Other) | None => {}
        }
    }
    Err(mail::silent(device))
}

/// The error code of an emergency, if a message is one.
pub(crate) fn emergency(message: &[u8]) -> Option<u16> {
    let [_, _, _, _, _, kind, _, service, low, high] = message.first_chunk::<10>()?;
    (kind & 15 == 3 && service >> 4 == 1).then(|| u16::from_le_bytes([*low, *high]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_told_from_emergencies_and_from_answers_to_others() {
        let wanted = object(0x6065, 0, 4);
        let mut message = [10, 0, 0, 0, 0, 3, 0, 0x30, 0x43, 0x65, 0x60, 0, 1, 2, 3, 4];
        assert!(matches!(reply(&message, wanted), Reply::Value(0x0403_0201)));
        message[8] = 0x4f;
        assert!(matches!(reply(&message, wanted), Reply::Value(1)));
        message[9] = 0x66;
        assert!(matches!(reply(&message, wanted), Reply::Other));
        // A device may tell as a whole what would fit into the answer.
        let whole = |told: u8| {
            let head = [
                16, 0, 0, 0, 0, 3, 0, 0x30, 0x41, 0x65, 0x60, 0, told, 0, 0, 0,
            ];
            [&head[..], &[1, 2, 3, 4, 5, 6]].concat()
        };
        assert!(matches!(reply(&whole(2), wanted), Reply::Value(0x0201)));
        assert!(matches!(
            reply(&whole(4), wanted),
            Reply::Value(0x0403_0201)
        ));
        assert!(matches!(reply(&whole(6), wanted), Reply::Longer(6)));
        assert!(matches!(reply(&whole(4)[..18], wanted), Reply::Other));
        let abort = [10, 0, 0, 0, 0, 3, 0, 0x20, 0x80, 0x65, 0x60, 0, 0, 0, 2, 6];
        assert!(matches!(reply(&abort, wanted), Reply::Abort(0x0602_0000)));
        let sent = [10, 0, 0, 0, 0, 3, 0, 0x10, 0x80, 0x73, 0x20, 0, 0, 0, 0, 0];
        assert!(matches!(reply(&sent, wanted), Reply::Other));
        assert_eq!(emergency(&sent), Some(0x7380));
        assert_eq!(emergency(&abort), None);
    }
}
