//! The histogram of a time, in fixed memory.

use hdrhistogram::Histogram as Hdr;

/// Largest time that is resolved: 10 s. Longer ones are counted there.
const LARGEST_NS: u64 = 10_000_000_000;
/// Relative resolution: two digits, 1 %.
const DIGITS: u8 = 2;

/// Histogram of times from 0 to 10 s with a resolution of 1 %. [`record`](Self::record) does not
/// allocate.
#[derive(Debug, Clone)]
pub struct Histogram {
    hdr: Hdr<u64>,
    max_ns: u64,
}

/// The quantiles of a histogram that are reported, ns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Quantiles {
    /// Number of values.
    pub count: u64,
    /// Median.
    pub p50_ns: u64,
    /// 99 % were this or less.
    pub p99_ns: u64,
    /// 99.9 % were this or less.
    pub p999_ns: u64,
    /// Largest, exact.
    pub max_ns: u64,
}

impl Histogram {
    /// An empty histogram. Allocates once; nothing else does.
    #[must_use]
    #[allow(
        clippy::expect_used,
        clippy::missing_panics_doc,
        reason = "the bounds are constants that are in range"
    )]
    pub fn new() -> Self {
        #[expect(
            clippy::expect_used,
            reason = "the bounds are constants that are in range"
        )]
        let hdr = Hdr::new_with_bounds(1, LARGEST_NS, DIGITS).expect("bounds in range");
        Self { hdr, max_ns: 0 }
    }

    /// Counts a value.
    pub fn record(&mut self, value_ns: u64) {
        self.max_ns = self.max_ns.max(value_ns);
        self.hdr.saturating_record(value_ns);
    }

    /// Counts everything that another histogram holds.
    pub fn merge(&mut self, other: &Self) {
        self.max_ns = self.max_ns.max(other.max_ns);
        // Fails only where the ranges differ, which are the same for all.
        let _ = self.hdr.add(&other.hdr);
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.max_ns = 0;
        self.hdr.reset();
    }

    /// The smallest value, to the resolution; 0 of an empty histogram.
    #[must_use]
    pub fn min_ns(&self) -> u64 {
        self.hdr.min()
    }

    /// Counts of every bucket that holds something: upper end of the bucket in ns, number.
    pub fn buckets(&self) -> impl Iterator<Item = (u64, u64)> + '_ {
        self.hdr
            .iter_recorded()
            .map(|v| (v.value_iterated_to(), v.count_at_value()))
    }

    /// The usual quantiles; all 0 of an empty histogram.
    #[must_use]
    pub fn quantiles(&self) -> Quantiles {
        // A bucket reports its upper end, which may lie above the largest value recorded.
        let at = |q| self.hdr.value_at_quantile(q).min(self.max_ns);
        Quantiles {
            count: self.hdr.len(),
            p50_ns: at(0.5),
            p99_ns: at(0.99),
            p999_ns: at(0.999),
            max_ns: self.max_ns,
        }
    }
}

impl Default for Histogram {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_sorted_values() {
        let mut histogram = Histogram::new();
        for value in (1..=1_000).rev() {
            histogram.record(value * 1_000);
        }
        let q = histogram.quantiles();
        assert_eq!((q.count, q.max_ns), (1_000, 1_000_000));
        for (got, want) in [
            (q.p50_ns, 500_000),
            (q.p99_ns, 990_000),
            (q.p999_ns, 999_000),
        ] {
            assert!(got >= want && got - want <= want / 50, "{got} for {want}");
        }
        assert_eq!(histogram.buckets().map(|(_, n)| n).sum::<u64>(), 1_000);
    }

    #[test]
    fn merging_is_counting_both() {
        let (mut a, mut b) = (Histogram::new(), Histogram::new());
        a.record(100);
        b.record(7_000);
        a.merge(&b);
        b.clear();
        assert_eq!((a.quantiles().count, a.quantiles().max_ns), (2, 7_000));
        assert_eq!((a.min_ns(), b.quantiles()), (100, Quantiles::default()));
    }

    #[test]
    fn too_long_a_time_is_counted_at_the_end() {
        let mut histogram = Histogram::new();
        histogram.record(u64::MAX);
        assert_eq!(histogram.quantiles().max_ns, u64::MAX);
        assert_eq!(histogram.quantiles().count, 1);
        assert_eq!(Histogram::new().quantiles(), Quantiles::default());
    }
}
