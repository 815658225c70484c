//! The compressor: runs of dense chords become smooth curves inside the tolerance.
//!
//! Programs made by CAM approximate curves by many more chords than they need, with coordinates
//! rounded to a few digits. Driven corner by corner, a curve of chords of length h is the slower
//! the smaller h is, because a corner's transition can be no longer than its chords: ten times the
//! time of the curve itself is usual. Here the chords are replaced, while they stream in, by a
//! cubic spline with continuous second derivative:
//!
//! 1. nearly collinear chords are merged within a twentieth of the tolerance (`thinning`);
//! 2. vertices that turn too much for a smooth curve are kept as corners, long chords keep a line
//!    in their middle (`sample_layout`), and the rest is sampled;
//! 3. the spline of least jerk that stays in the tube around the chords is fitted in a window of
//!    samples (`window`, `fit`), one half of which is put out each time;
//! 4. nothing is put out without a proof that it is in the tube, both ways and in order
//!    (`certificate`).
//!
//! Feeds and events that change within a run stay attached to their block, by its foot on the curve
//! (`marks`). Memory and look-ahead are bounded in samples and in blocks.
//!
//! Smoothing takes no more of the tolerance than leaves room for the chord error of one period.

mod banded;
mod certificate;
mod compressor;
mod driver;
mod fit;
mod held_radius;
mod knots;
mod marks;
mod output;
mod resort;
mod sample;
mod sample_layout;
mod shares;
mod still;
#[cfg(test)]
mod tests;
mod thinning;
mod vector;
mod window;

pub(crate) use compressor::Compressor;
pub(crate) use marks::{Change, Cut};
pub(crate) use output::{PartShape, SplinePart};
