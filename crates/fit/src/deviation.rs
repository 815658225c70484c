//! The deviation between a curve and a polyline, both ways, in order.
//!
//! It looks only at the finished curve, with none of the machinery that made it: the curve is
//! sampled densely, and everything near in path is compared with everything near. The curve is
//! parametrised by the chord length of the points; a window of chord lengths says what is near.

use crate::part::to_chord;
use crate::point::Point;
use glidepath_geometry::Nurbs;

/// Samples of the curve for each chord.
const SAMPLES: usize = 16;
/// Chords on either side within which the nearest is looked for.
const WINDOW: usize = 6;
/// Part of the farthest sample from which a summit between samples is looked for: a summit is never
/// much higher than the sample beside it.
const MAY_BE_HIGHEST: f64 = 0.5;
/// Golden sections of the interval of a summit: down to a thousandth of it, the summit to a
/// millionth.
const SECTIONS: usize = 16;

/// Largest distances between a curve and a polyline, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviation {
    /// The largest distance of a point of the run from the curve.
    pub points_to_curve_mm: f64,
    /// The largest distance of a point of the curve from the polyline through the points.
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

        let points_to_curve = points.iter().enumerate().map(|(i, point)| {
            let low = i.saturating_sub(WINDOW) * SAMPLES;
            let high = ((i + WINDOW) * SAMPLES + 1).min(samples.len());
            nearest_mm(curve, &samples[low..high], point)
        });
        Self {
            points_to_curve_mm: points_to_curve.fold(0.0, f64::max),
            curve_to_points_mm: farthest_mm(curve, &samples, points),
        }
    }
}

fn at(curve: &Nurbs, u: f64) -> Point {
    curve.jet(u).position.fixed_rows::<3>(0).into_owned()
}

/// Distance of the point of a curve that is farthest from a polyline: the samples, and between
/// those that are farther than their neighbours a search for the summit, where it may be the
/// highest.
fn farthest_mm(curve: &Nurbs, samples: &[(usize, f64, Point)], points: &[Point]) -> f64 {
    let to_polyline = |chord: usize, sample: &Point| {
        let low = chord.saturating_sub(WINDOW);
        let high = (chord + WINDOW + 2).min(points.len());
        points[low..high]
            .windows(2)
            .map(|pair| to_chord(sample, &pair[0], &pair[1]))
            .fold(f64::INFINITY, f64::min)
    };
    let sampled: Vec<f64> = samples
        .iter()
        .map(|(chord, _, sample)| to_polyline(*chord, sample))
        .collect();
    let most = sampled.iter().copied().fold(0.0, f64::max);
    let mut farthest = most;
    for i in 0..samples.len() {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(samples.len() - 1));
        let is_summit = sampled[i] >= sampled[before] && sampled[i] >= sampled[after];
        if is_summit && sampled[i] >= MAY_BE_HIGHEST * most {
            let at_u = |u: f64| to_polyline(samples[i].0, &at(curve, u));
            farthest = farthest.max(summit(&at_u, samples[before].1, samples[after].1));
        }
    }
    farthest
}

/// The greatest value of a function with one summit between two places, by golden sections.
fn summit(value: &impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_8;
    let mut at = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut is = at.map(value);
    for _ in 0..SECTIONS {
        if is[0] >= is[1] {
            high = at[1];
            at = [high - GOLDEN * (high - low), at[0]];
            is = [value(at[0]), is[0]];
        } else {
            low = at[0];
            at = [at[1], low + GOLDEN * (high - low)];
            is = [is[1], value(at[1])];
        }
    }
    is[0].max(is[1])
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
