//! Coming to rest exactly at a frame: the end of a block.
//!
//! The plan does not rest there, so program time does: a ramp to rate 0 is stretched until the program
//! time that passes on it is what is left to the frame. Like a stop in reserve it begins some ticks
//! from now and is played through before anything relies on it; unlike one it is wanted.
//!
//! ```text
//!        now                        frame
//! ────────┼──────────────┬────────────┤
//!         │ steady rate  │ ramp to 0  │   ramp of pace p takes E / p periods of program time;
//!         │◄───── w ────►│◄── E / p ─►│   w whole ticks, p ≤ 1 what is left: exact
//! ```
//!
//! Where a plan at its limits lets no single ramp pass, two may: a little slower first (see the module
//! above), then to rest. What cannot be reached is left to the next block: see [`Rate::secure`].
//!
//! A slow approach to a slow machine's stop takes more samples than a tick may spend, so the search can
//! pause between any two of them, and go on in the next tick.

use super::play::{Played, Playing, SET_UP};
use super::reserve::{Reserve, Steady, whole};
use super::steps::{Later, Steps};
use super::{FASTEST, Rate, Scene};
use crate::program_time::ProgramTime;
use crate::ramp::{Bounds, Ramp};

/// How the rate falls: perhaps in two steps, the last one exact.
#[derive(Debug, Clone, Copy)]
struct Approach {
    /// Part of the rate that goes first, and how fast; 0 for all at once.
    part: f64,
    part_pace: f64,
    /// The fastest the last ramp may be.
    pace: f64,
}

/// Steady ticks between the two ramps.
const GAP: f64 = 3.0;

/// What is tried: late and fast first.
const APPROACHES: [Approach; 24] = {
    let mut all = [Approach {
        part: 0.0,
        part_pace: 1.0,
        pace: 1.0,
    }; 24];
    let paces = [1.0, 0.85, 0.7, 0.58, 0.48, 0.4, 0.32, 0.26, 0.2];
    let (parts, part_paces, lasts) = ([0.3, 0.6, 0.85], [1.0, 0.6], [1.0, 0.6]);
    let mut i = 0;
    while i < paces.len() {
        all[i].pace = paces[i];
        i += 1;
    }
    let mut k = 0;
    while k < 12 {
        all[i + k] = Approach {
            part: parts[k / 4],
            part_pace: part_paces[k / 2 % 2],
            pace: lasts[k % 2],
        };
        k += 1;
    }
    all[i + 12] = Approach {
        part: 0.85,
        part_pace: 0.36,
        pace: 0.36,
    };
    all[i + 13] = Approach {
        part: 0.6,
        part_pace: 0.36,
        pace: 0.36,
    };
    all[i + 14] = Approach {
        part: 0.95,
        part_pace: 0.6,
        pace: 0.6,
    };
    all
};

/// What a search for a way to rest at a frame has come to.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum Search {
    Found(Reserve),
    /// There was no time to try everything.
    Open,
    /// Nothing passes from here.
    Barred,
    /// It is too near.
    OutOfReach,
}

/// A search for a late way to rest exactly at a frame after a steady rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct Arrival {
    frame: u64,
    /// The steady rate, where the last tick left it.
    from: Steady,
    bounds: Bounds,
    /// The approach whose turn it is, and as far as it was played.
    place: usize,
    attempt: Option<Attempt>,
}

/// A way to rest, before it is tried.
struct Plan {
    begins: f64,
    first: Option<Ramp>,
}

/// A way to rest that is being played through.
#[derive(Debug, Clone, Copy)]
struct Attempt {
    /// Ticks of the steady rate until it begins.
    begins: u32,
    /// The ramp part of the way.
    first: Option<Ramp>,
    /// The ramp that is played, and whether it is the one to rest.
    playing: Playing,
    is_last: bool,
}

impl Arrival {
    /// A search that begins at approach `place`; `None` if the frame is too near.
    pub(super) fn at(frame: u64, from: Steady, place: usize, scene: &Scene<'_>) -> Option<Self> {
        if periods(from.time, frame) <= 0.0 {
            return None;
        }
        let search = Self {
            frame,
            from,
            bounds: scene.fastest_up_to(frame, from),
            place,
            attempt: None,
        };
        search
            .plan(*APPROACHES.first()?)
            .is_some()
            .then_some(search)
    }

    /// The approach whose turn it is.
    pub(super) const fn place(&self) -> usize {
        self.place
    }

    /// Keeps up with the motion. False if it is about another frame, if the motion went another way, or
    /// if what is being tried would have begun.
    fn follow(&mut self, frame: u64, now: Steady) -> bool {
        if self.frame != frame {
            return false;
        }
        let Some(ticks) = self.from.follow(now) else {
            return false;
        };
        let Some(attempt) = &mut self.attempt else {
            return true;
        };
        let Some(begins) = attempt.begins.checked_sub(ticks) else {
            return false;
        };
        attempt.begins = begins;
        true
    }

    /// Goes on until a way is found, none is left, or the budget is used up.
    pub(super) fn go_on(&mut self, scene: &Scene<'_>, budget: &mut u32) -> Search {
        while let Some(&approach) = APPROACHES.get(self.place) {
            let attempt = match self.attempt.take() {
                Some(attempt) => Some(attempt),
                None if *budget < SET_UP => return Search::Open,
                None => self.plan(approach).and_then(|plan| {
                    *budget -= SET_UP;
                    self.begin(&plan, scene)
                }),
            };
            let Some(mut attempt) = attempt else {
                self.place += 1;
                continue;
            };
            match self.play(&mut attempt, scene, budget) {
                Played::Passed(_) => return Search::Found(attempt.reserve(self.frame)),
                Played::Barred => self.place += 1,
                Played::OutOfBudget => {
                    self.attempt = Some(attempt);
                    return Search::Open;
                }
            }
        }
        Search::Barred
    }

    /// When an approach begins, if there is time for it.
    fn plan(&self, approach: Approach) -> Option<Plan> {
        let rate = self.from.rate;
        let last_from = rate * (1.0 - approach.part);
        let (first, passed) = if approach.part > 0.0 {
            let bounds = self.bounds.paced(approach.part_pace);
            let ramp = Ramp::plan(rate, 0.0, last_from, bounds)?;
            let passed = ramp.elapsed_at(ramp.duration().ceil()) + GAP * last_from;
            (Some(ramp), passed)
        } else {
            (None, 0.0)
        };
        let fastest = Ramp::plan(last_from, 0.0, 0.0, self.bounds)?;
        let needed = passed + fastest.elapsed_at(fastest.duration()) / approach.pace;
        let begins = ((periods(self.from.time, self.frame) - needed) / rate).floor();
        (begins >= 3.0).then_some(Plan { begins, first })
    }

    fn begin(&self, plan: &Plan, scene: &Scene<'_>) -> Option<Attempt> {
        let playing = match plan.first {
            Some(ramp) => Playing::new(ramp, self.from.cue(plan.begins, scene)?),
            None => self.last(self.from, plan.begins, scene)?,
        };
        Some(Attempt {
            begins: whole(plan.begins),
            first: plan.first,
            playing,
            is_last: plan.first.is_none(),
        })
    }

    /// The ramp that rests at the frame, so many ticks after a steady rate began.
    fn last(&self, steady: Steady, begins: f64, scene: &Scene<'_>) -> Option<Playing> {
        let cue = steady.cue(begins, scene)?;
        let fastest = Ramp::plan(steady.rate, 0.0, 0.0, self.bounds)?;
        let fastest_takes = fastest.elapsed_at(fastest.duration());
        let pace = (fastest_takes / periods(cue.time, self.frame)).min(1.0);
        let ramp = Ramp::plan(steady.rate, 0.0, 0.0, self.bounds.paced(pace))?;
        Some(Playing::new(ramp, cue))
    }

    /// Plays an approach on.
    fn play(&self, attempt: &mut Attempt, scene: &Scene<'_>, budget: &mut u32) -> Played {
        loop {
            let played = attempt.playing.go_on(scene.track, scene.allowed, budget);
            let Played::Passed(end) = played else {
                return played;
            };
            if attempt.is_last {
                return played;
            }
            let steady = Steady {
                time: end.time,
                rate: attempt.playing.ramp().target(),
            };
            let Some(playing) = self.last(steady, GAP, scene) else {
                return Played::Barred;
            };
            (attempt.playing, attempt.is_last) = (playing, true);
        }
    }
}

/// Program time from a place to a frame; 0 or less if that is no later.
#[allow(clippy::cast_precision_loss, reason = "a number of frames at hand")]
const fn periods(time: ProgramTime, frame: u64) -> f64 {
    frame.saturating_sub(time.sequence) as f64 - time.fraction
}

impl Attempt {
    /// What it is when it has passed.
    fn reserve(&self, frame: u64) -> Reserve {
        let mut steps = Steps::new();
        let mut in_ticks = self.begins;
        if let Some(ramp) = self.first {
            steps.push(Later { in_ticks, ramp });
            in_ticks = whole(GAP);
        }
        let ramp = *self.playing.ramp();
        steps.push(Later { in_ticks, ramp });
        Reserve {
            steps,
            arrives_at: Some(frame),
        }
    }
}

impl Scene<'_> {
    /// Bounds of the fastest ramp worth trying on the way to a frame.
    fn fastest_up_to(&self, frame: u64, from: Steady) -> Bounds {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a number of frames at hand, not negative"
        )]
        let passed = (2.0 * self.reach as f64 * from.rate).ceil() as u64;
        let first = frame.saturating_sub(passed).max(from.time.sequence);
        let stop = self.track.longest_stop(first, frame + 1 - first);
        Bounds {
            alpha: FASTEST.alpha.min(1.0 / stop.by_acceleration),
            beta: FASTEST.beta.min(1.0 / stop.by_jerk_squared),
        }
    }
}

impl Rate {
    /// Makes sure of a rest at the end of the block. Returns whether there is a new way to it that
    /// passes a barrier.
    #[inline(never)]
    pub(super) fn secure_arrival(
        &mut self,
        frame: u64,
        scene: &Scene<'_>,
        budget: &mut u32,
    ) -> bool {
        if self.is_to_arrive_at(frame) {
            return false;
        }
        let now = self.steady();
        let mut search = self.arrival_search.take();
        if !search.as_mut().is_some_and(|it| it.follow(frame, now)) {
            search = Arrival::at(frame, now, 0, scene);
        }
        let found = search
            .as_mut()
            .map_or(Search::OutOfReach, |search| search.go_on(scene, budget));
        match found {
            Search::Found(reserve) => {
                self.reserve = Some(reserve);
                scene.track.barrier().is_some_and(|barrier| barrier < frame)
            }
            Search::Open => {
                self.arrival_search = search;
                false
            }
            Search::Barred | Search::OutOfReach => {
                // From nearer something may pass, but not from a place where the motion stands.
                self.has_missed = self.is_barred(scene) || matches!(found, Search::OutOfReach);
                false
            }
        }
    }

    /// Whether the motion is held where it stands.
    pub(super) fn is_barred(&self, scene: &Scene<'_>) -> bool {
        scene.track.stop().map(ProgramTime::at) == Some(self.now)
    }

    /// Whether it is settled how to come to rest at a frame.
    pub(crate) fn is_to_arrive_at(&self, frame: u64) -> bool {
        let settled = self.reserve.as_ref().and_then(|reserve| reserve.arrives_at);
        settled.or(self.arrives_at) == Some(frame)
    }

    /// Whether the end of the block turned out to be too near, since this was asked last.
    pub(crate) const fn take_missed(&mut self) -> bool {
        core::mem::replace(&mut self.has_missed, false)
    }

    /// Nobody wants to rest at the end of the block any more.
    pub(crate) const fn forget_arrival(&mut self) {
        self.arrives_at = None;
        if let Some(reserve) = &mut self.reserve {
            reserve.arrives_at = None;
        }
    }
}
