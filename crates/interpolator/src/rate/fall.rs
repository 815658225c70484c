//! Leaving a rate at which the plan is at its limits: tick by tick, as they allow.
//!
//! Where one axis or another is at a limit all the time, no ramp has room: its shape is settled
//! beforehand, and the limits leave a little now on this side, now on that. But how far the next
//! position may be moved along the path can be computed, and so what the next tick may do to the rate:
//!
//! ```text
//!   third difference     With the last step in program time d and the slope s, the next step is d + s′,
//!  +J ┄┄┄┄┄┄┄┄┄┄┄┄┄┄     and another slope s′ moves the next position by Q′·(s′ − s), and so all its
//!       ●   ●            differences. Every axis gives an interval of s′ for each of its limits; s′ has
//!  ─────────────────     to be in all of them. The positions prove it, as they do for ramps.
//!           ○   ○
//!  −J ┄┄┄┄┄┄┄┄┄┄┄┄┄┄
//! ```
//!
//! The steepest slope at every tick comes to where nothing is allowed. So a few ways are followed side
//! by side: one for each of a few slopes, of those that lead there the one with the least rate. The
//! steady rate is one more way, at every tick a new beginning. As soon as a way is steady at a rate
//! that is lower by a twentieth, ramps have room: there the plan takes 14 % less of the jerk.
//!
//! Four ways are enough: on near-optimal plans they lead down from wherever tens of thousands do, as a
//! search by brute force has shown.

use super::Scene;
use super::play::Cue;
use super::steps::Slopes;
use crate::ramp::Ramp;

/// The slopes, in parts of the steepest that the axes allow by themselves.
const SLOPES: [f64; 4] = [0.0, -0.25, -0.5, -1.0];
/// Ends at this part of the rate.
const ROOM: f64 = 0.95;
/// Part of an interval that a slope keeps away from its ends.
const INSIDE: f64 = 0.02;
/// What it costs to compute an interval and to follow a slope, and at most to follow all ways for a
/// tick, in samples of a ramp.
const INTERVAL: u32 = 3;
const SLOPE: u32 = 2;
const TICK: u32 = 30;

/// What a search has come to.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum Fallen {
    /// Steady at a lower rate.
    Lower(Cue, f64, Slopes),
    /// There was no time to go on.
    Open,
    /// The frames at hand do not last.
    Lost,
}

/// One way.
#[derive(Debug, Clone, Copy)]
struct Way {
    at: Cue,
    rate: f64,
    slope: f64,
    slopes: Slopes,
}

/// Ways down from a steady rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fall {
    steady: Way,
    /// For each slope the way that is nearest to it, if there is one.
    ways: [Option<Way>; SLOPES.len()],
    steepest: f64,
}

impl Fall {
    /// From a place where the rate is steady; the steepest slope is per tick.
    pub(super) const fn new(at: Cue, rate: f64, steepest: f64) -> Self {
        Self {
            steady: Way {
                at,
                rate,
                slope: 0.0,
                slopes: Slopes::new(0),
            },
            ways: [None; SLOPES.len()],
            steepest,
        }
    }

    /// Goes on until there is a lower steady rate, or until the budget is used up.
    pub(super) fn go_on(&mut self, scene: &Scene<'_>, budget: &mut u32) -> Fallen {
        while *budget >= TICK {
            let mut next = [None; SLOPES.len()];
            self.follow(&self.steady, &mut next, scene, budget);
            for way in self.ways.iter().flatten() {
                self.follow(way, &mut next, scene, budget);
            }
            self.ways = next;
            if !self.wait(scene, budget) {
                return Fallen::Lost;
            }
            let enough = ROOM * self.steady.rate;
            if let [Some(way), ..] = &self.ways
                && way.slope == 0.0
                && way.rate <= enough
            {
                return Fallen::Lower(way.at, way.rate, way.slopes);
            }
        }
        Fallen::Open
    }

    /// Where a way leads within a tick.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::float_cmp,
        reason = "kept in single precision; one that is the same need not be tried again"
    )]
    fn follow(
        &self,
        way: &Way,
        next: &mut [Option<Way>; SLOPES.len()],
        scene: &Scene<'_>,
        budget: &mut u32,
    ) {
        *budget = budget.saturating_sub(INTERVAL);
        let Some((lowest, highest)) = way.slopes_allowed(scene) else {
            return;
        };
        let mut last = f32::NAN;
        for part in SLOPES {
            let slope = (part * self.steepest).max(lowest).min(highest) as f32;
            // The steady rate goes on by itself.
            if slope == last || (slope == 0.0 && way.rate >= self.steady.rate) {
                continue;
            }
            last = slope;
            let Some(best) = next.get_mut(self.nearest(f64::from(slope))) else {
                continue;
            };
            let Some(ramp) = Ramp::tick_to(way.rate, way.slope, f64::from(slope)) else {
                continue;
            };
            if best.is_some_and(|best| best.rate <= ramp.target()) {
                continue;
            }
            *budget = budget.saturating_sub(SLOPE);
            if let Some(after) = way.after(&ramp, slope, scene) {
                *best = Some(after);
            }
        }
    }

    /// The place of the slope that is nearest to one.
    fn nearest(&self, slope: f64) -> usize {
        let parts = SLOPES.windows(2);
        parts
            .filter(|pair| slope < 0.5 * self.steepest * pair.iter().sum::<f64>())
            .count()
    }

    /// The steady rate goes on for a tick; false if it cannot.
    fn wait(&mut self, scene: &Scene<'_>, budget: &mut u32) -> bool {
        *budget = budget.saturating_sub(1);
        let Way {
            at, rate, slopes, ..
        } = &mut self.steady;
        at.time = at.time.after(*rate);
        slopes.in_ticks += 1;
        scene.track.take(at.time, &mut at.published, scene.allowed)
    }
}

impl Way {
    /// The slopes that the limits allow at the next tick, nearly.
    fn slopes_allowed(&self, scene: &Scene<'_>) -> Option<(f64, f64)> {
        let even = self.rate + 0.5 * self.slope;
        if even <= 0.0 {
            return None;
        }
        let (time, published) = (self.at.time.after(even), &self.at.published);
        let (low, high) = scene.track.room(time, published, scene.allowed)?;
        let (low, high) = (low.max(-even), high.min(1.0 - even));
        let inside = INSIDE * (high - low);
        (low <= high).then_some((self.slope + low + inside, self.slope + high - inside))
    }

    /// A tick later.
    fn after(&self, ramp: &Ramp, slope: f32, scene: &Scene<'_>) -> Option<Self> {
        let mut at = self.at;
        at.time = at.time.after(ramp.elapsed_at(1.0));
        if !scene.track.take(at.time, &mut at.published, scene.allowed) {
            return None;
        }
        Some(Self {
            at,
            rate: ramp.target(),
            slope: ramp.end_slope(),
            slopes: self.slopes.then(slope)?,
        })
    }
}
