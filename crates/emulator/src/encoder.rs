//! An encoder on a spindle, at a terminal with a counter that keeps what it is at the index (as EL5101 and
//! EL5151 do).

use crate::device::Device;

/// The objects of the terminal.
const VALID: (u16, u8) = (0x6000, 0x01);
const COUNTER: (u16, u8) = (0x6000, 0x11);
const LATCH: (u16, u8) = (0x6000, 0x12);
const ARM: (u16, u8) = (0x7000, 0x01);

/// An encoder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encoder {
    /// The terminal.
    pub device: usize,
    /// What turns it: the drive of the spindle, device and axis of it.
    pub spindle: (usize, usize),
    /// Counts of a revolution.
    pub counts_per_rev: f64,
    /// Where in a revolution its index is, from 0 to 1.
    pub index_at: f64,
}

/// An encoder at work.
#[derive(Debug, Clone)]
pub(crate) struct EncoderAtWork {
    encoder: Encoder,
    /// Revolutions when it was looked at last.
    seen: Option<f64>,
    /// What it counts too much.
    slip: i64,
    is_armed: bool,
    kept: Option<i64>,
}

impl EncoderAtWork {
    pub(crate) const fn new(encoder: Encoder) -> Self {
        Self {
            encoder,
            seen: None,
            slip: 0,
            is_armed: false,
            kept: None,
        }
    }

    pub(crate) const fn device(&self) -> usize {
        self.encoder.device
    }

    /// What turns it: the drive of the spindle, device and axis of it.
    pub(crate) const fn spindle(&self) -> (usize, usize) {
        self.encoder.spindle
    }

    /// It loses counts, or counts what is not there.
    pub(crate) const fn slip(&mut self, counts: i64) {
        self.slip += counts;
    }

    #[allow(clippy::cast_possible_truncation, reason = "a counter")]
    fn counts(&self, revolutions: f64) -> i64 {
        (revolutions * self.encoder.counts_per_rev).floor() as i64 + self.slip
    }

    /// The index between two places, if it was passed: the last one.
    fn passed(&self, from: f64, to: f64) -> Option<f64> {
        let nth = |at: f64| (at - self.encoder.index_at).floor();
        let at = nth(from).max(nth(to)) + self.encoder.index_at;
        ((nth(from) - nth(to)).abs() > 0.5).then_some(at)
    }

    /// Looks where the spindle is: as far as its motor has turned, or as far as is known behind a gearbox.
    pub(crate) fn watch(&mut self, devices: &mut [Device], behind: Option<f64>, now_ns: u64) {
        let (device, axis) = self.encoder.spindle;
        let spindle = devices.get(device);
        let revolutions = spindle.and_then(|device| device.drives.get(axis)?.revolutions(now_ns));
        let Some(now) = behind.or(revolutions) else {
            return;
        };
        let from = self.seen.replace(now).unwrap_or(now);
        let index = self.passed(from, now);
        let Some(terminal) = devices.get_mut(self.encoder.device) else {
            return;
        };
        let is_armed = terminal.output_bit(ARM);
        if !is_armed {
            self.kept = None;
        }
        if is_armed && self.is_armed && self.kept.is_none() {
            self.kept = index.map(|at| self.counts(at));
        }
        self.is_armed = is_armed;
        let (counter, kept) = (self.counts(now), self.kept);
        terminal.put_input(COUNTER, counter);
        terminal.put_input(VALID, kept.is_some().into());
        if let Some(kept) = kept {
            terminal.put_input(LATCH, kept);
        }
    }
}
