//! An encoder at a terminal that a drive of a joint turns, by way of belt and screw: on the load, or on a motor.

use crate::device::Device;

/// An encoder of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadEncoder {
    /// The terminal.
    pub device: usize,
    /// The object of its counter.
    pub counter: (u16, u8),
    /// What turns it: device, and axis of it.
    pub drive: (usize, usize),
    /// Counts for each count of the motor.
    pub ratio: f64,
    /// What it counts where the motor is at zero.
    pub offset: f64,
}

/// An encoder of a joint at work.
#[derive(Debug, Clone)]
pub(crate) struct LoadEncoderAtWork {
    encoder: LoadEncoder,
    /// What slipped between motor and load, counts.
    slip: f64,
}

impl LoadEncoderAtWork {
    pub(crate) const fn new(encoder: LoadEncoder) -> Self {
        Self { encoder, slip: 0.0 }
    }

    pub(crate) const fn device(&self) -> usize {
        self.encoder.device
    }

    /// The load slips on the motor.
    pub(crate) fn slip(&mut self, counts: f64) {
        self.slip += counts;
    }

    /// Looks where the motor is.
    pub(crate) fn watch(&self, devices: &mut [Device], now_ns: u64) {
        let (device, axis) = self.encoder.drive;
        let drive = devices
            .get(device)
            .and_then(|device| device.drives.get(axis));
        let Some(place) = drive.map(|drive| drive.place_at(now_ns)) else {
            return;
        };
        let counts = place * self.encoder.ratio + self.encoder.offset + self.slip;
        if let Some(terminal) = devices.get_mut(self.encoder.device) {
            #[allow(clippy::cast_possible_truncation, reason = "a counter")]
            terminal.put_input(self.encoder.counter, counts.floor() as i64);
        }
    }
}
