//! The situation in a tick: what the choice of a ramp depends on, apart from program time and its
//! rate.

use crate::real_time::differences::{Allowed, Differences};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::ramp::Bounds;
use crate::real_time::stop_time::StopTime;
use crate::real_time::track::Track;

/// What it costs to set up a stop, in samples. No measurement of it is kept.
pub(super) const SET_UP: u32 = 6;
/// The most samples a tick may spend: what [`Situation::budget`] comes to where three stops fill the track,
/// which is the shortest period a configuration may have. Of 512 frames a stop then takes 170 ticks:
/// 2 · (170 + 3 + 6) is 358.
const MOST: u32 = 360;
/// Largest bounds of a ramp, where the motion is so slow that limits allow any: a change from 0 to 1 takes
/// at least four ticks, two to bend and two to bend back.
const FASTEST: Bounds = Bounds {
    alpha: 0.5,
    beta: 0.25,
};

/// What the motion finds in a tick: the frames ahead of it, the positions behind it, and the
/// limits.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Situation<'a> {
    /// The frames at hand.
    pub(crate) track: &'a Track,
    /// The positions published so far, as far as limits look back.
    pub(crate) published: &'a Differences,
    /// The limits.
    pub(crate) allowed: &'a Allowed,
    /// Frames that a stop from full speed takes. It takes twice as many ticks, for the rate is a half on average.
    pub(crate) stop_frames: u64,
    /// Whether the queue is about as full as the planner ever keeps it: nine tenths of the horizon.
    pub(crate) is_fully_supplied: bool,
    /// The end of a block, where the plan moves and the motion is to come to rest.
    pub(crate) block_end: Option<u64>,
}

impl Situation<'_> {
    /// Samples a tick may spend on what has to be done within it: so many, or what it takes to play
    /// a stop from full speed through twice. With less, at a short period, no stop would ever pass.
    pub(super) fn budget(&self, least: u32) -> u32 {
        // In ticks, each a sample; with what it costs to set it up and the three ticks past its end.
        let stop = u32::try_from(2 * self.stop_frames).unwrap_or(u32::MAX / 4);
        least.max(2 * (stop + 3 + SET_UP)).min(MOST)
    }

    /// Whether the frames hold the motion at a program time.
    pub(super) fn is_held_at(&self, time: ProgramTime) -> bool {
        self.track.holding_frame().map(ProgramTime::at) == Some(time)
    }

    /// Bounds of the fastest ramp worth trying at a frame: no axis needs more than its limits for
    /// it at the highest speed ahead.
    pub(super) fn fastest_from(&self, sequence: u64) -> Bounds {
        fastest(self.track.longest_stop(sequence, self.stop_frames))
    }

    /// Bounds of the fastest ramp worth trying from a steady rate down to rest at a frame.
    pub(super) fn fastest_up_to(&self, frame: u64, from: ProgramTime, rate: f64) -> Bounds {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a number of frames at hand, not negative"
        )]
        let passed = (2.0 * self.stop_frames as f64 * rate).ceil() as u64;
        let first = frame.saturating_sub(passed).max(from.sequence);
        fastest(self.track.longest_stop(first, frame + 1 - first))
    }
}

/// By q″ = Q′·ṙ and q‴ = Q′·r̈ alone, as if the plan took nothing: ṙ ≤ A·T/V and r̈ ≤ J·T²/V.
fn fastest(stop: StopTime) -> Bounds {
    Bounds {
        alpha: FASTEST.alpha.min(1.0 / stop.by_acceleration),
        beta: FASTEST.beta.min(1.0 / stop.by_jerk_squared),
    }
}
