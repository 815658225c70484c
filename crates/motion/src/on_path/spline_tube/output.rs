//! The output of the compressor: lines, spans and stops, each with the blocks driven on it.

use super::marks::{Cut, Marks};
use glidepath_geometry::AxisVector;

/// A part of a compressed path.
#[derive(Debug, Clone)]
pub(crate) struct SplinePart {
    pub shape: PartShape,
    /// The blocks driven on it, in order, the first from its start.
    pub cuts: Vec<Cut>,
}

/// The curve of a part.
#[derive(Debug, Clone)]
pub(crate) enum PartShape {
    /// A line. Two lines in a row meet at a corner.
    Line {
        start: AxisVector,
        end: AxisVector,
        /// How far it is from the program, mm.
        error_mm: f64,
        /// Whether it continues a curve at its start, and is continued by one at its end.
        continues: [bool; 2],
    },
    /// A polynomial span, by its Bézier points. It continues what comes before it, with the same
    /// first and second derivative, unless that is a stop.
    Span {
        control: [AxisVector; 4],
        error_mm: f64,
    },
    /// The motion rests here.
    Stop,
}

/// Where parts go.
#[derive(Debug, Clone)]
pub(super) struct Output {
    /// Position of the axes that do not take part in the fit.
    base: AxisVector,
    /// What merging used of the tolerance, mm.
    merged_mm: f64,
    pub(super) marks: Marks,
    pub(super) parts: Vec<SplinePart>,
}

impl Output {
    pub(super) fn new(base: AxisVector, merged_mm: f64) -> Self {
        Self {
            base,
            merged_mm,
            marks: Marks::default(),
            parts: Vec::new(),
        }
    }

    /// Blocks that no part was put out for.
    pub(super) fn blocks_waiting(&self) -> usize {
        self.marks.len()
    }

    fn position<const D: usize>(&self, point: &[f64; D]) -> AxisVector {
        let mut position = self.base;
        for (slot, x) in position.iter_mut().zip(point) {
            *slot = *x;
        }
        position
    }

    /// A line between two points, which are at these lengths along the merged chords.
    pub(super) fn line<const D: usize>(
        &mut self,
        (start, end): (&[f64; D], &[f64; D]),
        (from_t, to_t): (f64, f64),
        error_mm: f64,
        continues: [bool; 2],
    ) {
        let shape = PartShape::Line {
            start: self.position(start),
            end: self.position(end),
            error_mm,
            continues,
        };
        let cuts = self.marks.take(|t| (t - from_t) / (to_t - from_t));
        self.parts.push(SplinePart { shape, cuts });
    }

    /// A span that is within a distance of the merged chords; `foot` gives the place on it of a
    /// length along these, 0 at its start and 1 at its end.
    pub(super) fn span<const D: usize>(
        &mut self,
        control: &[[f64; D]; 4],
        error_mm: f64,
        foot: impl FnMut(f64) -> f64,
    ) {
        let shape = PartShape::Span {
            control: [0, 1, 2, 3].map(|i| self.position(&control[i])),
            error_mm: error_mm + self.merged_mm,
        };
        let cuts = self.marks.take(foot);
        self.parts.push(SplinePart { shape, cuts });
    }

    /// A stop.
    pub(super) fn stop(&mut self) {
        self.parts.push(SplinePart {
            shape: PartShape::Stop,
            cuts: Vec::new(),
        });
    }
}
