//! One period of the real-time thread: a function of what it owns, the wake-up, and the rings.
//!
//! ```text
//! orders ─► will ─┐
//! frames ─► track ┼─► supply ─► steer ─► advance ─► setpoint ─► joints ─► settle ─► report ─┊─► stamp
//!                 └─ enough to go on?  rate  program time   check           end of epoch,  deadline
//!                                                                           program stop
//! ```
//!
//! Everything but the stamp is done shortly before the deadline: how long it takes, and how cold the
//! caches are after the sleep, does not delay the setpoint.
//!
//! No step allocates, locks, waits or calls the system. Work is bounded: so many orders and frames a
//! tick, and a budget for the choice of a ramp.

use crate::block_end::BlockEnd;
use crate::config::Config;
use crate::differences::{Allowed, Differences};
use crate::joints::Joints;
use crate::message::{Fault, Happening, Inputs, Order, Report};
use crate::place::Place;
use crate::program_time::ProgramTime;
use crate::rate::{BESIDE_FULL, Rate, Scene};
use crate::setpoint::Counters;
use crate::supply::Supply;
use crate::track::{Track, is_at_rest};
use crate::will::Will;
use glidepath_geometry::AxisVector;
use glidepath_link::{EndOfEpoch, FaultCause, FrameRefusal, MachineState, SetpointFrame};
use glidepath_program::FrameFlags;
use glidepath_realtime::{EventWriter, Wake};

/// Frames taken from the ring in one tick. More than one, so that the track fills up; few, so that
/// a tick stays short.
const FRAMES_PER_TICK: usize = 8;
/// Orders taken in one tick.
const ORDERS_PER_TICK: usize = 4;
/// How far the first frame of an epoch may be from where the machine stands, mm or degrees.
pub(crate) const SAME_PLACE: f64 = 1e-9;
/// Part of a limit by which a setpoint may exceed it before the motion is stopped for that.
const EXCESS_FAULT: f64 = 0.05;

/// The real-time thread's state.
pub(crate) struct Interpolator<'a> {
    pub(crate) period_t: f64,
    pub(crate) boot_id: u64,
    pub(crate) track: Track,
    pub(crate) rate: Rate,
    pub(crate) will: Will,
    pub(crate) supply: Supply,
    block_end: BlockEnd,
    /// The rate at which motion sets out from a rest of the plan: less than the goal where the block
    /// would be too short to come to rest at its end.
    sets_out_at: f64,
    pub(crate) published: Differences,
    allowed: Allowed,
    joints: Joints,
    /// The open or last epoch, 0 before the first.
    pub(crate) epoch: u64,
    pub(crate) end_of_epoch: EndOfEpoch,
    pub(crate) counters: Counters,
    /// The frame whose event was published last.
    pub(crate) announced: Option<u64>,
    /// Of the last frame passed.
    pub(crate) passed: Place,
    pub(crate) state: MachineState,
    happenings: EventWriter<'a, Happening>,
}

impl<'a> Interpolator<'a> {
    pub(crate) fn new(
        config: &Config,
        boot_id: u64,
        happenings: EventWriter<'a, Happening>,
    ) -> Self {
        let period_t = config.period_t();
        Self {
            period_t,
            boot_id,
            track: Track::new(period_t, config.limits),
            rate: Rate::new(ProgramTime::at(0), 0.0),
            will: Will::default(),
            supply: Supply::new(config),
            block_end: BlockEnd::Unwanted,
            sets_out_at: 1.0,
            published: Differences::at_rest(config.start_position),
            allowed: Allowed::new(&config.limits, period_t),
            joints: Joints::new(config.mechanism),
            epoch: 0,
            end_of_epoch: EndOfEpoch::None,
            counters: Counters::new(config),
            announced: None,
            passed: Place::NONE,
            state: MachineState::Idle,
            happenings,
        }
    }

    /// One period: reads the rings, advances program time, and says where the axes are to be. Needs
    /// nothing but the rings, so it is done before the deadline of the tick. Writes all of the report but
    /// the stamp, in its place: every copy of it would be a dozen more cache lines to wait for.
    #[cfg_attr(glidepath_rtsan, sanitize(realtime = "nonblocking"))]
    pub(crate) fn prepare(&mut self, tick: u64, inputs: &mut Inputs<'_>, report: &mut Report) {
        self.obey(inputs);
        self.take_frames(inputs);
        self.watch_supply();
        if self.is_open() {
            self.look_for_block_end();
            self.steer();
            self.advance(tick);
            self.evaluate(tick, &mut report.setpoint);
        } else {
            self.stand(&mut report.setpoint);
        }
        if self.joints.follow(&mut report.setpoint).is_err() {
            // Every frame passed a judge of the joints, so this cannot be; if it were, the motion ends.
            self.fail(FaultCause::Output);
        }
        self.settle();
        self.change_state(tick);
        self.report(report);
    }

    /// What is left to do at the deadline: the time it really was.
    #[cfg_attr(glidepath_rtsan, sanitize(realtime = "nonblocking"))]
    pub(crate) fn stamp(&mut self, report: &mut Report, wake: &Wake) {
        if wake.missed > 0 {
            self.happenings.write(Happening::Missed {
                tick: wake.tick,
                count: wake.missed,
            });
        }
        if self.counters.count(wake) {
            self.fail(FaultCause::MissedTicks);
        }
        self.counters.stamp(report, wake);
    }

    /// True while an epoch is being executed.
    pub(crate) fn is_open(&self) -> bool {
        !self.track.is_empty()
    }

    fn obey(&mut self, inputs: &mut Inputs<'_>) {
        for _ in 0..ORDERS_PER_TICK {
            let Some(order) = inputs.orders.dequeue() else {
                return;
            };
            if order == Order::PlannerLives {
                self.supply.planner_lives();
            }
            let passed = self.will.obey(order, self.is_open());
            if passed.program_stop {
                self.track.pass_stop();
            }
            if passed.block_end {
                self.block_end.skip();
                self.track.stand_at(None);
                self.sets_out_at = 1.0;
            }
        }
    }

    /// Takes frames while there is room. What belongs to no epoch that is open here was under way
    /// when its epoch ended, and is dropped.
    fn take_frames(&mut self, inputs: &mut Inputs<'_>) {
        self.track.release_before(self.rate.now().time.sequence);
        for _ in 0..FRAMES_PER_TICK {
            if self.track.is_full() {
                return;
            }
            let Some(next) = inputs.frames.peek() else {
                return;
            };
            let is_first = next.has(FrameFlags::FIRST) && next.epoch > self.epoch;
            if is_first && self.is_open() && self.will.is_stopping() {
                return; // The open epoch is about to end; then this one can begin.
            }
            // Straight from the ring, and only then is its place there given back.
            if self.is_open() && next.epoch == self.epoch {
                self.track.push(next);
            } else if is_first && self.will.fault().is_none() {
                self.open(next);
            }
            let _taken = inputs.frames.dequeue();
        }
    }

    /// Starts an epoch, in place of one that stands in the middle of its way.
    fn open(&mut self, frame: &SetpointFrame) {
        let away = AxisVector::from(frame.position) - self.published.position();
        if away.amax() > SAME_PLACE || !self.published.is_at_rest() {
            let cause = FaultCause::Frame(FrameRefusal::Elsewhere);
            self.will
                .fail(Fault::new(cause, frame.line, frame.sequence));
            return;
        }
        self.track.clear();
        self.track.push(frame);
        self.rate.begin_at(ProgramTime::at(frame.sequence));
        self.epoch = frame.epoch;
        self.end_of_epoch = EndOfEpoch::Open;
        self.announced = None;
        self.block_end = BlockEnd::Unwanted;
        self.sets_out_at = 1.0;
        self.supply.begin();
        self.will.turn_over();
    }

    fn watch_supply(&mut self) {
        let holds = self.will.holds(self.is_rapid());
        let (track, rate) = (&self.track, &self.rate);
        if self.is_open() && self.supply.watch(track, rate, &self.published, holds) {
            self.fail(FaultCause::PlannerLost);
        }
    }

    /// Chooses the rate, and how to stop if no more frames come. Where the plan itself rests, any
    /// rate is at rest, but it takes a new reserve to go on from there.
    #[allow(clippy::float_cmp, reason = "a steady rate is a copy of the goal")]
    fn steer(&mut self) {
        let mut goal = self.goal();
        let now = self.rate.now();
        let rests = self.published.is_at_rest() && self.plan_rests();
        if rests {
            if self.rate.take_finds_no_stop() {
                self.set_out_slower();
            }
            goal = goal.min(self.sets_out_at);
        }
        if rests && now.rate != goal {
            self.track.bar(now.time.sequence);
            self.rate.rest_at(now.time, goal);
        }
        let scene = Scene {
            track: &self.track,
            published: &self.published,
            allowed: &self.allowed,
            reach: self.supply.reach(),
            is_fully_supplied: self.supply.is_fully_supplied(),
            block_end: self.block_end.in_motion().filter(|end| {
                let stop = self.track.program_stop();
                stop.is_none_or(|stop| *end < stop)
            }),
        };
        if !rests {
            self.rate.steer(goal, &scene);
        }
        let arrives_at = scene.block_end;
        if self.rate.secure(goal, &scene) {
            self.track.unbar();
        }
        if arrives_at.is_some_and(|frame| self.rate.is_to_arrive_at(frame)) {
            self.track.stand_at(None);
        }
    }

    /// True where the plan itself is at rest.
    fn plan_rests(&self) -> bool {
        let now = self.rate.now().time;
        now.fraction <= 0.0 && self.track.frame(now.sequence).is_some_and(is_at_rest)
    }

    /// True if the machine stands, because program time does or because the plan rests.
    fn is_standing(&self) -> bool {
        self.published.is_at_rest() && (self.rate.now().rate <= 0.0 || self.plan_rests())
    }

    /// The rate that is wanted: the commanded override over the planned one, if nothing stops.
    fn goal(&self) -> f64 {
        if self.supply.is_short() {
            return 0.0;
        }
        let planned_override = self.present().planned_override;
        let rate = self.will.rate(self.is_rapid(), planned_override);
        if rate < 1.0 {
            rate.min(BESIDE_FULL)
        } else {
            rate
        }
    }

    /// The frame at or before the present program time.
    fn present(&self) -> Place {
        let frame = self.track.frame(self.rate.now().time.sequence);
        frame.map_or(self.passed, Place::of)
    }

    fn is_rapid(&self) -> bool {
        self.present().has(FrameFlags::RAPID)
    }

    /// Advances program time, not past a frame that holds the motion.
    fn advance(&mut self, tick: u64) {
        let before = self.rate.has_taken_reserve();
        let time = self.rate.advance().time;
        if self.rate.has_taken_reserve() && !before {
            self.counters.reserve_stops += 1;
            self.happenings.write(Happening::ReserveStop { tick });
        }
        let held = time.held_at(self.track.stop());
        if held != time {
            self.rate.rest_at(held, self.rate.now().rate);
        }
    }

    /// Compares the next position with the limits, and remembers it as published.
    pub(crate) fn check(&mut self, position: &AxisVector, tick: u64) {
        if !self.published.allow(position, &self.allowed) {
            let part = self.published.ratio(position, &self.allowed) - 1.0;
            self.happenings.write(Happening::Excess { tick, part });
            if part.is_nan() || part > EXCESS_FAULT {
                self.fail(FaultCause::Output);
            }
        }
        self.published.go_to(position);
    }

    /// What follows when program time stands: the end of the epoch, or a program stop.
    fn settle(&mut self) {
        if !self.is_open() {
            return;
        }
        let now = self.rate.now().time;
        let place = self.present();
        self.passed = place;
        if self.will.is_stopping() && self.is_standing() {
            self.close(if self.will.fault().is_some() {
                EndOfEpoch::Faulted
            } else {
                EndOfEpoch::Aborted
            });
        } else if place.has(FrameFlags::LAST) && self.is_standing() {
            self.close(EndOfEpoch::Completed);
        } else {
            if self.track.program_stop() == Some(now.sequence) {
                self.will.wait_for_operator();
            }
            let is_there = Some(now) == self.block_end.frame().map(ProgramTime::at);
            if is_there && (self.rate.now().rate <= 0.0 || self.plan_rests()) {
                self.will.stand_at_block_end();
            }
        }
    }

    fn close(&mut self, end: EndOfEpoch) {
        // Where the machine stands is not at a frame in general.
        if let Some(path) = self.track.path(self.rate.now().time) {
            self.passed.path_s = path.path_s;
        }
        self.track.clear();
        self.rate.rest_at(self.rate.now().time, 0.0);
        self.published = Differences::at_rest(self.published.position());
        self.end_of_epoch = end;
        self.supply.end();
        self.will.turn_over();
    }

    /// Latches a fault; the motion stops on the path.
    pub(crate) fn fail(&mut self, cause: FaultCause) {
        self.will
            .fail(Fault::new(cause, self.passed.line, self.passed.sequence));
    }

    fn change_state(&mut self, tick: u64) {
        let (is_open, stands) = (self.is_open(), self.is_standing());
        let is_rapid = self.is_rapid();
        let to = self.will.state(is_open, stands, is_rapid, &self.supply);
        if to != self.state {
            let (from, line) = (self.state, self.passed.line);
            self.happenings.write(Happening::State {
                tick,
                from,
                to,
                line,
            });
            self.state = to;
        }
    }
}

mod block_stops;
#[cfg(test)]
mod tests;
