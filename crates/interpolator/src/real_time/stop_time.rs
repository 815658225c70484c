//! The time that a stop takes from the speed at a frame, from which the bounds of ramps are worked
//! out.

use crate::real_time::pairs::{self, PAIRS, Pair, larger};
use glidepath_program::Limits;

/// How many ticks it takes to lose the speed at a frame: at the acceleration limit, V/(A·T), and, squared,
/// at the jerk limit, V/(J·T²). One over them is what slope and bend of the rate may be. The slowest axis
/// counts.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct StopTime {
    pub(crate) by_acceleration: f64,
    pub(crate) by_jerk_squared: f64,
}

impl StopTime {
    /// The longer of both.
    pub(crate) const fn longer(self, other: Self) -> Self {
        Self {
            by_acceleration: larger(self.by_acceleration, other.by_acceleration),
            by_jerk_squared: larger(self.by_jerk_squared, other.by_jerk_squared),
        }
    }
}

/// What limits the time to stop: acceleration and jerk, of the pairs of axes that have limits.
#[derive(Debug)]
pub(crate) struct StopLimits {
    pairs: [[Pair; 2]; PAIRS],
    used: usize,
}

impl StopLimits {
    pub(crate) fn new(limits: &Limits) -> Self {
        let both =
            pairs::pairs(limits.acceleration.as_slice()).zip(pairs::pairs(limits.jerk.as_slice()));
        let mut all = [[[f64::INFINITY; 2]; 2]; PAIRS];
        for (slot, (acceleration, jerk)) in all.iter_mut().zip(both) {
            *slot = [acceleration, jerk];
        }
        Self {
            pairs: all,
            used: pairs::in_use(limits),
        }
    }

    /// From so much velocity of the axes, or of joints in their place.
    pub(crate) fn stop_time(&self, velocity: &[f64], period_t: f64) -> StopTime {
        let (mut by_acceleration, mut by_jerk) = ([0.0; 2], [0.0; 2]);
        let used = self.pairs.iter().take(self.used);
        for (velocity, [acceleration, jerk]) in pairs::pairs(velocity).zip(used) {
            // Where there is no second axis that is not a number, and less than any.
            let part = |limit: &Pair| pairs::zip(velocity, *limit, |v, limit| v.abs() / limit);
            by_acceleration = pairs::zip(part(acceleration), by_acceleration, larger);
            by_jerk = pairs::zip(part(jerk), by_jerk, larger);
        }
        let most = |[one, other]: Pair| larger(one, other);
        StopTime {
            by_acceleration: most(by_acceleration) / period_t,
            by_jerk_squared: most(by_jerk) / (period_t * period_t),
        }
    }
}
