//! Bacterial foraging on the control points, as published.
//!
//! The knots are given, the variables are the coordinates of the control points but the two ends, in
//! the plane or on the line of the points if they lie in one: a search that leaves it makes a motion
//! of an axis that the program leaves alone. As published there are three for each. Else as there,
//! the value is the sum of the squared distances at the points' parameters, plus the tolerance
//! squared for each control point (constant here, as their number is). 50 bacteria, 31 · 4 · 4 =
//! 496 iterations. Least squares solves the same problem exactly, which is what the report
//! compares with.

use super::colony::{Colony, forage};
use super::hull::Hull;
use super::report::Foraging;
use crate::least_squares;
use crate::part::{Candidate, Part};
use crate::point::Point;
use crate::spline::{Spline, basis, span_from};

/// The published numbers. The step is replaced by one that goes with the points ([`STEP`]).
const PUBLISHED: Colony = Colony {
    bacteria: 50,
    chemotaxis: 31,
    swims: 4,
    reproductions: 4,
    dispersals: 4,
    dispersal_chance: 0.25,
    step: 1.0,
    shrink: 0.7,
};

/// The first steps, in root mean squares of the distances at the start. Not published; with longer
/// and with shorter ones the search ends higher.
const STEP: f64 = 0.25;

pub(crate) fn on_control_points(
    part: &Part,
    placed: &Candidate,
    seed: u64,
    progress: &mut dyn FnMut(f64),
) -> (Candidate, Option<Foraging>) {
    let knots = placed.spline.knots.clone();
    let problem = Problem::new(part, &knots);
    let exact = least_squares::solve(&part.points, &part.x, &knots);
    let (least_squares_mm2, least_squares_max_mm) =
        part.residual(exact.as_ref().unwrap_or(&placed.spline));
    let start = problem.flatten(&start(part, &knots));
    let step = STEP * (problem.squares_mm2(&start) / part.points.len() as f64).sqrt();
    let colony = Colony { step, ..PUBLISHED };
    let mut value = |at: &[f64]| problem.squares_mm2(at);
    let outcome = forage(&start, colony, seed, &mut value, progress);
    let search = Foraging {
        iterations: outcome.history.len() as u64,
        evaluations: outcome.evaluations,
        start_mm2: problem.squares_mm2(&start),
        least_squares_mm2,
        least_squares_max_mm,
    };
    let control = problem.control(&outcome.best);
    (part.judge(Spline { knots, control }), Some(search))
}

/// The sum of squares as a function of the control points between the ends, in the directions in
/// which the points of the part spread.
struct Problem<'a> {
    part: &'a Part,
    hull: Hull,
    /// For each point the first of its four B-splines, and their values.
    rows: Vec<(usize, [f64; 4])>,
    count: usize,
}

impl<'a> Problem<'a> {
    fn new(part: &'a Part, knots: &[f64]) -> Self {
        let mut k = 3;
        let row = |&x: &f64| {
            k = span_from(knots, x, k);
            (k - 3, basis(knots, k, x))
        };
        Self {
            part,
            hull: Hull::of(&part.points),
            rows: part.x.iter().map(row).collect(),
            count: knots.len() - 4,
        }
    }

    fn control(&self, at: &[f64]) -> Vec<Point> {
        let points = &self.part.points;
        let mut control = vec![points[0]];
        let inner = at.chunks_exact(self.hull.dimensions());
        control.extend(inner.map(|at| self.hull.point(at)));
        control.push(points[points.len() - 1]);
        debug_assert_eq!(control.len(), self.count);
        control
    }

    fn flatten(&self, points: &[Point]) -> Vec<f64> {
        let places = points.iter().flat_map(|point| self.hull.place(point));
        places.collect()
    }

    fn squares_mm2(&self, at: &[f64]) -> f64 {
        let control = self.control(at);
        // The value that the search compares. Its gradient, −2·Σ N·residual, would give the minimum in one
        // linear solve, which is what the report sets beside it.
        let square = |((first, values), point): (&(usize, [f64; 4]), &Point)| {
            let c = &control[*first..*first + 4];
            let on_curve =
                c[0] * values[0] + c[1] * values[1] + c[2] * values[2] + c[3] * values[3];
            (on_curve - point).norm_squared()
        };
        self.rows.iter().zip(&self.part.points).map(square).sum()
    }
}

/// The points of the polyline at the Greville abscissae: the averages of three knots.
fn start(part: &Part, knots: &[f64]) -> Vec<Point> {
    (1..knots.len() - 5)
        .map(|i| part.at((knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3.0))
        .collect()
}
