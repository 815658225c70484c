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
//! tick, following what is committed breaks no limit and needs no frame that is not here.** A steady
//! rate r ≤ 1 is inside the limits because the plan is.
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
//! Most candidates fail in their first samples, so a tick rarely uses its budget. Where nothing passes
//! the rate stays and the next tick tries again from another place: a plan that brakes at its limits
//! cannot be made to brake harder, but it will be slow soon.
//!
//! That leaves the question whether there will be any stop before the frames run out. So motion goes
//! on only with a stop in [`reserve`], played through beforehand.
//!
//! A ramp to rate 1 is stretched so that it ends on the grid of the frames: from there on the
//! setpoints are the frames, bit for bit. Between its grid points a plan may exceed its jerk limit by
//! a little (0.53 % if jerk steps in the middle of a period): r³ makes up for that at any lower steady
//! rate, hence [`BESIDE_FULL`].

mod reserve;

use crate::differences::{Allowed, Differences};
use crate::program_time::ProgramTime;
use crate::ramp::{Bounds, Instant, Ramp};
use crate::track::Track;
use reserve::{Reserve, Steady};

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
const BUDGET: u32 = 200;
/// What it costs to set up a candidate, and to stretch one from a slope, in samples.
const SET_UP: u32 = 4;
const SEARCH: u32 = 20;
/// Halvings of the range of paces, from the slowest to 1, in the search for the grid.
const SEARCH_STEPS: u32 = 40;
const SLOWEST: f64 = 0.02;
/// Largest bounds of a ramp: a change from 0 to 1 takes at least four ticks.
const FASTEST: Bounds = Bounds {
    alpha: 0.5,
    beta: 0.25,
};
/// The least change of the rate worth a ramp part of the way.
const LEAST_CHANGE: f64 = 1e-3;
/// The highest rate that a ramp part of the way to the full rate ends at: nearer to it there is too
/// little time left to lose to get back to the grid.
const PARTIAL_MOST: f64 = 0.9;
/// How near to the grid a ramp must end, periods.
const ON_GRID: f64 = 1e-10;
/// A better ramp ends at least this much earlier, ticks.
const GAIN: f64 = 0.5;

/// The highest steady rate below 1.
pub(crate) const BESIDE_FULL: f64 = 0.998;

/// What the choice of a ramp depends on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) track: &'a Track,
    pub(crate) published: &'a Differences,
    pub(crate) allowed: &'a Allowed,
    /// Frames a stop from full speed takes.
    pub(crate) reach: u64,
    /// There are as many frames ahead as there will ever be.
    pub(crate) is_fully_supplied: bool,
}

/// Program time and its rate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rate {
    /// Where the ramp, or the steady rate, started.
    start: ProgramTime,
    ramp: Option<Ramp>,
    /// The frame that held the motion when the ramp was played through. It does so to its end, even
    /// if motion could pass it by now: what the ramp would publish after it was not looked at.
    held_at: Option<u64>,
    /// Ticks since `start`.
    ticks: u32,
    now: ProgramTime,
    rate: f64,
    slope: f64,
    /// Stretching of the ramp.
    pace: f64,
    /// The candidate at which the last tick ran out of budget.
    resume_at: usize,
    reserve: Option<Reserve>,
    /// Where the search for a reserve goes on, and whether it came to its end without one.
    search_at: usize,
    all_tried: bool,
    /// Ticks in which limits were relaxed in the search.
    insisted: usize,
    /// The ramp being followed is the reserve, which may break limits by this part.
    taken: Option<f64>,
}

/// Program time of one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Advance {
    pub(crate) time: ProgramTime,
    pub(crate) rate: f64,
    pub(crate) slope: f64,
}

/// What trying a ramp has shown.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
enum Trial {
    Passed(Option<Reserve>),
    Barred,
    OutOfBudget,
}

impl Rate {
    /// Standing at a frame with a steady rate.
    pub(crate) const fn new(time: ProgramTime, rate: f64) -> Self {
        Self {
            start: time,
            ramp: None,
            held_at: None,
            ticks: 0,
            now: time,
            rate,
            slope: 0.0,
            pace: 0.0,
            resume_at: 0,
            reserve: None,
            search_at: 0,
            all_tried: false,
            insisted: 0,
            taken: None,
        }
    }

    pub(crate) const fn now(&self) -> Advance {
        Advance {
            time: self.now,
            rate: self.rate,
            slope: self.slope,
        }
    }

    /// True if the frames ran so low that the stop in reserve was begun.
    pub(crate) const fn has_taken_reserve(&self) -> bool {
        self.taken.is_some()
    }

    /// The part by which limits may be broken now, usually 0.
    pub(crate) fn excess(&self) -> f64 {
        self.taken.unwrap_or(0.0)
    }

    /// Advances program time by one tick.
    pub(crate) fn advance(&mut self) -> Advance {
        if self.ramp.is_none() {
            self.count_down();
        }
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
                self.now = self.clamped(self.start.after(elapsed));
                (self.rate, self.slope) = (rate, slope);
                if t >= ramp.duration() {
                    (self.rate, self.slope) = (ramp.target(), 0.0);
                    if self.rate >= 1.0 {
                        self.now = self.now.snapped();
                    }
                    self.ramp = None;
                }
                if self
                    .held_at
                    .is_some_and(|held| self.now == ProgramTime::at(held))
                {
                    self.rest_at(self.now, self.rate);
                }
            }
        }
        self.now()
    }

    /// Program time not past the frame that holds the ramp.
    fn clamped(&self, time: ProgramTime) -> ProgramTime {
        match self.held_at {
            Some(held) if time.sequence >= held => ProgramTime::at(held),
            _ => time,
        }
    }

    /// Moves program time to where it is held: the motion is at rest there, so any rate will do.
    pub(crate) fn rest_at(&mut self, time: ProgramTime, rate: f64) {
        *self = Self {
            search_at: self.search_at,
            all_tried: self.all_tried,
            insisted: self.insisted,
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
            return;
        }
        let fastest = scene.fastest_from(self.now.sequence);
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
                let most = PARTIAL_MOST.max(self.rate.min(BESIDE_FULL));
                (self.rate + part * (goal - self.rate)).min(most)
            } else {
                goal
            };
            if part < 1.0 && (target - self.rate).abs() < LEAST_CHANGE {
                continue;
            }
            let within = if arrives {
                self.remaining() - GAIN
            } else {
                f64::INFINITY
            };
            let Some(ramp) = self.ramp_to(target, fastest.paced(pace), within, &mut budget) else {
                continue;
            };
            match self.try_ramp(&ramp, scene, &mut budget) {
                Trial::Passed(reserve) => {
                    self.commit(ramp, pace, reserve);
                    self.held_at = scene.track.stop();
                    return;
                }
                Trial::Barred => {}
                Trial::OutOfBudget => {
                    self.resume_at = place;
                    return;
                }
            }
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

    /// A ramp from the present, if there is one of less than so many ticks; one to rate 1 ends on the
    /// grid of the frames.
    fn ramp_to(&self, target: f64, bounds: Bounds, within: f64, budget: &mut u32) -> Option<Ramp> {
        let plan = |pace| Ramp::plan(self.rate, self.slope, target, bounds.paced(pace));
        *budget = budget.saturating_sub(SET_UP);
        let ramp = plan(1.0).filter(|ramp| ramp.duration() < within)?;
        if target < 1.0 {
            return Some(ramp);
        }
        // The frame reached at rate 1 is behind the grid by what was lost, so lose a whole number.
        let over = (self.now.fraction - ramp.loss()).rem_euclid(1.0);
        let wanted = ramp.loss() + if over > 1.0 - ON_GRID { 0.0 } else { over };
        let on_grid = if self.slope == 0.0 {
            // The same curve, stretched: so is the loss.
            plan(if wanted > 0.0 {
                ramp.loss() / wanted
            } else {
                1.0
            })?
        } else {
            *budget = budget.saturating_sub(SEARCH);
            let (mut slow, mut fast) = (SLOWEST, 1.0);
            for _ in 0..SEARCH_STEPS {
                let pace = 0.5 * (slow + fast);
                if plan(pace)?.loss() > wanted {
                    slow = pace;
                } else {
                    fast = pace;
                }
            }
            plan(fast)?
        };
        // If there is too little time left to lose, another tick will be nearer to the grid.
        let is_on_grid = (on_grid.loss() - wanted).abs() < ON_GRID;
        (is_on_grid && on_grid.duration() < within).then_some(on_grid)
    }

    /// Plays a ramp through, and looks for a stop after it if it does not end in one.
    fn try_ramp(&self, ramp: &Ramp, scene: &Scene<'_>, budget: &mut u32) -> Trial {
        let cue = Cue {
            time: self.now,
            published: *scene.published,
            is_held: true,
        };
        let played = play(ramp, cue, scene.track, scene.allowed, budget);
        if played != Played::Passed || ramp.target() <= 0.0 || scene.track.stop().is_some() {
            return match played {
                Played::Passed => Trial::Passed(None),
                Played::Barred => Trial::Barred,
                Played::OutOfBudget => Trial::OutOfBudget,
            };
        }
        let end = self.now.after(ramp.at(ramp.duration().ceil()).elapsed);
        let mut from_first = 0;
        let steady = Steady {
            time: end,
            rate: ramp.target(),
        };
        match Reserve::find(steady, 0, scene, scene.allowed, &mut from_first, budget) {
            Some(reserve) => Trial::Passed(Some(reserve)),
            None => Trial::Barred,
        }
    }

    const fn commit(&mut self, ramp: Ramp, pace: f64, reserve: Option<Reserve>) {
        self.start = self.now;
        self.ticks = 0;
        self.ramp = Some(ramp);
        self.held_at = None;
        self.pace = pace;
        self.reserve = reserve;
        self.taken = None;
        self.resume_at = 0;
    }
}

/// What playing a ramp through has shown.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Played {
    Passed,
    Barred,
    OutOfBudget,
}

/// Where a ramp is played from.
#[derive(Debug, Clone, Copy)]
struct Cue {
    time: ProgramTime,
    /// The positions published before it.
    published: Differences,
    /// Whether motion stands at what holds it now. A reserve is for after that.
    is_held: bool,
}

/// Plays a ramp through to three ticks past its end.
fn play(ramp: &Ramp, cue: Cue, track: &Track, allowed: &Allowed, budget: &mut u32) -> Played {
    let mut published = cue.published;
    let end = ramp.duration() + 3.0;
    let mut t = 0.0;
    while t < end {
        if *budget == 0 {
            return Played::OutOfBudget;
        }
        *budget -= 1;
        t += 1.0;
        let time = cue.time.after(ramp.at(t).elapsed);
        let time = if cue.is_held {
            track.clamped(time)
        } else {
            time
        };
        let Some(position) = track.position(time) else {
            return Played::Barred;
        };
        if !published.take(&position, allowed) {
            return Played::Barred;
        }
    }
    Played::Passed
}

#[cfg(test)]
mod tests;
