//! Proof that a spline stays in the tube, both ways and in order.
//!
//! Between two break points (feet of samples, and knots) the curve is one cubic, with four Bézier
//! points. If every one of them is within r of a point of the chord that the part belongs to, and
//! these points follow each other along the chord, then so is the curve: C(u) = Σ B_i(u)·b_i is
//! within r of Σ B_i(u)·y_i, which is on the chord and moves along it. At the end of a chord the
//! match moves on to the vertex while the curve waits at the foot of it. So the larger of these
//! distances bounds the width of a matching of the curve with the polyline that never goes back: no
//! point of either is farther from the other, and both are passed in the same order.

use super::fit::Spline;
use super::knots::{bezier, hermite_points, steps};
use super::sample::Sample;
use super::vector::{add_scaled, dot, minus, tolerance_square};
use core::ops::Range;

/// How near a cusp a span may come, as [`glidepath_geometry::Cubic`] has it, with a margin.
const SLOWEST_R: f64 = 0.12;

/// What a certificate says.
#[derive(Debug, Clone, Copy)]
pub(super) struct Certificate {
    /// Largest distance, mm; infinite where the curve comes near a cusp.
    pub(super) worst_mm: f64,
    /// The sample at the end of the chord where that is.
    pub(super) worst_sample: usize,
    /// The sample at the start of the chord that the match is on at the end of the last span.
    pub(super) chord: usize,
    /// How far along that chord the match is at the end of the last span, 0…1.
    pub(super) passed_u: f64,
}

impl<const D: usize> Spline<D> {
    /// Certifies the first spans. The match starts a share `passed_u` along the first chord; the
    /// distance on each span goes to `errors_mm`. A degree of the rotary axes counts for `mm_per_deg`.
    pub(super) fn certify(
        &self,
        samples: &[Sample<D>],
        spans: usize,
        passed_u: f64,
        (feed_axes, mm_per_deg): (&Range<usize>, f64),
        errors_mm: &mut Vec<f64>,
    ) -> Certificate {
        errors_mm.clear();
        errors_mm.resize(spans, 0.0);
        let end_t = self.knots[spans + 3];
        let mut certificate = Certificate {
            worst_mm: 0.0,
            worst_sample: 1,
            chord: 0,
            passed_u,
        };
        let mut from_t = self.knots[3];
        let mut span = 0;
        let mut start = self.at(0, from_t);
        let mut is_regular = self.is_regular(0, feed_axes);
        for (j, pair) in samples.windows(2).enumerate() {
            let (a, b) = (&pair[0].point, &pair[1].point);
            let foot_t = pair[1].foot_t;
            let chord = minus(b, a);
            while from_t < foot_t && from_t < end_t {
                if span + 1 < spans && from_t >= self.knots[span + 4] {
                    span += 1;
                    start = self.at(span, from_t);
                    is_regular = self.is_regular(span, feed_axes);
                    continue;
                }
                let to_t = foot_t.min(self.knots[span + 4]);
                let end = self.at(span, to_t);
                // Hermite data rather than a cut of the span's own Bézier points: the start is that of the
                // last part, so each break costs one evaluation.
                let points = hermite_points(&start, &end, to_t - from_t);
                let passed_u = &mut certificate.passed_u;
                let square_mm2 = square_off_chord(&points, (a, &chord), mm_per_deg, passed_u);
                let error_mm = if is_regular {
                    square_mm2.sqrt()
                } else {
                    f64::INFINITY
                };
                note(&mut certificate, &mut errors_mm[span], error_mm, j + 1);
                (from_t, start) = (to_t, end);
            }
            if from_t < foot_t {
                break;
            }
            let missed_mm = tolerance_square(&minus(&start.0, b), mm_per_deg).sqrt();
            note(&mut certificate, &mut errors_mm[span], missed_mm, j + 1);
            (certificate.chord, certificate.passed_u) = (j + 1, 0.0);
            if from_t >= end_t {
                break;
            }
        }
        certificate
    }

    /// True if a span moves forward everywhere in the axes that measure the feed.
    fn is_regular(&self, span: usize, feed_axes: &Range<usize>) -> bool {
        let Some(points) = bezier(&self.knots, &self.control, span) else {
            return false;
        };
        let product = |a: &[f64; D], b: &[f64; D]| -> f64 {
            let axes = feed_axes.clone().filter(|&i| i < D);
            axes.map(|i| a[i] * b[i]).sum()
        };
        let mean = minus(&points[3], &points[0]).map(|x| x / 3.0);
        let least = SLOWEST_R * product(&mean, &mean);
        least > 0.0
            && steps(&points)
                .iter()
                .all(|step| product(step, &mean) >= least)
    }
}

/// The largest squared distance of Bézier points from points of a chord that follow each other, the
/// first of them not before a share `passed_u` of it.
fn square_off_chord<const D: usize>(
    points: &[[f64; D]; 4],
    (start, chord): (&[f64; D], &[f64; D]),
    mm_per_deg: f64,
    passed_u: &mut f64,
) -> f64 {
    let per_square = 1.0 / dot(chord, chord);
    let mut square_mm2 = 0.0_f64;
    for point in points {
        let offset = minus(point, start);
        let u = (dot(&offset, chord) * per_square).min(1.0).max(*passed_u);
        square_mm2 = square_mm2.max(tolerance_square(
            &add_scaled(&offset, -u, chord),
            mm_per_deg,
        ));
        *passed_u = u;
    }
    square_mm2
}

/// Takes a distance into account; one that is not a number counts as infinite.
fn note(certificate: &mut Certificate, of_span: &mut f64, error_mm: f64, sample: usize) {
    let error_mm = if error_mm.is_nan() {
        f64::INFINITY
    } else {
        error_mm
    };
    *of_span = of_span.max(error_mm);
    if error_mm > certificate.worst_mm {
        certificate.worst_mm = error_mm;
        certificate.worst_sample = sample;
    }
}
