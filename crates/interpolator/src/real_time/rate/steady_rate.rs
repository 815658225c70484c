//! A steady rate from some program time on: where stops and ramps to rest set out from.

use super::play::PlaybackPosition;
use crate::real_time::differences::{Differences, MachinePosition};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::track::Track;

/// A steady rate from a program time on.
#[derive(Debug, Clone, Copy)]
pub(super) struct SteadyRate {
    pub(super) time: ProgramTime,
    pub(super) rate: f64,
}

impl SteadyRate {
    /// Catches up with the motion, and returns how many ticks have passed: one, or none while the
    /// motion is held. `None` if the motion went another way.
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

    /// A tick at this rate, the third or later, with the positions published before it. `None` if
    /// it is outside the frames at hand.
    pub(super) fn playback(self, tick: f64, track: &Track) -> Option<PlaybackPosition> {
        let time = |back: f64| self.time.after(self.rate * (tick - back));
        let at = |back: f64| track.whereabouts(time(back));
        let mut published = Differences::at_rest(&at(3.0)?);
        for back in [2.0, 1.0, 0.0] {
            let MachinePosition { axes, joints } = at(back)?;
            published.go_to(&axes);
            if track.has_joints() {
                published.joints_go_to(&joints);
            }
        }
        Some(PlaybackPosition {
            time: time(0.0),
            published,
            is_held: false,
        })
    }
}

/// The whole part of a number of ticks.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "not negative, and less than the frames at hand over the rate"
)]
pub(super) const fn whole(ticks: f64) -> u32 {
    ticks as u32
}
