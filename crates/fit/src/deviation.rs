//! How far a curve and a polyline are apart, both ways, in order.
//!
//! It looks only at the finished curve, with none of the machinery that made it: the curve is sampled
//! densely, and everything near in path is compared with everything near. The curve is parametrised by
//! the chord length of the points; a window of chord lengths says what is near.

use crate::Point;
use crate::part::to_chord;
use glidepath_geometry::Nurbs;

/// Samples of the curve for each chord.
const SAMPLES: usize = 16;
/// Chords on either side within which the nearest is looked for.
const WINDOW: usize = 6;

/// Largest distances between a curve and a polyline, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// Of a point of the run from the curve.
    pub points_to_curve_mm: f64,
    /// Of a point of the curve from the polyline through the points.
    pub curve_to_points_mm: f64,
}

impl Deviation {
    /// The larger of the two, mm.
    #[must_use]
    pub const fn max_mm(&self) -> f64 {
        self.points_to_curve_mm.max(self.curve_to_points_mm)
    }

    /// Measures a curve parametrised by the chord length of distinct points, at least two.
    #[must_use]
    pub fn measure(curve: &Nurbs, points: &[Point]) -> Self {
        let mut x = vec![0.0];
        for pair in points.windows(2) {
            x.push(x[x.len() - 1] + (pair[1] - pair[0]).norm());
        }
        let mut samples = Vec::with_capacity(SAMPLES * points.len());
        for (chord, pair) in x.windows(2).enumerate() {
            for i in 0..SAMPLES {
                let u = pair[0] + (pair[1] - pair[0]) * i as f64 / SAMPLES as f64;
                samples.push((chord, u, at(curve, u)));
            }
        }
        let last = x[x.len() - 1];
        samples.push((points.len() - 2, last, at(curve, last)));

        let curve_to_points = samples.iter().map(|(chord, _, sample)| {
            let low = chord.saturating_sub(WINDOW);
            let high = (chord + WINDOW + 2).min(points.len());
            points[low..high]
                .windows(2)
                .map(|pair| to_chord(sample, &pair[0], &pair[1]))
                .fold(f64::INFINITY, f64::min)
        });
        let points_to_curve = points.iter().enumerate().map(|(i, point)| {
            let low = i.saturating_sub(WINDOW) * SAMPLES;
            let high = ((i + WINDOW) * SAMPLES + 1).min(samples.len());
            nearest_mm(curve, &samples[low..high], point)
        });
        Self {
            points_to_curve_mm: points_to_curve.fold(0.0, f64::max),
            curve_to_points_mm: curve_to_points.fold(0.0, f64::max),
        }
    }
}

fn at(curve: &Nurbs, u: f64) -> Point {
    curve.jet(u).position.fixed_rows::<3>(0).into_owned()
}

/// Distance of a point from the curve: the nearest sample, and Newton steps from there.
fn nearest_mm(curve: &Nurbs, samples: &[(usize, f64, Point)], point: &Point) -> f64 {
    let distance = |sample: &(usize, f64, Point)| (sample.2 - point).norm();
    let nearest = samples
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let Some(nearest) = nearest else {
        return f64::INFINITY;
    };
    let (mut u, mut least_mm) = (nearest.1, distance(nearest));
    for _ in 0..4 {
        let jet = curve.jet(u);
        let part = |v: &glidepath_geometry::AxisVector| v.fixed_rows::<3>(0).into_owned();
        let (d1, d2) = (part(&jet.d1), part(&jet.d2));
        let offset = part(&jet.position) - point;
        least_mm = least_mm.min(offset.norm());
        let slope = d1.norm_squared() + offset.dot(&d2);
        if slope <= 0.0 {
            break;
        }
        u -= offset.dot(&d1) / slope;
    }
    least_mm.min((at(curve, u) - point).norm())
}
