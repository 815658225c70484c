//! Modal state: what stays in force from block to block.

use glidepath_geometry::{AxisVector, LINEAR_XYZ, Plane, UVW};
use glidepath_program::PathMode;
use serde::{Deserialize, Serialize};

use crate::syntax::modes::{Distance, FeedMode, Motion, Retract, Units};

/// A feedrate of G94, or a feed per revolution of G95.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Feed {
    /// For moves of linear axes, mm/s or mm per revolution, > 0.
    pub linear_v: f64,
    /// For moves of rotary axes alone, °/s or ° per revolution, > 0. The same F word, which inches
    /// do not scale.
    pub rotary_v: f64,
}

impl Feed {
    /// So many times the feed.
    pub(crate) fn times(self, by: f64) -> Self {
        Self {
            linear_v: self.linear_v * by,
            rotary_v: self.rotary_v * by,
        }
    }

    /// The feed of a straight move.
    pub(crate) fn of_line(self, start: &AxisVector, end: &AxisVector) -> f64 {
        if LINEAR_XYZ
            .chain(UVW)
            .any(|axis| end[axis] - start[axis] != 0.0)
        {
            self.linear_v
        } else {
            self.rotary_v
        }
    }
}

/// The modal state between two blocks.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Modal {
    /// Motion mode; `None` before the first one and after G80.
    pub motion: Option<Motion>,
    /// Plane of arcs.
    pub plane: Plane,
    /// Meaning of axis words.
    pub distance: Distance,
    /// Meaning of I, J, K.
    pub arc_distance: Distance,
    /// Meaning of F.
    pub feed_mode: FeedMode,
    /// Feedrate of G94 or G95; `None` until one is given. G93 takes its F from every block.
    pub feed: Option<Feed>,
    /// Length units.
    pub units: Units,
    /// Path mode.
    pub path_mode: PathMode,
    /// Where canned cycles retract to.
    pub retract: Retract,
    /// True in G7: X words are diameters.
    pub diameter: bool,
}

impl Modal {
    /// The state at the start of a program: G8 G17 G21 G54 G64 G80 G90 G91.1 G94 G98.
    #[must_use]
    pub fn new(default_feed_mm_min: Option<f64>) -> Self {
        Self {
            motion: None,
            plane: Plane::Xy,
            distance: Distance::Absolute,
            arc_distance: Distance::Incremental,
            feed_mode: FeedMode::PerMinute,
            feed: default_feed_mm_min.map(|feed| Feed {
                linear_v: feed / 60.0,
                rotary_v: feed / 60.0,
            }),
            units: Units::Millimetre,
            path_mode: PathMode::Continuous { tolerance_mm: None },
            retract: Retract::Initial,
            diameter: false,
        }
    }
}
