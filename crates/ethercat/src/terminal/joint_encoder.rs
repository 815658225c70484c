//! An encoder of a joint at a terminal: on the load, or on a motor whose drive has none.

use super::at::At;
use super::counter::Counter;

/// Of a counter that has more, these are read: the lower ones.
const MOST_BITS: u32 = 32;

/// What an encoder of a joint is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EncoderUse {
    /// The joint is where it says: following errors, homing and probing are by it.
    Position,
    /// It is compared with what the drive counts, and nothing else.
    Watch,
}

/// An encoder of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointEncoderSettings {
    /// The joint, from 0.
    pub joint: usize,
    /// Where its counter is.
    pub at: At,
    /// Counts a mm or a degree, > 0.
    pub counts_per_unit: f64,
    /// It counts the other way.
    pub is_inverted: bool,
    /// Where the joint is when it counts zero, mm or degrees; `None` for one that only counts: it is where the drive
    /// says when it is heard first, and when the drive has found its home.
    pub home_offset: Option<f64>,
    /// Its number has no sign: with 16 bits, 40000 is no -25536.
    pub is_unsigned: bool,
    /// What it is for.
    pub used: EncoderUse,
    /// How far it may be from what the drive counts, mm or degrees.
    pub apart: f64,
}

/// An encoder of a joint, in the image of all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WiredJointEncoder {
    pub(crate) settings: JointEncoderSettings,
    /// Which of the devices that are no drives it is at.
    pub(crate) nth: usize,
    /// Where its counter is, and how many bits of it are read.
    pub(crate) counter: (usize, u32),
}

impl WiredJointEncoder {
    /// Whether a counter may be like this.
    pub(super) const fn fits(bit: usize, bits: u32) -> bool {
        bit.is_multiple_of(8) && matches!(bits, 16 | 32 | 64)
    }

    /// An encoder whose counter is at this bit of the image.
    pub(super) fn new(
        settings: JointEncoderSettings,
        nth: usize,
        (bit, bits): (usize, u32),
    ) -> Self {
        Self {
            settings,
            nth,
            counter: (bit, bits.min(MOST_BITS)),
        }
    }
}

/// An encoder of a joint at work.
#[derive(Debug)]
pub(super) struct JointEncoder {
    wired: WiredJointEncoder,
    counter: Counter,
}

impl JointEncoder {
    pub(super) const fn new(wired: WiredJointEncoder) -> Self {
        Self {
            counter: Counter::new(wired.counter),
            wired,
        }
    }

    pub(super) const fn nth(&self) -> usize {
        self.wired.nth
    }

    pub(super) const fn joint(&self) -> usize {
        self.wired.settings.joint
    }

    /// Takes what a frame says that was sent at a time; nothing if its device did not take part.
    pub(super) fn hear(&mut self, inputs: Option<&[u8]>, sent_ns: u64) {
        self.counter.hear(inputs, sent_ns);
    }

    /// Where it says that the joint was at a time, mm or degrees; `None` while it is not heard. One that only counts
    /// begins at 0.
    pub(super) fn place(&self, at_ns: u64) -> Option<f64> {
        if self.counter.is_missed() {
            return None;
        }
        let settings = &self.wired.settings;
        let zero = self.counter.zero(!settings.is_unsigned);
        let from = settings.home_offset.map_or(0, |_| zero);
        #[allow(clippy::cast_precision_loss, reason = "far below 2⁵³")]
        let of = |count: i64| (count - from) as f64;
        let (end, begin, younger_r) = self.counter.around(at_ns);
        let count = of(end) - (of(end) - of(begin)) * younger_r;
        let sign = if settings.is_inverted { -1.0 } else { 1.0 };
        Some(sign * count / settings.counts_per_unit + settings.home_offset.unwrap_or(0.0))
    }
}
