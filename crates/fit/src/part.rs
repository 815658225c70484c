//! A smooth part of a run: its points, their parameters, and what a spline makes of them.

use crate::least_squares;
use crate::point::Point;
use crate::spline::{Pieces, Spline, clamped};

/// Rounds of parameter correction where a fit is almost good enough.
const CORRECTIONS: u32 = 2;
/// Where between two points the curve is compared with their chord.
const BETWEEN: [f64; 5] = [0.1, 0.3, 0.5, 0.7, 0.9];
/// Almost: its error is below this many tolerances.
const ALMOST: f64 = 1.6;

/// Points between two corners, with the chord length up to each.
#[derive(Debug, Clone)]
pub(crate) struct Part {
    pub(crate) points: Vec<Point>,
    pub(crate) x: Vec<f64>,
    pub(crate) tolerance_mm: f64,
    /// For each chord, by how much the curve may exceed the tolerance beyond it, mm.
    allowance_mm: Vec<f64>,
}

/// A spline through a part and how far it is from it.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub(crate) spline: Spline,
    /// For each point its distance from the curve, or that of the curve beyond it from the chord
    /// to the next point less what is allowed there, whichever is larger, mm.
    pub(crate) errors_mm: Vec<f64>,
    /// Parameters of the points of the curve nearest to the points.
    feet: Vec<f64>,
}

impl Candidate {
    pub(crate) fn max_mm(&self) -> f64 {
        self.errors_mm.iter().copied().fold(0.0, f64::max)
    }
}

impl Part {
    /// A part through at least two distinct points.
    pub(crate) fn new(points: &[Point], tolerance_mm: f64) -> Self {
        let mut x = vec![0.0];
        let mut length = 0.0;
        for pair in points.windows(2) {
            length += (pair[1] - pair[0]).norm();
            x.push(length);
        }
        Self {
            points: points.to_vec(),
            allowance_mm: vec![0.0; x.len()],
            x,
            tolerance_mm,
        }
    }

    /// The same polyline with the middle of every chord as a further point.
    pub(crate) fn refined(&self) -> Self {
        let middles = self
            .points
            .windows(2)
            .flat_map(|p| [p[0], (p[0] + p[1]) * 0.5]);
        let last = self.points.last().copied();
        let points: Vec<Point> = middles.chain(last).collect();
        Self::new(&points, self.tolerance_mm)
    }

    /// The same, with the curve allowed to leave the chords by what a smooth curve through the
    /// points does: h²κ/8 over a chord of length h, with the turn at its ends for hκ. For points
    /// that are too far apart for the tolerance.
    pub(crate) fn bulging(&self) -> Self {
        let turn = |i: usize| match self.points.get(i.wrapping_sub(1)..i + 2) {
            Some([a, b, c]) => (b - a).angle(&(c - b)),
            _ => 0.0,
        };
        let bulge = |i: usize| {
            let chord = self.x.get(i + 1).map_or(0.0, |next| next - self.x[i]);
            0.125 * chord * turn(i).max(turn(i + 1))
        };
        Self {
            allowance_mm: (0..self.x.len()).map(bulge).collect(),
            ..self.clone()
        }
    }

    pub(crate) fn length(&self) -> f64 {
        self.x.last().copied().unwrap_or(0.0)
    }

    pub(crate) fn knots(&self, inside: &[f64]) -> Vec<f64> {
        clamped(0.0, inside, self.length())
    }

    /// The least-squares spline over the knots inside; none if the points do not determine it.
    pub(crate) fn fit(&self, inside: &[f64]) -> Option<Candidate> {
        let knots = self.knots(inside);
        // Strictly ascending from end to end, with room for rounding.
        let gap = 1e-9 * self.length();
        if knots[3..knots.len() - 3]
            .windows(2)
            .any(|pair| pair[1] - pair[0] <= gap)
        {
            return None;
        }
        if !least_squares::determined(&self.x, &knots) {
            return None;
        }
        Some(self.judge(least_squares::solve(&self.points, &self.x, &knots)?))
    }

    /// The same, with corrected parameters if that brings the error within the tolerance; none if
    /// nothing does.
    pub(crate) fn fit_within(&self, inside: &[f64]) -> Option<Candidate> {
        let mut candidate = self.fit(inside)?;
        for _ in 0..CORRECTIONS {
            let max_mm = candidate.max_mm();
            if max_mm <= self.tolerance_mm {
                return Some(candidate);
            }
            if max_mm > ALMOST * self.tolerance_mm {
                return None;
            }
            candidate = self.corrected(&candidate)?;
        }
        (candidate.max_mm() <= self.tolerance_mm).then_some(candidate)
    }

    /// Fits once more with the feet of the points as their parameters.
    pub(crate) fn corrected(&self, candidate: &Candidate) -> Option<Candidate> {
        let mut x = candidate.feet.clone();
        // In order, whatever the feet are, and the ends where they are.
        x[0] = 0.0;
        for i in 1..x.len() {
            x[i] = x[i].max(x[i - 1]).min(self.length());
        }
        if let Some(last) = x.last_mut() {
            *last = self.length();
        }
        let knots = &candidate.spline.knots;
        if !least_squares::determined(&x, knots) {
            return None;
        }
        let spline = least_squares::solve(&self.points, &x, knots)?;
        Some(self.measure(spline, &x))
    }

    /// The straight spline from the first to the last point.
    pub(crate) fn straight(&self) -> Spline {
        let (first, last) = (self.points[0], self.points[self.points.len() - 1]);
        let control = [0.0, 1.0, 2.0, 3.0].map(|i| first + (last - first) * (i / 3.0));
        Spline {
            knots: self.knots(&[]),
            control: control.to_vec(),
        }
    }

    /// The point of the polyline at a chord length.
    pub(crate) fn at(&self, x: f64) -> Point {
        let next = self.x.partition_point(|at| *at <= x);
        let next = next.clamp(1, self.x.len() - 1);
        let (a, b) = (self.x[next - 1], self.x[next]);
        let share = ((x - a) / (b - a)).clamp(0.0, 1.0);
        self.points[next - 1] + (self.points[next] - self.points[next - 1]) * share
    }

    /// Sum of the squared distances at the parameters of the points, mm², and the largest, mm.
    pub(crate) fn residual(&self, spline: &Spline) -> (f64, f64) {
        let pieces = spline.pieces();
        let mut piece = 0;
        let (mut sum_mm2, mut max_mm) = (0.0, 0.0_f64);
        for (point, &x) in self.points.iter().zip(&self.x) {
            piece = pieces.find(x, piece);
            let square_mm2 = (pieces.at(piece, x) - point).norm_squared();
            sum_mm2 += square_mm2;
            max_mm = max_mm.max(square_mm2.sqrt());
        }
        (sum_mm2, max_mm)
    }

    pub(crate) fn judge(&self, spline: Spline) -> Candidate {
        self.measure(spline, &self.x)
    }

    /// Distances with the parameters of the points about `x`.
    fn measure(&self, spline: Spline, x: &[f64]) -> Candidate {
        let pieces = spline.pieces();
        let mut errors_mm = Vec::with_capacity(x.len());
        let mut feet = Vec::with_capacity(x.len());
        let mut piece = 0;
        for (point, &x) in self.points.iter().zip(x) {
            piece = pieces.find(x, piece);
            let (foot, error_mm) = foot(&pieces, piece, point, x, self.length());
            feet.push(foot);
            errors_mm.push(error_mm);
        }
        let mut piece = 0;
        for i in 1..feet.len() {
            for share in BETWEEN {
                let x = feet[i - 1] + (feet[i] - feet[i - 1]) * share;
                piece = pieces.find(x, piece);
                let at = pieces.at(piece, x);
                let beyond_mm = to_chord(&at, &self.points[i - 1], &self.points[i]);
                let excess_mm = beyond_mm - self.allowance_mm[i - 1];
                errors_mm[i - 1] = errors_mm[i - 1].max(excess_mm);
            }
        }
        Candidate {
            spline,
            errors_mm,
            feet,
        }
    }
}

/// Parameter and distance of the foot of a point on the curve, by two Newton steps from `x`.
fn foot(pieces: &Pieces, piece: usize, point: &Point, x: f64, end: f64) -> (f64, f64) {
    let (mut best, mut least_mm) = (x, f64::INFINITY);
    let (mut x, mut piece) = (x, piece);
    for _ in 0..2 {
        let value = pieces.value(piece, x);
        let offset = value.at - point;
        let distance_mm = offset.norm();
        if distance_mm >= least_mm {
            return (best, least_mm);
        }
        (best, least_mm) = (x, distance_mm);
        let slope = value.d1.norm_squared() + offset.dot(&value.d2);
        if slope <= 0.0 {
            return (best, least_mm);
        }
        x = (x - offset.dot(&value.d1) / slope).clamp(0.0, end);
        piece = pieces.find(x, piece);
    }
    let distance_mm = (pieces.at(piece, x) - point).norm();
    if distance_mm < least_mm {
        (x, distance_mm)
    } else {
        (best, least_mm)
    }
}

/// Distance of a point from the straight line between two others, ends included.
pub(crate) fn to_chord(point: &Point, from: &Point, to: &Point) -> f64 {
    let (chord, offset) = (to - from, point - from);
    let square = chord.norm_squared();
    let share = if square > 0.0 {
        (offset.dot(&chord) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (offset - chord * share).norm()
}
