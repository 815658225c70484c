//! A rate that is given from outside, tick by tick: by the angle of the spindle.
//!
//! Between two ticks it is as good as steady: a rate is taken only if going on with it keeps the
//! limits and there is a stop after it. So whatever comes next, what was taken may be kept.

use super::play::PlaybackPosition;
use super::progress::Progress;
use super::ramp_trial::{RampTrial, TrialOutcome};
use super::situation::Situation;
use super::state::Rate;
use crate::real_time::differences::Differences;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::ramp::{Bounds, Ramp};

/// Samples a tick may spend on it.
const BUDGET: u32 = 240;
/// A change of the rate within a tick has no shape.
const AT_ONCE: Bounds = Bounds {
    alpha: 1.0,
    beta: 1.0,
};

impl Rate {
    /// Goes on at another steady rate from this tick on, if that passes. Returns whether it does.
    pub(crate) fn change_at_once(&mut self, rate: f64, situation: &Situation<'_>) -> bool {
        self.try_at_once(self.now.time, *situation.published, rate, situation)
    }

    /// Sets out from rest, to be at a program time at once and to go on at a rate, if that passes.
    pub(crate) fn set_out_at(
        &mut self,
        time: ProgramTime,
        rate: f64,
        situation: &Situation<'_>,
    ) -> bool {
        let mut published = *situation.published;
        let passes = situation
            .track
            .append_to(&mut published, time, situation.allowed);
        passes && self.try_at_once(time, published, rate, situation)
    }

    fn try_at_once(
        &mut self,
        time: ProgramTime,
        published: Differences,
        rate: f64,
        situation: &Situation<'_>,
    ) -> bool {
        if situation.track.ends_at_rest() {
            self.reserve.kept = None;
        }
        let Some(steady) = Ramp::plan(rate, 0.0, rate, AT_ONCE) else {
            return false;
        };
        let playback = PlaybackPosition {
            time,
            published,
            is_held: true,
        };
        let mut budget = situation.budget(BUDGET);
        let mut trial = RampTrial::new(&steady, playback, 0, situation);
        let TrialOutcome::Passed(reserve) = trial.go_on(situation, &mut budget) else {
            return false;
        };
        self.now = Progress {
            time,
            rate,
            slope: 0.0,
        };
        self.commit(steady, 1.0, situation.track.holding_frame(), reserve);
        true
    }

    /// How fast the rate may change in a tick, per tick, for the speeds that are planned from a
    /// frame on.
    pub(crate) fn most_change(&self, situation: &Situation<'_>) -> f64 {
        situation.fastest_from(self.now.time.sequence).beta
    }
}
