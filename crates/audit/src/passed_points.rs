//! The distance of the motion from the points of the program that it passes.
//!
//! ```text
//!            V ─ ─ ─ ─ ─ ─ ─ ─ ─      A motion that rounds a corner on its inner side is nowhere as far from the
//!            │ ╲                      program as the corner V is from the motion: 1.4 times as far, at 90°.
//!            │   ╭─────────────
//!            │ ╱                      So the deviation, which is both ways, is more than how far frames are off.
//! ```
//!
//! A point of the program is passed when the place of the motion on the program goes by it. It is then as far from the
//! motion as from the nearest chord: of the last ones before, for where a corner is cut its place may stay behind, and of
//! all those up to where the motion cannot be on what is before the point any more, for where the path comes back on
//! itself its place may be ahead.

use crate::follow::{ProgramPlace, ProgramPoint};
use crate::free_space::Chord;
use glidepath_geometry::AxisVector;
use std::collections::VecDeque;

/// The last chords of the motion that are kept.
const CHORDS: usize = 16;

/// The points that the motion is at, one sample after the other.
#[derive(Debug, Default)]
pub(crate) struct PassedPoints {
    last: Option<AxisVector>,
    /// The last chords of the motion, the newest first.
    chords: VecDeque<Chord>,
    open: Vec<Open>,
}

/// A point, and how far from it the nearest chord was so far.
#[derive(Debug)]
struct Open {
    point: ProgramPoint,
    least_mm: f64,
}

impl PassedPoints {
    /// The next sample, the points of the program that are passed on the way to it, and the earliest place at which it
    /// may be. Returns how far the motion stayed from the points that it has left behind, mm.
    pub(crate) fn next(
        &mut self,
        position: &AxisVector,
        passed: &[ProgramPoint],
        earliest: ProgramPlace,
    ) -> f64 {
        let chord = Chord::new(self.last.unwrap_or(*position), *position);
        for open in &mut self.open {
            let distance_mm = chord.distance_mm(&open.point.position, 1.0);
            open.least_mm = open.least_mm.min(distance_mm);
        }
        if chord.displacement() != AxisVector::zeros() {
            self.chords.push_front(chord);
            self.chords.truncate(CHORDS);
        }
        for point in passed {
            let last = self.chords.iter();
            let distances_mm = last.map(|chord| chord.distance_mm(&point.position, 1.0));
            let least_mm = distances_mm.fold(chord.distance_mm(&point.position, 1.0), f64::min);
            self.open.push(Open {
                point: *point,
                least_mm,
            });
        }
        self.last = Some(*position);
        let mut left_mm = 0.0_f64;
        self.open.retain(|open| {
            let is_left = open.point.place < earliest;
            if is_left {
                left_mm = left_mm.max(open.least_mm);
            }
            !is_left
        });
        left_mm
    }

    /// The motion rests at its end: how far it stayed from what is still open, mm.
    pub(crate) fn rest(&mut self) -> f64 {
        let open = self.open.drain(..);
        open.fold(0.0, |most, open| open.least_mm.max(most))
    }

    /// The motion goes through a position that is not judged.
    pub(crate) fn pass(&mut self, position: &AxisVector) {
        self.last = Some(*position);
        self.chords.clear();
    }
}
