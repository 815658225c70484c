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

use super::descent::{Later, Steps};
use super::play::{Played, SET_UP, play};
use super::reserve::{Reserve, Steady, whole};
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

/// Where to rest, seen from a steady rate.
struct Aim<'a> {
    frame: u64,
    from: Steady,
    /// Program time to the frame, periods.
    left: f64,
    bounds: Bounds,
    scene: &'a Scene<'a>,
}

/// A way to rest, before it is tried.
struct Plan {
    begins: f64,
    first: Option<Ramp>,
    last_from: f64,
    fastest: Ramp,
}

impl Reserve {
    /// A late way to rest exactly at `frame` after a steady rate. Goes on at approach `search_at`.
    pub(super) fn arriving_at(
        frame: u64,
        from: Steady,
        scene: &Scene<'_>,
        search_at: &mut usize,
        budget: &mut u32,
    ) -> Search {
        #[allow(clippy::cast_precision_loss, reason = "a number of frames at hand")]
        let left = frame.saturating_sub(from.time.sequence) as f64 - from.time.fraction;
        if left <= 0.0 {
            return Search::OutOfReach;
        }
        let aim = Aim {
            frame,
            from,
            left,
            bounds: scene.fastest_up_to(frame, from),
            scene,
        };
        let direct = APPROACHES.first().and_then(|approach| aim.plan(*approach));
        if direct.is_none() {
            return Search::OutOfReach;
        }
        for (place, &approach) in APPROACHES.iter().enumerate().skip(*search_at) {
            *search_at = place;
            if *budget < SET_UP {
                return Search::Open;
            }
            let Some(plan) = aim.plan(approach) else {
                continue;
            };
            *budget -= SET_UP;
            if let Some(found) = aim.play(&plan, budget) {
                *search_at = 0;
                return Search::Found(found);
            }
        }
        *search_at = 0;
        Search::Barred
    }
}

impl Aim<'_> {
    /// When an approach begins, if there is time for it.
    fn plan(&self, approach: Approach) -> Option<Plan> {
        let rate = self.from.rate;
        let last_from = rate * (1.0 - approach.part);
        let (first, passed) = if approach.part > 0.0 {
            let bounds = self.bounds.paced(approach.part_pace);
            let ramp = Ramp::plan(rate, 0.0, last_from, bounds)?;
            let passed = ramp.at(ramp.duration().ceil()).elapsed + GAP * last_from;
            (Some(ramp), passed)
        } else {
            (None, 0.0)
        };
        let fastest = Ramp::plan(last_from, 0.0, 0.0, self.bounds)?;
        let needed = passed + fastest.at(fastest.duration()).elapsed / approach.pace;
        let begins = ((self.left - needed) / rate).floor();
        (begins >= 3.0).then_some(Plan {
            begins,
            first,
            last_from,
            fastest,
        })
    }

    /// Plays a plan through; `None` if it does not pass.
    fn play(&self, plan: &Plan, budget: &mut u32) -> Option<Reserve> {
        let mut left = self.left - plan.begins * self.from.rate;
        let (mut steady, mut begins) = (self.from, plan.begins);
        let mut steps = Steps::default();
        if let Some(ramp) = plan.first {
            let cue = steady.cue(begins, self.scene)?;
            let Played::Passed(_) = play(&ramp, cue, self.scene, budget) else {
                return None;
            };
            let passed = ramp.at(ramp.duration().ceil()).elapsed;
            let in_ticks = whole(begins);
            steps.push(Later { in_ticks, ramp });
            steady = Steady {
                time: cue.time.after(passed),
                rate: plan.last_from,
            };
            left -= passed + GAP * plan.last_from;
            begins = GAP;
        }
        let fastest_takes = plan.fastest.at(plan.fastest.duration()).elapsed;
        let pace = (fastest_takes / left).min(1.0);
        let ramp = Ramp::plan(plan.last_from, 0.0, 0.0, self.bounds.paced(pace))?;
        let cue = steady.cue(begins, self.scene)?;
        let Played::Passed(_) = play(&ramp, cue, self.scene, budget) else {
            return None;
        };
        let in_ticks = whole(begins);
        steps.push(Later { in_ticks, ramp });
        Some(Reserve {
            steps,
            arrives_at: Some(self.frame),
        })
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
    pub(super) fn secure_arrival(
        &mut self,
        frame: u64,
        scene: &Scene<'_>,
        budget: &mut u32,
    ) -> bool {
        if self.is_to_arrive_at(frame) {
            return false;
        }
        let mut search_at = self.arrival_search;
        let search = Reserve::arriving_at(frame, self.steady(), scene, &mut search_at, budget);
        self.arrival_search = search_at;
        match search {
            Search::Found(reserve) => {
                self.reserve = Some(reserve);
                scene.track.barrier().is_some_and(|barrier| barrier < frame)
            }
            Search::Open => false,
            Search::Barred | Search::OutOfReach => {
                // From nearer something may pass, but not from a place where the motion stands.
                self.has_missed = self.is_barred(scene) || matches!(search, Search::OutOfReach);
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
