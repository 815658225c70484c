//! Cost of NURBS: evaluation per span, u(s), and the three previews.
//! `cargo bench -p glidepath-motion --bench nurbs`.
//!
//! Prints processor time for each call; for counts of instructions run it under
//! `valgrind --tool=callgrind` with `--count N`, which does N evaluations of the first kind and nothing
//! else.
#![allow(clippy::print_stdout, reason = "a measurement")]

#[path = "../tests/preview/curves.rs"]
mod curves;

use glidepath_geometry::NurbsPath;
use glidepath_motion::preview::{AdvanceRetreat, Certified, Demand, Method, Traditional, preview};
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
}
