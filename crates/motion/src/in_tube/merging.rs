//! Merging of dense chords: programs made by CAM follow a curve with many more lines than its
//! tolerance asks for.
//!
//! Lines that follow each other are drawn together into one as long as it stays within a share of
//! the tolerance:
//!
//! ```text
//!        q1   q2   q3
//!      ·····•····•····•·····
//!   A •─────────────────────• P      each dropped vertex q within ε of A–P, in order
//! ```
//!
//! Every dropped vertex is matched with the point of A–P that is as far along it, and these points
//! follow each other. Between two vertices both polylines are straight, so what holds at the
//! vertices holds everywhere, both ways: program and merged line are within ε of each other, in
//! order, in every group of axes. What is left of the tolerance is for the transitions.

use crate::feed_axes::feed_axes;
use glidepath_geometry::AxisVector;
use glidepath_program::tolerance_norm;

/// Most vertices dropped from one line.
const MOST_DROPPED: usize = 64;
/// How far off the vertices the parabola may be that fits them best, in distances of the furthest of
/// them. A vertex next to an end of the line says nothing of its middle.
const MOST_SAGITTA_VECTOR_R: f64 = 2.0;

/// The vertices a line has drawn together.
#[derive(Debug, Clone, Default)]
pub(crate) struct Dropped {
    vertices: Vec<AxisVector>,
    /// Largest distance of one of them from the line, mm.
    pub error_mm: f64,
    /// Offset of the parabola over the line that fits them best, in its middle.
    pub sagitta_vector: AxisVector,
}

impl Dropped {
    /// Whether the line is one chord.
    pub(crate) const fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Drops the vertex `through` if the line from `start` to `end` stays within `allowed_mm` of it
    /// and of those dropped before, where a degree of the rotary axes counts for so many mm. Changes nothing if not.
    pub(crate) fn extend(
        &mut self,
        [start, through, end]: [&AxisVector; 3],
        allowed_mm: f64,
        mm_per_deg: f64,
    ) -> bool {
        let (before, after) = (through - start, end - through);
        let line = end - start;
        let group = feed_axes(&line);
        let is_one_kind = feed_axes(&before) == group && feed_axes(&after) == group;
        if self.vertices.len() >= MOST_DROPPED || !is_one_kind {
            return false;
        }
        let square_mm2: f64 = group.clone().map(|i| line[i] * line[i]).sum();
        let mut passed_u = 0.0;
        let mut error_mm = 0.0_f64;
        let (mut offsets, mut squares) = (AxisVector::zeros(), 0.0);
        for vertex in self.vertices.iter().chain([through]) {
            let offset = vertex - start;
            let u = group.clone().map(|i| offset[i] * line[i]).sum::<f64>() / square_mm2;
            let across = offset - line * u;
            let distance_mm = tolerance_norm(&across, mm_per_deg);
            if !(passed_u..=1.0).contains(&u) || distance_mm > allowed_mm {
                return false;
            }
            passed_u = u;
            error_mm = error_mm.max(distance_mm);
            let height = 4.0 * u * (1.0 - u);
            offsets += across * height;
            squares += height * height;
        }
        self.vertices.push(*through);
        self.error_mm = error_mm;
        let sagitta_vector = if squares > 0.0 {
            offsets / squares
        } else {
            AxisVector::zeros()
        };
        let (size_mm, most_mm) = (
            tolerance_norm(&sagitta_vector, mm_per_deg),
            MOST_SAGITTA_VECTOR_R * error_mm,
        );
        self.sagitta_vector = if size_mm > most_mm {
            sagitta_vector * (most_mm / size_mm)
        } else {
            sagitta_vector
        };
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_next_to_an_end_makes_no_parabola() {
        let at = |x: f64, y: f64| {
            let mut point = AxisVector::zeros();
            (point[0], point[1]) = (x, y);
            point
        };
        let (start, end) = (at(0.0, 0.0), at(20.0, 0.0));
        let mut dropped = Dropped::default();
        assert!(dropped.extend([&start, &at(0.02, 0.001), &end], 0.002, 1.0));
        assert!(
            tolerance_norm(&dropped.sagitta_vector, 1.0) <= 0.0021,
            "{}",
            dropped.sagitta_vector
        );
        let mut middle = Dropped::default();
        assert!(middle.extend([&start, &at(10.0, 0.001), &end], 0.002, 1.0));
        assert!(
            (middle.sagitta_vector[1] - 0.001).abs() < 1e-12,
            "{}",
            middle.sagitta_vector
        );
    }
}
