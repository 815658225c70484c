//! The trial of a ramp: it must pass, and a stop after it must be known.
//!
//! Where the motion stands the next tick finds everything as it was: there a trial that has used up
//! the budget of a tick is kept, and goes on. Where it moves, the next tick finds something else.

use super::arrival_search::{ArrivalOutcome, ArrivalSearch};
use super::play::{PlaybackPosition, Playthrough, PlaythroughOutcome};
use super::reserve::Reserve;
use super::situation::Situation;
use super::steady_rate::SteadyRate;
use super::stop_search::{StopOutcome, StopSearch};
use crate::real_time::ramp::Ramp;

/// The stop after a ramp begins no earlier than so many ticks after its end, if there are frames
/// for that: in these a later one is found. Where it began at once, a plan that is at its limits
/// everywhere was not played as fast as planned.
const AFTERWARDS: u32 = 12;

/// What trying a ramp has shown.
#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for a moment; no boxes here"
)]
pub(super) enum TrialOutcome {
    /// The ramp keeps the limits, and this is the stop after it, unless it ends in one or the
    /// frames hold the motion.
    Passed(Option<Reserve>),
    /// The ramp breaks a limit, or there is no stop after it.
    Barred,
    /// There was no time to try everything: on the way to the end of a block, from this approach
    /// on.
    OutOfBudget {
        /// The index of the approach.
        approach: Option<usize>,
    },
}

/// A ramp that is being tried.
#[derive(Debug, Clone, Copy)]
pub(super) struct RampTrial {
    ramp: Ramp,
    /// The approach with which the search for a rest at the end of the block begins.
    first_approach: usize,
    stage: Stage,
    /// Ticks of the steady rate between the ramp and a stop.
    goes_on: u32,
    /// The frame that held the motion, and the one it was to rest at, when the trial began.
    holding_frame: Option<u64>,
    block_end: Option<u64>,
}

#[derive(Debug, Clone, Copy)]
#[allow(
    clippy::large_enum_variant,
    reason = "there is one of them; no boxes here"
)]
enum Stage {
    /// The ramp itself is played through.
    Ramp(Playthrough),
    /// It has passed, and a stop after it is searched.
    Stop(StopSearch),
    /// It has passed, and a way to rest at the end of the block is searched.
    Arrival(ArrivalSearch),
}

impl RampTrial {
    pub(super) fn new(
        ramp: &Ramp,
        playback: PlaybackPosition,
        first_approach: usize,
        situation: &Situation<'_>,
    ) -> Self {
        Self {
            ramp: *ramp,
            first_approach,
            stage: Stage::Ramp(Playthrough::new(*ramp, playback)),
            goes_on: 0,
            holding_frame: situation.track.holding_frame(),
            block_end: situation.block_end,
        }
    }

    /// The ramp that is tried.
    pub(super) const fn ramp(&self) -> &Ramp {
        &self.ramp
    }

    /// The frame that held the motion when the trial began.
    pub(super) const fn holding_frame(&self) -> Option<u64> {
        self.holding_frame
    }

    /// Whether the same frames hold the motion, and it is to rest at the same frame, as when the
    /// trial began.
    pub(super) fn is_about(&self, situation: &Situation<'_>) -> bool {
        situation.track.holding_frame() == self.holding_frame
            && situation.block_end == self.block_end
    }

    /// Whether the ramp has passed, and a stop after it anywhere is being searched.
    pub(super) const fn searches_stop(&self) -> bool {
        matches!(self.stage, Stage::Stop(_))
    }

    /// Goes on until the outcome is known, or until the budget is used up.
    pub(super) fn go_on(&mut self, situation: &Situation<'_>, budget: &mut u32) -> TrialOutcome {
        if let Stage::Ramp(playthrough) = &mut self.stage {
            let end = match playthrough.go_on(situation.track, situation.allowed, budget) {
                PlaythroughOutcome::Passed(_) if self.ramp.target() <= 0.0 => {
                    return TrialOutcome::Passed(None);
                }
                PlaythroughOutcome::Passed(end) => end,
                PlaythroughOutcome::Barred => return TrialOutcome::Barred,
                PlaythroughOutcome::OutOfBudget => {
                    return TrialOutcome::OutOfBudget { approach: None };
                }
            };
            let rate = self.ramp.target();
            let steady = SteadyRate {
                time: end.time,
                rate,
            };
            if let Some(frame) = self.block_end {
                let first = self.first_approach;
                let Some(arrival) = ArrivalSearch::new(frame, steady, first, situation) else {
                    return TrialOutcome::Barred;
                };
                self.stage = Stage::Arrival(arrival);
            } else if self.holding_frame.is_some() {
                return TrialOutcome::Passed(None);
            } else {
                let later = situation.is_fully_supplied.then_some(AFTERWARDS);
                let at = later.and_then(|ticks| steady.playback(f64::from(ticks), situation.track));
                self.goes_on = later.filter(|_| at.is_some()).unwrap_or(0);
                let at = at.unwrap_or(PlaybackPosition {
                    is_held: false,
                    ..end
                });
                self.stage = Stage::Stop(StopSearch::new(at, rate));
            }
        }
        self.search_rest(situation, budget)
    }

    /// Searches a rest after the ramp.
    fn search_rest(&mut self, situation: &Situation<'_>, budget: &mut u32) -> TrialOutcome {
        match &mut self.stage {
            Stage::Ramp(_) => TrialOutcome::Barred,
            Stage::Stop(search) => match search.go_on(situation, budget) {
                StopOutcome::Rest => {
                    let mut stop = *search.stop();
                    stop.delay(self.goes_on);
                    TrialOutcome::Passed(Some(Reserve {
                        stop,
                        arrives_at: None,
                    }))
                }
                StopOutcome::Open => TrialOutcome::OutOfBudget { approach: None },
                StopOutcome::Lost => TrialOutcome::Barred,
            },
            Stage::Arrival(search) => match search.go_on(situation, budget) {
                ArrivalOutcome::Found(reserve) => TrialOutcome::Passed(Some(reserve)),
                ArrivalOutcome::Open => TrialOutcome::OutOfBudget {
                    approach: Some(search.turn()),
                },
                ArrivalOutcome::Barred | ArrivalOutcome::OutOfReach => TrialOutcome::Barred,
            },
        }
    }
}
