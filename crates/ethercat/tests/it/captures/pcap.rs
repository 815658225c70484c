//! The frames of a capture, and their datagrams.

/// A datagram of a captured frame.
pub(super) struct Datagram<'f> {
    pub(super) command: u8,
    /// The station address; or how many devices are still to be passed, less than none.
    pub(super) station: u16,
    /// The register.
    pub(super) offset: u16,
    pub(super) data: &'f [u8],
    pub(super) counter: u16,
}

pub(super) fn word(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

pub(super) fn datagrams(frame: &[u8]) -> Vec<Datagram<'_>> {
    let (mut found, mut at) = (Vec::new(), 16);
    if frame.get(12..14) != Some(&[0x88, 0xa4]) {
        return found;
    }
    while at + 12 <= frame.len() {
        let length = word(frame, at + 6);
        let end = at + 10 + usize::from(length & 0x7ff);
        if end + 2 > frame.len() {
            break;
        }
        found.push(Datagram {
            command: frame[at],
            station: word(frame, at + 2),
            offset: word(frame, at + 4),
            data: &frame[at + 10..end],
            counter: word(frame, end),
        });
        if length & 0x8000 == 0 {
            break;
        }
        at = end + 2;
    }
    found
}

/// The frames of a capture: enhanced packet blocks of a pcapng file.
pub(super) fn frames(capture: &[u8]) -> Vec<&[u8]> {
    let number = |at: usize| {
        let bytes = capture.get(at..at + 4)?;
        Some(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]) as usize)
    };
    let (mut frames, mut at) = (Vec::new(), 0);
    while let (Some(kind), Some(length @ 12..)) = (number(at), number(at + 4)) {
        if kind == 6 {
            let captured = number(at + 20).unwrap();
            frames.push(&capture[at + 28..at + 28 + captured]);
        }
        at += length;
    }
    frames
}
