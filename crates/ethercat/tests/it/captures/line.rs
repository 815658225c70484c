//! A line with the devices of a capture behind an emulated drive, which leads them: its clock is that of all.

use super::pcap::datagrams;
use super::recorded::{Known, Recorded};
use glidepath_emulator::{Cable, ClockKind, DriveSettings as Emulated, Segment};
use glidepath_ethercat::Wire;
use std::io;

/// From the drive to the first device of the capture, ns: longer than any of their loops.
const WAY_NS: u64 = 20_000;

/// The wire. Emulated devices answer first, those of the capture behind them.
#[derive(Debug)]
pub(super) struct Line {
    segment: Segment,
    pub(super) devices: Vec<Recorded>,
    now_ns: u64,
    back: Option<Vec<u8>>,
}

impl Line {
    pub(super) fn new(known: &[Known], now_ns: u64) -> Self {
        let cable = Cable {
            from: 0,
            port: 1,
            into: 0,
            way_ns: WAY_NS,
        };
        // What hangs at the drive's port is not there: those of the capture are.
        let line = [
            Emulated::default(),
            Emulated::terminal("ANOTHER", ClockKind::None),
        ];
        let mut segment = Segment::branched(&line, &[cable], now_ns - 1_000_000_000).unwrap();
        segment.unplug(1..2, true, now_ns);
        Self {
            segment,
            devices: known.iter().cloned().map(Recorded::new).collect(),
            now_ns,
            back: None,
        }
    }
}

impl Wire for Line {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn sleep_until(&mut self, deadline_ns: u64) {
        self.now_ns = self.now_ns.max(deadline_ns);
    }

    fn send(&mut self, frame: &[u8]) -> io::Result<()> {
        let mut frame = frame.to_vec();
        self.segment.pass(&mut frame, self.now_ns);
        let (mut at, sent) = (16, frame.clone());
        for datagram in datagrams(&sent) {
            let length = datagram.data.len();
            let (data, counter) = frame[at + 10..].split_at_mut(length);
            let mut adp = datagram.station;
            let mut counted = 0;
            for device in &mut self.devices {
                counted += pass(device, (datagram.command, &mut adp, datagram.offset), data);
            }
            let sum = datagram.counter + counted;
            counter[..2].copy_from_slice(&sum.to_le_bytes());
            frame[at + 2..at + 4].copy_from_slice(&adp.to_le_bytes());
            at += 12 + length;
        }
        self.back = Some(frame);
        Ok(())
    }

    fn receive(&mut self, into: &mut [u8], until_ns: u64) -> io::Result<Option<usize>> {
        let Some(frame) = self.back.take() else {
            self.now_ns = self.now_ns.max(until_ns);
            return Ok(None);
        };
        self.now_ns += 60_000;
        into[..frame.len()].copy_from_slice(&frame);
        Ok(Some(frame.len()))
    }
}

/// A datagram passes a device of the capture. Returns what it adds to the working counter.
fn pass(
    device: &mut Recorded,
    (command, adp, offset): (u8, &mut u16, u16),
    data: &mut [u8],
) -> u16 {
    let is_next = *adp == 0;
    if matches!(command, 1 | 2 | 7 | 8) {
        *adp = adp.wrapping_add(1);
    }
    match command {
        2 if is_next => device.write(offset, data).into(),
        4 if device.is_at(*adp) => {
            let read = device.read(offset, data.len());
            read.map_or(0, |read| {
                data.copy_from_slice(&read);
                1
            })
        }
        5 if device.is_at(*adp) => device.write(offset, data).into(),
        7 => device.read(offset, data.len()).is_some().into(),
        8 => device.write(offset, data).into(),
        10..=12 => {
            let start = u32::from(*adp) | u32::from(offset) << 16;
            device.counted(start..start + data.len() as u32)
        }
        _ => 0,
    }
}
