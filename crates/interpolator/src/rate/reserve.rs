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
//! before a frame at rest that motion may not yet pass (a barrier, see [`Track`]). An epoch begins at
//! such a frame, so it begins to move with a reserve, and always has one.
//!
//! How a stop is found is told in [`super::descent`] and [`super::fall`]. The first costs less, the second
//! finds more: it begins when no place is left, or when there is little time. A plan can be at its limits on so many axes,
//! for so long, that no later one is found. Then the motion goes a little slower, where there is more room;
//! and if that cannot be, the stop in reserve is taken, however many frames there are: it is what is
//! known to keep the limits. A way back is found soon. Where the motion stands and no stop is found
//! from the full rate, it sets out at a lower one. With a horizon of 0.6 s this is rare, with near-optimal
//! plans too: they can be at their limits for a third of a second.

use super::descent::{Descent, Outcome};
use super::play::Cue;
use super::steps::Steps;
use super::trial::Trial;
use super::{Rate, Scene};
use crate::differences::Differences;
use crate::program_time::ProgramTime;
use crate::ramp::Ramp;

/// Samples a tick may spend on finding a reserve while there is time, and when there is little: then
/// the plan is hard to stop on, and whatever is found saves the motion from slowing down.
const BUDGET: u32 = 60;
const URGENT_BUDGET: u32 = 240;
/// The same for the way to rest at the end of a block, and for going slower.
const TRIAL_BUDGET: u32 = 120;
/// Places between the latest possible and the earliest useful at which a stop may begin. Counted
/// beyond that they are those of falls, the latest first again.
const PLACES: u32 = 8;
/// A reserve is replaced only by one that begins this much later, ticks.
const GAIN: u32 = 3;
/// Before a reserve begins, this many ticks are left to find a later one.
const URGENT: u32 = 14;

/// In the last ticks before a reserve begins it is tried to go slower instead: by how much, how fast.
const DIPS_LEFT: u32 = 4;
const DIPS: [(f64, f64); 6] = [
    (0.05, 0.7),
    (0.12, 1.0),
    (0.12, 0.6),
    (0.3, 1.0),
    (0.3, 0.6),
    (0.6, 0.8),
];

/// A stop that was played through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reserve {
    pub(super) steps: Steps,
    /// The frame at which it rests, if that is why it is wanted: the end of a block.
    pub(super) arrives_at: Option<u64>,
}

impl Reserve {
    /// Ticks until it begins.
    fn in_ticks(&self) -> u32 {
        self.steps.in_ticks().unwrap_or(0)
    }
}

/// A search for a stop that takes several ticks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Search {
    /// There is one. It stays where it is: a kilobyte that is moved is sixteen cache lines, twice.
    pub(super) is_under_way: bool,
    /// The steady rate, where the last tick left it.
    from: Steady,
    /// Ticks from there to the place where the stop may begin.
    begins: u32,
    /// Which place that is.
    place: u32,
    descent: Descent,
}

impl Search {
    /// None so far.
    pub(super) const fn none() -> Self {
        Self {
            is_under_way: false,
            from: Steady {
                time: ProgramTime::at(0),
                rate: 0.0,
            },
            begins: 0,
            place: 0,
            descent: Descent::new(Cue::NONE, 0.0, false),
        }
    }

    /// Begins at a place, if it is not too early there.
    fn begin(&mut self, place: u32, from: Steady, at_least: u32, scene: &Scene<'_>) {
        self.is_under_way = self.try_begin(place, from, at_least, scene).is_some();
    }

    fn try_begin(
        &mut self,
        place: u32,
        from: Steady,
        at_least: u32,
        scene: &Scene<'_>,
    ) -> Option<()> {
        let earliest = f64::from(at_least.max(3));
        let latest = latest(from, scene)?;
        let step = ((latest - earliest) / f64::from(PLACES)).max(1.0);
        let begins = (latest - f64::from(place % PLACES) * step).floor();
        if begins < earliest || place >= 2 * PLACES {
            return None;
        }
        let falls = place >= PLACES;
        self.descent
            .begin(from.cue(begins, scene)?, from.rate, falls);
        (self.from, self.begins, self.place) = (from, whole(begins), place);
        Some(())
    }

    /// Keeps up with the motion. False if it went another way, or where the stop may begin is over.
    fn follow(&mut self, now: Steady) -> bool {
        let passed = self.from.follow(now);
        let Some(begins) = passed.and_then(|ticks| self.begins.checked_sub(ticks)) else {
            return false;
        };
        self.begins = begins;
        true
    }
}

/// A steady rate that begins at a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steady {
    pub(super) time: ProgramTime,
    pub(super) rate: f64,
}

impl Steady {
    /// Goes to where the motion is now: ticks that have passed, one, or none while the motion is held.
    /// None if it went another way.
    #[allow(clippy::float_cmp, reason = "a steady rate does not change")]
    pub(super) fn follow(&mut self, now: Self) -> Option<u32> {
        if self.rate != now.rate {
            return None;
        }
        if self.time == now.time {
            return Some(0);
        }
        self.time = self.time.after(now.rate);
        (self.time == now.time).then_some(1)
    }

    /// A tick of it, the third or later, with the positions published before it.
    pub(super) fn cue(self, tick: f64, scene: &Scene<'_>) -> Option<Cue> {
        let time = |back: f64| self.time.after(self.rate * (tick - back));
        let at = |back: f64| scene.track.position(time(back));
        let mut published = Differences::at_rest(at(3.0)?);
        for back in [2.0, 1.0, 0.0] {
            published.go_to(&at(back)?);
        }
        Some(Cue {
            time: time(0.0),
            published,
            is_held: false,
        })
    }
}

/// The latest whole tick at which a stop could begin.
fn latest(from: Steady, scene: &Scene<'_>) -> Option<f64> {
    let Steady { time, rate } = from;
    let last = scene.track.end().checked_sub(time.sequence + 1)?;
    #[allow(clippy::cast_precision_loss, reason = "a number of frames at hand")]
    let (ahead, reach) = (last as f64 - time.fraction, scene.reach as f64);
    let about = (ahead - 2.0 * reach * rate).max(0.0);
    let bounds = scene.fastest_from(time.after(about).sequence);
    let ramp = Ramp::plan(rate, 0.0, 0.0, bounds)?;
    Some(((ahead - ramp.at(ramp.duration()).elapsed) / rate).floor())
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and less than the frames at hand over the rate"
)]
pub(super) const fn whole(ticks: f64) -> u32 {
    ticks as u32
}

impl Rate {
    /// Makes sure that there is a stop in reserve. Returns whether there is a new one, so that
    /// motion may pass a barrier.
    pub(crate) fn secure(&mut self, goal: f64, scene: &Scene<'_>) -> bool {
        if self.ramp.is_some() || self.rate <= 0.0 {
            return false;
        }
        let has_time = |reserve: &Reserve| reserve.in_ticks() > URGENT;
        if let Some(frame) = scene.block_end
            && goal > 0.0
            && (self.is_to_arrive_at(frame) || self.reserve.as_ref().is_none_or(has_time))
        {
            let mut budget = scene.budget(TRIAL_BUDGET);
            let passes_barrier = self.secure_arrival(frame, scene, &mut budget);
            // Motion does not set out without a way to rest at the end of the block.
            if self.is_to_arrive_at(frame) || self.is_barred(scene) {
                return passes_barrier;
            }
        }
        if scene.track.ends_at_rest() {
            self.reserve = None;
            return false;
        }
        let left = match (&self.reserve, scene.track.barrier()) {
            (Some(reserve), _) => reserve.in_ticks(),
            (None, barrier) => barrier.map_or(0, |barrier| self.ticks_to(barrier)),
        };
        // With the goal to stop, what is here is as good as what may come.
        if left >= self.enough(scene) || goal <= 0.0 {
            return false;
        }
        // Where the motion stands there is time while frames keep coming: with few of them no stop is found.
        let has_time = if self.is_barred(scene) {
            !scene.is_fully_supplied
        } else {
            left > 2 * URGENT
        };
        let mut budget = if has_time { BUDGET } else { URGENT_BUDGET };
        let finds_one = self.search_later(left + GAIN, scene, &mut budget);
        if finds_one {
            self.keep_found();
        } else if left < DIPS_LEFT && self.reserve.is_some() && scene.is_fully_supplied {
            self.dip(scene);
        }
        finds_one
    }

    /// With fewer ticks left until the reserve begins a later one is looked for. The sooner a search begins
    /// the less of it is left to any tick; but what is found soon begins soon.
    fn enough(&self, scene: &Scene<'_>) -> u32 {
        let frames = |n: u64| u32::try_from(n).unwrap_or(u32::MAX / 8);
        let reach = frames(scene.reach.max(16));
        let ahead = frames(scene.track.end().saturating_sub(self.now.sequence));
        (2 * ahead.saturating_sub(reach) / 3).clamp(3 * reach, 4 * reach)
    }

    /// The stop that was found becomes the one in reserve.
    fn keep_found(&mut self) {
        let reserve = self.reserve.get_or_insert(Reserve {
            steps: Steps::new(),
            arrives_at: None,
        });
        reserve.arrives_at = None;
        reserve.steps.copy(self.search.descent.steps());
        reserve.steps.delay(self.search.begins);
    }

    /// Goes on with the search for a later stop. Returns whether it has found one.
    #[inline(never)]
    fn search_later(&mut self, at_least: u32, scene: &Scene<'_>, budget: &mut u32) -> bool {
        let now = self.steady();
        // Ramps cost less, but the time to look for them ends.
        let is_urgent = self.reserve.is_some() && at_least <= 2 * URGENT;
        let first = if is_urgent { PLACES } else { 0 };
        let search = &mut self.search;
        let goes_on = search.is_under_way && search.follow(now) && search.place >= first;
        if !goes_on {
            search.begin(first, now, at_least, scene);
        }
        while search.is_under_way {
            match search.descent.go_on(scene, budget) {
                Outcome::Rest => {
                    search.is_under_way = false;
                    return true;
                }
                Outcome::Open => return false,
                Outcome::Lost => {
                    let next = search.place + 1;
                    search.begin(next, now, at_least, scene);
                    if !search.is_under_way && next < PLACES {
                        // No earlier place for ramps: falls from the latest on.
                        search.begin(PLACES, now, at_least, scene);
                    }
                }
            }
        }
        self.finds_no_stop = scene.is_fully_supplied && self.is_barred(scene);
        false
    }

    /// Goes a little slower, as little as possible, so that the stop in reserve need not begin: from
    /// a lower rate there is a later one.
    #[inline(never)]
    fn dip(&mut self, scene: &Scene<'_>) {
        let fastest = scene.fastest_from(self.now.sequence);
        let mut budget = scene.budget(TRIAL_BUDGET);
        for _ in 0..DIPS.len() {
            self.dips += 1;
            let Some((part, pace)) = DIPS.get(self.dips % DIPS.len()) else {
                continue;
            };
            let target = self.rate * (1.0 - part);
            let ramp = Ramp::plan(self.rate, 0.0, target, fastest.paced(*pace));
            let Some(ramp) = ramp else { continue };
            match self.try_ramp(&ramp, scene, 0, &mut budget) {
                Trial::Passed(reserve) => {
                    self.commit(ramp, *pace, reserve);
                    return;
                }
                Trial::Barred => {}
                Trial::OutOfBudget { .. } => return,
            }
        }
    }

    /// Whether, from where the motion stands, no stop was found after it has set out at the present
    /// rate, since this was asked last.
    pub(crate) const fn take_finds_no_stop(&mut self) -> bool {
        core::mem::replace(&mut self.finds_no_stop, false)
    }

    pub(super) const fn steady(&self) -> Steady {
        Steady {
            time: self.now,
            rate: self.rate,
        }
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a number of ticks; the cast saturates"
    )]
    fn ticks_to(&self, sequence: u64) -> u32 {
        let frames = sequence.saturating_sub(self.now.sequence) as f64 - self.now.fraction;
        (frames / self.rate).max(0.0) as u32
    }

    /// One tick less until the reserve begins; begins it.
    pub(super) fn count_down(&mut self) {
        let Some(reserve) = &mut self.reserve else {
            return;
        };
        let Some(ramp) = reserve.steps.count_down(self.rate, self.slope) else {
            return;
        };
        let rest = Some(*reserve).filter(|rest| !rest.steps.is_empty());
        let arrives_at = reserve.arrives_at;
        self.commit(ramp, 0.0, rest);
        self.arrives_at = arrives_at;
        self.has_taken = arrives_at.is_none();
    }
}
