//! The choice of a stop: a later one in reserve, or one that arrives at the end of a block.

use super::arrival_search::{ArrivalOutcome, ArrivalSearch};
use super::ramp_trial::TrialOutcome;
use super::reserve::Reserve;
use super::reserve_search::ReserveOutcome;
use super::situation::Situation;
use super::state::Rate;
use crate::real_time::ramp::Ramp;

/// Samples a tick may spend on finding a reserve while there is time, and when there is little:
/// then the plan is hard to stop on, and whatever is found saves the motion from slowing down. With 120
/// where there is little, from 40 ticks on, eight of 200 near-optimal random programs took up to 2 % longer
/// than planned, and the dearest tick of an easy path 41 300 instructions instead of 23 900.
const BUDGET: u32 = 60;
const URGENT_BUDGET: u32 = 240;
/// The same for the way to rest at the end of a block, and for going slower. No measurement of it is kept.
const TRIAL_BUDGET: u32 = 120;
/// A reserve is replaced only by one that begins this much later, ticks: a search costs the same however
/// little it gains.
const GAIN: u32 = 3;
/// Before a reserve begins, this many ticks are left to find a later one. With fewer the reserve is taken
/// before one is found; with twice as many the dearest tick of an ordinary plan took 78 000 instructions instead of
/// 25 000.
const URGENT: u32 = 14;
/// With no more ticks than these left, a tick may spend [`URGENT_BUDGET`].
const CALM: u32 = 2 * URGENT;
/// With so many left, and no more than the frames of two stops (a tick is taken for a frame, see
/// [`Rate::enough`]), only greedy slow-downs are tried: while ramps are tried in vain it becomes
/// too late, as it did where frames came in bursts of a tenth of a second.
const SHORT: u32 = 2 * URGENT;

/// Frames a stop is taken to have at least where it is asked whether a reserve begins late enough
/// ([`Rate::enough`]). No measurement of it is kept.
const LEAST_STOP_FRAMES: u64 = 16;

/// In the last ticks before a reserve begins it is tried to go slower instead. No measurement of it is kept.
const SLOWER_IN_TICKS: u32 = 4;
/// By which share of the rate, and at which pace: some of the steps of a search for a stop, the smallest
/// first, because what is lost here is time.
const SLOWER: [(f64, f64); 6] = [
    (0.05, 0.7),
    (0.12, 1.0),
    (0.12, 0.6),
    (0.3, 1.0),
    (0.3, 0.6),
    (0.6, 0.8),
];

impl Rate {
    /// Makes sure that there is a stop in reserve. Returns whether there is a new one, so that
    /// motion may pass a barrier.
    pub(crate) fn ensure_stop(&mut self, goal: f64, situation: &Situation<'_>) -> bool {
        if self.ramp.is_some() || self.now.rate <= 0.0 {
            return false;
        }
        let is_far = |reserve: &Reserve| reserve.in_ticks() > URGENT;
        if let Some(frame) = situation.block_end
            && goal > 0.0
            && (self.is_to_arrive_at(frame) || self.reserve.kept.as_ref().is_none_or(is_far))
        {
            let mut budget = situation.budget(TRIAL_BUDGET);
            let passes_barrier = self.ensure_arrival(frame, situation, &mut budget);
            // Motion does not set out without a way to rest at the end of the block.
            if self.is_to_arrive_at(frame) || situation.is_held_at(self.now.time) {
                return passes_barrier;
            }
        }
        if situation.track.ends_at_rest() {
            self.reserve.kept = None;
            return false;
        }
        let left = match (&self.reserve.kept, situation.track.barrier()) {
            (Some(reserve), _) => reserve.in_ticks(),
            (None, barrier) => barrier.map_or(0, |barrier| self.ticks_to(barrier)),
        };
        // With the goal to stop, what is here is as good as what may come.
        if left >= self.enough(situation) || goal <= 0.0 {
            return false;
        }
        // Where the motion stands there is time while frames keep coming: with few of them no stop
        // is found.
        let is_calm = if situation.is_held_at(self.now.time) {
            !situation.is_fully_supplied
        } else {
            left > CALM
        };
        let mut budget = if is_calm { BUDGET } else { URGENT_BUDGET };
        let finds_one = self.search_later_stop(left + GAIN, situation, &mut budget);
        if finds_one {
            self.keep_found();
        } else if left < SLOWER_IN_TICKS
            && self.reserve.kept.is_some()
            && situation.is_fully_supplied
        {
            self.slow_down_a_little(situation);
        }
        finds_one
    }

    /// With fewer ticks left until the reserve begins a later one is looked for. The sooner a
    /// search begins the less of it is left to any tick; but what is found soon begins soon.
    ///
    /// Frames are taken for ticks. At a rate of 1 they are; below it a frame lasts for more ticks, so that a
    /// search begins nearer to the reserve than was meant, by frames. Only when it begins depends on it. No
    /// measurement of that is kept.
    fn enough(&self, situation: &Situation<'_>) -> u32 {
        let frames = |n: u64| u32::try_from(n).unwrap_or(u32::MAX / 8);
        let stop = frames(situation.stop_frames.max(LEAST_STOP_FRAMES));
        let ahead = situation.track.end();
        let ahead = frames(ahead.saturating_sub(self.now.time.sequence));
        // Two thirds of what is ahead of a stop, but three to four times the frames of one. So the two thirds count
        // only where 5½ to 7 stops are ahead. No measurement of it is kept.
        (2 * ahead.saturating_sub(stop) / 3).clamp(3 * stop, 4 * stop)
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a number of ticks; the cast saturates"
    )]
    fn ticks_to(&self, sequence: u64) -> u32 {
        let now = self.now.time;
        let frames = sequence.saturating_sub(now.sequence) as f64 - now.fraction;
        (frames / self.now.rate).max(0.0) as u32
    }

    /// Goes on with the search for a later stop. Returns whether it has found one.
    fn search_later_stop(
        &mut self,
        at_least: u32,
        situation: &Situation<'_>,
        budget: &mut u32,
    ) -> bool {
        let now = self.steady();
        let short = u64::from(SHORT).min(2 * situation.stop_frames);
        let is_short =
            self.reserve.kept.is_some() && u64::from(at_least) <= short + u64::from(GAIN);
        let search = &mut self.reserve.search;
        match search.go_on(now, at_least, is_short, situation, budget) {
            ReserveOutcome::Found => true,
            ReserveOutcome::Open => false,
            ReserveOutcome::NoneLeft => {
                let stands = situation.is_held_at(self.now.time);
                self.reserve.found_none = situation.is_fully_supplied && stands;
                false
            }
        }
    }

    /// The stop that was found becomes the one in reserve.
    fn keep_found(&mut self) {
        let reserve = self.reserve.kept.get_or_insert(Reserve::empty());
        reserve.arrives_at = None;
        self.reserve.search.take_found(&mut reserve.stop);
    }

    /// Goes a little slower, as little as possible, so that the stop in reserve need not begin:
    /// from a lower rate there is a later one.
    #[inline(never)]
    fn slow_down_a_little(&mut self, situation: &Situation<'_>) {
        let fastest = situation.fastest_from(self.now.time.sequence);
        let mut budget = situation.budget(TRIAL_BUDGET);
        for _ in 0..SLOWER.len() {
            let turn = self.reserve.slower_tried % SLOWER.len();
            self.reserve.slower_tried += 1;
            let Some((share, pace)) = SLOWER.get(turn) else {
                continue;
            };
            let target = self.now.rate * (1.0 - share);
            let ramp = Ramp::plan(self.now.rate, 0.0, target, fastest.paced(*pace));
            let Some(ramp) = ramp else { continue };
            match self.try_ramp(&ramp, situation, 0, &mut budget) {
                TrialOutcome::Passed(reserve) => {
                    self.commit(ramp, *pace, None, reserve);
                    return;
                }
                TrialOutcome::Barred => {}
                TrialOutcome::OutOfBudget { .. } => return,
            }
        }
    }

    /// Makes sure of a rest at the end of the block. Returns whether there is a new way to it that
    /// passes a barrier.
    #[inline(never)]
    fn ensure_arrival(&mut self, frame: u64, situation: &Situation<'_>, budget: &mut u32) -> bool {
        if self.is_to_arrive_at(frame) {
            return false;
        }
        let now = self.steady();
        let mut search = self.arrival.search.take();
        if !search.as_mut().is_some_and(|it| it.follow(frame, now)) {
            search = ArrivalSearch::new(frame, now, 0, situation);
        }
        let outcome = search
            .as_mut()
            .map_or(ArrivalOutcome::OutOfReach, |search| {
                search.go_on(situation, budget)
            });
        match outcome {
            ArrivalOutcome::Found(reserve) => {
                self.reserve.kept = Some(reserve);
                let barrier = situation.track.barrier();
                barrier.is_some_and(|barrier| barrier < frame)
            }
            ArrivalOutcome::Open => {
                self.arrival.search = search;
                false
            }
            ArrivalOutcome::Barred | ArrivalOutcome::OutOfReach => {
                self.arrival.barred_from = Some(frame);
                // From nearer something may pass, but not from where the motion stands.
                self.arrival.has_missed = situation.is_held_at(self.now.time)
                    || matches!(outcome, ArrivalOutcome::OutOfReach);
                false
            }
        }
    }
}
