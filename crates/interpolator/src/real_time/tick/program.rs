//! The part of a tick for the program: it takes frames, advances program time, and ends the epoch.

use super::state::Interpolator;
use crate::real_time::output::Written;
use crate::real_time::program_time::ProgramTime;
use crate::real_time::rate::{Situation, beside_full};
use crate::real_time::single_block_stop::SingleBlockStop;
use crate::shared::config::stops::StopCause;
use crate::shared::fault::Fault;
use crate::shared::message::Inputs;
use crate::shared::rest::SAME_POSITION;
use glidepath_geometry::AxisVector;
use glidepath_link::{EndOfEpoch, FaultCause, FrameRefusal, Setpoint, SetpointFrame};
use glidepath_program::{Event, FrameFlags};

/// Frames taken from the ring in one tick. More than one, so that the track fills up; few, so that
/// a tick stays short.
const FRAMES_PER_TICK: usize = 8;

impl Interpolator<'_> {
    /// Takes frames while there is room. What belongs to no epoch that is open here was under way
    /// when its epoch ended, and is dropped.
    pub(super) fn take_frames(&mut self, inputs: &mut Inputs<'_>) {
        if self.stops.is_due() && !self.is_open() {
            // What the program before has left on goes off first.
            return;
        }
        self.track.release_before(self.rate.now().time.sequence);
        if self.requests.retraces() && !self.take_kept_frames() {
            return;
        }
        for _ in 0..FRAMES_PER_TICK {
            if self.track.is_full() {
                return;
            }
            let Some(next) = inputs.frames.peek() else {
                return;
            };
            let is_new = next.epoch > self.epoch.max(self.barred);
            let is_first = is_new && next.has(FrameFlags::FIRST);
            if is_first && self.is_open() && self.requests.is_stopping() {
                // The open epoch is about to end; then this one can begin.
                return;
            }
            // Straight from the ring, and only then is its room there given back.
            if self.is_open() && next.epoch == self.epoch {
                self.track.push(next);
            } else if is_first && self.requests.fault().is_none() && self.may_begin() {
                self.open(next);
            } else if is_first {
                // Its planner has no other first frame, and hears of it.
                self.barred = next.epoch;
                self.requests.give_machine_back();
            }
            let _taken = inputs.frames.dequeue();
        }
    }

    /// Whether a program may begin.
    const fn may_begin(&self) -> bool {
        self.drives.are_ready() && !self.joint_mover.is_active()
    }

    /// Starts an epoch, instead of one that stands in the middle of its way.
    fn open(&mut self, frame: &SetpointFrame) {
        let away = AxisVector::from(frame.position) - self.output.published().position();
        if away.amax() > SAME_POSITION || !self.output.published().is_at_rest() {
            self.barred = frame.epoch;
            self.requests.give_machine_back();
            let cause = FaultCause::Frame(FrameRefusal::Elsewhere);
            self.requests
                .fail(Fault::new(cause, frame.line, frame.sequence));
            return;
        }
        self.track.clear();
        self.track.push(frame);
        self.retrace.begin_at(frame.sequence);
        self.rate.begin_at(ProgramTime::at(frame.sequence));
        self.epoch = frame.epoch;
        self.end_of_epoch = EndOfEpoch::Open;
        self.is_unanswered = false;
        self.output.begin_epoch();
        if let Some(superposed) = &mut self.superposed {
            let at = frame.position.get(superposed.axis().index()).copied();
            superposed.begin_epoch(at.unwrap_or(0.0));
            if !self.probing.goes_on() {
                superposed.begin_program();
            }
        }
        self.single_block_stop = SingleBlockStop::none();
        self.queue_level.begin_epoch();
        if !self.probing.goes_on() {
            self.wait.forget();
        }
        let is_held = self.probing.goes_on();
        self.requests.forget_epoch(is_held);
        self.probing.open();
    }

    /// No epoch up to this number begins; the one with this number ends, if it is open.
    pub(super) fn bar(&mut self, epoch: u64) {
        if self.is_open() && self.epoch == epoch {
            self.requests.abort();
        }
        self.barred = self.barred.max(epoch);
    }

    /// Looks whether there are frames enough, and stops for good if the planner is lost.
    pub(super) fn watch_supply(&mut self) {
        let is_awaiting = self.wait.is_standing();
        let holds = self.requests.holds(self.is_rapid()) || is_awaiting;
        let (track, rate, published) = (&self.track, &self.rate, self.output.published());
        if self.is_open() && self.queue_level.watch(track, rate, published, holds) {
            // Behind the motion there is no planner to be lost.
            if !self.requests.heading().is_back() {
                self.fail(FaultCause::PlannerLost);
            }
        }
    }

    /// Keeps in mind where the present block ends, if the motion is to rest there.
    pub(super) fn look_for_block_end(&mut self) {
        let (track, rate) = (&mut self.track, &mut self.rate);
        self.single_block_stop
            .look_ahead(&self.requests, rate, track, self.output.published());
    }

    /// Chooses the rate, and how to stop if no more frames come. Where the plan itself rests, any
    /// rate is at rest, but it takes a new reserve to go on from there.
    #[allow(clippy::float_cmp, reason = "a steady rate is a copy of the goal")]
    pub(super) fn choose_rate(&mut self) {
        let mut goal = self.goal();
        let now = self.rate.now();
        let rests = self.output.published().is_at_rest() && self.plan_rests();
        if rests {
            if self.rate.take_found_no_stop() {
                self.single_block_stop.set_out_slower();
            }
            goal = goal.min(self.single_block_stop.sets_out_at());
        }
        if let Some(slower) = self.single_block_stop.approaches_at(&self.rate) {
            goal = goal.min(slower);
        }
        if rests && now.rate != goal {
            self.track.bar(now.time.sequence);
            self.rate.rest_at(now.time, goal);
        }
        let stop = self.track.waits_at();
        let situation = Situation {
            track: &self.track,
            published: self.output.published(),
            allowed: self.output.allowed(),
            stop_frames: self.queue_level.stop_frames(),
            is_fully_supplied: self.queue_level.is_fully_supplied(),
            block_end: self
                .single_block_stop
                .in_motion()
                .filter(|end| stop.is_none_or(|stop| *end < stop)),
        };
        if !rests {
            self.rate.choose_ramp(goal, &situation);
        }
        let arrives_at = situation.block_end;
        if self.rate.ensure_stop(goal, &situation) {
            self.track.unbar();
        }
        if arrives_at.is_some_and(|frame| self.rate.is_to_arrive_at(frame)) {
            self.track.hold_at_block_end(None);
        }
    }

    /// The rate that is wanted: the commanded override over the planned one, if nothing stops.
    pub(super) fn goal(&self) -> f64 {
        if self.queue_level.is_short() || self.probing.is_tripped() {
            return 0.0;
        }
        let planned_override = self.present().planned_override;
        beside_full(self.requests.wanted_rate(self.is_rapid(), planned_override))
    }

    /// Advances program time, not past a frame that holds the motion.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "every tick does it: a call costs forty instructions"
    )]
    pub(super) fn advance_program_time(&mut self, tick: u64) {
        let before = self.rate.has_taken_reserve();
        let time = self.rate.advance().time;
        if self.rate.has_taken_reserve() && !before {
            self.statistics.begin_reserve_stop(tick);
        }
        let held = time.held_at(self.track.holding_frame());
        if held != time {
            self.rate.rest_at(held, self.rate.now().rate);
        }
    }

    /// Writes the setpoint at the present program time, and says if it should not be.
    pub(super) fn write_moving(&mut self, tick: u64, setpoint: &mut Setpoint) {
        let now = self.rate.now();
        let dropped = now.rate <= 0.0 && self.requests.is_stopping();
        let (output, track) = (&mut self.output, &self.track);
        let written = output.write_moving(self.epoch, &now, track, dropped, setpoint);
        self.judge(written, tick);
        if written == Written::Nothing {
            // Every committed ramp ends on frames at hand, so this cannot be; if it were, standing
            // still is all that is left.
            self.fail(FaultCause::Output);
            self.rate.rest_at(now.time, 0.0);
            self.write_standing(setpoint);
        }
        if self.requests.retraces() {
            self.place_retraced(setpoint);
        }
        if setpoint.event_count != 0 {
            self.hear_events(setpoint);
        }
    }

    /// Takes note of what happens with a setpoint.
    #[cold]
    #[inline(never)]
    fn hear_events(&mut self, setpoint: &Setpoint) {
        if matches!(setpoint.event(), Ok(Some(Event::Probe { .. }))) {
            self.probing.begin();
        }
        if self.track.m_code_waits().late(setpoint).is_some() {
            self.wait.hear(setpoint);
        }
        if let Ok(Some(event)) = setpoint.event() {
            self.wait.hear_word(event);
        }
        self.tell_spindle(setpoint);
    }

    /// Looks whether the contact was made that the motion is looking for.
    pub(super) fn look_for_contact(&mut self) {
        let is_found = || self.drives.seen().contact_in == self.epoch && !self.jog.owns_axes();
        if self.probing.is_looking() && is_found() {
            self.probing.find();
        }
    }

    /// What follows when program time stands: the end of the epoch, or a program stop.
    pub(super) fn end_epoch_or_wait(&mut self) {
        if !self.is_open() {
            if self.requests.fault().is_some() {
                self.stops.ask(StopCause::Fault);
            }
            self.wait_behind_search();
            return;
        }
        let now = self.rate.now().time;
        let present = self.present();
        self.passed = present;
        if self.requests.is_stopping() && self.is_standing() && !self.is_tapping() {
            self.close(if self.requests.fault().is_some() {
                EndOfEpoch::Faulted
            } else {
                EndOfEpoch::Aborted
            });
        } else if self.probing.is_tripped() && self.is_standing() {
            self.close(EndOfEpoch::Tripped);
        } else if present.has(FrameFlags::LAST) && self.is_standing() {
            self.close(EndOfEpoch::Completed);
        } else {
            if self.track.program_stop() == Some(now.sequence) {
                self.requests.wait_for_operator();
            }
            let stands = self.rate.now().rate <= 0.0 || self.plan_rests();
            // What is awaited there comes first: a resume does not go on from it.
            if self.single_block_stop.is_at(now) && stands && !self.is_at_m_code_wait() {
                self.requests.stand_at_block_end();
            }
        }
    }

    /// What follows while a program is to go on behind a search.
    fn wait_behind_search(&mut self) {
        if self.probing.goes_on() && self.requests.is_stopping() {
            self.end_of_epoch = if self.requests.fault().is_some() {
                EndOfEpoch::Faulted
            } else {
                EndOfEpoch::Aborted
            };
            self.stops.ask(if self.requests.fault().is_some() {
                StopCause::Fault
            } else {
                StopCause::Abort
            });
            self.requests.forget_epoch(false);
            // The first frame behind the search may be under way.
            self.bar(self.epoch + 1);
            self.probing.abort();
        }
    }
}
