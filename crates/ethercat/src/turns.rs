//! A counter that goes round and begins anew, and the way that was counted by it.
//!
//! ```text
//! counter   … 1798 1799 0 1 2 …      (from 0, 1800 of them)
//! counts    … 1798 1799 1800 1801 …
//! ```
//!
//! Of all counts that the counter could mean, the nearest to those before is meant: nobody goes half a round in a
//! period.

/// The range of a counter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Round {
    /// Its lowest value.
    from: i32,
    /// How many values it has, 2 to 2³².
    count: i64,
}

/// Values of a counter of 32 bits.
const ALL: i64 = 1 << 32;

impl Round {
    /// The range of a drive by 0x607B: from its lowest to its highest position, or 32 bits where it tells none.
    pub(crate) const fn of(lowest: i32, highest: i32) -> Self {
        let count = highest as i64 - lowest as i64 + 1;
        if count < 2 {
            return Self {
                from: i32::MIN,
                count: ALL,
            };
        }
        Self {
            from: lowest,
            count,
        }
    }

    /// Whether it goes round at 32 bits alone.
    pub(crate) const fn is_whole(self) -> bool {
        self.count == ALL
    }

    /// What the counter shows at so many counts.
    #[allow(clippy::cast_possible_truncation, reason = "it is in the range")]
    pub(crate) const fn shown(self, counts: i64) -> i32 {
        let from = self.from as i64;
        (from + (counts - from).rem_euclid(self.count)) as i32
    }

    /// The counts nearest to `near` at which the counter shows that.
    pub(crate) const fn counts(self, shown: i32, near: i64) -> i64 {
        let half = self.count / 2;
        let off = (shown as i64 - near + half).rem_euclid(self.count) - half;
        near + off
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A way through a counter and back.
    fn goes(round: Round, steps: &[i64]) {
        let (mut counts, mut seen) = (round.from.into(), i64::from(round.from));
        for step in steps {
            counts += step;
            let shown = round.shown(counts);
            let least = i64::from(round.from);
            assert!((least..least + round.count).contains(&i64::from(shown)));
            seen = round.counts(shown, seen);
            assert_eq!(seen, counts);
        }
    }

    #[test]
    fn a_way_of_many_rounds_is_counted_there_and_back() {
        for round in [
            Round::of(0, 1799),
            Round::of(-900, 899),
            Round::of(-1_000_000, 1_999_999),
            Round::of(0, i32::MAX),
            Round::of(0, 0),
            Round::of(i32::MIN, i32::MAX),
        ] {
            let step = round.count * 2 / 5;
            let there: Vec<i64> = core::iter::repeat_n(step, 50).collect();
            goes(round, &there);
            let back: Vec<i64> = there.iter().map(|step| -step).collect();
            goes(round, &back);
            goes(round, &[1, -1, -1, -1, step, -step, 0]);
        }
    }

    #[test]
    fn a_drive_that_tells_no_range_has_all_bits() {
        assert_eq!(Round::of(0, 0), Round::of(i32::MIN, i32::MAX));
        let round = Round::of(0, 0);
        assert_eq!(round.shown(i64::from(i32::MAX) + 1), i32::MIN);
        assert_eq!(round.counts(i32::MIN, i32::MAX.into()), 1 << 31);
    }
}
