//! One period of the real-time thread: a function of what it owns, the wake-up, and the rings.
//!
//! ```text
//! demands ─► jog ───────────────────────────────────────────────► setpoint, while it owns the axes
//! orders ─► stop requests ─┐
//! frames ─► track ─────────┴► supply ─► rate ─► program time ─► setpoint ─► joints ─┐
//!                             enough    chosen  advanced        written,            │
//!                             to go on?                         checked             │
//!        ┌───────────────────────────────────────────────────────────────────────◄──┘
//!        └► end of the epoch, program stop ─► state ─► report ─┊─► stamp
//!                                                           deadline
//! ```
//!
//! Everything but the stamp is done shortly before the deadline: how long it takes, and how cold
//! the caches are after the sleep, does not delay the setpoint.
//!
//! No step allocates, locks, waits or calls the system. Work is bounded: so many orders and frames
//! a tick, and a budget for the choice of a ramp.

use crate::account::Account;
use crate::block_stop::BlockStop;
use crate::config::Config;
use crate::drives::Drives;
use crate::frame_summary::FrameSummary;
use crate::jog::{Jog, Surroundings};
use crate::message::{Fault, Happening, Inputs, Order, Report, Timing};
use crate::output::{Output, Written};
use crate::program_time::ProgramTime;
use crate::rate::{Rate, Situation, beside_full};
use crate::rest::SAME_POSITION;
use crate::stop_requests::StopRequests;
use crate::supply::Supply;
use crate::track::Track;
use glidepath_geometry::AxisVector;
use glidepath_link::{
    Command, EndOfEpoch, FaultCause, FrameRefusal, MachineState, Setpoint, SetpointFrame,
};
use glidepath_program::FrameFlags;
use glidepath_realtime::{EventWriter, Wake};

/// Frames taken from the ring in one tick. More than one, so that the track fills up; few, so that
/// a tick stays short.
const FRAMES_PER_TICK: usize = 8;
/// Orders taken in one tick.
const ORDERS_PER_TICK: usize = 4;
/// Share of a limit by which a setpoint may exceed it before the motion is stopped for that.
const EXCESS_FAULT: f64 = 0.05;

/// The real-time thread's state.
pub(crate) struct Interpolator<'a> {
    track: Track,
    rate: Rate,
    requests: StopRequests,
    supply: Supply,
    block_stop: BlockStop,
    jog: Jog,
    drives: Drives,
    output: Output,
    /// The open or last epoch, 0 before the first.
    epoch: u64,
    end_of_epoch: EndOfEpoch,
    /// What is kept of the last frame passed.
    passed: FrameSummary,
    /// The machine has moved in the present epoch.
    has_moved: bool,
    account: Account<'a>,
}

impl<'a> Interpolator<'a> {
    pub(crate) fn new(
        config: &Config,
        boot_id: u64,
        happenings: EventWriter<'a, Happening>,
    ) -> Self {
        let period_t = config.period_t();
        Self {
            track: Track::new(period_t, config.limits),
            rate: Rate::new(ProgramTime::at(0), 0.0),
            requests: StopRequests::default(),
            supply: Supply::new(config),
            block_stop: BlockStop::none(),
            jog: Jog::new(config),
            drives: Drives::new(config),
            output: Output::new(config, boot_id),
            epoch: 0,
            end_of_epoch: EndOfEpoch::None,
            passed: FrameSummary::NONE,
            has_moved: false,
            account: Account::new(config, happenings),
        }
    }

    /// One period: reads the rings, advances program time, and says where the axes are to be. Needs
    /// nothing but the rings, so it is done before the deadline of the tick. Writes all of the
    /// report but the stamp, in its place: every copy of it would be a dozen more cache lines to
    /// wait for.
    #[cfg_attr(glidepath_rtsan, sanitize(realtime = "nonblocking"))]
    pub(crate) fn prepare(&mut self, due: &Wake, inputs: &mut Inputs<'_>, report: &mut Report) {
        let tick = due.tick;
        self.carry_out_orders(inputs);
        if !self.drives.are_simulated() {
            self.attend_to_drives(inputs);
        }
        self.hear_demands(due.scheduled_ns, inputs);
        self.take_frames(inputs);
        self.watch_supply();
        if self.jog.owns_axes() {
            self.follow_jog(due, &mut report.setpoint);
            self.write_joints(&mut report.setpoint);
        } else if self.is_open() {
            self.look_for_block_end();
            self.choose_rate();
            self.advance_program_time(tick);
            self.write_moving(tick, &mut report.setpoint);
            self.write_joints(&mut report.setpoint);
        } else if self.drives.following() != 0 && self.drives.seen().is_known {
            self.write_following(&mut report.setpoint);
        } else {
            self.write_standing(&mut report.setpoint);
            self.write_joints(&mut report.setpoint);
        }
        self.end_epoch_or_wait();
        self.update_state(tick);
        self.fill(report);
    }

    /// What is left to do at the deadline: the time it really was.
    #[cfg_attr(glidepath_rtsan, sanitize(realtime = "nonblocking"))]
    pub(crate) fn stamp(&mut self, report: &mut Report, wake: &Wake) {
        if self.account.stamp(report, wake) {
            self.fail(FaultCause::MissedTicks);
        }
    }

    /// A report found no room in its ring: nobody has taken one for a second, and the drives get
    /// nothing either.
    pub(crate) fn lose_report(&mut self) {
        self.account.lose_report();
        self.fail(FaultCause::Ports);
    }

    /// Keeps how long the tick took, for the next report.
    pub(crate) const fn keep_timing(&mut self, timing: Timing) {
        self.account.keep_timing(timing);
    }

    /// True while an epoch is being executed.
    fn is_open(&self) -> bool {
        !self.track.is_empty()
    }

    fn carry_out_orders(&mut self, inputs: &mut Inputs<'_>) {
        for _ in 0..ORDERS_PER_TICK {
            let Some(order) = inputs.orders.dequeue() else {
                return;
            };
            match order {
                Order::PlannerLives => self.supply.planner_lives(),
                Order::Command(command) => self.drives.carry_out(command, self.is_open()),
                Order::Cut(_) => self.lose_power(),
                Order::Fault(_) => {}
            }
            if let Order::Command(command) = order
                && !self.is_for_program(command)
            {
                continue;
            }
            let released = self.requests.carry_out(order, self.is_open());
            if released.program_stop {
                self.track.pass_stop();
            }
            if released.block_end {
                self.block_stop.skip();
                self.track.hold_at_block_end(None);
            }
        }
    }

    /// Carries out what a command is to the jog. Returns whether it is one to the program, too.
    fn is_for_program(&mut self, command: Command) -> bool {
        match command {
            Command::Hold | Command::Abort => self.jog.cancel(),
            Command::Return => {
                let around = self.surroundings(0, false);
                self.jog.go_back(&around);
            }
            Command::JogOverride(ratio) => self.jog.set_override(ratio),
            // The path begins where the axes are not.
            Command::Resume | Command::Step => return !self.jog.owns_axes(),
            _ => {}
        }
        true
    }

    /// Takes the demands for a jog. They count from rest only, with a program held or none, and as
    /// long as no program is about to begin.
    fn hear_demands(&mut self, now_ns: u64, inputs: &mut Inputs<'_>) {
        if self.requests.is_stopping() {
            self.jog.cancel();
        }
        let is_free = if self.is_open() {
            let state = self.account.state();
            matches!(state, MachineState::Held | MachineState::ProgramStop) && self.is_standing()
        } else {
            let state = self.account.state();
            matches!(state, MachineState::Idle | MachineState::NotHomed)
                && self.drives.following() == 0
                && inputs.frames.peek().is_none()
        };
        let may_start = is_free && !self.requests.is_stopping();
        while let Some(demand) = inputs.demands.dequeue() {
            let around = self.surroundings(now_ns, may_start);
            if self.jog.hear(&demand, &around) && self.is_open() {
                // Whatever it is held for may end: it goes on when the operator says so.
                self.requests.hold();
            }
        }
    }

    fn surroundings(&self, now_ns: u64, may_start: bool) -> Surroundings {
        Surroundings {
            now_ns,
            position: self.output.published().position(),
            may_start,
            is_on_path: self.is_open(),
            is_homed: self.drives.are_homed(),
        }
    }

    /// Writes the setpoint of axes that a jog moves, or has moved away from the path.
    fn follow_jog(&mut self, due: &Wake, setpoint: &mut Setpoint) {
        let motion = self.jog.step(due.scheduled_ns);
        let (output, away) = (&mut self.output, self.jog.away());
        let written = output.write_by_hand(self.epoch, &self.passed, &motion, &away, setpoint);
        self.judge(written, due.tick);
    }

    /// Sees to what the drives say.
    fn attend_to_drives(&mut self, inputs: &mut Inputs<'_>) {
        let is_open = self.is_open();
        let place = (self.passed.line, self.passed.sequence);
        let (output, requests) = (&mut self.output, &mut self.requests);
        let observations = &mut inputs.observations;
        let is_cut = self
            .drives
            .attend(observations, output, requests, is_open, place);
        if is_cut {
            self.end_motion();
        }
    }

    /// What moved the drives is over: they have no power any more.
    fn end_motion(&mut self) {
        self.jog.end();
        if self.is_open() {
            self.close(EndOfEpoch::Faulted);
        }
        self.output.rest();
    }

    /// The drives lose their power at once; where they are is where they were last seen.
    fn lose_power(&mut self) {
        self.drives.cut();
        self.output.begin_reference();
        self.end_motion();
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
            if is_first && self.is_open() && self.requests.is_stopping() {
                // The open epoch is about to end; then this one can begin.
                return;
            }
            // Straight from the ring, and only then is its room there given back.
            if self.is_open() && next.epoch == self.epoch {
                self.track.push(next);
            } else if is_first && self.requests.fault().is_none() && self.drives.are_ready() {
                self.open(next);
            }
            let _taken = inputs.frames.dequeue();
        }
    }

    /// Starts an epoch, instead of one that stands in the middle of its way.
    fn open(&mut self, frame: &SetpointFrame) {
        let away = AxisVector::from(frame.position) - self.output.published().position();
        if away.amax() > SAME_POSITION || !self.output.published().is_at_rest() {
            let cause = FaultCause::Frame(FrameRefusal::Elsewhere);
            self.requests
                .fail(Fault::new(cause, frame.line, frame.sequence));
            return;
        }
        self.track.clear();
        self.track.push(frame);
        self.rate.begin_at(ProgramTime::at(frame.sequence));
        self.epoch = frame.epoch;
        self.end_of_epoch = EndOfEpoch::Open;
        self.output.begin_epoch();
        self.block_stop = BlockStop::none();
        self.supply.begin_epoch();
        self.requests.forget_epoch();
    }

    /// Looks whether there are frames enough, and stops for good if the planner is lost.
    fn watch_supply(&mut self) {
        let holds = self.requests.holds(self.is_rapid());
        let (track, rate, published) = (&self.track, &self.rate, self.output.published());
        if self.is_open() && self.supply.watch(track, rate, published, holds) {
            self.fail(FaultCause::PlannerLost);
        }
    }

    /// Keeps in mind where the present block ends, if the motion is to rest there.
    fn look_for_block_end(&mut self) {
        let (track, rate) = (&mut self.track, &mut self.rate);
        self.block_stop
            .look_ahead(&self.requests, rate, track, self.output.published());
    }

    /// Chooses the rate, and how to stop if no more frames come. Where the plan itself rests, any
    /// rate is at rest, but it takes a new reserve to go on from there.
    #[allow(clippy::float_cmp, reason = "a steady rate is a copy of the goal")]
    fn choose_rate(&mut self) {
        let mut goal = self.goal();
        let now = self.rate.now();
        let rests = self.output.published().is_at_rest() && self.plan_rests();
        if rests {
            if self.rate.take_found_no_stop() {
                self.block_stop.set_out_slower();
            }
            goal = goal.min(self.block_stop.sets_out_at());
        }
        if rests && now.rate != goal {
            self.track.bar(now.time.sequence);
            self.rate.rest_at(now.time, goal);
        }
        let program_stop = self.track.program_stop();
        let situation = Situation {
            track: &self.track,
            published: self.output.published(),
            allowed: self.output.allowed(),
            reach: self.supply.reach(),
            is_fully_supplied: self.supply.is_fully_supplied(),
            block_end: self
                .block_stop
                .in_motion()
                .filter(|end| program_stop.is_none_or(|stop| *end < stop)),
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

    /// True where the plan itself is at rest.
    fn plan_rests(&self) -> bool {
        self.track.rests_at(self.rate.now().time)
    }

    /// True if the machine stands, because program time does or because the plan rests.
    fn is_standing(&self) -> bool {
        self.output.published().is_at_rest() && (self.rate.now().rate <= 0.0 || self.plan_rests())
    }

    /// The rate that is wanted: the commanded override over the planned one, if nothing stops.
    fn goal(&self) -> f64 {
        if self.supply.is_short() {
            return 0.0;
        }
        let planned_override = self.present().planned_override;
        beside_full(self.requests.wanted_rate(self.is_rapid(), planned_override))
    }

    /// What is known of the frame at or before the present program time.
    fn present(&self) -> FrameSummary {
        let frame = self.track.frame(self.rate.now().time.sequence);
        frame.map_or(self.passed, FrameSummary::of)
    }

    fn is_rapid(&self) -> bool {
        self.present().has(FrameFlags::RAPID)
    }

    /// Advances program time, not past a frame that holds the motion.
    fn advance_program_time(&mut self, tick: u64) {
        let before = self.rate.has_taken_reserve();
        let time = self.rate.advance().time;
        if self.rate.has_taken_reserve() && !before {
            self.account.begin_reserve_stop(tick);
        }
        let held = time.held_at(self.track.holding_frame());
        if held != time {
            self.rate.rest_at(held, self.rate.now().rate);
        }
    }

    /// Writes the setpoint at the present program time, and says if it should not be.
    fn write_moving(&mut self, tick: u64, setpoint: &mut Setpoint) {
        let now = self.rate.now();
        let (output, track) = (&mut self.output, &self.track);
        let written = output.write_moving(self.epoch, &now, track, setpoint);
        self.judge(written, tick);
        if written == Written::Nothing {
            // Every committed ramp ends on frames at hand, so this cannot be; if it were, standing
            // still is all that is left.
            self.fail(FaultCause::Output);
            self.rate.rest_at(now.time, 0.0);
            self.write_standing(setpoint);
        }
    }

    /// Tells of a setpoint that exceeds a limit, and stops the motion for one that is far above.
    fn judge(&mut self, written: Written, tick: u64) {
        if let Written::Excess(part) = written {
            self.account.exceed(tick, part);
            if part.is_nan() || part > EXCESS_FAULT {
                self.fail(FaultCause::Output);
            }
        }
    }

    /// Writes the setpoint of a machine that stays where it is.
    fn write_standing(&mut self, setpoint: &mut Setpoint) {
        self.output
            .write_standing(self.epoch, &self.passed, setpoint);
    }

    /// Writes the setpoint of a machine whose joints are where the drives say.
    fn write_following(&mut self, setpoint: &mut Setpoint) {
        let (seen, follows) = (self.drives.seen(), self.drives.following());
        self.output
            .write_following(self.epoch, &self.passed, seen, follows, setpoint);
    }

    fn write_joints(&mut self, setpoint: &mut Setpoint) {
        if self.output.write_joints(setpoint).is_err() {
            // Every frame passed a judge of the joints, so this cannot be; if it were, the motion
            // ends.
            self.fail(FaultCause::Output);
        }
    }

    /// What follows when program time stands: the end of the epoch, or a program stop.
    fn end_epoch_or_wait(&mut self) {
        if !self.is_open() {
            return;
        }
        let now = self.rate.now().time;
        let present = self.present();
        self.passed = present;
        if self.requests.is_stopping() && self.is_standing() {
            self.close(if self.requests.fault().is_some() {
                EndOfEpoch::Faulted
            } else {
                EndOfEpoch::Aborted
            });
        } else if present.has(FrameFlags::LAST) && self.is_standing() {
            self.close(EndOfEpoch::Completed);
        } else {
            if self.track.program_stop() == Some(now.sequence) {
                self.requests.wait_for_operator();
            }
            if self.block_stop.is_at(now) && (self.rate.now().rate <= 0.0 || self.plan_rests()) {
                self.requests.stand_at_block_end();
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
        self.jog.forget_path();
        self.output.rest();
        self.end_of_epoch = end;
        self.supply.end_epoch();
        self.requests.forget_epoch();
    }

    /// Latches a fault; the motion stops on the path.
    fn fail(&mut self, cause: FaultCause) {
        self.requests
            .fail(Fault::new(cause, self.passed.line, self.passed.sequence));
    }

    fn update_state(&mut self, tick: u64) {
        let (is_open, stands) = (self.is_open(), self.is_standing());
        let is_rapid = self.is_rapid();
        let of_program = self.requests.state(is_open, stands, is_rapid, &self.supply);
        let state = match of_program {
            MachineState::Stopping => MachineState::Stopping,
            _ if self.jog.is_active() && self.requests.is_stopping() => MachineState::Stopping,
            _ if self.jog.is_active() => MachineState::Jogging,
            MachineState::Idle => self.drives.state_at_rest(),
            _ => of_program,
        };
        self.has_moved = is_open && (self.has_moved || !stands);
        // Before the motion begins, frames are few by nature, and rests that the program begins with
        // are not its motion.
        self.account
            .enter(state, tick, self.passed.line, self.has_moved);
    }

    /// Writes the state after this tick, and what the ports thread must know.
    fn fill(&self, report: &mut Report) {
        let now = self.rate.now().time.sequence;
        let (feed_override, rapid_override) = self.requests.overrides();
        report.end_of_epoch = self.end_of_epoch;
        report.fault = self.requests.fault().copied();
        report.is_returning = self.jog.is_returning();
        report.is_away = self.jog.owns_axes() && self.is_open();
        report.frames_executed = if self.epoch == 0 { 0 } else { now + 1 };
        report.queue_depth = if self.is_open() {
            self.track.end().saturating_sub(now + 1)
        } else {
            0
        };
        (report.feed_override, report.rapid_override) = (feed_override, rapid_override);
        report.jog_override = self.jog.override_ratio();
        report.power = self.drives.power();
        report.single_block = self.requests.is_single_block();
        self.account.fill(report);
    }
}

#[cfg(test)]
mod tests;
