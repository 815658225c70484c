//! Where the motion is to rest at the end of a block: what the search for the end, the rate of program
//! time and the track have to know of each other.

use super::Interpolator;
use crate::block_end::BlockEnd;

impl Interpolator<'_> {
    /// Keeps in mind where the present block ends, if the motion is to rest there.
    pub(super) fn look_for_block_end(&mut self) {
        if self.will.is_at_block_end() {
            return;
        }
        if self.will.wants_block_end() {
            if self.rate.take_missed() {
                self.try_slower_or_later();
            }
            self.block_end.look(self.rate.now().time, &self.track);
        } else {
            self.block_end = BlockEnd::Unwanted;
            self.rate.forget_arrival();
        }
        self.track
            .stand_at(self.block_end.at_rest().or(self.waits_for_arrival()));
    }

    /// The frame at which the motion waits, at a rest of the plan, until it is known where the block
    /// ends, as far as the frames at hand tell, and how to come to rest there.
    fn waits_for_arrival(&self) -> Option<u64> {
        let is_open = match (self.block_end, self.block_end.in_motion()) {
            (BlockEnd::Sought { from }, _) => from + 1 < self.track.end(),
            (_, Some(frame)) => !self.rate.is_to_arrive_at(frame),
            _ => false,
        };
        (is_open && self.plan_rests()).then(|| self.rate.now().time.sequence)
    }

    /// The end of the block is too near to come to rest there: where the motion sets out from a rest
    /// of the plan, not if it does so more slowly.
    fn try_slower_or_later(&mut self) {
        if self.plan_rests() && !self.published.is_at_rest() {
            // Only then any rate will do.
        } else if !self.plan_rests() || !self.set_out_slower() {
            self.block_end.skip();
            self.sets_out_at = 1.0;
        }
    }

    /// Lets the motion set out at a lower rate; false if it is as low as can be.
    pub(super) fn set_out_slower(&mut self) -> bool {
        const SLOWER: f64 = 0.4;
        const SLOWEST: f64 = 0.02;
        let can_be = self.sets_out_at > SLOWEST;
        if can_be {
            self.sets_out_at *= SLOWER;
        }
        can_be
    }
}
