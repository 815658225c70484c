//! Fits of the butterfly and a circle, with the figures of `glidepath_fit`'s documentation.
#![allow(clippy::print_stdout, reason = "a command that prints")]

#[path = "../tests/samples/mod.rs"]
mod samples;

use glidepath_fit::{Method, Settings, fit};
use std::time::Instant;

fn main() {
    let runs = [
        ("butterfly", samples::curve("butterfly", 0.1), 0.010),
        ("butterfly", samples::curve("butterfly", 0.1), 0.002),
        ("butterfly", samples::curve("butterfly", 0.05), 0.010),
        ("butterfly", samples::curve("butterfly", 0.05), 0.002),
        ("circle", samples::circle(50.0, 0.1), 0.001),
    ];
    let methods = std::env::args().skip(1).count();
    for (name, points, tolerance_mm) in runs {
        for method in [Method::LeastSquares, Method::Hybrid, Method::Foraging] {
            if method != Method::LeastSquares && methods == 0 {
                continue;
            }
            let settings = Settings {
                method,
                ..Settings::new(tolerance_mm)
            };
            let start = Instant::now();
            match fit(&points, &settings, &mut |_| {}) {
                Ok(fit) => {
                    println!(
                        "{name} {} points, {tolerance_mm} mm, {method:?}: {} control points, {:.6} and {:.6} mm, {:.3} s",
                        points.len(),
                        fit.curve.control_points().len(),
                        fit.deviation.points_to_curve_mm,
                        fit.deviation.curve_to_points_mm,
                        start.elapsed().as_secs_f64(),
                    );
                    for part in &fit.parts {
                        println!("    {part:?}");
                    }
                }
                Err(error) => println!("{name}: {error}"),
            }
        }
    }
}
