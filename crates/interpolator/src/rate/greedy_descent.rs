//! Leaving a rate at which the plan is at its limits: tick by tick, as they allow.
//!
//! Where one axis or another is at a limit all the time, no ramp has room: its shape is settled
//! beforehand, and the limits leave a little now on this side, now on that. But how far the next
//! position may be moved along the path can be computed, and so what the next tick may do to the
//! rate:
//!
//! ```text
//!   third difference     With the last step in program time d and the slope s, the next step is
//!  +J ┄┄┄┄┄┄┄┄┄┄┄┄┄┄     d + s′, and another slope s′ moves the next position by Q′·(s′ − s), and
//!       ●   ●            so all its differences. Every axis gives an interval of s′ for each of its
//!  ─────────────────     limits; s′ has to be in all of them. The positions prove it, as they do
//!           ○   ○        for ramps.
//!  −J ┄┄┄┄┄┄┄┄┄┄┄┄┄┄
//! ```
//!
//! The steepest slope at every tick comes to where nothing is allowed. So a few branches are
//! followed side by side: one for each of a few slopes, of those that lead there the one with the
//! least rate. The steady rate is one more branch, at every tick a new beginning. As soon as a
//! branch is steady at a rate that is lower by a twentieth, ramps have room: there the plan takes
//! 14 % less of the jerk.
//!
//! Four branches are enough: on near-optimal plans they lead down from wherever tens of thousands
//! do, as a search by brute force has shown.

use super::kept_stop::DescentSlopes;
use super::play::Cue;
use super::situation::Situation;
use crate::ramp::Ramp;

/// The slopes, as shares of the steepest that the axes allow by themselves.
const SLOPES: [f64; 4] = [0.0, -0.25, -0.5, -1.0];
/// The descent ends at this share of the rate it set out from.
const ROOM: f64 = 0.95;
/// Share of an interval that a slope keeps away from its ends.
const INSIDE: f64 = 0.02;
/// What it costs to compute an interval and to follow a slope, and at most to follow all branches
/// for a tick, in samples of a ramp.
const INTERVAL: u32 = 3;
const SLOPE: u32 = 2;
const TICK: u32 = 30;

/// What a descent has come to.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum DescentOutcome {
    /// Steady at a lower rate.
    Lower(Cue, f64, DescentSlopes),
    /// There was no time to go on.
    Open,
    /// The frames at hand do not last.
    Lost,
}

/// One way down: where it has come to, and the slopes that led there.
#[derive(Debug, Clone, Copy)]
struct Branch {
    at: Cue,
    rate: f64,
    slope: f64,
    slopes: DescentSlopes,
}

/// The branches down from a steady rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct GreedyDescent {
    steady: Branch,
    /// For each slope the branch that is nearest to it, if there is one.
    branches: [Option<Branch>; SLOPES.len()],
    steepest: f64,
}

impl GreedyDescent {
    /// A descent from where the rate is steady; the steepest slope is per tick.
    pub(super) const fn new(at: Cue, rate: f64, steepest: f64) -> Self {
        Self {
            steady: Branch {
                at,
                rate,
                slope: 0.0,
                slopes: DescentSlopes::new(0),
            },
            branches: [None; SLOPES.len()],
            steepest,
        }
    }

    /// Goes on until there is a lower steady rate, or until the budget is used up.
    pub(super) fn go_on(&mut self, situation: &Situation<'_>, budget: &mut u32) -> DescentOutcome {
        while *budget >= TICK {
            let mut next = [None; SLOPES.len()];
            self.follow(&self.steady, &mut next, situation, budget);
            for branch in self.branches.iter().flatten() {
                self.follow(branch, &mut next, situation, budget);
            }
            self.branches = next;
            if !self.wait(situation, budget) {
                return DescentOutcome::Lost;
            }
            let enough = ROOM * self.steady.rate;
            if let [Some(branch), ..] = &self.branches
                && branch.slope == 0.0
                && branch.rate <= enough
            {
                return DescentOutcome::Lower(branch.at, branch.rate, branch.slopes);
            }
        }
        DescentOutcome::Open
    }

    /// Where a branch leads within a tick.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::float_cmp,
        reason = "kept in single precision; one that is the same need not be tried again"
    )]
    fn follow(
        &self,
        branch: &Branch,
        next: &mut [Option<Branch>; SLOPES.len()],
        situation: &Situation<'_>,
        budget: &mut u32,
    ) {
        *budget = budget.saturating_sub(INTERVAL);
        let Some((lowest, highest)) = branch.slopes_allowed(situation) else {
            return;
        };
        let mut last = f32::NAN;
        for share in SLOPES {
            let slope = (share * self.steepest).max(lowest).min(highest) as f32;
            // The steady rate goes on by itself.
            if slope == last || (slope == 0.0 && branch.rate >= self.steady.rate) {
                continue;
            }
            last = slope;
            let Some(best) = next.get_mut(self.nearest(f64::from(slope))) else {
                continue;
            };
            let Some(ramp) = Ramp::tick_to(branch.rate, branch.slope, f64::from(slope)) else {
                continue;
            };
            if best.is_some_and(|best| best.rate <= ramp.target()) {
                continue;
            }
            *budget = budget.saturating_sub(SLOPE);
            if let Some(after) = branch.after(&ramp, slope, situation) {
                *best = Some(after);
            }
        }
    }

    /// The index of the slope in [`SLOPES`] that is nearest to one.
    fn nearest(&self, slope: f64) -> usize {
        let neighbours = SLOPES.windows(2);
        neighbours
            .filter(|pair| slope < 0.5 * self.steepest * pair.iter().sum::<f64>())
            .count()
    }

    /// The steady rate goes on for a tick; false if it cannot.
    fn wait(&mut self, situation: &Situation<'_>, budget: &mut u32) -> bool {
        *budget = budget.saturating_sub(1);
        let Branch {
            at, rate, slopes, ..
        } = &mut self.steady;
        at.time = at.time.after(*rate);
        slopes.in_ticks += 1;
        situation
            .track
            .append_to(&mut at.published, at.time, situation.allowed)
    }
}

impl Branch {
    /// The slopes that the limits allow at the next tick, nearly.
    fn slopes_allowed(&self, situation: &Situation<'_>) -> Option<(f64, f64)> {
        let even = self.rate + 0.5 * self.slope;
        if even <= 0.0 {
            return None;
        }
        let (time, published) = (self.at.time.after(even), &self.at.published);
        let (low, high) = situation.track.room(time, published, situation.allowed)?;
        let (low, high) = (low.max(-even), high.min(1.0 - even));
        let inside = INSIDE * (high - low);
        (low <= high).then_some((self.slope + low + inside, self.slope + high - inside))
    }

    /// A tick later.
    fn after(&self, ramp: &Ramp, slope: f32, situation: &Situation<'_>) -> Option<Self> {
        let mut at = self.at;
        at.time = at.time.after(ramp.elapsed_at(1.0));
        if !situation
            .track
            .append_to(&mut at.published, at.time, situation.allowed)
        {
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
