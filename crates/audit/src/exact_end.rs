//! A place that the motion must pass exactly.

use glidepath_geometry::{AxisVector, ROTARY_ABC, Segment, feed_length};
use glidepath_program::tolerance_norm;

/// A place the motion must pass exactly. Where it passes without a rest (G61), a chord between two
/// samples on the path cuts it off by what follows from the turn and the curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ExactEnd {
    /// Sine of half the turn.
    sb: f64,
    /// Largest curvature on either side, 1/mm.
    max_k: f64,
    /// Half of what the rotary axes change their rates by, degrees a unit of the path.
    rotary_sb: f64,
    /// Most that they bend on either side, degrees a unit squared.
    rotary_k: f64,
}

impl ExactEnd {
    /// At rest.
    pub(crate) const STOP: Self = Self {
        sb: 0.0,
        max_k: 0.0,
        rotary_sb: 0.0,
        rotary_k: 0.0,
    };

    pub(crate) fn passing(from: &Segment, to: &Segment) -> Self {
        let (before, after) = (from.jet(from.length()), to.jet(0.0));
        let rotary = |rates: &AxisVector| {
            let squares = ROTARY_ABC.map(|i| rates[i] * rates[i]);
            squares.sum::<f64>().sqrt()
        };
        Self {
            sb: 0.5 * feed_length(&(after.d1 - before.d1)),
            max_k: before.d2.norm().max(after.d2.norm()),
            rotary_sb: 0.5 * rotary(&(after.d1 - before.d1)),
            rotary_k: rotary(&before.d2).max(rotary(&after.d2)),
        }
    }

    /// What a chord may cut off, mm.
    pub(crate) fn cut_mm(&self, chord: &AxisVector) -> f64 {
        cut(tolerance_norm(chord, 1.0), self.sb, self.max_k)
    }

    /// What it may cut off of the rotary axes, degrees.
    pub(crate) fn cut_deg(&self, chord: &AxisVector) -> f64 {
        cut(tolerance_norm(chord, 1.0), self.rotary_sb, self.rotary_k)
    }
}

fn cut(length: f64, sb: f64, max_k: f64) -> f64 {
    0.5 * length * sb + length * length * max_k / 8.0
}
