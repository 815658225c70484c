//! The datagrams of a frame.

use core::ops::Range;

/// Bytes of the header of a datagram.
const HEAD: usize = 10;
/// Bytes of the Ethernet header and of EtherCAT's.
const START: usize = 16;
/// EtherCAT, as Ethernet has it: most significant byte first.
const ETHER_TYPE: [u8; 2] = [0x88, 0xa4];

/// A datagram: what it asks for, and where its data is in the frame.
#[derive(Debug, Clone)]
pub(crate) struct Datagram {
    pub(crate) command: u8,
    pub(crate) index: u8,
    /// Position or station address, and address in the memory; both together are a logical address.
    pub(crate) device: u16,
    pub(crate) address: u16,
    pub(crate) data: Range<usize>,
    head: usize,
}

impl Datagram {
    pub(crate) const fn logical(&self) -> u32 {
        self.device as u32 | (self.address as u32) << 16
    }

    /// Adds to the working counter, and writes the address of the device that was passed on.
    pub(crate) fn close(&self, frame: &mut [u8], counted: u16) {
        let end = self.data.end;
        if let Some([low, high]) = frame.get(end..end + 2) {
            let counter = u16::from_le_bytes([*low, *high]).wrapping_add(counted);
            frame[end..end + 2].copy_from_slice(&counter.to_le_bytes());
        }
        if let Some(place) = frame.get_mut(self.head + 2..self.head + 4) {
            place.copy_from_slice(&self.device.to_le_bytes());
        }
    }
}

/// The datagrams of an EtherCAT frame, as far as they are whole; none of another frame.
pub(crate) fn datagrams(frame: &[u8]) -> Vec<Datagram> {
    let mut found = Vec::new();
    if frame.get(12..14) != Some(&ETHER_TYPE[..]) || frame.len() < START {
        return found;
    }
    let length = usize::from(u16::from_le_bytes([frame[14], frame[15]]) & 0x7ff);
    let end = frame.len().min(START + length);
    let mut at = START;
    while let Some(head) = frame.get(at..at + HEAD).filter(|_| at + HEAD <= end) {
        let word = |n: usize| u16::from_le_bytes([head[n], head[n + 1]]);
        let data = at + HEAD..at + HEAD + usize::from(word(6) & 0x7ff);
        if data.end + 2 > end {
            break;
        }
        let follows = word(6) & 0x8000 != 0;
        let next = data.end + 2;
        found.push(Datagram {
            command: head[0],
            index: head[1],
            device: word(2),
            address: word(4),
            data,
            head: at,
        });
        if !follows {
            break;
        }
        at = next;
    }
    found
}
