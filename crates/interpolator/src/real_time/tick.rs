//! The tick, one period of the real-time thread: a function of what it owns, the wake-up, and the
//! rings.
//!
//! ```text
//! demands ─► jog ───────────────────────────────────────────────► setpoint, while it owns the axes
//! orders ─► stop requests ─┐
//! frames ─► track ─────────┴► level ──► rate ─► program time ─► setpoint ─► joints ─┐
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

mod by_hand;
mod following;
mod program;
mod retracing;
mod state;
mod superposing;
mod waiting;

pub(crate) use state::Interpolator;

use crate::shared::message::{Inputs, TickReport, Timing};
use glidepath_link::{FaultCause, MachineState, Setpoint};
use glidepath_program::FrameFlags;
use glidepath_realtime::Wake;

impl Interpolator<'_> {
    /// One period: reads the rings, advances program time, and says where the axes are to be. Needs
    /// nothing but the rings, so it is done before the deadline of the tick. Writes all of the
    /// report but the stamp, in its place: every copy of it would be a dozen more cache lines to
    /// wait for.
    #[cfg_attr(glidepath_rtsan, sanitize(realtime = "nonblocking"))]
    pub(crate) fn prepare(&mut self, due: &Wake, inputs: &mut Inputs<'_>, report: &mut TickReport) {
        let tick = due.tick;
        self.carry_out_orders(inputs);
        if !self.drives.are_simulated() {
            self.attend_to_drives(inputs);
            self.look_for_contact();
        }
        self.hear_demands(due.scheduled_ns, inputs);
        self.take_frames(inputs);
        self.watch_supply();
        self.watch_wait();
        if self.joint_mover.is_active() {
            self.follow_mover(tick, &mut report.setpoint);
        } else if self.jog.owns_axes() {
            self.follow_jog(due, &mut report.setpoint);
            self.write_joints(tick, &mut report.setpoint);
        } else if self.is_open() {
            if !(self.pass.is_in_use() && self.follow_spindle(due, &mut report.setpoint)) {
                self.look_for_block_end();
                self.choose_rate();
                self.advance_program_time(tick);
                self.write_moving(tick, &mut report.setpoint);
            }
            self.write_joints(tick, &mut report.setpoint);
        } else if self.drives.following() != 0 && self.drives.seen().is_known {
            self.write_following(&mut report.setpoint);
        } else {
            self.write_standing(&mut report.setpoint);
            self.write_joints(tick, &mut report.setpoint);
        }
        if self.stops.is_due() {
            self.tell_stops(&mut report.setpoint);
        }
        self.end_epoch_or_wait();
        self.stand_at_m_code_wait(due.scheduled_ns, report.setpoint.number);
        self.update_state(tick);
        self.fill(report);
    }

    /// What is left to do at the deadline: the time it really was.
    #[cfg_attr(glidepath_rtsan, sanitize(realtime = "nonblocking"))]
    pub(crate) fn stamp(&mut self, report: &mut TickReport, wake: &Wake) {
        if let Some((missed, allowed)) = self.statistics.stamp(report, wake) {
            self.fail_by_missed(missed, allowed);
        }
    }

    /// A report found no room in its ring: nobody has taken one for a second, and the drives get
    /// nothing either.
    pub(crate) fn lose_report(&mut self) {
        self.statistics.lose_report();
        self.fail(FaultCause::Ports);
    }

    /// Keeps how long the tick took, for the next report.
    pub(crate) const fn keep_timing(&mut self, timing: Timing) {
        self.statistics.keep_timing(timing);
    }

    pub(super) fn write_joints(&mut self, tick: u64, setpoint: &mut Setpoint) {
        if self.superposed.is_some() {
            return self.write_superposed(tick, setpoint);
        }
        match self.output.write_joints(setpoint) {
            Ok(written) => self.judge(written, tick),
            // Every frame passed a judge of the joints, so this cannot be; if it were, the motion ends.
            Err(_) => self.fail(FaultCause::Output),
        }
    }

    fn update_state(&mut self, tick: u64) {
        let (is_open, stands) = (self.is_open(), self.is_standing());
        // What is passed is the present frame, or the last one of an epoch that has ended.
        let is_rapid =
            self.passed.has(FrameFlags::RAPID) || self.single_block_stop.is_before_rapid();
        let of_program = self
            .requests
            .state(is_open, stands, is_rapid, &self.queue_level);
        let state = match of_program {
            MachineState::Stopping => MachineState::Stopping,
            _ if self.moves_by_hand() && self.requests.is_stopping() => MachineState::Stopping,
            _ if self.jog.is_active() => MachineState::Jogging,
            _ if self.joint_mover.is_active() => MachineState::Homing,
            MachineState::Idle if self.probing.goes_on() => MachineState::Waiting,
            MachineState::Idle => self.drives.state_at_rest(),
            MachineState::Running | MachineState::Waiting | MachineState::Starved
                if self.wait.is_standing() =>
            {
                MachineState::Awaiting
            }
            // What it waits for, where it has turned, comes from no planner.
            MachineState::Waiting | MachineState::Starved | MachineState::Starving
                if self.requests.retraces() =>
            {
                MachineState::Held
            }
            MachineState::Running
            | MachineState::Holding
            | MachineState::Held
            | MachineState::Starving
            | MachineState::Starved
            | MachineState::ProgramStop
            | MachineState::Faulted
            | MachineState::Waiting
            | MachineState::Awaiting
            | MachineState::Jogging
            | MachineState::Homing
            | MachineState::Off
            | MachineState::NotHomed
            | MachineState::Preparing => of_program,
        };
        self.has_moved = is_open && (self.has_moved || !stands);
        // Before the motion begins, frames are few by nature, and rests that the program begins with
        // are not its motion.
        self.statistics
            .enter(state, tick, self.passed.line, self.has_moved);
    }

    /// Whether something moves, or may, without a program.
    pub(super) const fn moves_by_hand(&self) -> bool {
        self.jog.is_active() || self.joint_mover.is_active()
    }

    /// Writes the state after this tick, and what the ports thread must know.
    fn fill(&self, report: &mut TickReport) {
        let now = self.rate.now().time.sequence;
        let (feed_override, rapid_override) = self.requests.overrides();
        report.end_of_epoch = self.end_of_epoch;
        report.fault = self.requests.fault().copied();
        report.awaited = self.wait.awaited();
        report.is_unanswered = self.is_unanswered;
        report.is_returning = self.jog.is_returning();
        report.is_away = self.jog.owns_axes() && self.is_open();
        report.is_held = self.requests.is_held();
        report.frames_executed = if self.epoch == 0 {
            0
        } else {
            report.setpoint.sequence + 1
        };
        report.queue_depth = if self.is_open() {
            self.track.end().saturating_sub(now + 1)
        } else {
            0
        };
        (report.feed_override, report.rapid_override) = (feed_override, rapid_override);
        report.jog_override = self.jog.override_ratio();
        report.jogged = self.jog.jogged();
        report.power = self.drives.power();
        report.moved = self.joint_mover.moved();
        report.barred = self.barred;
        self.output.write_sides(&mut report.sides);
        if let Some(superposed) = &self.superposed {
            report.superposition = superposed.state();
        }
        report.single_block = self.requests.is_single_block();
        self.statistics.fill(report);
    }
}

#[cfg(test)]
mod tests;
