//! The trace of the programmed path, as far as it can be seen beside the motion.

use super::track::{MotionTrace, TrackPoint};
use crate::chords::chords;
use glidepath_geometry::AxisVector;
use glidepath_program::Item;

/// The path of feed moves, in bounded memory.
#[derive(Debug, Default)]
pub(super) struct ProgramTrace(MotionTrace);

impl ProgramTrace {
    /// The next item of the program.
    pub(super) fn push(&mut self, item: &Item) {
        let is_first = self.0.points().is_empty();
        chords(item, is_first, |position, rapid| {
            self.point(position, rapid);
        });
    }

    fn point(&mut self, position: &AxisVector, rapid: bool) {
        self.0.push(TrackPoint {
            at: [position[0], position[1], position[2]],
            feed_v: 0.0,
            rapid,
            bound: None,
        });
    }

    /// The same path in coordinates with another zero.
    pub(super) fn seen_from(&self, zero: [f64; 3]) -> Self {
        Self(self.0.seen_from(zero))
    }

    /// Its points.
    pub(super) fn points(&self) -> &[TrackPoint] {
        self.0.points()
    }
}
