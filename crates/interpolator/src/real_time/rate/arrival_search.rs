//! The search for a ramp that comes to rest exactly at a frame: the end of a block.
//!
//! The plan does not rest there, so program time does: a ramp to rate 0 is stretched until the
//! program time that passes on it is what is left to the frame. Like a stop in reserve it begins
//! some ticks from now and is played through before anything relies on it; unlike one it is wanted.
//!
//! ```text
//!        now                        frame
//! ────────┼──────────────┬────────────┤
//!         │ steady rate  │ ramp to 0  │   ramp of pace p takes E / p periods of program time;
//!         │◄───── w ────►│◄── E / p ─►│   w whole ticks, p ≤ 1 what is left: exact
//! ```
//!
//! Where a plan at its limits lets no single ramp pass, two may: a little slower first (see the
//! module above), then to rest. What cannot be reached is left to the next block: see
//! [`Rate::ensure_stop`](super::Rate::ensure_stop).
//!
//! A slow approach to a slow machine's stop takes more samples than a tick may spend, so the search
//! can pause between any two of them, and go on in the next tick.

use super::kept_stop::{DelayedRamp, KeptStop};
use super::play::{Playthrough, PlaythroughOutcome};
use super::reserve::Reserve;
use super::situation::{SET_UP, Situation};
use super::steady_rate::{SteadyRate, whole};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::ramp::{Bounds, Ramp};
use crate::real_time::track::Track;

/// How the rate goes down: perhaps in two ramps, the last one exact.
#[derive(Debug, Clone, Copy)]
struct Approach {
    /// Share of the rate that goes first, and how fast; 0 for all at once.
    share: f64,
    share_pace: f64,
    /// The fastest the last ramp may be.
    pace: f64,
}

/// Steady ticks between the two ramps, and before the first, at least: each is played from three positions
/// at a steady rate before it ([`SteadyRate::playback`]).
const GAP: f64 = 3.0;

/// What is tried: late and fast first. Nine paces of one ramp, each about .83 times the one before; then
/// two ramps, of which the first makes room where a plan is at its limits. No measurement of them is kept.
/// What fails in its first samples costs little, so many are tried.
const APPROACHES: [Approach; 24] = {
    let mut all = [Approach {
        share: 0.0,
        share_pace: 1.0,
        pace: 1.0,
    }; 24];
    let paces = [1.0, 0.85, 0.7, 0.58, 0.48, 0.4, 0.32, 0.26, 0.2];
    let (shares, share_paces, lasts) = ([0.3, 0.6, 0.85], [1.0, 0.6], [1.0, 0.6]);
    let mut i = 0;
    while i < paces.len() {
        all[i].pace = paces[i];
        i += 1;
    }
    let mut k = 0;
    while k < 12 {
        all[i + k] = Approach {
            share: shares[k / 4],
            share_pace: share_paces[k / 2 % 2],
            pace: lasts[k % 2],
        };
        k += 1;
    }
    all[i + 12] = Approach {
        share: 0.85,
        share_pace: 0.36,
        pace: 0.36,
    };
    all[i + 13] = Approach {
        share: 0.6,
        share_pace: 0.36,
        pace: 0.36,
    };
    all[i + 14] = Approach {
        share: 0.95,
        share_pace: 0.6,
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
pub(super) enum ArrivalOutcome {
    /// This stop rests at the frame.
    Found(Reserve),
    /// There was no time to try everything.
    Open,
    /// Nothing passes from here.
    Barred,
    /// The frame is too near.
    OutOfReach,
}

/// A search for a late way to rest exactly at a frame after a steady rate.
#[derive(Debug, Clone, Copy)]
pub(super) struct ArrivalSearch {
    frame: u64,
    /// The steady rate, where the last tick left it.
    from: SteadyRate,
    bounds: Bounds,
    /// The index of the approach whose turn it is, and as far as it was played.
    turn: usize,
    attempt: Option<Attempt>,
}

/// When an approach would begin, before it is tried.
struct Schedule {
    begins: f64,
    first: Option<Ramp>,
}

/// A way to rest that is being played through.
#[derive(Debug, Clone, Copy)]
struct Attempt {
    /// Ticks of the steady rate until it begins.
    begins: u32,
    /// The ramp to a lower rate before the one to rest.
    first: Option<Ramp>,
    /// The ramp that is played, and whether it is the one to rest.
    playthrough: Playthrough,
    is_last: bool,
}

impl ArrivalSearch {
    /// A search that begins with the approach of index `turn`; `None` if the frame is too near.
    pub(super) fn new(
        frame: u64,
        from: SteadyRate,
        turn: usize,
        situation: &Situation<'_>,
    ) -> Option<Self> {
        if periods(from.time, frame) <= 0.0 {
            return None;
        }
        let search = Self {
            frame,
            from,
            bounds: situation.fastest_up_to(frame, from.time, from.rate),
            turn,
            attempt: None,
        };
        search
            .schedule(*APPROACHES.first()?)
            .is_some()
            .then_some(search)
    }

    /// The index of the approach whose turn it is.
    pub(super) const fn turn(&self) -> usize {
        self.turn
    }

    /// Catches up with the motion. False if the search is about another frame, if the motion went
    /// another way, or if what is being tried would have begun.
    pub(super) fn follow(&mut self, frame: u64, now: SteadyRate) -> bool {
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
    pub(super) fn go_on(&mut self, situation: &Situation<'_>, budget: &mut u32) -> ArrivalOutcome {
        while let Some(&approach) = APPROACHES.get(self.turn) {
            let attempt = match self.attempt.take() {
                Some(attempt) => Some(attempt),
                None if *budget < SET_UP => return ArrivalOutcome::Open,
                None => self.schedule(approach).and_then(|schedule| {
                    *budget -= SET_UP;
                    self.begin(&schedule, situation.track)
                }),
            };
            let Some(mut attempt) = attempt else {
                self.turn += 1;
                continue;
            };
            match self.play(&mut attempt, situation, budget) {
                PlaythroughOutcome::Passed(_) => {
                    return ArrivalOutcome::Found(attempt.reserve(self.frame));
                }
                PlaythroughOutcome::Barred => self.turn += 1,
                PlaythroughOutcome::OutOfBudget => {
                    self.attempt = Some(attempt);
                    return ArrivalOutcome::Open;
                }
            }
        }
        ArrivalOutcome::Barred
    }

    /// When an approach begins, if there is time for it.
    fn schedule(&self, approach: Approach) -> Option<Schedule> {
        let rate = self.from.rate;
        let last_from = rate * (1.0 - approach.share);
        let (first, passed) = if approach.share > 0.0 {
            let bounds = self.bounds.paced(approach.share_pace);
            let ramp = Ramp::plan(rate, 0.0, last_from, bounds)?;
            let passed = ramp.elapsed_at(ramp.duration().ceil()) + GAP * last_from;
            (Some(ramp), passed)
        } else {
            (None, 0.0)
        };
        let fastest = Ramp::plan(last_from, 0.0, 0.0, self.bounds)?;
        // Stretching by 1/p scales the program time that a ramp to rest takes by the same, so the last ramp
        // needs E/p; what whole ticks leave is made up for by a pace a little below p.
        let needed = passed + fastest.elapsed_at(fastest.duration()) / approach.pace;
        let begins = ((periods(self.from.time, self.frame) - needed) / rate).floor();
        (begins >= GAP).then_some(Schedule { begins, first })
    }

    fn begin(&self, schedule: &Schedule, track: &Track) -> Option<Attempt> {
        let playthrough = match schedule.first {
            Some(ramp) => Playthrough::new(ramp, self.from.playback(schedule.begins, track)?),
            None => self.last_ramp(self.from, schedule.begins, track)?,
        };
        Some(Attempt {
            begins: whole(schedule.begins),
            first: schedule.first,
            playthrough,
            is_last: schedule.first.is_none(),
        })
    }

    /// The ramp that rests at the frame, so many ticks after a steady rate began.
    fn last_ramp(&self, steady: SteadyRate, begins: f64, track: &Track) -> Option<Playthrough> {
        let playback = steady.playback(begins, track)?;
        let fastest = Ramp::plan(steady.rate, 0.0, 0.0, self.bounds)?;
        let fastest_takes = fastest.elapsed_at(fastest.duration());
        let pace = (fastest_takes / periods(playback.time, self.frame)).min(1.0);
        let ramp = Ramp::plan(steady.rate, 0.0, 0.0, self.bounds.paced(pace))?;
        Some(Playthrough::new(ramp, playback))
    }

    /// Plays an approach on.
    fn play(
        &self,
        attempt: &mut Attempt,
        situation: &Situation<'_>,
        budget: &mut u32,
    ) -> PlaythroughOutcome {
        loop {
            let (track, allowed) = (situation.track, situation.allowed);
            let outcome = attempt.playthrough.go_on(track, allowed, budget);
            let PlaythroughOutcome::Passed(end) = outcome else {
                return outcome;
            };
            if attempt.is_last {
                return outcome;
            }
            let steady = SteadyRate {
                time: end.time,
                rate: attempt.playthrough.ramp().target(),
            };
            let Some(playthrough) = self.last_ramp(steady, GAP, track) else {
                return PlaythroughOutcome::Barred;
            };
            (attempt.playthrough, attempt.is_last) = (playthrough, true);
        }
    }
}

/// Program time from one time to a frame; 0 or less if that is no later.
#[allow(clippy::cast_precision_loss, reason = "a number of frames at hand")]
const fn periods(time: ProgramTime, frame: u64) -> f64 {
    frame.saturating_sub(time.sequence) as f64 - time.fraction
}

impl Attempt {
    /// The stop that it is when it has passed.
    fn reserve(&self, frame: u64) -> Reserve {
        let mut stop = KeptStop::new();
        let mut in_ticks = self.begins;
        if let Some(ramp) = self.first {
            stop.push(DelayedRamp { in_ticks, ramp });
            in_ticks = whole(GAP);
        }
        let ramp = *self.playthrough.ramp();
        stop.push(DelayedRamp { in_ticks, ramp });
        Reserve {
            stop,
            arrives_at: Some(frame),
        }
    }
}
