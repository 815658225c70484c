//! The comparison of published and default methods side by side, ten laps of curves in parametric
//! and implicit form. The table: `cargo test -p glidepath-curve --test it table -- --nocapture`.

#![allow(clippy::unwrap_used, reason = "a test")]

use crate::support::*;
use glidepath_curve::implicit::ImplicitStepper;
use glidepath_curve::parametric::{Method, ParametricStepper};
use glidepath_curve::published::{Reading, linear_step};
use glidepath_curve::{ImplicitCurve, ParametricCurve};
use nalgebra::Vector3;
use std::f64::consts::TAU;

const LAPS: f64 = 10.0;

struct Case {
    name: &'static str,
    xyz: [&'static str; 3],
    fg: [&'static str; 2],
    start_t: f64,
    lap_t: f64,
}

const CASES: [Case; 5] = [
    Case {
        name: "Viviani",
        xyz: ["20*(1+cos(t))", "20*sin(t)", "40*sin(t/2)"],
        fg: ["x^2+y^2+z^2-1600", "(x-20)^2+y^2-400"],
        start_t: 1.5,
        lap_t: 2.0 * TAU,
    },
    Case {
        name: "plane, sphere",
        xyz: ["20*cos(t)", "20*sin(t)", "15"],
        fg: ["x^2+y^2+z^2-625", "z-15"],
        start_t: 0.0,
        lap_t: TAU,
    },
    Case {
        name: "cylinders",
        xyz: ["15*cos(t)", "15*sin(t)", "sqrt(400-225*sin(t)^2)"],
        fg: ["x^2+y^2-225", "y^2+z^2-400"],
        start_t: 0.0,
        lap_t: TAU,
    },
    Case {
        name: "ellipse",
        xyz: ["40*cos(t)", "15*sin(t)", "0"],
        fg: ["(x/40)^2+(y/15)^2-1", "z"],
        start_t: 0.0,
        lap_t: TAU,
    },
    Case {
        name: "helix",
        xyz: ["15*cos(t)", "15*sin(t)", "3*t"],
        fg: ["x-15*cos(z/3)", "y-15*sin(z/3)"],
        start_t: 0.0,
        lap_t: TAU,
    },
];

/// What ten laps came to.
#[derive(Default)]
struct Result {
    chords: u32,
    evaluations: u32,
    /// Largest distance from the curve.
    off_mm: f64,
    /// Largest difference of a chord from its length.
    uneven_mm: f64,
    is_lost: bool,
}

impl Result {
    fn text(&self) -> String {
        if self.is_lost {
            return format!("{:>8} {:>9}", "-", "lost");
        }
        let each = f64::from(self.evaluations) / f64::from(self.chords);
        format!("{each:8.2} {:9.1e}", self.off_mm)
    }

    fn count(&mut self, chord_mm: f64, length_mm: f64, evaluations: u32, off_mm: f64) {
        self.chords += 1;
        self.evaluations += evaluations;
        self.off_mm = self.off_mm.max(off_mm);
        self.uneven_mm = self.uneven_mm.max((length_mm - chord_mm).abs());
    }
}

fn parametric(case: &Case, chord: f64, method: Method) -> Result {
    let (curve, other) = (formulas(case.xyz), surfaces(case.fg));
    let mut stepper = ParametricStepper::new(&curve, case.start_t, method);
    let mut result = Result::default();
    loop {
        let from = stepper.local().point;
        let step = stepper
            .look(chord, case.start_t + LAPS * case.lap_t)
            .unwrap();
        if step.is_end {
            return result;
        }
        stepper.advance(&step);
        let point = step.local.point;
        // The other form of the curve is the judge.
        result.count(
            chord,
            (point - from).norm(),
            step.evaluations,
            other.residual_mm(&point),
        );
    }
}

/// The parameter of the point of a curve next to `p`, near a parameter, and the distance.
fn nearest(curve: &ParametricCurve, p: &Vector3<f64>, near_t: f64) -> (f64, f64) {
    let mut t = near_t;
    for _ in 0..20 {
        let at = curve.local(t);
        let out = at.point - p;
        t -= out.dot(&at.d1) / (at.d1.norm_squared() + out.dot(&at.d2));
    }
    (t, (curve.point(t) - p).norm())
}

/// The next point and the number of evaluations, from a point and a direction.
type Next<'a> = dyn FnMut(&Vector3<f64>, &Vector3<f64>) -> Option<(Vector3<f64>, u32)> + 'a;

fn implicit(case: &Case, chord: f64, next: &mut Next<'_>) -> Result {
    let judge = formulas(case.xyz);
    let start = judge.local(case.start_t);
    let (mut point, mut ahead, mut t) = (start.point, start.d1, case.start_t);
    let mut result = Result::default();
    while t < case.start_t + LAPS * case.lap_t {
        let Some((to, evaluations)) = next(&point, &ahead) else {
            result.is_lost = true;
            break;
        };
        let guess = t + chord / judge.local(t).d1.norm();
        let (there, off) = nearest(&judge, &to, guess);
        result.count(chord, (to - point).norm(), evaluations, off);
        // Backwards, or far off: not on this curve any more.
        if !(there > t && off < 5.0) {
            result.is_lost = true;
            break;
        }
        (ahead, point, t) = (to - point, to, there);
    }
    result
}

fn default_steps<'a>(curve: &'a ImplicitCurve, case: &Case, chord: f64) -> Box<Next<'a>> {
    let start = formulas(case.xyz).local(case.start_t);
    let mut stepper = ImplicitStepper::new(curve, start.point, &start.d1).unwrap();
    Box::new(move |_, _| {
        let step = stepper.look(chord).ok()?;
        stepper.advance(&step);
        Some((step.point, step.evaluations))
    })
}

fn linear_steps(curve: &ImplicitCurve, chord: f64, reading: Reading) -> Box<Next<'_>> {
    Box::new(move |point, ahead| Some((linear_step(curve, point, ahead, chord, reading)?, 1)))
}

#[test]
fn published_and_default_methods() {
    println!("evaluations per chord, largest distance from the curve in mm over {LAPS} laps");
    println!(
        "{:14} {:>5} | parametric: {:^18} | {:^18} | {:^18} | implicit: {:^18} | {:^18} | {:^18}",
        "curve", "chord", "bisection", "secant", "default", "tangent", "residual", "default"
    );
    for case in &CASES {
        let curve = surfaces(case.fg);
        for chord in [0.4, 2.0] {
            let by = |method| parametric(case, chord, method);
            let (bisection, secant, newton) = (
                by(Method::Bisection),
                by(Method::Secant),
                by(Method::Newton),
            );
            let tangent = implicit(
                case,
                chord,
                &mut *linear_steps(&curve, chord, Reading::Tangent),
            );
            let residual = implicit(
                case,
                chord,
                &mut *linear_steps(&curve, chord, Reading::Residual),
            );
            let corrected = implicit(case, chord, &mut *default_steps(&curve, case, chord));
            println!(
                "{:14} {chord:5} |             {} | {} | {} |           {} | {} | {}",
                case.name,
                bisection.text(),
                secant.text(),
                newton.text(),
                tangent.text(),
                residual.text(),
                corrected.text()
            );
            for result in [&bisection, &secant, &newton, &corrected] {
                assert!(!result.is_lost);
                assert!(result.off_mm <= 1e-9, "{}: {}", case.name, result.off_mm);
                assert!(
                    result.uneven_mm <= 1e-9,
                    "{}: {}",
                    case.name,
                    result.uneven_mm
                );
            }
            assert!(newton.evaluations * 8 < bisection.evaluations);
            // Four sagittas and more: no tolerance in which a part is cut.
            assert!(tangent.is_lost || tangent.off_mm > 100.0 * corrected.off_mm.max(1e-6));
            assert!(residual.is_lost || residual.off_mm > 100.0 * corrected.off_mm.max(1e-6));
        }
    }
}
