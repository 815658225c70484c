//! The histogram of how late ticks began, as far as this process saw them.

use serde_json::{Value, json};

/// The first bin ends here, µs.
const FROM_US: f64 = 1.0;
/// Bins of a factor of ten.
const PER_DECADE: f64 = 8.0;
/// From 1 µs to 100 ms.
const BINS: usize = 40;

/// Counts by logarithmic bins.
#[derive(Debug)]
pub(super) struct Histogram([u64; BINS]);

impl Default for Histogram {
    fn default() -> Self {
        Self([0; BINS])
    }
}

impl Histogram {
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "bins for people, clamped"
    )]
    pub(super) fn push(&mut self, lateness_ns: u64) {
        let decades = (lateness_ns as f64 * 1e-3 / FROM_US).max(1.0).log10();
        let bin = (decades * PER_DECADE) as usize;
        if let Some(count) = self.0.get_mut(bin.min(BINS - 1)) {
            *count += 1;
        }
    }

    pub(super) fn object(&self) -> Value {
        json!({ "from_us": FROM_US, "per_decade": PER_DECADE, "counts": self.0.to_vec() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_counted_where_they_belong() {
        let mut histogram = Histogram::default();
        for lateness_ns in [0, 50, 1000, 4_000_000, u64::MAX] {
            histogram.push(lateness_ns);
        }
        let counts = histogram.0;
        // 4 ms are 4000 times the beginning.
        assert_eq!((counts[0], counts[28], counts[BINS - 1]), (3, 1, 1));
        assert_eq!(counts.iter().sum::<u64>(), 5);
    }
}
