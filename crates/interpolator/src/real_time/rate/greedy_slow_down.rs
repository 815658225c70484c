//! The greedy slow-down: leaving a rate at which the plan is at its limits, tick by tick, as they allow.
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
//! least rate. The steady rate is one more branch, at every tick a new beginning: a slow-down finds
//! what begins later than it does, too. As soon as a branch is lower by a twentieth, a ramp to rest
//! is tried from the lowest one at every tick: at a rate of 0.95 the plan takes 14 % less of the
//! jerk.
//!
//! ```text
//!   r                                    trail, a column for each tick: the slope that led to each
//!   1 ──┬────┬────┬──────── steady         branch, and from which. A branch does not know its past;
//!        ╲    ╲    ╲╲                      once it is at rest its slopes are read backward.
//!         ╲    ╳     ╲ ╲___
//!          ╲  ╱ ╲     ╲     ╲  ramp
//! ```
//!
//! Eight branches find nearly what hundreds do.

use super::kept_stop::{KeptSlowDown, SlowDownSlopes, TICKS};
use super::play::{PlaybackPosition, Playthrough, PlaythroughOutcome};
use super::situation::{SET_UP, Situation};
use crate::real_time::ramp::Ramp;

/// The slopes, as shares of the steepest that the axes allow by themselves: close to each other where
/// they are small, as those are that a plan at its limits leaves room for. There is a branch for each, so
/// the work of a tick grows with their number twice, branches times slopes; hundreds find hardly more.
const SLOPES: [f64; 8] = [0.0, -0.05, -0.1, -0.2, -0.35, -0.5, -0.75, -1.0];
/// The steepest slope is looked up at every so many ticks: it is the longest stop time of as many frames as a
/// stop takes, which hardly changes from one tick to the next.
const STEEPEST_EVERY: usize = 4;
/// From this share of the rate on ramps to rest are tried, with one pace after the other. Of the paces no
/// measurement is kept.
const ROOM: f64 = 0.95;
const PACES: [f64; 3] = [1.0, 0.7, 0.45];
/// Share of an interval that a slope keeps away from its ends. The interval is of first order in the slope:
/// at its very ends the position that is played may be outside.
const INSIDE: f64 = 0.02;
/// What it costs to compute an interval and to follow a slope, and about the least to follow all
/// branches for a tick, in samples of a ramp: the first needs velocities beside positions. No measurement
/// of them is kept.
const INTERVAL: u32 = 3;
const SLOPE: u32 = 2;
const TICK: u32 = 30;

/// What a slow-down has come to.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum SlowDownOutcome {
    /// A stop is known: with this ramp at the end of the way down.
    Rest(Ramp),
    /// There was no time to go on.
    Open,
    /// The frames at hand do not last.
    Lost,
}

/// One way down, as far as it has come.
#[derive(Debug, Clone, Copy)]
struct Branch {
    at: PlaybackPosition,
    rate: f64,
    slope: f64,
}

/// For each slope the branch that is nearest to it, if there is one.
type Branches = [Option<Branch>; SLOPES.len()];

/// The branches down from a steady rate.
#[derive(Debug)]
pub(super) struct GreedySlowDown {
    /// The steady rate, as long as there are frames for it.
    steady: Option<Branch>,
    /// What it is.
    rate: f64,
    branches: Branches,
    steepest: f64,
    /// Ticks since the beginning.
    ticks: usize,
    /// For each tick, how the branches got where they were after it.
    trail: Box<[[Footprint; SLOPES.len()]]>,
    /// The ramp to rest that is tried, and the branch it is to end.
    last: Option<(Playthrough, usize)>,
    /// How many ramps to rest were tried.
    tried: usize,
}

/// How a branch got where it is.
#[derive(Debug, Clone, Copy)]
struct Footprint {
    slope: f32,
    /// The branch a tick before, or [`STEADY`].
    from: u8,
}

/// In place of a branch: the steady rate.
const STEADY: u8 = u8::MAX;

impl GreedySlowDown {
    /// A slow-down that has not begun. Allocates all it will ever use.
    pub(super) fn new() -> Self {
        let none = Footprint {
            slope: 0.0,
            from: STEADY,
        };
        Self {
            steady: None,
            rate: 0.0,
            branches: [None; SLOPES.len()],
            steepest: 0.0,
            ticks: 0,
            trail: vec![[none; SLOPES.len()]; TICKS].into_boxed_slice(),
            last: None,
            tried: 0,
        }
    }

    /// Begins anew, where the rate is steady.
    pub(super) const fn begin(&mut self, at: PlaybackPosition, rate: f64) {
        self.steady = Some(Branch {
            at,
            rate,
            slope: 0.0,
        });
        self.rate = rate;
        self.branches = [None; SLOPES.len()];
        (self.ticks, self.last, self.tried) = (0, None, 0);
    }

    /// Goes on until there is a way to rest, or until the budget is used up.
    pub(super) fn go_on(&mut self, situation: &Situation<'_>, budget: &mut u32) -> SlowDownOutcome {
        while *budget >= TICK {
            if let Some((playthrough, _)) = &mut self.last {
                match playthrough.go_on(situation.track, situation.allowed, budget) {
                    PlaythroughOutcome::Passed(_) => {
                        return SlowDownOutcome::Rest(*playthrough.ramp());
                    }
                    PlaythroughOutcome::Barred => self.last = None,
                    PlaythroughOutcome::OutOfBudget => break,
                }
            }
            if !self.go_down(situation, budget) {
                return SlowDownOutcome::Lost;
            }
            self.turn_to_rest(situation, budget);
        }
        SlowDownOutcome::Open
    }

    /// All branches go on for a tick, and so does the steady rate; false if it cannot.
    fn go_down(&mut self, situation: &Situation<'_>, budget: &mut u32) -> bool {
        if self.ticks >= TICKS {
            return false;
        }
        if self.ticks.is_multiple_of(STEEPEST_EVERY) {
            let branches = self.branches.iter().flatten();
            let Some(branch) = self.steady.iter().chain(branches).next() else {
                return false;
            };
            let bounds = situation.fastest_from(branch.at.time.sequence);
            self.steepest = bounds.alpha;
        }
        let mut next = [None; SLOPES.len()];
        if let Some(steady) = self.steady {
            self.follow(&steady, STEADY, &mut next, situation, budget);
            *budget = budget.saturating_sub(1);
            self.steady = steady.wait(situation);
        }
        let branches = self.branches;
        for (branch, from) in branches.iter().zip(0..) {
            if let Some(branch) = branch {
                self.follow(branch, from, &mut next, situation, budget);
            }
        }
        self.branches = next;
        self.ticks += 1;
        self.steady.is_some() || next.iter().any(Option::is_some)
    }

    /// Begins with a ramp to rest from the lowest branch that one leads to rest from, if that is low
    /// enough.
    fn turn_to_rest(&mut self, situation: &Situation<'_>, budget: &mut u32) {
        let enough = ROOM * self.rate;
        let low = |branch: &Branch| branch.rate <= enough;
        let Some(any) = self.branches.iter().flatten().find(|b| low(b)) else {
            return;
        };
        *budget = budget.saturating_sub(SET_UP);
        let pace = PACES.get(self.tried % PACES.len()).unwrap_or(&1.0);
        self.tried += 1;
        let bounds = situation.fastest_from(any.at.time.sequence).paced(*pace);
        let ramps = self.branches.iter().enumerate().filter_map(|(i, branch)| {
            let branch = branch.as_ref().filter(|branch| low(branch))?;
            let ramp = Ramp::plan(branch.rate, branch.slope, 0.0, bounds)?;
            Some((i, branch, ramp))
        });
        let lowest = ramps.min_by(|(_, a, _), (_, b, _)| a.rate.total_cmp(&b.rate));
        self.last = lowest.map(|(i, branch, ramp)| (Playthrough::new(ramp, branch.at), i));
    }

    /// Writes the slopes down that lead to the last ramp.
    pub(super) fn write(&self, slopes: &mut SlowDownSlopes) -> KeptSlowDown {
        let end = self.last.as_ref().map_or(0, |(_, branch)| *branch);
        let len = self.steps_back(end).count();
        let first = u32::try_from(self.ticks - len).unwrap_or(u32::MAX);
        let len = u16::try_from(len).unwrap_or(u16::MAX);
        slopes.write_back(first, len, self.steps_back(end))
    }

    /// The slopes that led to a branch, the last one first.
    fn steps_back(&self, branch: usize) -> impl Iterator<Item = f32> {
        let mut branch = Some(branch);
        self.trail
            .iter()
            .take(self.ticks)
            .rev()
            .map_while(move |tick| {
                let Footprint { slope, from } = *tick.get(branch?)?;
                branch = (from != STEADY).then_some(usize::from(from));
                Some(slope)
            })
    }

    /// Where a branch leads within a tick.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::float_cmp,
        reason = "kept in single precision; one that is the same need not be tried again"
    )]
    fn follow(
        &mut self,
        branch: &Branch,
        from: u8,
        next: &mut Branches,
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
            if slope == last || (slope == 0.0 && branch.rate >= self.rate) {
                continue;
            }
            last = slope;
            let nearest = self.nearest(f64::from(slope));
            let Some(best) = next.get_mut(nearest) else {
                continue;
            };
            let Some(ramp) = Ramp::tick_to(branch.rate, branch.slope, f64::from(slope)) else {
                continue;
            };
            // As in dynamic programming, of branches with about the same slope only the lowest goes on; the
            // places on the path that they have come to are taken to be alike.
            if best.is_some_and(|best| best.rate <= ramp.target()) {
                continue;
            }
            *budget = budget.saturating_sub(SLOPE);
            let Some(after) = branch.after(&ramp, situation) else {
                continue;
            };
            *best = Some(after);
            let tick = self.trail.get_mut(self.ticks);
            if let Some(footprint) = tick.and_then(|tick| tick.get_mut(nearest)) {
                *footprint = Footprint { slope, from };
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
}

impl Branch {
    /// The slopes that the limits allow at the next tick, nearly.
    fn slopes_allowed(&self, situation: &Situation<'_>) -> Option<(f64, f64)> {
        // The step in program time if the slope does not change. Rates are those between two steps, so half
        // of a slope is still to come ([`Ramp::tick_to`]).
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

    /// A tick later, at a steady rate; `None` beyond the frames at hand.
    fn wait(mut self, situation: &Situation<'_>) -> Option<Self> {
        let Situation { track, allowed, .. } = situation;
        self.at.go_on(self.rate, track, allowed).then_some(self)
    }

    /// A tick later.
    fn after(&self, ramp: &Ramp, situation: &Situation<'_>) -> Option<Self> {
        let mut at = self.at;
        let passes = at.go_on(ramp.elapsed_at(1.0), situation.track, situation.allowed);
        passes.then_some(Self {
            at,
            rate: ramp.target(),
            slope: ramp.end_slope(),
        })
    }
}
