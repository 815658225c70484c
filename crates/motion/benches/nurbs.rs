//! The benchmark of NURBS: evaluation per span, u(s), the three previews, whole plans. `cargo bench
//! -p glidepath-motion --bench nurbs`.
//!
//! Prints processor time for each call; for counts of instructions run it under `valgrind
//! --tool=callgrind` with `--count N`, which does N evaluations of the first kind and nothing
//! else.
#![allow(clippy::print_stdout, reason = "a measurement")]

#[path = "../tests/it/preview/curves.rs"]
mod curves;

use glidepath_geometry::NurbsPath;
use glidepath_motion::Planner;
use glidepath_motion::preview::{AdvanceRetreat, Certified, Demand, Method, Traditional, preview};
use glidepath_program::{
    Effort, Item, ItemKind, Limits, PathBounds, PathMode, Rate, Settings, Smoothing,
};
use std::hint::black_box;
use std::time::Instant;

/// Calls of what is short.
const CALLS: u32 = 1_000_000;

fn nanoseconds(calls: u32, mut call: impl FnMut(u32)) -> f64 {
    let start = Instant::now();
    for i in 0..calls {
        call(i);
    }
    start.elapsed().as_secs_f64() * 1e9 / f64::from(calls)
}

/// Spreads the calls over the curve, so that no branch is learnt.
fn share(i: u32) -> f64 {
    f64::from(i.wrapping_mul(2_654_435_761)) / f64::from(u32::MAX)
}

fn evaluation(name: &str, path: &NurbsPath) {
    let curve = path.curve();
    let (first, last) = curve.domain();
    let u = |i: u32| first + (last - first) * share(i);
    let jet = nanoseconds(CALLS, |i| {
        black_box(curve.jet(black_box(u(i))));
    });
    let speed = nanoseconds(CALLS, |i| {
        black_box(curve.speed(black_box(u(i))));
    });
    let by_s = nanoseconds(CALLS / 4, |i| {
        black_box(path.jet(black_box(path.length() * share(i))));
    });
    println!(
        "{name}: degree {}, {} spans: jet by u {jet:.0} ns, ds/du {speed:.0} ns, jet by s {by_s:.0} ns",
        curve.degree(),
        curve.spans().len()
    );
}

fn previews(name: &str, path: &NurbsPath) {
    let patent = AdvanceRetreat::default();
    let methods: [&dyn Method; 3] = [&Traditional, &patent, &Certified];
    for period_t in [0.001, 0.004] {
        let demand = Demand::chord(100.0, period_t, 0.001);
        for method in methods {
            let points = preview(path, &demand, method).points_evaluated;
            let ns = nanoseconds(100, |_| drop(black_box(preview(path, &demand, method))));
            println!(
                "{name} at {} ms, {}: {points} points, {:.1} µs, {:.0} mm/s of curve",
                period_t * 1e3,
                method.name(),
                ns / 1e3,
                path.length() / (ns * 1e-9)
            );
        }
    }
}

/// A whole plan: curve to frames.
fn plans(name: &str, path: &NurbsPath) {
    let mill = Limits::uniform(200.0, 2000.0, 40_000.0);
    let mut bounded = Limits::uniform(1e4, 1e5, 1e8);
    bounded.path = PathBounds {
        tangential_a: 1000.0,
        normal_a: 1000.0,
        jerk_j: 20_000.0,
    };
    for (kind, limits, tolerance_mm) in [
        ("limits of axes", mill, 0.02),
        ("limits of the path", bounded, 0.001),
    ] {
        let settings = Settings {
            limits,
            tolerance_mm,
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: glidepath_program::Corners::default(),
            period_t: 0.004,
            effort: Effort::Fast,
        };
        let spans = path.curve().spans().len() as f64;
        let cut_ns = nanoseconds(20, |_| {
            black_box(path.segments(1e-3 * tolerance_mm));
        });
        let mut frames = 0;
        let ns = nanoseconds(5, |_| frames = planned(path, settings));
        println!(
            "{name}, {kind}: cut in {:.1} µs a span, planned in {:.0} µs a span, {:.1} % of the \
             time of motion",
            cut_ns / spans / 1e3,
            ns / spans / 1e3,
            100.0 * ns * 1e-9 / (f64::from(frames) * settings.period_t)
        );
    }
}

fn planned(path: &NurbsPath, settings: Settings) -> u32 {
    let segments = path.segments(1e-3 * settings.tolerance_mm);
    let mut planner = Planner::new(settings, path.jet(0.0).position);
    for segment in segments {
        let kind = ItemKind::Move {
            segment,
            rate: Rate::Feed(100.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        // Pieces of a curve are accepted.
        let _ = planner.push(&Item {
            block: 0,
            line: 1,
            kind,
        });
    }
    planner.finish();
    let mut frames = 0;
    while let Ok(Some(frame)) = planner.pop_frame() {
        black_box(frame);
        frames += 1;
    }
    frames
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let count = arguments.iter().position(|a| a == "--count");
    let count = count.and_then(|at| arguments.get(at + 1)?.parse::<u32>().ok());
    let butterfly = curves::path("butterfly");
    if let Some(count) = count {
        for i in 0..count {
            black_box(butterfly.curve().jet(black_box(share(i))));
        }
        return;
    }
    for name in ["butterfly", "infinity", "helix3d"] {
        evaluation(name, &curves::path(name));
    }
    previews("butterfly", &butterfly);
    for name in ["butterfly", "helix3d"] {
        plans(name, &curves::path(name));
    }
}
