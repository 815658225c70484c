//! The places at which an edge can have been: between the samples around it.
//!
//! ```text
//!     sample      sample      frame with the edge         sample
//!  ─────┼───────────┼──────────────┼─────────────────────────┼─────
//!       └ the last one that is older than the edge           └ the first that is younger
//! ```
//!
//! An input of a terminal shows an edge late by its filter, and is up to a period younger than the positions
//! beside it. So the edge is younger than the sample that is the filter's time and a period before the one
//! beside it, and older than the next one. When in its period a drive measures, and when it takes its
//! position for the probe, may differ by a part of the period: that is the way of a period. A joint that
//! stands swings when something touches.

/// The filter of a terminal's input, ns: 3 ms as a rule.
const FILTER_NS: u64 = 4_000_000;
/// How far a joint swings that stands, mm or degrees.
const SWINGS: f64 = 0.01;

/// Samples before the one beside the edge that are older than it, at most so many.
pub(super) fn samples_before(period_ns: u64, most: usize) -> usize {
    let filter = FILTER_NS.div_ceil(period_ns.max(1));
    usize::try_from(filter + 1).unwrap_or(most).min(most)
}

/// The places of a joint around an edge, mm or degrees.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Span {
    low: f64,
    high: f64,
    last: f64,
    /// The longest way between two samples.
    way: f64,
}

impl Span {
    /// From a first sample on.
    pub(super) const fn new(place: f64) -> Self {
        Self {
            low: place,
            high: place,
            last: place,
            way: 0.0,
        }
    }

    /// The next sample.
    pub(super) const fn add(&mut self, place: f64) {
        self.low = self.low.min(place);
        self.high = self.high.max(place);
        self.way = self.way.max((place - self.last).abs());
        self.last = place;
    }

    /// Where the joint can have been: from, to.
    pub(super) const fn ends(&self) -> (f64, f64) {
        let margin = self.way + SWINGS;
        (self.low - margin, self.high + margin)
    }

    pub(super) fn contains(&self, place: f64) -> bool {
        let (low, high) = self.ends();
        (low..=high).contains(&place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_is_between_the_samples_around_it_and_a_period_more() {
        assert_eq!(samples_before(4_000_000, 15), 2);
        assert_eq!(samples_before(1_000_000, 15), 5);
        assert_eq!(samples_before(250_000, 15), 15);
        let mut span = Span::new(1.0);
        for place in [0.9, 0.82, 0.8] {
            span.add(place);
        }
        // 0.1 mm is the longest way of a period.
        for (place, is_inside) in [(1.12, false), (1.1, true), (0.7, true), (0.68, false)] {
            assert_eq!(span.contains(place), is_inside, "{place}");
        }
        assert!(!Span::new(5.0).contains(5.02) && Span::new(5.0).contains(4.995));
    }
}
