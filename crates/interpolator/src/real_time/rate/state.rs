//! The state of the rate: program time, its rate, and what is known of how both go on.
//!
//! ```text
//!               rest_at, begin_at: program time is held
//!                                  │
//!   ┌──────────────────────────────▼───────────────────────────┐
//!   │ steady: `ramp` is none                                   │◄────────────┐
//!   │ `reserve.kept` counts down, and later stops replace it   │             │
//!   └───┬───────────────────────┬─────────────────────────┬────┘             │ end of
//!       │ choose_ramp, or       │ the reserve begins,     │ the reserve      │ the ramp
//!       │ slow_down_a_little    │ and arrives nowhere     │ begins, and      │
//!       │                       │                         │ arrives at       │
//!       │                       │                         │ a frame          │
//!   ┌───▼────┐ choose_ramp ┌────▼────────┐            ┌───▼─────┐            │
//!   │ Chosen │◄────────────┤ ReserveStop │            │ Arrival │            │
//!   └───┬────┘             └────┬────────┘            └───┬─────┘            │
//!       └───────────────────────┴─────────────────────────┴──────────────────┘
//!   On a ramp that is `Chosen` a better one may replace it; in an `Arrival` only a stop before
//!   the frame may.
//! ```
//!
//! * While the rate is **steady**, it has a stop in reserve unless the frames hold the motion, and
//!   a later one is searched ([`LaterStops`]). A stop may be several ramps; between two of them the
//!   rate is steady, too, the rest of the stop is the reserve, and the [`RateReason`] stays.
//! * On a **ramp** ([`FollowedRamp`]) the reserve is the stop after the ramp. None other is
//!   searched, but better ramps are.
//! * **Held**, by a frame at rest: program time stands at whatever rate, and both searches that
//!   depend on where the motion stands ([`CandidateSearch`], [`ArrivalAttempts`]) keep from tick to
//!   tick what they have found out.
//!
//! Every ramp is begun by [`Rate::commit`], which ends what was searched for another one.

use super::arrival_search::ArrivalSearch;
use super::progress::Progress;
use super::ramp_trial::RampTrial;
use super::reserve::Reserve;
use super::reserve_search::ReserveSearch;
use super::steady_rate::SteadyRate;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::ramp::{Instant, Ramp};

/// Program time and its rate.
#[derive(Debug)]
pub(crate) struct Rate {
    pub(super) now: Progress,
    /// The ramp that is followed; none while the rate is steady.
    pub(super) ramp: Option<FollowedRamp>,
    /// Why the rate goes where it goes, on the ramp and at the steady rate after it.
    pub(super) reason: RateReason,
    pub(super) reserve: LaterStops,
    pub(super) candidates: CandidateSearch,
    pub(super) arrival: ArrivalAttempts,
}

/// The ramp that is followed.
#[derive(Debug, Clone, Copy)]
pub(super) struct FollowedRamp {
    pub(super) ramp: Ramp,
    /// Program time at its start, and the ticks since.
    start: ProgramTime,
    ticks: u32,
    /// The pace of the candidate that it was; 0 if it was none, or is not known any more.
    pub(super) pace: f64,
    /// The frame that held the motion when the ramp was played through. It does so to the ramp's
    /// end, even if motion could pass it by now: what the ramp would publish after it was not
    /// looked at.
    held_at: Option<u64>,
}

/// Why the rate goes where it goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RateReason {
    /// It goes to the goal or part of the way, or stays.
    Chosen,
    /// The stop in reserve was begun: the frames ran low, or no later stop was found.
    ReserveStop,
    /// It comes to rest at this frame, the end of a block.
    Arrival(u64),
}

/// The stop in reserve, and the search for a later one: while the rate is steady.
#[derive(Debug)]
pub(super) struct LaterStops {
    pub(super) kept: Option<Reserve>,
    pub(super) search: ReserveSearch,
    /// A search found no stop where the motion stands, and nobody was told so far.
    pub(super) found_none: bool,
    /// How often it was tried to go slower than to take the reserve.
    pub(super) slower_tried: usize,
}

/// What is known of the candidates for the next ramp from the present state: until one is
/// committed.
#[derive(Debug)]
pub(super) struct CandidateSearch {
    /// The index of the candidate at which the last tick ran out of budget, and of the approach to
    /// the end of a block that was its turn then.
    pub(super) resume_at: usize,
    pub(super) approach: usize,
    /// Candidates that did not pass, one after the other, at rest.
    pub(super) barred: usize,
    /// A ramp that leaves a rest, and is still being tried.
    pub(super) set_out: Option<RampTrial>,
}

/// How to come to rest at the end of a block after the steady rate.
#[derive(Debug)]
pub(super) struct ArrivalAttempts {
    pub(super) search: Option<ArrivalSearch>,
    /// The end of the block turned out to be too near, and nobody was told so far.
    pub(super) has_missed: bool,
    /// The end of a block before which nothing passed from the rate at that time.
    pub(super) barred_from: Option<u64>,
}

impl CandidateSearch {
    const fn none() -> Self {
        Self {
            resume_at: 0,
            approach: 0,
            barred: 0,
            set_out: None,
        }
    }

    /// Forgets what was found out. The trial is not overwritten.
    const fn clear(&mut self) {
        self.set_out = None;
        (self.resume_at, self.approach, self.barred) = (0, 0, 0);
    }
}

impl Rate {
    /// Standing at a frame with a steady rate.
    pub(crate) fn new(time: ProgramTime, rate: f64) -> Self {
        Self {
            now: Progress {
                time,
                rate,
                slope: 0.0,
            },
            ramp: None,
            reason: RateReason::Chosen,
            reserve: LaterStops {
                kept: None,
                search: ReserveSearch::new(),
                found_none: false,
                slower_tried: 0,
            },
            candidates: CandidateSearch::none(),
            arrival: ArrivalAttempts {
                search: None,
                has_missed: false,
                barred_from: None,
            },
        }
    }

    pub(crate) const fn now(&self) -> Progress {
        self.now
    }

    /// True if the stop in reserve was begun: the frames ran low, or no later stop was found.
    pub(crate) fn has_taken_reserve(&self) -> bool {
        self.reason == RateReason::ReserveStop
    }

    /// Whether it is settled how to come to rest at a frame.
    pub(crate) fn is_to_arrive_at(&self, frame: u64) -> bool {
        let kept = self.reserve.kept.as_ref();
        let settled = kept.and_then(|reserve| reserve.arrives_at);
        settled.or(self.arrives_at()) == Some(frame)
    }

    /// The frame, the end of a block, at which the present course comes to rest.
    pub(super) const fn arrives_at(&self) -> Option<u64> {
        match self.reason {
            RateReason::Arrival(frame) => Some(frame),
            RateReason::Chosen | RateReason::ReserveStop => None,
        }
    }

    /// Ticks to the end of the ramp that is followed.
    pub(super) fn remaining(&self) -> f64 {
        self.ramp.as_ref().map_or(0.0, |followed| {
            followed.ramp.duration() - f64::from(followed.ticks)
        })
    }

    /// The present rate, as if it were steady.
    pub(super) const fn steady(&self) -> SteadyRate {
        SteadyRate {
            time: self.now.time,
            rate: self.now.rate,
        }
    }

    /// Advances program time by one tick.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "every tick does it: a call costs forty instructions"
    )]
    pub(crate) fn advance(&mut self) -> Progress {
        if self.ramp.is_none() {
            self.count_down();
        }
        let Some(followed) = &mut self.ramp else {
            self.now.time = self.now.time.after(self.now.rate);
            return self.now;
        };
        followed.ticks += 1;
        let t = f64::from(followed.ticks);
        let Instant {
            elapsed,
            rate,
            slope,
        } = followed.ramp.at(t);
        let mut held_at = followed.held_at;
        let time = followed.start.after(elapsed).held_at(held_at);
        // Rounding may take it back by a hair, to a frame that was given away.
        if time > self.now.time {
            self.now.time = time;
        }
        (self.now.rate, self.now.slope) = (rate, slope);
        if t >= followed.ramp.duration() {
            (self.now.rate, self.now.slope) = (followed.ramp.target(), followed.ramp.end_slope());
            self.end_ramp();
            // In the middle of a greedy slow-down what follows begins at once.
            if self.now.slope != 0.0 && self.count_down() {
                held_at = None;
            }
        }
        if held_at.is_some_and(|held| self.now.time == ProgramTime::at(held)) {
            self.rest_at(self.now.time, self.now.rate);
        }
        self.now
    }

    /// The ramp has come to its end, and program time is rounded to where that is meant to be.
    fn end_ramp(&mut self) {
        if self.now.rate >= 1.0 {
            self.now.time = self.now.time.snapped();
        } else if self.now.rate <= 0.0
            && let RateReason::Arrival(frame) = self.reason
        {
            // But for rounding it is there.
            self.now.time = ProgramTime::at(frame);
            self.reason = RateReason::Chosen;
        }
        self.ramp = None;
    }

    /// Moves program time to where it is held: the motion is at rest there, so any rate will do.
    pub(crate) fn rest_at(&mut self, time: ProgramTime, rate: f64) {
        // Field by field: what is not in use is not written, and the searches stay where they are.
        self.now = Progress {
            time,
            rate,
            slope: 0.0,
        };
        (self.ramp, self.reason) = (None, RateReason::Chosen);
        (self.reserve.kept, self.reserve.slower_tried) = (None, 0);
        self.candidates.clear();
    }

    /// Stands at the first frame of an epoch, and knows of nothing else.
    pub(crate) fn begin_at(&mut self, time: ProgramTime) {
        self.rest_at(time, 0.0);
        self.reserve.search.give_up();
        (self.arrival.search, self.reserve.found_none) = (None, false);
        (self.arrival.has_missed, self.arrival.barred_from) = (false, None);
    }

    /// Whether, from where the motion stands, no stop was found after it has set out at the present
    /// rate, since this was asked last.
    pub(crate) const fn take_found_no_stop(&mut self) -> bool {
        core::mem::replace(&mut self.reserve.found_none, false)
    }

    /// Whether the end of the block turned out to be too near, since this was asked last.
    pub(crate) const fn take_missed(&mut self) -> bool {
        core::mem::replace(&mut self.arrival.has_missed, false)
    }

    /// Whether nothing was found that comes to rest at a frame, from the rate at that time.
    pub(crate) fn was_barred_from(&self, frame: u64) -> bool {
        self.arrival.barred_from == Some(frame)
    }

    /// Nobody wants to rest at the end of the block any more.
    pub(crate) const fn forget_arrival(&mut self) {
        if let RateReason::Arrival(_) = self.reason {
            self.reason = RateReason::Chosen;
        }
        if let Some(reserve) = &mut self.reserve.kept {
            reserve.arrives_at = None;
        }
    }

    /// Begins a ramp of a pace, played through up to the frame that holds the motion, with the stop
    /// after it.
    pub(super) fn commit(
        &mut self,
        ramp: Ramp,
        pace: f64,
        held_at: Option<u64>,
        reserve: Option<Reserve>,
    ) {
        // A ramp that changes nothing takes no tick, in which what is to begin later would come
        // late.
        self.ramp = (ramp.duration() > 0.0).then_some(FollowedRamp {
            ramp,
            start: self.now.time,
            ticks: 0,
            pace,
            held_at,
        });
        if self.ramp.is_none() {
            (self.now.rate, self.now.slope) = (ramp.target(), 0.0);
        }
        self.reason = RateReason::Chosen;
        self.reserve.kept = reserve;
        self.candidates.clear();
        self.arrival.search = None;
    }

    /// One tick less until the reserve begins. Begins it when its time has come, and returns
    /// whether it has.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "every tick does it: a call costs more than what it mostly does"
    )]
    fn count_down(&mut self) -> bool {
        let Some(reserve) = &mut self.reserve.kept else {
            return false;
        };
        let Some(ramp) =
            reserve
                .stop
                .count_down(self.now.rate, self.now.slope, self.reserve.search.slopes())
        else {
            return false;
        };
        let rest = Some(*reserve).filter(|rest| !rest.stop.is_empty());
        let reason = reserve
            .arrives_at
            .map_or(RateReason::ReserveStop, RateReason::Arrival);
        self.commit(ramp, 0.0, None, rest);
        self.reason = reason;
        true
    }
}
