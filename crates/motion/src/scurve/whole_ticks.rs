//! The published way to plan a speed change in whole periods, for comparison.
//!
//! Gu, Zhou, Lin et al. plan the seven phases period by period and plan again where the speed would
//! exceed its limit: (1) take a period at the jerk of the phase; (2) where, after it, the
//! acceleration could not be brought to zero below the limit, go back by that period; (3) turn to
//! the opposite jerk, or the smallest that brings the acceleration to zero within a period; (4)
//! check again, and repeat. As the phases last whole periods, the speed reached falls short of the
//! limit: by a few percent on average at 4 ms, in proportion to the period. [`super::Profile`] has
//! the peak speed in closed form and reaches the limit; nothing here is used by the planner.

use super::ramp::PathLimits;

/// A speed change in whole periods.
#[derive(Debug, Clone, PartialEq)]
pub struct WholeTicks {
    /// The jerk in each period, mm/s³.
    pub jerks_j: Vec<f64>,
    /// The speed at the end, mm/s.
    pub peak_v: f64,
    /// Periods that were planned and taken back.
    pub taken_back: u32,
}

/// Most periods of a speed change.
const MOST_TICKS: usize = 1_000_000;

/// Speeds up from `entry_v` towards `top_v` ≥ `entry_v` in whole periods, as published.
#[must_use]
pub fn speed_up_in_whole_ticks(
    entry_v: f64,
    top_v: f64,
    limits: PathLimits,
    period_t: f64,
) -> WholeTicks {
    let PathLimits { accel_a, jerk_j } = limits;
    let mut plan = WholeTicks {
        jerks_j: Vec::new(),
        peak_v: entry_v,
        taken_back: 0,
    };
    let (mut v, mut a) = (entry_v, 0.0);
    let after =
        |v: f64, a: f64, j: f64| (v + period_t * (a + 0.5 * period_t * j), a + period_t * j);
    // The speed once the acceleration is brought to zero, in whole periods.
    let settled_v = |mut v: f64, mut a: f64| {
        while a > 0.0 {
            (v, a) = after(v, a, -jerk_j.min(a / period_t));
        }
        v
    };
    let mut is_rising = true;
    while plan.jerks_j.len() < MOST_TICKS {
        let j = if is_rising {
            jerk_j.min((accel_a - a) / period_t).max(0.0)
        } else {
            -jerk_j.min(a / period_t)
        };
        let (next_v, next_a) = after(v, a, j);
        if is_rising && settled_v(next_v, next_a) > top_v {
            plan.taken_back += 1;
            is_rising = false;
            continue;
        }
        if !is_rising && a <= 0.0 {
            break;
        }
        (v, a) = (next_v, next_a);
        plan.jerks_j.push(j);
    }
    plan.peak_v = v;
    plan
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scurve::profile::Profile;

    /// Mean and worst shortfall of the peak speed, relative, over a grid of speeds and limits.
    fn shortfall(period_t: f64) -> (f64, f64) {
        let (mut sum, mut worst, mut count) = (0.0, 0.0_f64, 0.0);
        for top_v in [10.0, 17.0, 31.0, 50.0, 73.0, 100.0] {
            for accel_a in [500.0, 1000.0, 2000.0] {
                for jerk_j in [10_000.0, 20_000.0, 60_000.0] {
                    for entry_r in [0.0, 0.1, 0.3, 0.5] {
                        let limits = PathLimits { accel_a, jerk_j };
                        let entry_v = entry_r * top_v;
                        let plan = speed_up_in_whole_ticks(entry_v, top_v, limits, period_t);
                        assert!(plan.peak_v <= top_v, "{plan:?}");
                        assert!(plan.taken_back == 1 && plan.peak_v >= entry_v);
                        let (mut v, mut a) = (entry_v, 0.0_f64);
                        for j in &plan.jerks_j {
                            assert!(j.abs() <= jerk_j * (1.0 + 1e-12));
                            v += period_t * (a + 0.5 * period_t * j);
                            a += period_t * j;
                            assert!(a <= accel_a * (1.0 + 1e-12) && a > -1e-9);
                        }
                        assert!(a.abs() < 1e-9 && (v - plan.peak_v).abs() < 1e-9);
                        let short_r = (top_v - plan.peak_v) / top_v;
                        (sum, worst, count) = (sum + short_r, worst.max(short_r), count + 1.0);
                        // The closed form reaches the limit.
                        let profile = Profile::new(entry_v, entry_v, 1e4, top_v, limits);
                        let peak_v = profile.map(|profile| profile.peak_v());
                        assert!(peak_v.is_some_and(|v| (v - top_v).abs() < 1e-9 * top_v));
                    }
                }
            }
        }
        (sum / count, worst)
    }

    #[test]
    fn whole_periods_fall_short_of_the_limit_in_proportion_to_the_period() {
        let (fine, fine_worst) = shortfall(0.001);
        let (coarse, coarse_worst) = shortfall(0.004);
        assert!((0.002..0.03).contains(&fine), "{fine} {fine_worst}");
        assert!((0.015..0.1).contains(&coarse), "{coarse} {coarse_worst}");
        assert!((2.5..6.0).contains(&(coarse / fine)), "{}", coarse / fine);
        assert!(coarse_worst > 0.08 && coarse_worst < 0.5, "{coarse_worst}");
    }
}
