//! Places on the scaled path, directions there, and how they change from piece to piece.

use super::{SLOWER, ScaledPath};
use crate::in_tube::path::SHARP;
use crate::in_tube::window::solver::dot;

impl<const D: usize> ScaledPath<D> {
    /// The end of piece `i`.
    pub(crate) fn vertex(&self, i: usize) -> [f64; D] {
        let segment = &self.segments[i];
        core::array::from_fn(|k| segment.start[k] + segment.length * segment.tangent[k])
    }

    /// True if the path goes on from piece `i` without a corner, but slower. The motion has to be
    /// slow by the end of the piece, neither before nor after: a sample that changed sides there from
    /// one window to the next would ask for what the motion it belongs to cannot do.
    pub(crate) fn slows_after(&self, i: usize) -> bool {
        let next = self.segments.get(i + 1);
        next.is_some_and(|next| next.top < SLOWER * self.segments[i].top)
            && self.turn(i, i + 1) <= SHARP
    }

    /// True if some axis is to move slower after piece `i`, by the programmed feed.
    pub(crate) fn feed_falls_after(&self, i: usize) -> bool {
        let Some(next) = self.segments.get(i + 1) else {
            return false;
        };
        let mut axes = self.segments[i].feed_axes.iter().zip(&next.feed_axes);
        axes.any(|(now, then)| *now < SLOWER * then)
    }

    /// How much the direction changes between two pieces: 2·sin(turn/2).
    pub(crate) fn turn(&self, i: usize, j: usize) -> f64 {
        let (a, b) = (&self.segments[i].tangent, &self.segments[j].tangent);
        let difference: [f64; D] = core::array::from_fn(|k| a[k] - b[k]);
        dot(&difference, &difference).sqrt()
    }

    /// How the direction of the program jumps from piece `i` to the next. Pieces that stand for a curve
    /// are chords of it: the turn between two of them is none of the curve.
    pub(crate) fn corner(&self, i: usize) -> [f64; D] {
        let [leaving, entering] = self.headings(i);
        core::array::from_fn(|k| entering[k] - leaving[k])
    }

    /// The direction of the program at the end of piece `i`, and at the start of the next.
    pub(crate) fn headings(&self, i: usize) -> [[f64; D]; 2] {
        [self.heading_at(i, 1.0), self.heading_at(i + 1, 0.0)]
    }

    /// The direction of what piece `i` stands for at a progress on it.
    pub(crate) fn heading(&self, i: usize, progress: f64) -> [f64; D] {
        self.heading_at(i, self.share_of(i, progress))
    }

    /// The same as a unit vector. A straight piece has its own to the bit.
    pub(crate) fn unit_heading(&self, i: usize, progress: f64) -> [f64; D] {
        let segment = &self.segments[i];
        if dot(&segment.sagitta_vector, &segment.sagitta_vector) <= 0.0 {
            return segment.tangent;
        }
        let heading = self.heading(i, progress);
        let length = dot(&heading, &heading).sqrt();
        heading.map(|part| part / length)
    }

    fn heading_at(&self, i: usize, u: f64) -> [f64; D] {
        let segment = &self.segments[i];
        let slope = 4.0 * (1.0 - 2.0 * u);
        core::array::from_fn(|k| {
            segment.tangent[k] + slope * segment.sagitta_vector[k] / segment.length
        })
    }

    /// Where the program is near the place of some progress on piece `i`.
    pub(crate) fn center(&self, i: usize, progress: f64) -> [f64; D] {
        self.center_at(i, self.share_of(i, progress).clamp(0.0, 1.0))
    }

    /// The same beyond the ends of the piece, too, where its parabola goes on.
    pub(crate) fn center_beyond(&self, i: usize, progress: f64) -> [f64; D] {
        self.center_at(i, self.share_of(i, progress))
    }

    /// The point of what a piece stands for at a progress.
    pub(crate) fn position(&self, i: usize, progress: f64) -> [f64; D] {
        let segment = &self.segments[i];
        let (center, along) = (self.center_beyond(i, progress), progress - segment.s);
        core::array::from_fn(|k| center[k] + along * segment.tangent[k])
    }

    /// How far along a piece a progress is, 0 to 1.
    fn share_of(&self, i: usize, progress: f64) -> f64 {
        let segment = &self.segments[i];
        (progress - segment.s) / segment.length
    }

    fn center_at(&self, i: usize, u: f64) -> [f64; D] {
        let segment = &self.segments[i];
        let height = 4.0 * u * (1.0 - u);
        core::array::from_fn(|k| segment.start[k] + height * segment.sagitta_vector[k])
    }
}
