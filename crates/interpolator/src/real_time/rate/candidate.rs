//! The candidates, ramps that are tried, and how one is made to end on the grid of the frames.

use super::progress::Progress;
use crate::real_time::ramp::{Bounds, Ramp};

/// Stretching of the candidates, fast to slow: nearly in equal ratios, 1.25 to 1.6. A slower one takes less
/// of the limits, acceleration as its pace, jerk as the square of it.
pub(super) const PACES: [f64; 6] = [1.0, 0.8, 0.63, 0.5, 0.36, 0.22];

/// The highest steady rate below 1. Its cube makes up for .9 % of jerk, and a plan whose jerk is inside its limit may
/// have .88 % too much between its grid points: .52 % where jerk changes at two places of a period, .65 % at four,
/// .88 % anywhere.
pub(crate) const BESIDE_FULL: f64 = 0.997;

/// A rate that may be kept up: full, or so far below it that the plan's jerk between its grid
/// points is made up for.
pub(crate) fn beside_full(rate: f64) -> f64 {
    if rate < 1.0 {
        rate.min(BESIDE_FULL)
    } else {
        rate
    }
}

/// A ramp to try: which share of the way to the goal, and how fast.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) share: f64,
    pub(super) pace: f64,
}

/// Everything that is tried, best first.
pub(super) const CANDIDATES: [Candidate; 18] = {
    let mut all = [Candidate {
        share: 1.0,
        pace: PACES[0],
    }; 18];
    let mut i = 0;
    while i < PACES.len() {
        all[i].pace = PACES[i];
        i += 1;
    }
    let shares = [0.6, 0.3, 0.12, 0.04];
    while i < all.len() {
        all[i].share = shares[(i - PACES.len()) / 3];
        all[i].pace = PACES[(i - PACES.len()) % 3 * 2];
        i += 1;
    }
    all
};

/// What it costs to set up a candidate, and to stretch one from a slope, in samples. No measurement of them
/// is kept.
const SET_UP: u32 = 4;
const STRETCHING: u32 = 6;
/// Most refinements of a stretching, by regula falsi in the manner of Illinois.
const REFINEMENTS: u32 = 16;
/// The first guess of how much slower a ramp has to be, how fast that grows, and the most of it, at which
/// the tick gives this candidate up.
const SLOWER: f64 = 1.25;
const SLOWEST: f64 = 50.0;
/// How near to the grid a ramp must end, periods: from there on setpoints are frames, so this is a step in
/// position of that share of the way in a period.
const ON_GRID: f64 = 1e-10;

/// The rate at which a ramp ends that leads from `rate` a share of the way to a goal. Beside the full
/// rate it may take long to lose what leads back to the grid, but no more is lost by it than from a
/// lower rate: a period in each turn.
pub(super) fn partial_target(rate: f64, share: f64, goal: f64) -> f64 {
    if share >= 1.0 {
        return goal;
    }
    (rate + share * (goal - rate)).min(BESIDE_FULL)
}

/// A ramp from the present, if there is one of less than so many ticks; one to rate 1 ends on the
/// grid of the frames.
pub(super) fn ramp_to(
    now: &Progress,
    target: f64,
    bounds: Bounds,
    within: f64,
    budget: &mut u32,
) -> Option<Ramp> {
    let plan = |pace| Ramp::plan(now.rate, now.slope, target, bounds.paced(pace));
    *budget = budget.saturating_sub(SET_UP);
    let ramp = plan(1.0).filter(|ramp| ramp.duration() < within)?;
    if target < 1.0 {
        return Some(ramp);
    }
    // After n ticks, at rate 1 again, program time is fraction + n − loss: on a frame if fraction − loss is whole.
    let over = (now.time.fraction - ramp.loss()).rem_euclid(1.0);
    let wanted = ramp.loss() + if over > 1.0 - ON_GRID { 0.0 } else { over };
    let on_grid = if now.slope == 0.0 {
        // The same curve, stretched: so is the loss.
        plan(if wanted > 0.0 {
            ramp.loss() / wanted
        } else {
            1.0
        })?
    } else {
        *budget = budget.saturating_sub(STRETCHING);
        stretched(&ramp, wanted, plan)?
    };
    // If there is too little time left to lose, another tick will be nearer to the grid.
    let is_on_grid = (on_grid.loss() - wanted).abs() < ON_GRID;
    (is_on_grid && on_grid.duration() < within).then_some(on_grid)
}

/// The ramp, among those of all paces, that loses so much program time, no less than the one of
/// pace 1.
///
/// From a slope the curve is not just stretched, but the loss still grows nearly in proportion to
/// the stretching: the secant finds it in a few steps, between two ends that enclose it.
fn stretched(ramp: &Ramp, wanted: f64, plan: impl Fn(f64) -> Option<Ramp>) -> Option<Ramp> {
    let beyond = |stretching: f64| {
        let ramp = plan(1.0 / stretching)?;
        Some((ramp, ramp.loss() - wanted))
    };
    let (mut low, mut low_by) = (1.0, ramp.loss() - wanted);
    if low_by > -ON_GRID {
        return Some(*ramp);
    }
    let mut high = SLOWER;
    let (mut found, mut high_by) = beyond(high)?;
    while high_by < 0.0 {
        (low, low_by) = (high, high_by);
        high *= SLOWER;
        if high > SLOWEST {
            return None;
        }
        (found, high_by) = beyond(high)?;
    }
    let mut kept_low = false;
    for _ in 0..REFINEMENTS {
        let between = (low * high_by - high * low_by) / (high_by - low_by);
        let by;
        (found, by) = beyond(between)?;
        if by.abs() < 0.5 * ON_GRID {
            break;
        }
        // An end that stays twice counts half, so that it moves too.
        if by < 0.0 {
            (low, low_by) = (between, by);
            high_by *= if kept_low { 1.0 } else { 0.5 };
            kept_low = false;
        } else {
            (high, high_by) = (between, by);
            low_by *= if kept_low { 0.5 } else { 1.0 };
            kept_low = true;
        }
    }
    Some(found)
}
