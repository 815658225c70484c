//! The pace of a block, and the speed of a move whose segment is not known yet.

use glidepath_geometry::Segment;
use glidepath_program::Rate;

/// At which speed a block moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Pace {
    Rapid,
    Feed,
}

/// Speed of a move whose segment is not known yet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Speed {
    Rapid,
    /// mm/s or °/s.
    Feed(f64),
    /// mm/s or °/s at the speed that the spindle was told: a feed per revolution of a spindle whose
    /// speed is measured.
    PerRevolution(f64),
    /// G93: moves of this length per minute.
    Moves(f64),
}

impl Speed {
    /// A share of a feed; what takes a time stays.
    pub(crate) fn times(self, share: f64) -> Self {
        match self {
            Self::Feed(feed_v) => Self::Feed(feed_v * share),
            Self::PerRevolution(feed_v) => Self::PerRevolution(feed_v * share),
            Self::Rapid | Self::Moves(_) => self,
        }
    }

    pub(crate) fn rate(self, segment: &Segment) -> Rate {
        match self {
            Self::Rapid => Rate::Rapid,
            Self::Feed(feed_v) => Rate::Feed(feed_v),
            Self::PerRevolution(feed_v) => Rate::PerRevolution {
                feed_v,
                most_v: f64::INFINITY,
            },
            Self::Moves(per_minute) => Rate::Feed(segment.length() * per_minute / 60.0),
        }
    }
}
