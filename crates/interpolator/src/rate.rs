//! The rate of program time: hold, resume and override without breaking a limit.
//!
//! Every tick, program time advances by the rate r, 0 ≤ r ≤ 1, in periods. With Q the planned
//! motion, the published one has
//!
//! ```text
//! q′ = Q′ r      q″ = Q″ r² + Q′ ṙ      q‴ = Q‴ r³ + 3 Q″ r ṙ + Q′ r̈
//! ```
//!
//! so a change of r costs acceleration and jerk on top of the plan's own, and the plan may be at its
//! limit, for a while or (time-optimal plans) most of the time. No bound on ṙ and r̈ that is computed
//! from the present alone is therefore safe: the rate may start to fall where there is room, and
//! then find that it cannot be released where there is none.
//!
//! The way out is that the future is known. A change of the rate is a [`Ramp`] from the present rate
//! and slope to another steady rate. Before a ramp is chosen it is *played through* on the frames at
//! hand: the positions it would publish are computed, tick by tick to three ticks past its end, and
//! their differences compared with the limits. Only a ramp that passes is committed, and a committed
//! ramp is followed until a better one passes. Hence the invariant that makes this safe: **at every
//! tick, following what is committed breaks no limit and needs no frame that is not here.** Doing
//! nothing is always possible; a steady rate r ≤ 1 is inside the limits because the plan is.
//!
//! What is tried, in this order, until one passes or the tick's budget of samples is used up (the
//! next tick then goes on from there):
//!
//! * ramps to the goal, fast to slow: the fastest bends to what the axes allow at the highest speed
//!   ahead, as if the plan itself took nothing; the others are the same stretched in time;
//! * ramps part of the way. At r < 1 the plan takes only r³ of the jerk it was given: once a little
//!   slower, there is room to go on. This is what gets away from a plan at its limits.
//!
//! While the rate is on its way by a slow or a partial ramp, faster ones are tried at every tick.
//! Most candidates fail in their first samples, so a tick rarely uses its budget.
//!
//! Where nothing passes the rate stays and the next tick tries again from another place: a plan that
//! brakes at its limits cannot be made to brake harder, but it will be slow soon. If that goes on
//! for [`PATIENCE_T`] or frames run out, the stop must not wait for ever: then limits are relaxed,
//! a little at first, and the excess is counted and reported.
//!
//! A ramp to rate 1 is stretched so that it ends on the grid of the frames: from there on the
//! setpoints are the frames, bit for bit.

use crate::differences::{Allowed, Differences};
use crate::program_time::ProgramTime;
use crate::ramp::{Bounds, Instant, Ramp};
use crate::track::Track;

/// Stretching of the candidates, fast to slow.
const PACES: [f64; 6] = [1.0, 0.8, 0.63, 0.5, 0.36, 0.22];

/// A ramp to try: how much of the way to the goal, and how fast.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    part: f64,
    pace: f64,
}

/// Everything that is tried, best first.
const CANDIDATES: [Candidate; 18] = {
    let mut all = [Candidate {
        part: 1.0,
        pace: PACES[0],
    }; 18];
    let mut i = 0;
    while i < PACES.len() {
        all[i].pace = PACES[i];
        i += 1;
    }
    let parts = [0.6, 0.3, 0.12, 0.04];
    while i < all.len() {
        all[i].part = parts[(i - PACES.len()) / 3];
        all[i].pace = PACES[(i - PACES.len()) % 3 * 2];
        i += 1;
    }
    all
};

/// Samples a tick may spend on playing candidates through.
const BUDGET: u32 = 400;
/// Time without any passable ramp after which limits are relaxed, s.
const PATIENCE_T: f64 = 1.0;
/// Parts by which limits are relaxed, each for a tenth of a second.
const RELAXED: [f64; 6] = [1e-3, 3e-3, 1e-2, 3e-2, 1e-1, 3e-1];
/// Largest bounds of a ramp: a change from 0 to 1 takes at least four ticks.
const FASTEST: Bounds = Bounds {
    alpha: 0.5,
    beta: 0.25,
};
/// A better ramp ends at least this much earlier, ticks.
const GAIN: f64 = 0.5;

/// What the choice of a ramp depends on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) track: &'a Track,
    pub(crate) published: &'a Differences,
    pub(crate) allowed: &'a Allowed,
    pub(crate) period_t: f64,
    /// Frames ahead whose speed counts.
    pub(crate) reach: u64,
}

/// Program time and its rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rate {
    /// Where the ramp, or the steady rate, started.
    start: ProgramTime,
    ramp: Option<Ramp>,
    /// Ticks since `start`.
    ticks: u32,
    now: ProgramTime,
    rate: f64,
    slope: f64,
    /// Stretching of the ramp.
    pace: f64,
    /// Ticks with a goal and no ramp towards it.
    waited: u32,
    /// The candidate at which the last tick ran out of budget.
    resume_at: usize,
    /// Part by which the last committed ramp may break limits; 0 if not at all.
    excess: f64,
}

/// Program time of one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Advance {
    pub(crate) time: ProgramTime,
    pub(crate) rate: f64,
    pub(crate) slope: f64,
}

enum Trial {
    Passed,
    Barred,
    OutOfBudget,
}

impl Rate {
    /// Standing at a frame with a steady rate.
    pub(crate) const fn new(time: ProgramTime, rate: f64) -> Self {
        Self {
            start: time,
            ramp: None,
            ticks: 0,
            now: time,
            rate,
            slope: 0.0,
            pace: 0.0,
            waited: 0,
            resume_at: 0,
            excess: 0.0,
        }
    }

    pub(crate) const fn now(&self) -> Advance {
        Advance {
            time: self.now,
            rate: self.rate,
            slope: self.slope,
        }
    }

    /// The part by which limits had to be relaxed for the present ramp, usually 0.
    pub(crate) const fn excess(&self) -> f64 {
        self.excess
    }

    /// Advances program time by one tick.
    pub(crate) fn advance(&mut self) -> Advance {
        match self.ramp {
            None => self.now = self.now.after(self.rate),
            Some(ramp) => {
                self.ticks += 1;
                let t = f64::from(self.ticks);
                let Instant {
                    elapsed,
                    rate,
                    slope,
                } = ramp.at(t);
                self.now = self.start.after(elapsed);
                (self.rate, self.slope) = (rate, slope);
                if t >= ramp.duration() {
                    (self.rate, self.slope) = (ramp.target(), 0.0);
                    if self.rate >= 1.0 {
                        self.now = self.now.snapped();
                    }
                    self.ramp = None;
                }
            }
        }
        self.now()
    }

    /// Moves program time to where it is held: the motion is at rest there, so any rate will do.
    pub(crate) fn rest_at(&mut self, time: ProgramTime, rate: f64) {
        *self = Self {
            excess: self.excess,
            ..Self::new(time, rate)
        };
    }

    /// Chooses how to get to a rate: commits a ramp if there is one that passes and is better than
    /// what is committed.
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    pub(crate) fn steer(&mut self, goal: f64, scene: &Scene<'_>) {
        let heading = self.ramp.map_or(self.rate, |ramp| ramp.target());
        let arrives = heading == goal;
        if arrives && (self.ramp.is_none() || self.pace >= PACES[0]) {
            self.waited = 0;
            return;
        }
        let fastest = self.fastest(scene);
        let mut budget = BUDGET;
        let first = core::mem::take(&mut self.resume_at);
        for k in 0..CANDIDATES.len() {
            let place = (first + k) % CANDIDATES.len();
            let Some(&Candidate { part, pace }) = CANDIDATES.get(place) else {
                continue;
            };
            if !self.is_better(part, pace, goal, heading) {
                continue;
            }
            let target = if part < 1.0 {
                self.rate + part * (goal - self.rate)
            } else {
                goal
            };
            let Some(ramp) = self.ramp_to(target, fastest.paced(pace)) else {
                continue;
            };
            if arrives && ramp.duration() > self.remaining() - GAIN {
                continue;
            }
            match self.play(&ramp, scene, scene.allowed, &mut budget) {
                Trial::Passed => return self.commit(ramp, pace, 0.0),
                Trial::Barred => {}
                Trial::OutOfBudget => {
                    self.resume_at = place;
                    break;
                }
            }
        }
        if !arrives {
            self.waited = self.waited.saturating_add(1);
            self.insist(goal, fastest, scene);
        }
    }

    /// Whether a candidate, if it passes, is better than what is committed.
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    fn is_better(&self, part: f64, pace: f64, goal: f64, heading: f64) -> bool {
        if heading == goal {
            return part >= 1.0 && pace > self.pace;
        }
        let already = (heading - self.rate) / (goal - self.rate);
        !already.is_finite() || part > already
    }

    /// Ticks to the end of the committed ramp.
    fn remaining(&self) -> f64 {
        self.ramp
            .map_or(0.0, |ramp| ramp.duration() - f64::from(self.ticks))
    }

    /// Bounds of the fastest ramp worth trying: no axis needs more than its limits for it at the
    /// highest speed ahead.
    fn fastest(&self, scene: &Scene<'_>) -> Bounds {
        let stop = scene.track.longest_stop(self.now.sequence, scene.reach);
        Bounds {
            alpha: FASTEST.alpha.min(1.0 / stop.by_acceleration),
            beta: FASTEST.beta.min(1.0 / stop.by_jerk_squared),
        }
    }

    /// Nothing passes: after [`PATIENCE_T`], or when frames run out, commits the fastest ramp that
    /// passes relaxed limits.
    fn insist(&mut self, goal: f64, fastest: Bounds, scene: &Scene<'_>) {
        let waited_t = f64::from(self.waited) * scene.period_t;
        let over = waited_t - PATIENCE_T;
        if over <= 0.0 {
            return;
        }
        let mut budget = BUDGET;
        for (step, part) in RELAXED.into_iter().enumerate() {
            if f64::from(u32::try_from(step).unwrap_or(u32::MAX)) * 0.1 > over {
                return;
            }
            let allowed = scene.allowed.relaxed(part);
            for pace in PACES {
                let Some(ramp) = self.ramp_to(goal, fastest.paced(pace)) else {
                    continue;
                };
                if matches!(
                    self.play(&ramp, scene, &allowed, &mut budget),
                    Trial::Passed
                ) {
                    return self.commit(ramp, pace, part);
                }
            }
        }
    }

    /// A ramp from the present, if there is one; one to rate 1 ends on the grid of the frames.
    fn ramp_to(&self, target: f64, bounds: Bounds) -> Option<Ramp> {
        let ramp = Ramp::plan(self.rate, self.slope, target, bounds)?;
        if target < 1.0 {
            return Some(ramp);
        }
        // The frame reached at rate 1 is behind the grid by what was lost, so lose a whole number.
        let wanted = {
            let over = (self.now.fraction - ramp.loss()).rem_euclid(1.0);
            ramp.loss() + over
        };
        let (mut slow, mut fast) = (0.25, 1.0);
        for _ in 0..48 {
            let pace = 0.5 * (slow + fast);
            let loss = Ramp::plan(self.rate, self.slope, target, bounds.paced(pace))?.loss();
            if loss > wanted {
                slow = pace;
            } else {
                fast = pace;
            }
        }
        Ramp::plan(self.rate, self.slope, target, bounds.paced(fast))
    }

    /// Plays a ramp through to three ticks past its end.
    fn play(&self, ramp: &Ramp, scene: &Scene<'_>, allowed: &Allowed, budget: &mut u32) -> Trial {
        let mut published = *scene.published;
        let end = ramp.duration() + 3.0;
        let mut t = 0.0;
        while t < end {
            if *budget == 0 {
                return Trial::OutOfBudget;
            }
            *budget -= 1;
            t += 1.0;
            let time = self.now.after(ramp.at(t).elapsed);
            let Some(position) = scene.track.position(time) else {
                return Trial::Barred;
            };
            if !published.allow(&position, allowed) {
                return Trial::Barred;
            }
            published = published.then(&position);
        }
        Trial::Passed
    }

    const fn commit(&mut self, ramp: Ramp, pace: f64, excess: f64) {
        self.start = self.now;
        self.ticks = 0;
        self.ramp = Some(ramp);
        self.pace = pace;
        self.excess = excess;
        self.waited = 0;
        self.resume_at = 0;
    }
}

#[cfg(test)]
mod tests;
