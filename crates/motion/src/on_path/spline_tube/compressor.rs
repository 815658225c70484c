//! Runs of blocks through the stages of the compressor.

use super::chords::Chords;
use super::marks::Change;
use super::output::{Output, Part};
use super::shares::Tube;
use super::thinning::{Thinning, Vertex};
use core::ops::Range;
use glidepath_geometry::{AXES, AxisVector, LINEAR_XYZ};
use glidepath_program::Settings;

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
