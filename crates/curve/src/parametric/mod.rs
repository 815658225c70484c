//! Parametric curves: x(t), y(t), z(t).

mod bracket;
mod breaks;
mod chords;
mod step;

pub use bracket::{Bracket, bracket, certify_bracket};
pub use breaks::breaks;
pub use chords::ParametricChords;
pub(crate) use step::inside;
pub use step::{ChordEnd, Method, ParametricStepper};

use crate::sagitta_mm;
use crate::{Expression, ExpressionError};
use glidepath_geometry::number::{Interval, Number, Series};
use nalgebra::Vector3;

/// A curve given by its coordinates, mm, as formulas in `t`.
#[derive(Debug, Clone, PartialEq)]
pub struct ParametricCurve {
    coordinates: [Expression; 3],
}

/// A point of a curve with derivatives by its parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Local {
    /// mm.
    pub point: Vector3<f64>,
    /// First derivative.
    pub d1: Vector3<f64>,
    /// Second derivative.
    pub d2: Vector3<f64>,
}

/// The bounds that hold all over a range of the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// |C′|.
    pub speed: Interval,
    /// Largest |C″|.
    pub bend: f64,
    /// Largest curvature, 1/mm; infinite if |C′| may vanish.
    pub curvature_k: f64,
}

impl ParametricCurve {
    /// From the formulas of x, y and z.
    ///
    /// # Errors
    /// The coordinate (0 for x) whose formula is wrong, and how.
    pub fn parse(formulas: [&str; 3]) -> Result<Self, (usize, ExpressionError)> {
        let parse = |i: usize| Expression::parse(formulas[i], &["t"]).map_err(|error| (i, error));
        Ok(Self {
            coordinates: [parse(0)?, parse(1)?, parse(2)?],
        })
    }

    fn eval<T: Number>(&self, t: T) -> [T; 3] {
        core::array::from_fn(|i| self.coordinates[i].eval(&[t]))
    }

    /// A point; not finite where the curve is not defined.
    #[must_use]
    pub fn point(&self, t: f64) -> Vector3<f64> {
        self.eval(t).into()
    }

    /// A point with derivatives.
    #[must_use]
    pub fn local(&self, t: f64) -> Local {
        let series = self.eval(Series::<3>::variable(t));
        let derivative = |k| Vector3::from_fn(|i, _| series[i].derivative(k));
        Local {
            point: derivative(0),
            d1: derivative(1),
            d2: derivative(2),
        }
    }

    /// C, C′ and C″ over a range of the parameter.
    fn enclosure(&self, from: f64, to: f64) -> [[Interval; 3]; 3] {
        let series = self.eval(Series::<3, Interval>::variable(Interval::new(from, to)));
        core::array::from_fn(|k| core::array::from_fn(|i| series[i].derivative(k)))
    }

    /// What holds all over a range of the parameter; `None` if nothing can be said because the
    /// curve or a derivative is not defined or not bounded there.
    #[must_use]
    pub fn bounds(&self, from: f64, to: f64) -> Option<Bounds> {
        let [point, d1, d2] = self.enclosure(from, to);
        let finite = [point, d1, d2]
            .iter()
            .all(|v| v.iter().all(|c| c.is_finite()));
        if !finite {
            return None;
        }
        let speed = norm(&d1);
        let bend = norm(&d2).high();
        let across = norm(&cross(&d1, &d2)).high();
        let slowest = speed.low();
        Some(Bounds {
            speed,
            bend,
            curvature_k: if slowest > 0.0 {
                (across / (slowest * slowest * slowest)).next_up()
            } else {
                f64::INFINITY
            },
        })
    }

    /// A bound on the distance between the curve over a range of the parameter and its chord, mm;
    /// both ways, and in order. `None` if there is none.
    ///
    /// The smaller of two bounds: linear interpolation over Δt is within |C″| Δt²/8 of the curve,
    /// and an arc within the sagitta of its sharpest curvature.
    #[must_use]
    pub fn chord_error_mm(&self, from: f64, to: f64) -> Option<f64> {
        let bounds = self.bounds(from, to)?;
        let dt = to - from;
        let linear = 0.125 * bounds.bend * dt * dt;
        // The chord is no longer than the arc.
        let arc = bounds.speed.high() * dt;
        let is_short = arc * bounds.curvature_k <= core::f64::consts::PI;
        let round = if is_short {
            sagitta_mm(bounds.curvature_k, arc)
        } else {
            f64::INFINITY
        };
        // A few operations on positive numbers: their rounding is far below this.
        Some(linear.min(round) * (1.0 + 1e-12))
    }
}

fn norm(v: &[Interval; 3]) -> Interval {
    (v[0].square() + v[1].square() + v[2].square()).sqrt()
}

fn cross(a: &[Interval; 3], b: &[Interval; 3]) -> [Interval; 3] {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

impl Local {
    /// Curvature, 1/mm; not finite at a cusp.
    #[must_use]
    pub fn curvature_k(&self) -> f64 {
        self.d1.cross(&self.d2).norm() / self.d1.norm().powi(3)
    }

    /// A first guess of the parameter at the end of a chord: the series of |C(t + x) − C(t)| solved
    /// to second order.
    fn guess(&self, chord_mm: f64) -> f64 {
        let speed = self.d1.norm();
        let first = chord_mm / speed;
        let second = first - self.d1.dot(&self.d2) * chord_mm * chord_mm / (2.0 * speed.powi(4));
        if second > 0.25 * first && second < 4.0 * first {
            second
        } else {
            first
        }
    }
}
