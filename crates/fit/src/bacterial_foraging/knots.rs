//! Bacterial foraging on the knots.
//!
//! The variables are the logarithms of the gaps between knots, the control points come from least
//! squares. As long as the search succeeds, there is one knot less.

use super::colony::{Colony, forage};
use super::report::Foraging;
use crate::knots::{by_cost, without_one};
use crate::part::{Candidate, Part};
use crate::spline::inside;

/// A few bacteria for a few rounds: every value is a least-squares fit. A step of .3 is in logarithms of
/// gaps, all of them together: it does not depend on the length of the run. No measurement is kept.
const ON_KNOTS: Colony = Colony {
    bacteria: 8,
    chemotaxis: 15,
    swims: 4,
    reproductions: 2,
    dispersals: 1,
    dispersal_chance: 0.25,
    step: 0.3,
    shrink: 0.7,
};

pub(crate) fn on_knots(
    part: &Part,
    placed: Candidate,
    seed: u64,
    progress: &mut dyn FnMut(f64),
) -> (Candidate, Option<Foraging>) {
    let (start_mm2, start_max_mm) = part.residual(&placed.spline);
    let mut search = Foraging {
        iterations: 0,
        evaluations: 0,
        start_mm2,
        least_squares_mm2: start_mm2,
        least_squares_max_mm: start_max_mm,
    };
    let mut best = placed;
    let mut tries = 0_u64;
    while !inside(&best.spline.knots).is_empty() {
        let Some(next) = one_less(part, &best, seed.wrapping_add(tries), &mut search) else {
            break;
        };
        best = next;
        while let Some(next) = without_one(part, &best) {
            best = next;
        }
        tries += 1;
        // How many knots will go is not known: every one that went, half of what was left.
        progress(1.0 - 0.5_f64.powi(i32::try_from(tries).unwrap_or(i32::MAX)));
    }
    (best, Some(search))
}

/// Without the cheapest knot, the others moved so that the fit is within the tolerance; none if the
/// search fails.
fn one_less(part: &Part, from: &Candidate, seed: u64, search: &mut Foraging) -> Option<Candidate> {
    let mut stay = inside(&from.spline.knots).to_vec();
    stay.remove(*by_cost(from).first()?);
    let start = logarithms(&stay, part.length());
    let mut found = None;
    let mut value = |at: &[f64]| {
        let knots = from_logarithms(at, part.length());
        let Some(candidate) = part.fit(&knots) else {
            return f64::INFINITY;
        };
        if candidate.max_mm() <= part.tolerance_mm {
            found = Some(candidate);
            return f64::NEG_INFINITY;
        }
        // Not the largest error, which is flat wherever another point is the worst: the cube still counts
        // most what is out of tolerance, and sums up, so that every step tells something.
        let cube = |error: &f64| (error / part.tolerance_mm).powi(3);
        candidate.errors_mm.iter().map(cube).sum()
    };
    let outcome = forage(&start, ON_KNOTS, seed, &mut value, &mut |_| {});
    search.iterations += outcome.history.len() as u64;
    search.evaluations += outcome.evaluations;
    found
}

/// Gaps by their logarithms stay above zero whatever step is taken; their sum is brought to the length
/// again ([`from_logarithms`]), so one direction of the search changes nothing.
fn logarithms(inside: &[f64], length: f64) -> Vec<f64> {
    let mut from = 0.0;
    inside
        .iter()
        .chain([&length])
        .map(|to| {
            let gap = to - from;
            from = *to;
            gap.ln()
        })
        .collect()
}

fn from_logarithms(gaps: &[f64], length: f64) -> Vec<f64> {
    let total: f64 = gaps.iter().map(|gap| gap.exp()).sum();
    let mut sum = 0.0;
    gaps[..gaps.len() - 1]
        .iter()
        .map(|gap| {
            sum += gap.exp();
            length * sum / total
        })
        .collect()
}
