//! A probe on the machine: it closes where an axis passes a place, at that moment and not at the next
//! SYNC0, and every drive with a touch probe is told.

use crate::device::Device;
use std::collections::VecDeque;

/// A probe, and what it is wired to beside the touch probes of all drives.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// The drive whose motor it moves with: device, and axis of it.
    pub drive: (usize, usize),
    /// Where it closes, as that drive counts.
    pub at_counts: f64,
    /// Whether it is closed above that place, or below.
    pub is_closed_above: bool,
    /// Inputs of terminals: device, and bit of its inputs.
    pub inputs: Vec<(usize, usize)>,
    /// How long an input of a terminal takes to show it, ns.
    pub filter_ns: u64,
    /// Inputs of drives: device, axis of it, and bit of 0x60FD.
    pub drive_inputs: Vec<(usize, usize, u8)>,
}

/// A probe at work.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    probe: Probe,
    /// `None` before the first step.
    is_closed: Option<bool>,
    /// Until when the way was looked at, ns.
    seen_ns: u64,
    /// Edges that inputs do not show yet.
    coming: VecDeque<(u64, bool)>,
}

impl Contact {
    pub(crate) const fn new(probe: Probe) -> Self {
        Self {
            probe,
            is_closed: None,
            seen_ns: 0,
            coming: VecDeque::new(),
        }
    }

    const fn level(&self, place: f64) -> bool {
        if self.probe.is_closed_above {
            place >= self.probe.at_counts
        } else {
            place <= self.probe.at_counts
        }
    }

    /// Looks at how far all motors have come.
    pub(crate) fn watch(&mut self, devices: &mut [Device], now_ns: u64) {
        let drives = devices.iter().filter(|device| device.has_probe());
        let drives = drives.flat_map(|device| &device.drives);
        let until_ns = drives.filter_map(|drive| Some(drive.ways.as_ref()?.last_ns()));
        let until_ns = until_ns.min().unwrap_or(now_ns);
        for (at_ns, rises) in self.edges(devices, until_ns) {
            for device in &mut *devices {
                device.capture(rises, at_ns);
            }
            for (device, axis, bit) in &self.probe.drive_inputs {
                if let Some(device) = devices.get_mut(*device) {
                    device.show_at_drive(*axis, *bit, rises);
                }
            }
            self.coming.push_back((at_ns, rises));
        }
        let filter_ns = self.probe.filter_ns;
        while let Some((at_ns, level)) = self.coming.front().copied()
            && at_ns + filter_ns <= now_ns
        {
            self.coming.pop_front();
            for (device, bit) in &self.probe.inputs {
                if let Some(device) = devices.get_mut(*device) {
                    device.change_inputs(|pins| pins.set_bit(*bit, level));
                }
            }
        }
    }

    /// The edges in what is new of the way of its motor, until a time that all motors have reached.
    fn edges(&mut self, devices: &[Device], until_ns: u64) -> Vec<(u64, bool)> {
        let (device, axis) = self.probe.drive;
        let drive = devices
            .get(device)
            .and_then(|device| device.drives.get(axis));
        let ways = drive.and_then(|drive| drive.ways.as_ref());
        let mut edges = Vec::new();
        for way in ways.iter().flat_map(|ways| ways.all()) {
            if way.to_ns <= self.seen_ns || way.to_ns > until_ns {
                continue;
            }
            self.seen_ns = way.to_ns;
            let level = self.level(way.to);
            match self.is_closed.replace(level) {
                // It was so before anything moved.
                None if level => edges.push((way.from_ns, true)),
                Some(before) if before != level => {
                    edges.push((way.passes_ns(self.probe.at_counts), level));
                }
                _ => {}
            }
        }
        edges
    }
}
