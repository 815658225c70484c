//! The stop at the end of a block: what the search for the end, the rate of program time and the
//! track have to know of each other. It is that of a single block, or the one in front of a rapid while
//! the rapid override is 0.

use crate::real_time::block_end::{BlockEnd, Ends, begins_rapid};
use crate::real_time::differences::Differences;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::rate::Rate;
use crate::real_time::stop_requests::StopRequests;
use crate::real_time::track::Track;

/// The end of the present block, and how the motion sets out to it.
#[derive(Debug)]
pub(crate) struct SingleBlockStop {
    /// The ends that are looked for.
    ends: Option<Ends>,
    end: BlockEnd,
    /// The motion is to rest where it is, since what follows is a rapid.
    is_before_rapid: bool,
    /// The rate at which motion sets out from a rest of the plan: less than the goal where the
    /// block would be too short to come to rest at its end, or where no stop is found from a higher
    /// one.
    sets_out_at: f64,
}

impl SingleBlockStop {
    /// Nobody wants to stop at the end of a block.
    pub(crate) const fn none() -> Self {
        Self {
            ends: None,
            end: BlockEnd::Unwanted,
            is_before_rapid: false,
            sets_out_at: 1.0,
        }
    }

    /// The rate at which the motion goes to where it is to rest: a lower one in front of a rapid that the
    /// plan, at its limits, does not let it rest in front of otherwise. A lower rate leaves room: of the
    /// jerk, the plan takes r³. Without it one of 120 random plans ran into the rapid, with it none of 800.
    pub(crate) fn approaches_at(&self, rate: &Rate) -> Option<f64> {
        const SLOWER: f64 = 0.4;
        let is_barred = |frame| rate.was_barred_from(frame);
        let is_slower =
            self.ends == Some(Ends::BeforeRapids) && self.end.in_motion().is_some_and(is_barred);
        is_slower.then_some(SLOWER)
    }

    /// Whether the motion is to rest where it is, since what follows is a rapid and the rapid override
    /// is 0.
    pub(crate) const fn is_before_rapid(&self) -> bool {
        self.is_before_rapid
    }

    /// The rate at which motion sets out from a rest of the plan.
    pub(crate) const fn sets_out_at(&self) -> f64 {
        self.sets_out_at
    }

    /// The end of the block, if the motion has to be brought to rest there.
    pub(crate) const fn in_motion(&self) -> Option<u64> {
        self.end.in_motion()
    }

    /// Whether a program time is the end of the block that a single block ends at.
    pub(crate) fn is_at(&self, time: ProgramTime) -> bool {
        self.ends == Some(Ends::Every) && Some(time) == self.end.frame().map(ProgramTime::at)
    }

    /// Leaves the end of this block to be passed, and looks for the next one.
    pub(crate) const fn skip(&mut self) {
        self.end.skip();
        self.sets_out_at = 1.0;
    }

    /// Keeps in mind where the present block ends, or the last one before a rapid, if the motion is to
    /// rest there, and holds the motion where the plan rests by itself.
    pub(crate) fn look_ahead(
        &mut self,
        requests: &StopRequests,
        rate: &mut Rate,
        track: &mut Track,
        published: &Differences,
    ) {
        let ends = requests.wanted_ends();
        if ends.is_none() && self.ends.is_none() {
            return;
        }
        let now = rate.now().time;
        self.is_before_rapid = requests.bars_rapids() && stands_before_rapid(now, track);
        if requests.is_at_block_end() {
            return;
        }
        if ends != self.ends {
            // What was found for the others is no end of these.
            (self.ends, self.end, self.sets_out_at) = (ends, BlockEnd::Unwanted, 1.0);
            rate.forget_arrival();
        }
        if let Some(ends) = ends {
            if rate.take_missed() {
                self.try_slower_or_later(rate, track, published);
            }
            self.end.look(ends, now, track);
        }
        let held_at = self.end.at_rest().or(self.waits_for_arrival(rate, track));
        track.hold_at_block_end(held_at);
    }

    /// The frame at which the motion waits, at a rest of the plan, until it is known where the
    /// block ends, as far as the frames at hand tell, and how to come to rest there.
    fn waits_for_arrival(&self, rate: &Rate, track: &Track) -> Option<u64> {
        let is_open = match (self.end, self.end.in_motion()) {
            (BlockEnd::Sought { from }, _) => from + 1 < track.end(),
            (_, Some(frame)) => !rate.is_to_arrive_at(frame),
            _ => false,
        };
        let time = rate.now().time;
        (is_open && track.rests_at(time)).then_some(time.sequence)
    }

    /// The end of the block is too near to come to rest there: where the motion sets out from a
    /// rest of the plan, not if it does so more slowly.
    fn try_slower_or_later(&mut self, rate: &Rate, track: &Track, published: &Differences) {
        let plan_rests = track.rests_at(rate.now().time);
        if plan_rests && !published.is_at_rest() {
            // Only then any rate will do.
        } else if !plan_rests || !self.set_out_slower() {
            self.skip();
        }
    }

    /// Lets the motion set out at a lower rate; false if it is as low as can be.
    pub(crate) fn set_out_slower(&mut self) -> bool {
        const SLOWER: f64 = 0.4;
        const SLOWEST: f64 = 0.02;
        let can_be = self.sets_out_at > SLOWEST;
        if can_be {
            self.sets_out_at *= SLOWER;
        }
        can_be
    }
}

/// Whether a program time is a frame behind which a rapid begins.
fn stands_before_rapid(now: ProgramTime, track: &Track) -> bool {
    let (here, next) = (track.frame(now.sequence), track.frame(now.sequence + 1));
    let both = here.zip(next);
    now.fraction <= 0.0 && both.is_some_and(|(here, next)| begins_rapid(here, next))
}
