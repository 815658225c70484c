//! The rate a program asks for, before and after the operator's override.

use crate::feed_axes::counted_axes;
use glidepath_geometry::{AXES, AxisVector, Segment, limit_along};
use glidepath_program::{Limits, Override, Rate};

/// The rate of a segment before any override.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ProgrammedRate {
    pub rate: Rate,
    /// The speed at which some axis reaches its velocity limit, mm/s: what a rapid is driven at. On a piece of a curve
    /// in a tube less, where chords bound it.
    pub axes_v: f64,
}

impl ProgrammedRate {
    /// The speeds of a piece under an override.
    pub(crate) fn of_piece(&self, wanted: Override) -> PieceRate {
        let rate_v = self.under(wanted);
        let top_v = rate_v.min(self.axes_v);
        PieceRate {
            top_v,
            feed_v: if self.rate.is_rapid() { top_v } else { rate_v },
        }
    }

    /// The rate under an override, mm/s.
    pub(crate) fn under(&self, wanted: Override) -> f64 {
        let programmed_v = match self.rate.feed_v() {
            // Its pitch does not depend on the operator.
            Some(feed_v) if self.rate.is_synchronised() => feed_v,
            Some(feed_v) => feed_v * wanted.feed_r,
            None => self.axes_v * wanted.rapid_r,
        };
        programmed_v.min(self.rate.most_v())
    }
}

/// Speeds of a piece under an override, mm/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PieceRate {
    /// Along it: as fast as feed and axes allow.
    pub(crate) top_v: f64,
    /// By its feed alone; of a rapid the same.
    pub(crate) feed_v: f64,
}

impl PieceRate {
    /// Where the feed is slower than the axes.
    #[cfg(test)]
    pub(crate) const fn by_feed(feed_v: f64) -> Self {
        Self {
            top_v: feed_v,
            feed_v,
        }
    }

    /// How fast the axes that the feed counts may go along a displacement. Rotary axes that hold it up are bounded by
    /// themselves: what the others do beside, within the tolerance, is held up by nothing but the feed.
    pub(crate) fn counted_v(&self, displacement: &AxisVector) -> f64 {
        let counted = counted_axes(displacement);
        let is_all_counted = (0..AXES).all(|i| counted.contains(&i) || displacement[i] == 0.0);
        if is_all_counted {
            self.top_v
        } else {
            self.feed_v
        }
    }

    /// True if both are the same, to the bit.
    pub(crate) const fn is(&self, other: &Self) -> bool {
        self.top_v.to_bits() == other.top_v.to_bits()
            && self.feed_v.to_bits() == other.feed_v.to_bits()
    }
}

/// The speed at which some axis reaches its velocity limit at the start of a segment, mm/s.
pub(crate) fn axes_speed(segment: &Segment, limits: &Limits) -> f64 {
    axes_speed_along(&segment.jet(0.0).d1, limits)
}

/// The same in a direction: `d1` is the change of every axis for each millimetre of path.
pub(crate) fn axes_speed_along(d1: &AxisVector, limits: &Limits) -> f64 {
    f64::INFINITY.min(limit_along(d1, &limits.velocity))
}
