//! Runs of blocks through the stages of the compressor.

use super::marks::Change;
use super::output::{Output, SplinePart};
use super::sample_layout::SampleLayout;
use super::shares::ToleranceShares;
use super::thinning::{Thinning, Vertex};
use core::ops::Range;
use glidepath_geometry::{AXES, AxisVector, LINEAR_XYZ};
use glidepath_program::{ProgramLine, Settings};

/// A run of blocks over some of the axes.
#[derive(Debug, Clone)]
struct StagesOver<const D: usize> {
    thinning: Thinning<D>,
    layout: SampleLayout<D>,
    /// What the first block held back by merging changes.
    change: Option<Change>,
}

impl<const D: usize> StagesOver<D> {
    fn new(shares: ToleranceShares, start: &AxisVector) -> Self {
        Self {
            thinning: Thinning::new(
                (shares.merge_mm, shares.mm_per_deg),
                shares.feed_axes.clone(),
                first_axes(start),
            ),
            layout: SampleLayout::new(shares),
            change: None,
        }
    }

    fn push(
        &mut self,
        end: &AxisVector,
        line: ProgramLine,
        change: Option<Change>,
        out: &mut Output,
    ) {
        let vertex = Vertex {
            point: first_axes(end),
            line,
        };
        if let Some(chord) = self.thinning.push(vertex, change.is_some()) {
            self.layout.push(chord, self.change.take(), out);
        }
        if change.is_some() {
            self.change = change;
        }
    }

    fn finish(&mut self, out: &mut Output) {
        if let Some(chord) = self.thinning.flush() {
            self.layout.push(chord, self.change.take(), out);
        }
        self.layout.finish(out);
    }
}

fn first_axes<const D: usize>(point: &AxisVector) -> [f64; D] {
    core::array::from_fn(|i| point[i])
}

/// A run, over as many axes as need be.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant, reason = "there is one of them")]
enum Stages {
    Linear(StagesOver<3>),
    All(StagesOver<AXES>),
}

/// Compresses runs of blocks.
#[derive(Debug, Clone)]
pub(crate) struct Compressor {
    stages: Stages,
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
        let shares = ToleranceShares::new(tolerance_mm, settings, feed_axes.clone());
        let output = Output::new(start, shares.merge_mm);
        let stages = if is_linear && feed_axes == LINEAR_XYZ {
            Stages::Linear(StagesOver::new(shares, &start))
        } else {
            Stages::All(StagesOver::new(shares, &start))
        };
        Self { stages, output }
    }

    /// True if the axes of this displacement can move in the run.
    pub(crate) fn takes(&self, displacement: &AxisVector) -> bool {
        let is_linear = displacement.iter().skip(LINEAR_XYZ.end).all(|x| *x == 0.0);
        is_linear || matches!(self.stages, Stages::All(_))
    }

    /// The next block: a line to a point at least a rounding error away. `change` is there for the
    /// first block, and where its rate is another than that of the block before or events happen.
    pub(crate) fn push(&mut self, end: &AxisVector, line: ProgramLine, change: Option<Change>) {
        match &mut self.stages {
            Stages::Linear(stages) => stages.push(end, line, change, &mut self.output),
            Stages::All(stages) => stages.push(end, line, change, &mut self.output),
        }
    }

    /// The run ends: everything is put out.
    pub(crate) fn finish(&mut self) {
        match &mut self.stages {
            Stages::Linear(stages) => stages.finish(&mut self.output),
            Stages::All(stages) => stages.finish(&mut self.output),
        }
    }

    /// The parts that are decided, in order.
    pub(crate) fn parts(&mut self) -> std::vec::Drain<'_, SplinePart> {
        self.output.parts.drain(..)
    }
}
