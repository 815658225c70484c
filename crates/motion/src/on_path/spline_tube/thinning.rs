//! Merging of nearly collinear chords, before anything is fitted.
//!
//! ```text
//!        q1   q2   q3
//!      ·····•····•····•·····
//!   A •─────────────────────• P      each dropped vertex q within ε of A–P, in order
//! ```
//!
//! Every dropped vertex is matched with the nearest point of A–P, and these points follow each
//! other. Between two vertices both polylines are straight, so what holds at the vertices holds
//! everywhere, both ways and in order. It makes very dense chords cheap, and takes the noise of
//! rounded digits out before any angle is formed.

use super::vector::{add_scaled, dot, minus, norm, tolerance_square};
use crate::ruled::{self, RULED_MM};
use core::mem;
use core::ops::Range;
use glidepath_program::ProgramLine;

/// Most vertices held back, the last one included. All are looked at for each one that comes, so the work
/// a block is bounded by it; with fewer, very dense chords are merged less.
const MOST_HELD: usize = 32;
/// From so many times the distance allowed on a chord is seen to be straight: it is turned by no more
/// than a vertex makes of it that is off by such a share of that distance.
const LONG_R: f64 = 4000.0;
const TURNED_R: f64 = 0.25;
/// A little less than a quarter of a block is before the middle half that is kept straight.
const QUARTER_R: f64 = 0.24;

/// A vertex, and the line of the block that ends in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vertex<const D: usize> {
    pub(super) point: [f64; D],
    pub(super) line: ProgramLine,
}

/// A merged chord.
#[derive(Debug, Clone)]
pub(super) struct MergedChord<const D: usize> {
    pub(super) start: [f64; D],
    pub(super) end: [f64; D],
    pub(super) length_t: f64,
    /// Largest distance of a dropped vertex from it, mm.
    pub(super) error_mm: f64,
    /// The blocks on it: where on it each starts, 0…1, and its source line.
    pub(super) blocks: Vec<(f64, ProgramLine)>,
}

impl<const D: usize> MergedChord<D> {
    /// How much of it, from its nearer end on, is before the middle half of a block that one can lay a ruler to;
    /// none if it has no such block.
    pub(super) fn before_ruled_t(&self) -> Option<f64> {
        if self.length_t < RULED_MM {
            return None;
        }
        let starts = self.blocks.iter().map(|&(from_u, _)| from_u);
        let ends = self.blocks.iter().skip(1).map(|&(from_u, _)| from_u);
        let blocks_t = starts
            .zip(ends.chain([1.0]))
            .map(|ends| [ends.0, ends.1].map(|u| u * self.length_t));
        let mut ruled_t = blocks_t.filter(|[from_t, to_t]| to_t - from_t >= RULED_MM);
        let [first_t, end_t] = ruled_t.next()?;
        let [from_t, last_t] = ruled_t.last().unwrap_or([first_t, end_t]);
        let at_start_t = first_t + QUARTER_R * (end_t - first_t);
        let at_end_t = self.length_t - last_t + QUARTER_R * (last_t - from_t);
        Some(at_start_t.min(at_end_t))
    }
}

/// Merges chords as they come.
#[derive(Debug, Clone)]
pub(super) struct Thinning<const D: usize> {
    /// Largest distance of a dropped vertex, mm.
    allowed_mm: f64,
    /// What a degree of the rotary axes counts for, mm.
    mm_per_deg: f64,
    feed_axes: Range<usize>,
    anchor: [f64; D],
    held: Vec<Vertex<D>>,
    /// One of the chords to the vertices held is long.
    is_long: bool,
}

impl<const D: usize> Thinning<D> {
    /// A vertex may be dropped up to so many mm away, where a degree of the rotary axes counts for so many.
    pub(super) fn new(
        (allowed_mm, mm_per_deg): (f64, f64),
        feed_axes: Range<usize>,
        start: [f64; D],
    ) -> Self {
        Self {
            allowed_mm,
            mm_per_deg,
            feed_axes,
            anchor: start,
            held: Vec::with_capacity(MOST_HELD),
            is_long: false,
        }
    }

    /// Takes the next vertex; gives a chord if the vertex is not on the same. With `apart` the
    /// chord before ends here whatever comes.
    pub(super) fn push(&mut self, next: Vertex<D>, apart: bool) -> Option<MergedChord<D>> {
        let last = self.held.last().map_or(&self.anchor, |last| &last.point);
        let step = minus(&next.point, last);
        let long_mm = (LONG_R * self.allowed_mm).min(RULED_MM);
        let is_long = dot(&step, &step) >= long_mm * long_mm;
        let done = if apart || !self.reaches(&next.point, self.is_long || is_long) {
            self.flush()
        } else {
            None
        };
        self.is_long |= is_long;
        self.held.push(next);
        done
    }

    /// The chord held back, if any.
    pub(super) fn flush(&mut self) -> Option<MergedChord<D>> {
        let end = self.held.last()?.point;
        self.is_long = false;
        let chord = minus(&end, &self.anchor);
        let length_t = norm(&chord);
        let per_square = 1.0 / (length_t * length_t);
        let (mut from_u, mut error_mm2) = (0.0, 0.0_f64);
        let mut blocks = Vec::with_capacity(self.held.len());
        for vertex in self.held.drain(..) {
            blocks.push((from_u, vertex.line));
            let offset = minus(&vertex.point, &self.anchor);
            from_u = dot(&offset, &chord) * per_square;
            error_mm2 = error_mm2.max(tolerance_square(
                &add_scaled(&offset, -from_u, &chord),
                self.mm_per_deg,
            ));
        }
        let start = mem::replace(&mut self.anchor, end);
        Some(MergedChord {
            start,
            end,
            length_t,
            error_mm: if blocks.len() > 1 {
                error_mm2.sqrt()
            } else {
                0.0
            },
            blocks,
        })
    }

    /// True if the chord from the anchor to a point passes all vertices held, in order; nearer if one of
    /// the chords is long.
    fn reaches(&self, point: &[f64; D], is_long: bool) -> bool {
        if self.held.len() >= MOST_HELD {
            return false;
        }
        let chord = minus(point, &self.anchor);
        let per_square = 1.0 / dot(&chord, &chord);
        let allowed_mm = if is_long {
            (TURNED_R * self.allowed_mm).min(ruled::TURNED_MM)
        } else {
            self.allowed_mm
        };
        let allowed_mm2 = allowed_mm * allowed_mm;
        let mut passed_u = 0.0;
        let mut fed = 0.0;
        for vertex in &self.held {
            let offset = minus(&vertex.point, &self.anchor);
            let u = dot(&offset, &chord) * per_square;
            let off = add_scaled(&offset, -u, &chord);
            if !(u > passed_u && u < 1.0) || tolerance_square(&off, self.mm_per_deg) > allowed_mm2 {
                return false;
            }
            passed_u = u;
            if D == 9 {
                // The axes that measure the feed go forward by themselves.
                let fed_now = self.fed(&offset, &chord);
                if fed_now <= fed {
                    return false;
                }
                fed = fed_now;
            }
        }
        D < 9 || self.fed(&chord, &chord) > fed
    }

    fn fed(&self, offset: &[f64; D], chord: &[f64; D]) -> f64 {
        let axes = self.feed_axes.clone().filter(|&i| i < D);
        axes.map(|i| offset[i] * chord[i]).sum()
    }
}
