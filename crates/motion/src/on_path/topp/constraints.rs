//! The problem: a quadratic spline on a track of knots, and every limit as a constraint over three
//! of its coefficients.

use super::interval::BETWEEN_R;
use super::knots::KnotPath;
use super::parabola::Taylor;
use glidepath_geometry::{AXES, Jet};
use glidepath_program::Limits;

/// A limit: `of`·x ≤ limit, or ≤ limit/√(`root_of`·x), x three neighbouring coefficients.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Constraint {
    pub(crate) first: usize,
    pub(crate) of: [f64; 3],
    pub(crate) root_of: Option<[f64; 3]>,
    pub(crate) limit: f64,
}

/// The value of b at a knot, and the path around it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Knot {
    pub(crate) first: usize,
    pub(crate) of: [f64; 3],
    pub(crate) share_s: f64,
}

impl Knot {
    pub(crate) fn value(&self, x: &[f64]) -> f64 {
        let near = &x[self.first..self.first + 3];
        self.of[0] * near[0] + self.of[1] * near[1] + self.of[2] * near[2]
    }
}

/// All constraints.
#[derive(Debug)]
pub(crate) struct Problem {
    pub(crate) constraints: Vec<Constraint>,
    pub(crate) knots: Vec<Knot>,
}

/// The same of the jerk of an axis, which changes faster.
const JERK_BETWEEN_R: f64 = 1.0 - 2e-3;
/// A limit this many times what can be asked for is none.
const IDLE_R: f64 = 1.5;

impl Problem {
    /// `shares`: of its limits that each interval may use.
    pub(crate) fn new(knot_path: &KnotPath, limits: &Limits, shares: &[f64]) -> Self {
        let mut problem = Self {
            constraints: Vec::new(),
            knots: Vec::new(),
        };
        let count = knot_path.intervals.len();
        for (k, (interval, share_r)) in knot_path.intervals.iter().zip(shares).enumerate() {
            let parabola = knot_path.parabola(k);
            problem.cap(k, parabola.middle(), share_r * interval.middle_v);
            for (taylor, jet, top_v) in [
                (&parabola.start, &interval.start, interval.start_v),
                (&parabola.end, &interval.end, interval.end_v),
            ] {
                problem.cap(k, taylor.value, share_r * top_v);
                problem.axes(k, taylor, (jet, top_v), limits, *share_r);
                problem.path(k, taylor, limits);
            }
            problem.knots.push(Knot {
                first: k,
                of: parabola.start.value,
                share_s: 0.5 * (interval.length_s + knot_path.before_s(k)),
            });
            if k + 1 == count {
                problem.knots.push(Knot {
                    first: k,
                    of: parabola.end.value,
                    share_s: 0.5 * interval.length_s,
                });
            }
        }
        problem
    }

    /// Time, about: Σ h/√b.
    pub(crate) fn time(&self, x: &[f64]) -> f64 {
        let times = self.knots.iter().map(|k| k.share_s / k.value(x).sqrt());
        times.sum()
    }

    pub(crate) fn knots(&self) -> usize {
        self.knots.len()
    }

    fn cap(&mut self, first: usize, of: [f64; 3], top_v: f64) {
        let limit = top_v * top_v;
        if limit.is_finite() {
            self.constraints.push(Constraint {
                first,
                of,
                root_of: None,
                limit,
            });
        }
    }

    /// A limit both ways.
    fn both(&mut self, first: usize, of: [f64; 3], root_of: Option<[f64; 3]>, limit: f64) {
        for of in [of, of.map(|c| -c)] {
            self.constraints.push(Constraint {
                first,
                of,
                root_of,
                limit,
            });
        }
    }

    fn path(&mut self, first: usize, taylor: &Taylor, limits: &Limits) {
        let bounds = &limits.path;
        if bounds.tangential_a < Limits::UNLIMITED {
            self.both(first, taylor.slope, None, 2.0 * bounds.tangential_a);
        }
        if bounds.jerk_j < Limits::UNLIMITED {
            self.both(
                first,
                taylor.second,
                Some(taylor.value),
                2.0 * BETWEEN_R * bounds.jerk_j,
            );
        }
    }

    /// The limits of the axes at a place, but for those that cannot bind there whatever the others
    /// leave.
    fn axes(
        &mut self,
        first: usize,
        taylor: &Taylor,
        (jet, top_v): (&Jet, f64),
        limits: &Limits,
        share_r: f64,
    ) {
        let bounds = &limits.path;
        let Taylor {
            value,
            slope,
            second,
        } = taylor;
        for axis in 0..AXES {
            let (d1, d2, d3) = (jet.d1[axis], jet.d2[axis], jet.d3[axis]);
            if d1.to_bits() << 1 == 0 && d2.to_bits() << 1 == 0 && d3.to_bits() << 1 == 0 {
                continue;
            }
            let (most_a, most_j) = (limits.acceleration[axis], limits.jerk[axis]);
            let along_a = d1.abs() * bounds.tangential_a;
            let needed_a = along_a + d2.abs() * top_v * top_v;
            let cross_j = 3.0 * d2.abs() * top_v * bounds.tangential_a;
            let needed_j = d1.abs() * bounds.jerk_j + cross_j + d3.abs() * top_v.powi(3);
            if most_a < IDLE_R * needed_a && most_a < Limits::UNLIMITED {
                let of = core::array::from_fn(|i| 0.5 * d1 * slope[i] + d2 * value[i]);
                self.both(first, of, None, share_r * BETWEEN_R * most_a);
            }
            if most_j < IDLE_R * needed_j && most_j < Limits::UNLIMITED {
                let of = core::array::from_fn(|i| {
                    0.5 * d1 * second[i] + 1.5 * d2 * slope[i] + d3 * value[i]
                });
                self.both(first, of, Some(*value), share_r * JERK_BETWEEN_R * most_j);
            }
        }
    }
}
