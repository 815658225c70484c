//! A counter in the process data: its count without wraps, and where it was between two frames.

use super::bits::number;

/// Frames that are kept. The moment that is asked for is up to a period before the last one was sent; where the one
/// before was sent late, it is before that, too.
const FRAMES: usize = 4;

/// A counter at work.
#[derive(Debug)]
pub(super) struct Counter {
    /// Where it is in the image of all, and how many bits it has.
    place: (usize, u32),
    raw: Option<u32>,
    /// Without wraps.
    count: i64,
    /// When the last frames were sent, ns, and the count in them; the last one first.
    frames: [(u64, i64); FRAMES],
    /// This frame was without it.
    is_missed: bool,
}

impl Counter {
    pub(super) const fn new(place: (usize, u32)) -> Self {
        Self {
            place,
            raw: None,
            count: 0,
            frames: [(0, 0); FRAMES],
            is_missed: true,
        }
    }

    /// Takes what a frame says that was sent at a time; nothing if its device did not take part. The first count is
    /// zero.
    pub(super) fn hear(&mut self, inputs: Option<&[u8]>, sent_ns: u64) {
        self.is_missed = inputs.is_none();
        let Some(inputs) = inputs else {
            return;
        };
        let raw = number(inputs, self.place.0, self.place.1);
        let is_first = self.raw.is_none();
        self.count += self.apart(raw, self.raw.unwrap_or(raw));
        self.raw = Some(raw);
        if is_first {
            self.frames = [(sent_ns, self.count); FRAMES];
        }
        self.frames.rotate_right(1);
        self.frames[0] = (sent_ns, self.count);
    }

    /// Whether it was ever heard.
    pub(super) const fn is_known(&self) -> bool {
        self.raw.is_some()
    }

    /// Whether the last frame was without it.
    pub(super) const fn is_missed(&self) -> bool {
        self.is_missed
    }

    /// What it has counted since it was heard first.
    pub(super) const fn count(&self) -> i64 {
        self.count
    }

    /// What it had counted when it was at a number, the nearest one to now.
    pub(super) fn count_of(&self, raw: u32) -> i64 {
        self.count - self.apart(self.raw.unwrap_or(raw), raw)
    }

    /// What it had counted when it was at zero, if its number has a sign or none.
    pub(super) fn zero(&self, has_sign: bool) -> i64 {
        let raw = self.raw.unwrap_or(0);
        let from_zero = if has_sign {
            self.apart(raw, 0)
        } else {
            raw.into()
        };
        self.count - from_zero
    }

    /// How far a number is from another, over its end if that is nearer.
    #[allow(
        clippy::cast_possible_wrap,
        reason = "the bits of a number with a sign"
    )]
    fn apart(&self, raw: u32, from: u32) -> i64 {
        let unused = 32 - self.place.1.clamp(1, 32);
        ((raw.wrapping_sub(from) << unused) as i32 >> unused).into()
    }

    /// The counts of the frames after and before a time, and how far before the later one that is, as a part of the
    /// time between them: 1 at most.
    #[allow(clippy::cast_precision_loss, reason = "some periods")]
    pub(super) fn around(&self, at_ns: u64) -> (i64, i64, f64) {
        let sent_before = |(sent_ns, _): &(u64, i64)| *sent_ns <= at_ns;
        let older = self.frames[1..].iter().position(sent_before);
        let nth = older.unwrap_or(FRAMES - 2);
        let ((end_ns, end), (begin_ns, begin)) = (self.frames[nth], self.frames[nth + 1]);
        let younger_ns = end_ns.saturating_sub(at_ns) as f64;
        let span_ns = end_ns.saturating_sub(begin_ns).max(1) as f64;
        (end, begin, (younger_ns / span_ns).min(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A frame with a counter of 16 bits in its second and third byte.
    fn hear(counter: &mut Counter, raw: u16, sent_ns: u64) {
        let [low, high] = raw.to_le_bytes();
        counter.hear(Some(&[9, low, high]), sent_ns);
    }

    #[test]
    fn a_counter_goes_on_over_its_end_either_way() {
        let mut counter = Counter::new((8, 16));
        assert!(!counter.is_known() && counter.is_missed());
        hear(&mut counter, 0xfff0, 1000);
        assert_eq!((counter.count(), counter.zero(true)), (0, 16));
        assert_eq!(counter.zero(false), -0xfff0);
        hear(&mut counter, 0x10, 2000);
        assert_eq!((counter.count(), counter.zero(true)), (32, 16));
        assert_eq!(counter.count_of(0xfff8), 8);
        hear(&mut counter, 0xffe0, 3000);
        assert_eq!(counter.count(), -16);
        counter.hear(None, 4000);
        assert!(counter.is_known() && counter.is_missed());
    }

    #[test]
    fn between_two_frames_it_is_between_their_counts() {
        let mut counter = Counter::new((8, 16));
        hear(&mut counter, 100, 1000);
        // Of the first frame alone nothing is known but that.
        assert_eq!(counter.around(500).0, counter.around(500).1);
        hear(&mut counter, 200, 2000);
        hear(&mut counter, 500, 3000);
        assert_eq!(counter.around(2750), (400, 100, 0.25));
        assert_eq!(counter.around(1500), (100, 0, 0.5));
        assert_eq!(counter.around(u64::MAX), (400, 100, 0.0));
    }
}
