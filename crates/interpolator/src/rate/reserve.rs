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
//! A plan can be at its limits on so many axes, for so long, that no later stop is found. Then the one
//! in reserve is taken, however many frames there are: it is what is known to keep the limits. A
//! little slower, with r³ of the plan's jerk, there is more room, and a way back is found soon. Where
//! the motion stands and no stop is found from the full rate, it sets out at a lower one.

use super::play::{Cue, Played, SET_UP, play};
use super::{FASTEST, Rate, Scene};
use crate::differences::Differences;
use crate::program_time::ProgramTime;
use crate::ramp::{Bounds, Ramp};

/// Samples a tick may spend on finding a reserve, unless stops are longer.
const BUDGET: u32 = 120;
/// Places between the latest possible and the earliest useful at which a stop of a shape may begin.
const PLACES: usize = 48;
/// A reserve is replaced only by one that begins this much later, ticks.
const GAIN: u32 = 3;
/// Before a reserve begins, this many ticks are left to relaxed limits.
const URGENT: u32 = 14;
/// A shape of a stop: how much of the rate goes at first, and how fast.
#[derive(Debug, Clone, Copy)]
struct Shape {
    part: f64,
    pace: f64,
}

/// The shapes, simple ones first. One that does not take the whole rate at first gets away from a
/// plan at its limits: then there is room for a second ramp that takes the rest.
const SHAPES: [Shape; 7] = [
    Shape {
        part: 1.0,
        pace: 1.0,
    },
    Shape {
        part: 1.0,
        pace: 0.7,
    },
    Shape {
        part: 1.0,
        pace: 0.45,
    },
    Shape {
        part: 0.3,
        pace: 1.0,
    },
    Shape {
        part: 0.3,
        pace: 0.6,
    },
    Shape {
        part: 0.1,
        pace: 0.8,
    },
    Shape {
        part: 0.6,
        pace: 0.8,
    },
];

/// All candidates: every shape at every place.
pub(super) const CANDIDATES: usize = PLACES * SHAPES.len();

/// Between the end of the first ramp and the second: ticks, and the second's pace.
const SECOND: [(f64, f64); 8] = [
    (3.0, 1.0),
    (3.0, 0.6),
    (6.0, 1.0),
    (6.0, 0.6),
    (10.0, 1.0),
    (10.0, 0.6),
    (15.0, 1.0),
    (15.0, 0.6),
];

/// A ramp that begins some ticks from now.
#[derive(Debug, Clone, Copy)]
pub(super) struct Later {
    pub(super) in_ticks: u32,
    pub(super) ramp: Ramp,
}

/// A stop that was played through.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reserve {
    pub(super) first: Later,
    /// Takes what the first leaves; counted from the end of the first.
    pub(super) second: Option<Later>,
    /// The frame at which it rests, if that is why it is wanted: the end of a block.
    pub(super) arrives_at: Option<u64>,
}

/// A steady rate that begins at a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steady {
    pub(super) time: ProgramTime,
    pub(super) rate: f64,
}

impl Steady {
    /// A tick of it, the third or later, with the positions published before it.
    pub(super) fn cue(self, tick: f64, scene: &Scene<'_>) -> Option<Cue> {
        let time = |back: f64| self.time.after(self.rate * (tick - back));
        let at = |back: f64| scene.track.position(time(back));
        let first = Differences::at_rest(at(3.0)?);
        let published = first.then(&at(2.0)?).then(&at(1.0)?).then(&at(0.0)?);
        Some(Cue {
            time: time(0.0),
            published,
            is_held: false,
        })
    }
}

impl Reserve {
    /// A late stop that passes, after at least `at_least` ticks of a steady rate. Goes on at
    /// candidate `search_at`, where the last search ended; [`CANDIDATES`] if that was the end.
    pub(super) fn find(
        from: Steady,
        at_least: u32,
        scene: &Scene<'_>,
        search_at: &mut usize,
        budget: &mut u32,
    ) -> Option<Self> {
        let earliest = f64::from(at_least.max(3));
        for candidate in *search_at..CANDIDATES {
            *search_at = candidate;
            if *budget < SET_UP {
                return None;
            }
            let Some(&shape) = SHAPES.get(candidate / PLACES) else {
                continue;
            };
            let Some((latest, ramp)) = latest(from, shape, scene) else {
                continue;
            };
            #[allow(clippy::cast_precision_loss, reason = "small numbers")]
            let (place, places) = ((candidate % PLACES) as f64, PLACES as f64);
            let step = ((latest - earliest) / places).max(1.0);
            let begins = (latest - place * step).floor();
            if begins < earliest {
                continue;
            }
            *budget -= SET_UP;
            let found = stop_at(from, begins, &ramp, scene, budget);
            if found.is_some() {
                *search_at = 0;
                return found;
            }
        }
        *search_at = CANDIDATES;
        None
    }
}

/// The stop that begins at a tick with a ramp, if it passes.
fn stop_at(
    from: Steady,
    begins: f64,
    ramp: &Ramp,
    scene: &Scene<'_>,
    budget: &mut u32,
) -> Option<Reserve> {
    let cue = from.cue(begins, scene)?;
    if play(ramp, cue, scene.track, scene.allowed, budget) != Played::Passed {
        return None;
    }
    let second = if ramp.target() > 0.0 {
        let time = cue.time.after(ramp.at(ramp.duration().ceil()).elapsed);
        Some(second_ramp(
            Steady {
                time,
                rate: ramp.target(),
            },
            scene,
            budget,
        )?)
    } else {
        None
    };
    let first = Later {
        in_ticks: whole(begins),
        ramp: *ramp,
    };
    Some(Reserve {
        first,
        second,
        arrives_at: None,
    })
}

/// A ramp to rest soon after the first.
fn second_ramp(from: Steady, scene: &Scene<'_>, budget: &mut u32) -> Option<Later> {
    let bounds = scene.fastest_from(from.time.sequence);
    SECOND.iter().find_map(|&(begins, pace)| {
        let ramp = Ramp::plan(from.rate, 0.0, 0.0, bounds.paced(pace))?;
        let cue = from.cue(begins, scene)?;
        let played = play(&ramp, cue, scene.track, scene.allowed, budget);
        (played == Played::Passed).then_some(Later {
            in_ticks: whole(begins),
            ramp,
        })
    })
}

/// The latest whole tick at which a stop of a shape can begin, and its first ramp.
fn latest(from: Steady, shape: Shape, scene: &Scene<'_>) -> Option<(f64, Ramp)> {
    let Steady { time, rate } = from;
    let last = scene.track.end().checked_sub(time.sequence + 1)?;
    #[allow(clippy::cast_precision_loss, reason = "a number of frames at hand")]
    let (ahead, reach) = (last as f64 - time.fraction, scene.reach as f64);
    let about = (ahead - 2.0 * reach * rate).max(0.0);
    let bounds = scene.fastest_from(time.after(about).sequence);
    let target = rate * (1.0 - shape.part);
    let ramp = Ramp::plan(rate, 0.0, target, bounds.paced(shape.pace))?;
    let rest = Ramp::plan(target, 0.0, 0.0, bounds)?;
    let gap = 4.0 * target;
    let length = ramp.at(ramp.duration()).elapsed + rest.at(rest.duration()).elapsed + gap;
    Some((((ahead - length) / rate).floor(), ramp))
}

#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and less than the frames at hand over the rate"
)]
pub(super) const fn whole(ticks: f64) -> u32 {
    ticks as u32
}

impl Scene<'_> {
    /// Bounds of the fastest ramp worth trying at a place: no axis needs more than its limits for it
    /// at the highest speed ahead.
    pub(super) fn fastest_from(&self, sequence: u64) -> Bounds {
        let stop = self.track.longest_stop(sequence, self.reach);
        Bounds {
            alpha: FASTEST.alpha.min(1.0 / stop.by_acceleration),
            beta: FASTEST.beta.min(1.0 / stop.by_jerk_squared),
        }
    }
}

impl Rate {
    /// Makes sure that there is a stop in reserve. Returns whether there is a new one, so that
    /// motion may pass a barrier.
    pub(crate) fn secure(&mut self, goal: f64, scene: &Scene<'_>) -> bool {
        if self.ramp.is_some() || self.rate <= 0.0 {
            return false;
        }
        let mut budget = scene.budget(BUDGET);
        let has_time = |reserve: &Reserve| reserve.first.in_ticks > URGENT;
        if let Some(frame) = scene.block_end
            && goal > 0.0
            && (self.is_to_arrive_at(frame) || self.reserve.as_ref().is_none_or(has_time))
        {
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
            (Some(reserve), _) => reserve.first.in_ticks,
            (None, barrier) => barrier.map_or(0, |barrier| self.ticks_to(barrier)),
        };
        let enough = u32::try_from(scene.reach.max(16) * 3).unwrap_or(u32::MAX);
        // With the goal to stop, what is here is as good as what may come.
        if left >= enough || goal <= 0.0 {
            return false;
        }
        if self.search_at >= CANDIDATES {
            self.search_at = 0;
            self.finds_no_stop = scene.is_fully_supplied && self.is_barred(scene);
        }
        let from = self.steady();
        let search_at = &mut self.search_at;
        let found = Reserve::find(from, left + GAIN, scene, search_at, &mut budget);
        if found.is_some() {
            self.reserve = found;
        }
        found.is_some()
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
        if reserve.first.in_ticks > 0 {
            reserve.first.in_ticks -= 1;
            return;
        }
        let Reserve {
            first,
            second,
            arrives_at,
        } = *reserve;
        let rest = second.map(|second| Reserve {
            first: second,
            second: None,
            arrives_at,
        });
        self.commit(first.ramp, 0.0, rest);
        self.arrives_at = arrives_at;
        self.has_taken = arrives_at.is_none();
    }
}
