//! The cables of a segment: which device hangs at which port, and when a frame passes whom.
//!
//! A frame goes through the ports of a device in the order 0, 3, 1, 2 and round again, out by those
//! with a cable and past those without. Between ports 0 and 3 is what reads and writes it. A device
//! whose IN and OUT are swapped is entered by port 1, and sees the frame when those behind it have.

use crate::memory::{DL_STATUS, Memory, PORT_TIMES};

/// Ports in the order in which a frame goes through them.
const ROUND: [u8; 4] = [0, 3, 1, 2];

/// The cable by which a device hangs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cable {
    /// The device at its other end, which is nearer to the master.
    pub from: usize,
    /// The port there, 1 to 3.
    pub port: u8,
    /// The port at this end: 0, or another one if IN and OUT are swapped.
    pub into: u8,
    /// How long a frame takes, each way, ns.
    pub way_ns: u64,
}

/// When a frame passes a device, ns since it reached the first one.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Passage {
    /// It is read and written.
    pub(crate) read_ns: u64,
    /// It comes in by each port; `None` for a port without a cable.
    pub(crate) ports_ns: [Option<u64>; 4],
}

impl Passage {
    /// Writes which ports have a cable. The times of the others are what happens to be there.
    pub(crate) fn put(&self, memory: &mut Memory) {
        let mut status = 0x0001_u16;
        for (port, port_ns) in self.ports_ns.iter().enumerate() {
            if port_ns.is_some() {
                // A link, and frames go out by it.
                status |= 1 << (4 + port) | 0b10 << (8 + 2 * port);
            } else {
                status |= 0b01 << (8 + 2 * port);
            }
        }
        memory.put(DL_STATUS, &status.to_le_bytes());
        for at in (PORT_TIMES..).step_by(4).take(4) {
            // As a LAN9252 had it.
            memory.put(at, b"hoff");
        }
    }
}

/// How frames pass `count` devices, of which all but the first hang by the cables. `None` if not every
/// device hangs somewhere, or they are not in the order in which a frame is read.
pub(crate) fn passages(count: usize, cables: &[Cable]) -> Option<Vec<Passage>> {
    let mut way = Way {
        cables,
        passages: vec![Passage::default(); count],
        order: Vec::new(),
    };
    if count > 0 {
        way.visit(0, 0, 0)?;
    }
    let is_in_order = way.order.iter().copied().eq(0..count);
    is_in_order.then_some(way.passages)
}

struct Way<'c> {
    cables: &'c [Cable],
    passages: Vec<Passage>,
    /// Devices in the order in which they read the frame.
    order: Vec<usize>,
}

impl Way<'_> {
    /// A frame enters a device. Returns when it has left by the same port.
    fn visit(&mut self, device: usize, entry: u8, mut now_ns: u64) -> Option<u64> {
        self.passages.get_mut(device)?.ports_ns[usize::from(entry)] = Some(now_ns);
        let first = ROUND.iter().position(|port| *port == entry)?;
        let mut round = ROUND.iter().cycle().skip(first).copied();
        let mut from = round.next()?;
        for to in round {
            if from == 0 {
                self.order.push(device);
                self.passages[device].read_ns = now_ns;
            }
            if to == entry {
                break;
            }
            let hung = |cable: &Cable| cable.from == device && cable.port == to;
            if let Some(nth) = self.cables.iter().position(hung) {
                let cable = self.cables[nth];
                now_ns = self.visit(nth + 1, cable.into, now_ns + cable.way_ns)? + cable.way_ns;
                self.passages[device].ports_ns[usize::from(to)] = Some(now_ns);
            }
            from = to;
        }
        Some(now_ns)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test")]

    use super::*;

    #[test]
    fn a_frame_goes_through_every_cable_and_back() {
        let cable = |from, port, way_ns| Cable {
            from,
            port,
            into: 0,
            way_ns,
        };
        // A junction with two devices at port 3 and one at port 1.
        let cables = [cable(0, 3, 100), cable(1, 1, 10), cable(0, 1, 1000)];
        let passages = passages(4, &cables).unwrap();
        let read: Vec<_> = passages.iter().map(|passage| passage.read_ns).collect();
        assert_eq!(read, [0, 100, 110, 1220]);
        assert_eq!(passages[0].ports_ns, [Some(0), Some(2220), None, Some(220)]);
        assert_eq!(passages[1].ports_ns, [Some(100), Some(120), None, None]);
    }

    #[test]
    fn a_device_with_in_and_out_swapped_reads_after_those_behind_it() {
        let swapped = Cable {
            from: 0,
            port: 1,
            into: 1,
            way_ns: 100,
        };
        let behind = Cable {
            from: 2,
            port: 0,
            into: 0,
            way_ns: 10,
        };
        // The second one that reads hangs behind the third.
        let passages = passages(3, &[behind, swapped]).unwrap();
        assert_eq!(
            [passages[1].read_ns, passages[2].read_ns],
            [110, 120],
            "{passages:?}"
        );
        assert!(super::passages(3, &[swapped, behind]).is_none());
    }
}
