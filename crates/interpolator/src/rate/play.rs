//! Playing a ramp through: what it would publish, tick by tick.

use super::Scene;
use crate::differences::{Allowed, Differences};
use crate::program_time::ProgramTime;
use crate::ramp::Ramp;
use crate::track::Track;

/// What it costs to set up a stop, in samples.
pub(super) const SET_UP: u32 = 6;

/// What playing a ramp through has shown.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum Played {
    /// Where the ramp ends, at a whole tick.
    Passed(Cue),
    Barred,
    OutOfBudget,
}

/// Where a ramp is played from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cue {
    pub(super) time: ProgramTime,
    /// The positions published before it.
    pub(super) published: Differences,
    /// Whether motion stands at what holds it now. A reserve is for after that.
    pub(super) is_held: bool,
}

impl Cue {
    /// Nowhere yet.
    pub(super) const NONE: Self = Self {
        time: ProgramTime::at(0),
        published: Differences::NONE,
        is_held: false,
    };
}

/// A ramp that is being played through, to three ticks past its end. It can pause between any two
/// samples.
#[derive(Debug, Clone, Copy)]
pub(super) struct Playing {
    ramp: Ramp,
    from: ProgramTime,
    is_held: bool,
    /// Ticks played, and the positions up to there.
    t: f64,
    published: Differences,
    /// Where the ramp ends, once it was played so far.
    after: Cue,
}

impl Playing {
    pub(super) const fn new(ramp: Ramp, cue: Cue) -> Self {
        Self {
            ramp,
            from: cue.time,
            is_held: cue.is_held,
            t: 0.0,
            published: cue.published,
            after: cue,
        }
    }

    pub(super) const fn ramp(&self) -> &Ramp {
        &self.ramp
    }

    #[allow(clippy::float_cmp, reason = "both are whole numbers")]
    pub(super) fn go_on(&mut self, track: &Track, allowed: &Allowed, budget: &mut u32) -> Played {
        let stop = track.stop().filter(|_| self.is_held);
        let (whole, end) = (self.ramp.duration().ceil(), self.ramp.duration() + 3.0);
        while self.t < end {
            if *budget == 0 {
                return Played::OutOfBudget;
            }
            *budget -= 1;
            self.t += 1.0;
            let elapsed = self.ramp.elapsed_at(self.t);
            let time = self.from.after(elapsed).held_at(stop);
            if !track.take(time, &mut self.published, allowed) {
                return Played::Barred;
            }
            if self.t == whole {
                (self.after.time, self.after.published) = (time, self.published);
            }
        }
        Played::Passed(self.after)
    }
}

/// Most samples of a tick: what it takes where three stops fill the track, which is the shortest period
/// a configuration may have.
const MOST: u32 = 360;

impl Scene<'_> {
    /// Samples a tick may spend on what has to be done within it: so many, or what it takes to play a
    /// stop from full speed through twice. With less, at a short period, no stop would ever pass.
    pub(super) fn budget(&self, least: u32) -> u32 {
        let stop = u32::try_from(2 * self.reach).unwrap_or(u32::MAX / 4);
        least.max(2 * (stop + 3 + SET_UP)).min(MOST)
    }
}
