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
//! on only with a stop in [`reserve`], played through beforehand (how it is found: [`descent`]). To come to rest at the end of a block
//! is a reserve, too, that ends at a given frame and is taken on purpose: see [`arrival`].
//!
//! A ramp to rate 1 is stretched so that it ends on the grid of the frames: from there on the
//! setpoints are the frames, bit for bit. Between its grid points a plan may exceed its jerk limit by
//! a little (0.53 % if jerk steps in the middle of a period): r³ makes up for that at any lower steady
//! rate, hence [`BESIDE_FULL`].

mod arrival;
mod candidate;
mod descent;
mod fall;
mod play;
mod reserve;
mod steps;
mod trial;

use crate::differences::{Allowed, Differences};
use crate::program_time::ProgramTime;
use crate::ramp::{Bounds, Instant, Ramp};
use crate::track::Track;
use arrival::Arrival;
use candidate::{CANDIDATES, Candidate, PACES};
use reserve::{Reserve, Search};
use trial::{Trial, Trying};

/// Samples a tick may spend on playing candidates through, unless stops are longer.
const BUDGET: u32 = 170;
/// Largest bounds of a ramp: a change from 0 to 1 takes at least four ticks.
const FASTEST: Bounds = Bounds {
    alpha: 0.5,
    beta: 0.25,
};
/// The least change of the rate worth a ramp part of the way.
const LEAST_CHANGE: f64 = 1e-3;
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
    /// The end of a block, where the plan moves and the motion is to come to rest.
    pub(crate) block_end: Option<u64>,
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
    /// The search for a reserve that is under way, and whether one came to its end without any where
    /// the motion stands.
    search: Search,
    finds_no_stop: bool,
    /// A ramp that leaves a rest, and is still being tried.
    set_out: Option<Trying>,
    /// How often it was tried to go slower than to take a reserve.
    dips: usize,
    /// The ramp being followed is the reserve.
    has_taken: bool,
    /// The ramp being followed, or the next, comes to rest at this frame, the end of a block.
    arrives_at: Option<u64>,
    /// The search for such a ramp after the steady rate, and where it goes on after the candidate at
    /// which the last tick ran out of budget.
    arrival_search: Option<Arrival>,
    trial_search: usize,
    /// The end of the block turned out to be too near.
    has_missed: bool,
    /// Candidates that did not pass, one after the other, at rest.
    barred: usize,
}

/// Program time of one tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Advance {
    pub(crate) time: ProgramTime,
    pub(crate) rate: f64,
    pub(crate) slope: f64,
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
            search: Search::none(),
            finds_no_stop: false,
            set_out: None,
            dips: 0,
            has_taken: false,
            arrives_at: None,
            arrival_search: None,
            trial_search: 0,
            has_missed: false,
            barred: 0,
        }
    }

    pub(crate) const fn now(&self) -> Advance {
        Advance {
            time: self.now,
            rate: self.rate,
            slope: self.slope,
        }
    }

    /// True if the stop in reserve was begun: the frames ran low, or no later stop was found.
    pub(crate) const fn has_taken_reserve(&self) -> bool {
        self.has_taken
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
                let time = self.start.after(elapsed).held_at(self.held_at);
                // Rounding may take it back by a hair, to a frame that was given away.
                if time > self.now {
                    self.now = time;
                }
                (self.rate, self.slope) = (rate, slope);
                if t >= ramp.duration() {
                    (self.rate, self.slope) = (ramp.target(), ramp.end_slope());
                    if self.rate >= 1.0 {
                        self.now = self.now.snapped();
                    } else if self.rate <= 0.0
                        && let Some(frame) = self.arrives_at.take()
                    {
                        // But for rounding it is there.
                        self.now = ProgramTime::at(frame);
                    }
                    self.ramp = None;
                    if self.slope != 0.0 {
                        // In the middle of a fall: what follows begins at once.
                        self.count_down();
                    }
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

    /// Moves program time to where it is held: the motion is at rest there, so any rate will do.
    pub(crate) fn rest_at(&mut self, time: ProgramTime, rate: f64) {
        // Field by field: what is not in use is not written, and the searches stay where they are.
        (self.start, self.now) = (time, time);
        (self.rate, self.slope, self.pace) = (rate, 0.0, 0.0);
        (self.ramp, self.held_at, self.ticks) = (None, None, 0);
        (self.reserve, self.set_out) = (None, None);
        (self.has_taken, self.arrives_at) = (false, None);
        (self.resume_at, self.trial_search) = (0, 0);
        (self.dips, self.barred) = (0, 0);
    }

    /// Stands at the first frame of an epoch, and knows of nothing else.
    pub(crate) fn begin_at(&mut self, time: ProgramTime) {
        self.rest_at(time, 0.0);
        self.search.is_under_way = false;
        (self.arrival_search, self.finds_no_stop) = (None, false);
        self.has_missed = false;
    }

    /// Chooses how to get to a rate: commits a ramp if there is one that passes and is better than
    /// what is committed.
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    pub(crate) fn steer(&mut self, goal: f64, scene: &Scene<'_>) {
        let heading = self.heading(goal, scene);
        let arrives = heading == Some(goal);
        if arrives && (self.ramp.is_none() || self.pace >= PACES[0]) {
            return;
        }
        // On the way to rest at the end of a block nothing but a stop before it is wanted.
        if self.arrives_at.is_some() && goal > 0.0 {
            return;
        }
        if self.rate > 0.0 || !scene.published.is_at_rest() {
            self.barred = 0;
        }
        self.choose(goal, heading, scene);
    }

    /// Tries ramps to a goal, or part of the way, until one passes. Not in line, like all that looks for
    /// a ramp or a stop: what most ticks do not do is not to spread their code and their stack.
    #[inline(never)]
    #[allow(clippy::float_cmp, reason = "targets are copies of goals")]
    fn choose(&mut self, goal: f64, heading: Option<f64>, scene: &Scene<'_>) {
        let arrives = heading == Some(goal);
        let mut budget = scene.budget(BUDGET);
        if self.go_on_setting_out(goal, scene, &mut budget) {
            return;
        }
        let fastest = scene.fastest_from(self.now.sequence);
        let first = core::mem::take(&mut self.resume_at);
        let mut search_at = core::mem::take(&mut self.trial_search);
        for k in 0..CANDIDATES.len() {
            let place = (first + k) % CANDIDATES.len();
            let Some(&Candidate { part, pace }) = CANDIDATES.get(place) else {
                continue;
            };
            if self.rate <= 0.0 && self.barred >= CANDIDATES.len() {
                // Nothing gets away from here that rests at the end of the block, where the plan moves.
                (self.has_missed, self.barred) = (scene.block_end.is_some(), 0);
            }
            self.barred += 1;
            if !self.is_better(part, pace, goal, heading) {
                continue;
            }
            let target = self.target(part, goal);
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
            match self.try_ramp(&ramp, scene, search_at, &mut budget) {
                Trial::Passed(reserve) => {
                    self.commit(ramp, pace, reserve);
                    self.held_at = scene.track.stop();
                    return;
                }
                Trial::Barred => search_at = 0,
                Trial::OutOfBudget { approach } => {
                    self.barred -= 1;
                    // What does not fit into the budget of a tick that begins with it never will.
                    let never = usize::from(k == 0 && self.set_out.is_none());
                    self.resume_at = place + never * usize::from(approach.is_none());
                    self.trial_search = approach
                        .filter(|_| self.set_out.is_none())
                        .map_or(0, |approach| approach.max(search_at + never));
                    return;
                }
            }
        }
    }

    /// Ticks to the end of the committed ramp.
    fn remaining(&self) -> f64 {
        self.ramp
            .map_or(0.0, |ramp| ramp.duration() - f64::from(self.ticks))
    }

    fn commit(&mut self, ramp: Ramp, pace: f64, reserve: Option<Reserve>) {
        self.start = self.now;
        self.ticks = 0;
        // A ramp that changes nothing takes no tick, in which what is to begin later would come late.
        self.ramp = (ramp.duration() > 0.0).then_some(ramp);
        if self.ramp.is_none() {
            (self.rate, self.slope) = (ramp.target(), 0.0);
        }
        self.held_at = None;
        self.pace = pace;
        self.reserve = reserve;
        self.has_taken = false;
        self.set_out = None;
        self.resume_at = 0;
        self.arrives_at = None;
        self.arrival_search = None;
        self.trial_search = 0;
        self.barred = 0;
    }
}

#[cfg(test)]
mod tests;
