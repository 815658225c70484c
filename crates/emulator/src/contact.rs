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
    /// The bit of 0x60FD by which all drives show it; `None` for none.
    pub drive_bit: Option<u8>,
}

/// The way of a motor in a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Way {
    pub(crate) from_ns: u64,
    pub(crate) to_ns: u64,
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Time constant of its lag, s; 0 for a steady speed.
    pub(crate) lag_t: f64,
}

impl Way {
    #[allow(clippy::cast_precision_loss, reason = "a step")]
    fn step_t(&self) -> f64 {
        (self.to_ns - self.from_ns) as f64 * 1e-9
    }

    /// The part of the way that is done after a part of the time, or the reverse.
    fn done(&self, of_time: f64) -> f64 {
        if self.lag_t <= 0.0 {
            return of_time;
        }
        let steps = self.step_t() / self.lag_t;
        (-steps * of_time).exp_m1() / (-steps).exp_m1()
    }

    fn time_of(&self, done: f64) -> f64 {
        if self.lag_t <= 0.0 {
            return done;
        }
        let steps = self.step_t() / self.lag_t;
        -(done * (-steps).exp_m1()).ln_1p() / steps
    }

    /// When it passes a place that is on it, ns.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a part of a step"
    )]
    fn passes_ns(&self, place: f64) -> u64 {
        let done = ((place - self.from) / (self.to - self.from)).clamp(0.0, 1.0);
        self.from_ns + (self.time_of(done) * self.step_t() * 1e9).round() as u64
    }

    /// Where the motor is at a time.
    #[allow(clippy::cast_precision_loss, reason = "a step")]
    fn at(&self, now_ns: u64) -> f64 {
        let since_t = now_ns.saturating_sub(self.from_ns) as f64 * 1e-9;
        let of_time = (since_t / self.step_t()).clamp(0.0, 1.0);
        self.from + (self.to - self.from) * self.done(of_time)
    }
}

/// The last ways of a motor.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ways(VecDeque<Way>);

impl Ways {
    const MOST: usize = 64;

    pub(crate) fn push(&mut self, way: Way) {
        if self.0.len() == Self::MOST {
            self.0.pop_front();
        }
        self.0.push_back(way);
    }

    fn last_ns(&self) -> u64 {
        self.0.back().map_or(0, |way| way.to_ns)
    }

    /// Where the motor was at a time.
    pub(crate) fn at(&self, now_ns: u64) -> Option<f64> {
        let way = self.0.iter().find(|way| now_ns <= way.to_ns);
        way.or(self.0.back()).map(|way| way.at(now_ns))
    }
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
                if let Some(bit) = self.probe.drive_bit {
                    device.show_at_drives(bit, rises);
                }
            }
            self.coming.push_back((at_ns, rises));
        }
        let filter_ns = self.probe.filter_ns;
        while let Some((_, level)) = self
            .coming
            .pop_front_if(|(at_ns, _)| *at_ns + filter_ns <= now_ns)
        {
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
        for way in ways.iter().flat_map(|ways| &ways.0) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_passed_when_the_motor_is_there() {
        for lag_t in [0.0, 0.000_5, 0.002, 0.1] {
            let way = Way {
                from_ns: 1_000_000_000,
                to_ns: 1_004_000_000,
                from: 100.0,
                to: -60.0,
                lag_t,
            };
            for place in [100.0, 99.0, 20.0, -59.999, -60.0] {
                let at_ns = way.passes_ns(place);
                assert!((way.at(at_ns) - place).abs() < 1e-3, "{lag_t} {place}");
            }
            assert!(way.at(1_002_000_000) <= 20.0 + 1e-9);
        }
    }
}
