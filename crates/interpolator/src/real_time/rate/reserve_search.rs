//! The stop in reserve: how the motion comes to rest if no more frames arrive.
//!
//! While program time advances at a steady rate, a reserve says: so many ticks from now, a certain
//! ramp to rest may begin; it has been played through, and needs only frames that are here. As long
//! as frames keep coming, a later one is found well before, and replaces it. If none is found in
//! time, it is taken.
//!
//! ```text
//!       now          reserve begins      rests      newest frame
//! ───────┼──────────────────┼──────────────┼────────────┤
//!        │◄─ steady rate ──►│◄──── r → 0 ─►│
//! ```
//!
//! No reserve is needed where the frames themselves hold the motion: before a program stop, and
//! before a frame at rest that motion may not yet pass (a barrier, see
//! [`Track`](crate::real_time::track::Track)). An epoch begins at such a frame, so it begins to move with a
//! reserve, and always has one.
//!
//! How a stop is found is told in [`super::stop_search`] and [`super::greedy_slow_down`]. The first
//! costs less, the second finds more: it is begun when no start is left for the first, or when
//! there is little time. A plan can be at its limits on so many axes, for so long, that no later
//! stop is found, or that there is none. Then the motion goes a little slower, where there is more
//! room; and if that cannot be, the stop in reserve is taken, however many frames there are: it is
//! what is known to keep the limits. A way back is mostly found soon. Where the motion stands and no stop
//! is found from the full rate, it sets out at a lower one. With a horizon of 0.6 s this is rare,
//! with near-optimal plans too.

use super::greedy_slow_down::{GreedySlowDown, SlowDownOutcome};
use super::kept_stop::{DelayedRamp, KeptStop, SlowDownSlopes};
use super::play::PlaybackPosition;
use super::situation::Situation;
use super::steady_rate::{SteadyRate, whole};
use super::stop_search::{StopOutcome, StopSearch};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::ramp::Ramp;

/// The starts of a stop that are tried: which share of the ticks between the latest possible and the
/// earliest useful it is before the latest. Late first: the later a stop begins, the longer no other has
/// to be found. There is nothing to bisect, for a plan has room here and none there: that one start fails
/// says nothing of an earlier one. So a few are tried that are far apart; of where, no measurement is kept.
const STARTS: [f64; 6] = [0.0, 0.2, 0.4, 0.8, 0.95, 1.0];
/// From this one on with a greedy slow-down, which finds later starts, too: the steady rate is one of its
/// branches, so it may go down from any tick after its start.
const SLOW_DOWNS: usize = 3;
/// Ticks before a stop begins, at least: it is played from three positions at the steady rate before it
/// ([`SteadyRate::playback`]), because limits are of third differences.
const LEAST_TICKS: u32 = 3;

/// What a search for a later stop has come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReserveOutcome {
    /// A stop is known.
    Found,
    /// There was no time to try everything.
    Open,
    /// From no start is there a stop.
    NoneLeft,
}

/// A search for a later stop in reserve that takes several ticks.
#[derive(Debug)]
pub(super) struct ReserveSearch {
    /// There is one. It stays where it is: a kilobyte that is moved is sixteen cache lines, twice.
    is_under_way: bool,
    /// The steady rate, where the last tick left it.
    from: SteadyRate,
    /// Ticks from there to the start of the stop.
    begins: u32,
    /// The index of that start in [`STARTS`].
    turn: usize,
    stop: StopSearch,
    slow_down: GreedySlowDown,
    slopes: SlowDownSlopes,
    found: KeptStop,
}

impl ReserveSearch {
    /// No search so far.
    pub(super) fn new() -> Self {
        Self {
            is_under_way: false,
            from: SteadyRate {
                time: ProgramTime::at(0),
                rate: 0.0,
            },
            begins: 0,
            turn: 0,
            stop: StopSearch::new(PlaybackPosition::NONE, 0.0),
            slow_down: GreedySlowDown::new(),
            slopes: SlowDownSlopes::new(),
            found: KeptStop::new(),
        }
    }

    /// Gives the search up.
    pub(super) const fn give_up(&mut self) {
        self.is_under_way = false;
    }

    /// The stop that was found becomes the one in reserve.
    pub(super) fn take_found(&mut self, kept: &mut KeptStop) {
        kept.copy(&self.found);
        kept.delay(self.begins);
        if kept.descends() {
            self.slopes.keep();
        }
    }

    /// The slopes of the stop in reserve.
    pub(super) const fn slopes(&self) -> &SlowDownSlopes {
        &self.slopes
    }

    /// Goes on with the search for a stop that begins `at_least` so many ticks from now, or begins
    /// it anew if the motion went another way. Where time `is_short`, only greedy slow-downs are left
    /// to try. Not in line, like all that looks for a ramp or a stop: what most ticks do not do is
    /// not to spread their code and their stack.
    #[inline(never)]
    pub(super) fn go_on(
        &mut self,
        now: SteadyRate,
        at_least: u32,
        is_short: bool,
        situation: &Situation<'_>,
        budget: &mut u32,
    ) -> ReserveOutcome {
        let first = if is_short { SLOW_DOWNS } else { 0 };
        let goes_on = self.is_under_way && self.follow(now) && self.turn >= first;
        if !goes_on {
            self.begin(first, now, at_least, situation);
        }
        while self.is_under_way {
            match self.go_on_from_start(situation, budget) {
                StopOutcome::Rest => {
                    self.is_under_way = false;
                    return ReserveOutcome::Found;
                }
                StopOutcome::Open => return ReserveOutcome::Open,
                StopOutcome::Lost => self.begin(self.turn + 1, now, at_least, situation),
            }
        }
        ReserveOutcome::NoneLeft
    }

    fn go_on_from_start(&mut self, situation: &Situation<'_>, budget: &mut u32) -> StopOutcome {
        if self.turn < SLOW_DOWNS {
            let outcome = self.stop.go_on(situation, budget);
            if matches!(outcome, StopOutcome::Rest) {
                self.found.copy(self.stop.stop());
            }
            return outcome;
        }
        match self.slow_down.go_on(situation, budget) {
            SlowDownOutcome::Rest(ramp) => {
                self.found = KeptStop::after(self.slow_down.write(&mut self.slopes));
                self.found.push(DelayedRamp { in_ticks: 0, ramp });
                StopOutcome::Rest
            }
            SlowDownOutcome::Open => StopOutcome::Open,
            SlowDownOutcome::Lost => StopOutcome::Lost,
        }
    }

    /// Begins with a start, if it is not too early.
    fn begin(&mut self, turn: usize, from: SteadyRate, at_least: u32, situation: &Situation<'_>) {
        self.is_under_way = self.try_begin(turn, from, at_least, situation).is_some();
    }

    fn try_begin(
        &mut self,
        turn: usize,
        from: SteadyRate,
        at_least: u32,
        situation: &Situation<'_>,
    ) -> Option<()> {
        let earliest = f64::from(at_least.max(LEAST_TICKS));
        let latest = latest(from, situation)?;
        let begins = (latest - STARTS.get(turn)? * (latest - earliest)).floor();
        if begins < earliest {
            return None;
        }
        let playback = from.playback(begins, situation.track)?;
        if turn < SLOW_DOWNS {
            self.stop.begin(playback, from.rate);
        } else {
            self.slow_down.begin(playback, from.rate);
        }
        (self.from, self.begins, self.turn) = (from, whole(begins), turn);
        Some(())
    }

    /// Catches up with the motion. False if it went another way, or where the stop may begin is
    /// over.
    fn follow(&mut self, now: SteadyRate) -> bool {
        let passed = self.from.follow(now);
        let Some(begins) = passed.and_then(|ticks| self.begins.checked_sub(ticks)) else {
            return false;
        };
        self.begins = begins;
        true
    }
}

/// The latest whole tick at which a stop could begin.
fn latest(from: SteadyRate, situation: &Situation<'_>) -> Option<f64> {
    let SteadyRate { time, rate } = from;
    let last = situation.track.end().checked_sub(time.sequence + 1)?;
    #[allow(clippy::cast_precision_loss, reason = "a number of frames at hand")]
    let ahead = last as f64 - time.fraction;
    // The bounds of the fastest ramp depend on the speed where it begins, which depends on them. So as many ticks
    // as a stop from full speed takes are gone back, at the rate, and the highest speed in the frames of a stop
    // from there on counts. In ticks it takes twice as many as in frames.
    let stop_ticks = 2.0 * situation.stop_frames as f64;
    let about = (ahead - stop_ticks * rate).max(0.0);
    let bounds = situation.fastest_from(time.after(about).sequence);
    let ramp = Ramp::plan(rate, 0.0, 0.0, bounds)?;
    // What is left of the frames when the fastest ramp has had its part, in ticks at the steady rate. Only
    // where searches begin depends on it; what they find was played through.
    Some(((ahead - ramp.at(ramp.duration()).elapsed) / rate).floor())
}
