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

/// Plays a ramp through to three ticks past its end.
pub(super) fn play(
    ramp: &Ramp,
    cue: Cue,
    track: &Track,
    allowed: &Allowed,
    budget: &mut u32,
) -> Played {
    let (mut published, mut after) = (cue.published, cue);
    let (whole, end) = (ramp.duration().ceil(), ramp.duration() + 3.0);
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
        if t <= whole {
            (after.time, after.published) = (time, published);
        }
    }
    Played::Passed(after)
}

/// Most samples of a tick: what it takes where three stops fill the track, which is the shortest period
/// a configuration may have.
const MOST: u32 = 360;

impl Scene<'_> {
    /// Samples a tick may spend: so many, or what it takes to play a stop from full speed through
    /// twice. With less, at a short period, no stop would ever pass.
    pub(super) fn budget(&self, least: u32) -> u32 {
        let stop = u32::try_from(2 * self.reach).unwrap_or(u32::MAX / 4);
        least.max(2 * (stop + 3 + SET_UP)).min(MOST)
    }
}
