//! The compressor: runs of dense chords become smooth curves inside the tolerance.
//!
//! Programs made by CAM approximate curves by many more chords than they need, with coordinates
//! rounded to a few digits. Driven corner by corner, a curve of chords of length h is the slower the
//! smaller h is, because a corner's transition can be no longer than its chords: ten times the time
//! of the curve itself is usual. Here the chords are replaced, while they stream in, by a cubic
//! spline with continuous second derivative:
//!
//! 1. nearly collinear chords are merged within a twentieth of the tolerance (`thinning`);
//! 2. vertices that turn too much for a smooth curve are kept as corners, long chords keep a line in
//!    their middle (`chords`), and the rest is sampled;
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
mod chords;
mod fit;
mod knots;
mod marks;
mod output;
mod resort;
#[cfg(test)]
mod tests;
mod thinning;
mod vector;
mod window;

pub(crate) use marks::{Change, Cut};
pub(crate) use output::{Part, PartShape};

use chords::Chords;
use core::ops::Range;
use glidepath_geometry::{AXES, AxisVector, LINEAR_XYZ, ROTARY_ABC, UVW};
use glidepath_program::Settings;
use output::Output;
use thinning::{Thinning, Vertex};

/// Share of the tolerance that merging may use.
const MERGE_SHARE_R: f64 = 0.05;
/// Most of the tolerance that is left for the chord error of one period.
const CHORD_SHARE_R: f64 = 0.25;
/// Share of what is allowed that the weights aim at.
const TARGET_R: f64 = 0.8;
/// Longest wavelength that is smoothed away, in tolerances.
const LONGEST_R: f64 = 1250.0;

/// The tube a curve has to stay in.
#[derive(Debug, Clone)]
struct Tube {
    /// The tolerance of the program, everything together, mm.
    tolerance_mm: f64,
    /// What merging may use of it.
    merge_mm: f64,
    /// What the fit may use, and what it aims at.
    allowed_mm: f64,
    target_mm: f64,
    longest_mm: f64,
    /// The axes that measure the feed.
    feed_axes: Range<usize>,
}

impl Tube {
    fn new(tolerance_mm: f64, settings: &Settings, feed_axes: Range<usize>) -> Self {
        // The chord of one period is a·T²/8 away from a curve that takes all of an axis' limit.
        let period_t = settings.period_t;
        let sharpest_a = feed_axes
            .clone()
            .map(|i| settings.limits.acceleration[i])
            .fold(0.0, f64::max);
        let chord_mm = (sharpest_a * period_t * period_t / 8.0).min(CHORD_SHARE_R * tolerance_mm);
        let merge_mm = MERGE_SHARE_R * tolerance_mm;
        let allowed_mm = tolerance_mm - merge_mm - chord_mm;
        Self {
            tolerance_mm,
            merge_mm,
            allowed_mm,
            target_mm: TARGET_R * allowed_mm,
            longest_mm: LONGEST_R * tolerance_mm,
            feed_axes,
        }
    }
}

/// A run of blocks over some of the axes.
#[derive(Debug)]
struct RunOf<const D: usize> {
    thinning: Thinning<D>,
    chords: Chords<D>,
    /// What the first block held back by merging changes.
    change: Option<Change>,
}

impl<const D: usize> RunOf<D> {
    fn new(tube: Tube, start: &AxisVector) -> Self {
        Self {
            thinning: Thinning::new(tube.merge_mm, tube.feed_axes.clone(), first_axes(start)),
            chords: Chords::new(tube),
            change: None,
        }
    }

    fn push(&mut self, end: &AxisVector, line: u32, change: Option<Change>, out: &mut Output) {
        let vertex = Vertex {
            point: first_axes(end),
            line,
        };
        if let Some(chord) = self.thinning.push(vertex, change.is_some()) {
            self.chords.push(chord, self.change.take(), out);
        }
        if change.is_some() {
            self.change = change;
        }
    }

    fn finish(&mut self, out: &mut Output) {
        if let Some(chord) = self.thinning.flush() {
            self.chords.push(chord, self.change.take(), out);
        }
        self.chords.finish(out);
    }
}

fn first_axes<const D: usize>(point: &AxisVector) -> [f64; D] {
    core::array::from_fn(|i| point[i])
}

/// A run, over as many axes as need be.
#[derive(Debug)]
#[allow(clippy::large_enum_variant, reason = "there is one of them")]
enum Run {
    Linear(RunOf<3>),
    All(RunOf<AXES>),
}

/// Compresses runs of blocks.
#[derive(Debug)]
pub(crate) struct Compressor {
    run: Run,
    output: Output,
}

impl Compressor {
    /// A run that starts at a point, its feed measured in some of the axes. `is_linear`: no other
    /// axis than X, Y, Z moves in it.
    pub(crate) fn new(
        start: AxisVector,
        feed_axes: Range<usize>,
        is_linear: bool,
        tolerance_mm: f64,
        settings: &Settings,
    ) -> Self {
        let tube = Tube::new(tolerance_mm, settings, feed_axes.clone());
        let output = Output::new(start, tube.merge_mm);
        let run = if is_linear && feed_axes == LINEAR_XYZ {
            Run::Linear(RunOf::new(tube, &start))
        } else {
            Run::All(RunOf::new(tube, &start))
        };
        Self { run, output }
    }

    /// True if the axes of this displacement can move in the run.
    pub(crate) fn takes(&self, displacement: &AxisVector) -> bool {
        let is_linear = displacement.iter().skip(LINEAR_XYZ.end).all(|x| *x == 0.0);
        is_linear || matches!(self.run, Run::All(_))
    }

    /// The next block: a line to a point at least a rounding error away. `change` is there for the
    /// first block, and where its rate is another than that of the block before or events happen.
    pub(crate) fn push(&mut self, end: &AxisVector, line: u32, change: Option<Change>) {
        match &mut self.run {
            Run::Linear(run) => run.push(end, line, change, &mut self.output),
            Run::All(run) => run.push(end, line, change, &mut self.output),
        }
    }

    /// The run ends: everything is put out.
    pub(crate) fn finish(&mut self) {
        match &mut self.run {
            Run::Linear(run) => run.finish(&mut self.output),
            Run::All(run) => run.finish(&mut self.output),
        }
    }

    /// The parts that are decided, in order.
    pub(crate) fn parts(&mut self) -> std::vec::Drain<'_, Part> {
        self.output.parts.drain(..)
    }
}

/// The axes that measure the feed of a displacement; see [`glidepath_geometry::feed_length`].
pub(crate) fn feed_axes(displacement: &AxisVector) -> Range<usize> {
    [LINEAR_XYZ, UVW]
        .into_iter()
        .find(|axes| axes.clone().any(|i| displacement[i].abs() > 1e-7))
        .unwrap_or(ROTARY_ABC)
}
