//! The spindle's encoder at a terminal: a counter, and what it was at the index.
//!
//! ```text
//!  arm ──index──► valid: the counter at the index is kept ──► disarm ──not valid──► arm
//! ```
//!
//! The counter runs on at the index, which it is only compared with: the first index says where the angle is
//! whole, and at every later one it has to be whole again. Between two frames it turns evenly.

use super::bits::{bit, number, put_bit};
use super::counter::Counter;
use super::encoder_settings::EncoderSettings;
use crate::event::Event;
use glidepath_link::{Feedback, SpindleFlags};

/// How far the counter may be from whole revolutions at the index, counts.
const SLACK: i64 = 2;
/// Revolutions without an index behind which pulses are not counted any more.
const MISSING_R: f64 = 4.0;
/// How long no angle is told after the counter was wrong, ns: nothing that follows the spindle goes on.
const QUIET_NS: u64 = 500_000_000;
/// How long it is at its speed before it is told to be, ns.
const SETTLED_NS: u64 = 20_000_000;
/// How near it is at rest, and at any speed at least, rev/s.
const STILL_V: f64 = 0.05;
/// Samples over which a speed is taken.
const WINDOW: usize = 16;

/// The places of its values in the image of all, bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WiredEncoder {
    pub(crate) settings: EncoderSettings,
    /// Which of the devices that are no drives it is.
    pub(crate) nth: usize,
    /// Where the counter is, and how many bits it has.
    pub(crate) counter: (usize, u32),
    pub(crate) index: Option<WiredIndex>,
}

/// The places of what is kept at the index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WiredIndex {
    pub(crate) latch: usize,
    pub(crate) valid: usize,
    /// Among the outputs.
    pub(crate) arm: usize,
}

/// What of the counter is known at the index.
#[derive(Debug, Clone, Copy)]
struct Index {
    /// The counter where the angle is whole.
    origin: i64,
    /// Revolutions from there when the index was seen last.
    seen: f64,
}

/// An encoder at work.
#[derive(Debug)]
pub(super) struct Encoder {
    wired: WiredEncoder,
    /// How much later than they say setpoints are played, by which samples are stamped earlier, ns.
    delay_ns: u64,
    counter: Counter,
    is_armed: bool,
    index: Option<Index>,
    pulses: u64,
    slipped: bool,
    quiet_until_ns: Option<u64>,
    /// The last samples: time, ns, and angle.
    samples: [(u64, f64); WINDOW],
    nth: usize,
    wanted_v: f64,
    near_ns: Option<u64>,
}

impl Encoder {
    pub(super) const fn new(wired: WiredEncoder, delay_ns: u64) -> Self {
        Self {
            wired,
            delay_ns,
            counter: Counter::new(wired.counter),
            is_armed: false,
            index: None,
            pulses: 0,
            slipped: false,
            quiet_until_ns: None,
            samples: [(0, 0.0); WINDOW],
            nth: 0,
            wanted_v: 0.0,
            near_ns: None,
        }
    }

    pub(super) const fn nth(&self) -> usize {
        self.wired.nth
    }

    /// Takes what a frame says that was sent at a time; nothing if its device did not take part.
    pub(super) fn hear(
        &mut self,
        inputs: Option<&[u8]>,
        sent_ns: u64,
        tell: &mut dyn FnMut(Event),
    ) {
        let from = self.counter.count();
        self.counter.hear(inputs, sent_ns);
        let Some(inputs) = inputs else {
            return;
        };
        let to = self.counter.count();
        let pulses = (self.revolutions(to).floor() - self.revolutions(from).floor()).abs();
        if let Some(wired) = self.wired.index {
            self.take_index(wired, inputs, tell);
            self.count_pulses(pulses);
        }
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a few whole revolutions, not negative"
    )]
    fn count_pulses(&mut self, pulses: f64) {
        let revolutions = self.revolutions(self.counter.count());
        if let Some(index) = self.index
            && (revolutions - index.seen).abs() <= MISSING_R
        {
            self.pulses += pulses as u64;
        }
    }

    fn take_index(&mut self, wired: WiredIndex, inputs: &[u8], tell: &mut dyn FnMut(Event)) {
        let is_valid = bit(inputs, wired.valid);
        if !self.is_armed {
            self.is_armed = !is_valid;
            return;
        }
        if !is_valid {
            return;
        }
        self.is_armed = false;
        let kept = number(inputs, wired.latch, self.wired.counter.1);
        let at = self.counter.count_of(kept);
        let origin = self.index.map_or(at, |index| index.origin);
        let seen = self.turns(at - origin);
        let off = self.counts_off(at - origin);
        if off.abs() > SLACK {
            tell(Event::EncoderSlipped(off));
            (self.index, self.slipped) = (None, true);
            return;
        }
        self.index = Some(Index { origin, seen });
    }

    /// How many counts there are beside whole revolutions.
    fn counts_off(&self, counts: i64) -> i64 {
        let of_turn = i64::from(self.wired.settings.counts_per_rev);
        let rest = counts.rem_euclid(of_turn);
        if 2 * rest > of_turn {
            rest - of_turn
        } else {
            rest
        }
    }

    /// Revolutions of so many counts, clockwise.
    #[allow(clippy::cast_precision_loss, reason = "far below 2⁵³")]
    fn turns(&self, counts: i64) -> f64 {
        let sign = if self.wired.settings.is_inverted {
            -1.0
        } else {
            1.0
        };
        sign * counts as f64 / f64::from(self.wired.settings.counts_per_rev)
    }

    fn revolutions(&self, count: i64) -> f64 {
        let origin = self.index.map_or(0, |index| index.origin);
        self.turns(count - origin)
    }

    /// Whether the angle is known: with an index, when that was passed.
    const fn is_known(&self) -> bool {
        let knows = self.wired.index.is_none() || self.index.is_some();
        self.counter.is_known() && knows && self.quiet_until_ns.is_none()
    }

    /// The angle at a time around the last frames, between which it turns evenly.
    fn angle_at(&self, at_ns: u64) -> f64 {
        let (end, begin, younger_r) = self.counter.around(at_ns);
        let (end, begin) = (self.revolutions(end), self.revolutions(begin));
        end - (end - begin) * younger_r
    }

    /// Arms the index.
    pub(super) fn put(&mut self, image: &mut [u8], wanted_v: f64) {
        if wanted_v.to_bits() != self.wanted_v.to_bits() {
            self.near_ns = None;
        }
        self.wanted_v = wanted_v;
        if let Some(wired) = self.wired.index {
            put_bit(image, wired.arm, self.is_armed);
        }
    }

    /// Adds what is known of it. `has_drive` if the spindle's drive says how fast it is.
    pub(super) fn tell(&mut self, feedback: &mut Feedback, has_drive: bool) {
        let now_ns = feedback.sample_ns;
        if core::mem::take(&mut self.slipped) {
            self.quiet_until_ns = Some(now_ns + QUIET_NS);
        }
        self.quiet_until_ns = self.quiet_until_ns.filter(|until| now_ns < *until);
        if self.counter.is_missed() || !self.is_known() {
            self.near_ns = None;
            return;
        }
        let angle = self.angle_at(now_ns + self.delay_ns);
        let old = core::mem::replace(&mut self.samples[self.nth], (now_ns, angle));
        self.nth = (self.nth + 1) % WINDOW;
        let mut set = |flag: SpindleFlags, is: bool| {
            feedback.spindle_flags |= if is { flag.0 } else { 0 };
        };
        set(SpindleFlags::ANGLE, true);
        set(SpindleFlags::INDEX, self.wired.index.is_some());
        feedback.spindle_angle = angle;
        feedback.spindle_index_count = self.pulses;
        if has_drive || old.0 == 0 || now_ns <= old.0 {
            return;
        }
        #[allow(clippy::cast_precision_loss, reason = "some periods")]
        let speed_v = (angle - old.1) / ((now_ns - old.0) as f64 * 1e-9);
        let near_v = (self.wired.settings.near_r * self.wanted_v.abs()).max(STILL_V);
        if (speed_v - self.wanted_v).abs() > near_v {
            self.near_ns = None;
        } else {
            self.near_ns = self.near_ns.or(Some(now_ns));
        }
        let is_settled = self
            .near_ns
            .is_some_and(|since| now_ns >= since + SETTLED_NS);
        let stands = self.wanted_v.abs() <= 0.0;
        feedback.spindle_v = speed_v;
        set(SpindleFlags::SPEED, true);
        set(SpindleFlags::AT_SPEED, is_settled && !stands);
        set(SpindleFlags::STOPPED, is_settled && stands);
    }
}

#[cfg(test)]
mod tests;
