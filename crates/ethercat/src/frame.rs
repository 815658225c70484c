//! EtherCAT frames: datagrams one after the other.
//!
//! ```text
//! Ethernet 14 │ length and type 2 │ command 1, index 1, address 4, length 2, 0 2 │ data │ counter 2 │ …
//! ```
//!
//! A frame comes back with the layout it was sent with, so an answer is looked for where the
//! question was, and only taken if command, index and length are still those.

use crate::wire::MAX_FRAME;
use core::ops::Range;

/// The command of a datagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Command {
    /// Read by position in the segment.
    Aprd = 1,
    /// Write by position.
    Apwr = 2,
    /// Read by station address.
    Fprd = 4,
    /// Write by station address.
    Fpwr = 5,
    /// Read from all, answers are joined by OR.
    Brd = 7,
    /// Write to all.
    Bwr = 8,
    /// Read by logical address.
    Lrd = 10,
    /// Write by logical address.
    Lwr = 11,
    /// Read and write by logical address.
    Lrw = 12,
    /// Read by station address, all others are written what was read.
    Frmw = 14,
}

/// The address of a datagram: a device and a place in its memory, or a logical address.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Address(u32);

impl Address {
    /// The nth device from the master on.
    #[must_use]
    pub fn position(nth: u16, register: u16) -> Self {
        Self::station(0_u16.wrapping_sub(nth), register)
    }

    /// The device with this station address.
    #[must_use]
    pub fn station(station: u16, register: u16) -> Self {
        Self(u32::from(station) | u32::from(register) << 16)
    }

    /// Every device.
    #[must_use]
    pub fn all(register: u16) -> Self {
        Self::station(0, register)
    }

    /// A logical address.
    #[must_use]
    pub const fn logical(address: u32) -> Self {
        Self(address)
    }
}

/// A datagram in a frame.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Slot {
    head: usize,
    data: Range<usize>,
}

/// The answer in the place of a datagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Answer<'a> {
    /// The data.
    pub data: &'a [u8],
    /// The working counter.
    pub counter: u16,
}

const START: usize = 16;
const HEAD: usize = 10;
/// Shorter frames are not sent by Ethernet.
const SHORTEST: usize = 60;
const BROADCAST: [u8; 6] = [0xff; 6];
/// Not of the world: bit 1 of the first byte is set by the first device that a frame passes.
const SOURCE: [u8; 6] = [0x10, 0x10, 0x10, 0x10, 0x10, 0x10];

/// A frame to be filled and sent. It allocates when it is made, and never again.
#[derive(Debug, Clone)]
pub struct Frame {
    bytes: Vec<u8>,
    end: usize,
    last: Option<usize>,
}

impl Default for Frame {
    fn default() -> Self {
        let mut bytes = vec![0; MAX_FRAME];
        bytes[..6].copy_from_slice(&BROADCAST);
        bytes[6..12].copy_from_slice(&SOURCE);
        bytes[12..14].copy_from_slice(&[0x88, 0xa4]);
        Self {
            bytes,
            end: START,
            last: None,
        }
    }
}

impl Frame {
    /// Takes all datagrams out.
    pub fn clear(&mut self) {
        self.bytes[START..].fill(0);
        (self.end, self.last) = (START, None);
    }

    /// Adds a datagram with data of a length, which is zero; `None` if the frame has no room.
    pub fn push(
        &mut self,
        command: Command,
        index: u8,
        address: Address,
        length: usize,
    ) -> Option<Slot> {
        let head = self.end;
        let data = head + HEAD..head + HEAD + length;
        if data.end + 2 > MAX_FRAME {
            return None;
        }
        if let Some(last) = self.last {
            // More follow.
            self.bytes[last + 7] |= 0x80;
        }
        let count = u16::try_from(length).ok()?;
        self.bytes[head] = command as u8;
        self.bytes[head + 1] = index;
        self.bytes[head + 2..head + 6].copy_from_slice(&address.0.to_le_bytes());
        self.bytes[head + 6..head + 8].copy_from_slice(&count.to_le_bytes());
        (self.last, self.end) = (Some(head), data.end + 2);
        let whole = u16::try_from(self.end - START).ok()? | 0x1000;
        self.bytes[14..16].copy_from_slice(&whole.to_le_bytes());
        Some(Slot { head, data })
    }

    /// The data of a datagram.
    pub fn data(&mut self, slot: &Slot) -> &mut [u8] {
        &mut self.bytes[slot.data.clone()]
    }

    /// The frame as it is sent.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..self.end.max(SHORTEST)]
    }

    /// What a frame that came back has in the place of a datagram; `None` if it is the answer to
    /// something else.
    #[must_use]
    pub fn answer<'a>(&self, slot: &Slot, received: &'a [u8]) -> Option<Answer<'a>> {
        let is_ethercat = received.get(12..14)? == &self.bytes[12..14];
        // A frame that no device has seen came back from a loop, or is our own.
        let was_seen = received.get(6)? & 2 != 0;
        let (head, end) = (slot.head, slot.data.end);
        let asked = &self.bytes[head..head + 8];
        let told = received.get(head..head + 8)?;
        let is_same = asked[..2] == told[..2] && asked[6..8] == told[6..8];
        if !(is_ethercat && was_seen && is_same) {
            return None;
        }
        let counter = received.get(end..end + 2)?;
        Some(Answer {
            data: received.get(slot.data.clone())?,
            counter: u16::from_le_bytes([counter[0], counter[1]]),
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn a_frame_is_laid_out_as_the_standard_has_it() {
        let mut frame = Frame::default();
        let first = frame.push(Command::Brd, 7, Address::all(0x130), 2).unwrap();
        let second = frame.push(Command::Fpwr, 7, Address::station(0x1001, 0x120), 2);
        frame.data(&second.unwrap()).copy_from_slice(&[8, 0]);
        let bytes = frame.bytes();
        assert_eq!(bytes.len(), 60);
        assert_eq!(bytes[12..16], [0x88, 0xa4, 28, 0x10]);
        assert_eq!(bytes[16..26], [7, 7, 0, 0, 0x30, 1, 2, 0x80, 0, 0]);
        assert_eq!(bytes[30..42], [5, 7, 1, 0x10, 0x20, 1, 2, 0, 0, 0, 8, 0]);
        // What comes back is looked at where it was sent, once a device has seen it.
        let mut back = bytes.to_vec();
        assert_eq!(frame.answer(&first, &back), None);
        back[6] |= 2;
        (back[26], back[28]) = (8, 3);
        let answer = frame.answer(&first, &back).unwrap();
        assert_eq!((answer.data, answer.counter), (&[8, 0][..], 3));
        back[17] = 6;
        assert_eq!(frame.answer(&first, &back), None);
        assert_eq!(frame.answer(&first, &back[..20]), None);
    }

    #[test]
    fn what_does_not_fit_is_not_taken() {
        let mut frame = Frame::default();
        assert!(
            frame
                .push(Command::Lrw, 0, Address::logical(0), 1486)
                .is_some()
        );
        assert!(frame.push(Command::Brd, 0, Address::all(0), 1).is_none());
        frame.clear();
        assert!(
            frame
                .push(Command::Lrw, 0, Address::logical(0), 1487)
                .is_none()
        );
    }
}
