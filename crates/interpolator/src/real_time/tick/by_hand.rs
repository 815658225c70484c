//! The part of a tick that serves whoever moves the machine without a program: the operator's
//! orders, jogs, and what the drives say.

use super::state::Interpolator;
use crate::real_time::jog::JogContext;
use crate::real_time::output::Written;
use crate::shared::config::stops::StopCause;
use crate::shared::message::{Inputs, Order};
use glidepath_geometry::AXES;
use glidepath_link::{Command, EndOfEpoch, EventRecord, FaultCause, MachineState, Setpoint};
use glidepath_realtime::Wake;

/// Orders taken in one tick.
const ORDERS_PER_TICK: usize = 4;

impl Interpolator<'_> {
    pub(super) fn carry_out_orders(&mut self, inputs: &mut Inputs<'_>) {
        for _ in 0..ORDERS_PER_TICK {
            let Some(order) = inputs.orders.dequeue() else {
                return;
            };
            match order {
                Order::PlannerLives => self.queue_level.planner_lives(),
                Order::Command(command) => self.drives.carry_out(command, self.is_open()),
                Order::Cut(_) => self.lose_power(),
                Order::Bar(epoch) => self.bar(epoch),
                Order::Joints(order) => {
                    let stands = self.may_move_joints().then(|| *self.output.joints());
                    self.joint_mover.take(&order, stands.as_ref());
                }
                Order::Fault(fault) if fault.cause.is_loss() => self.stops.ask(StopCause::Loss),
                Order::Fault(_) | Order::Prepare(_) => {}
            }
            if let Order::Command(command) = order
                && !self.is_for_program(command)
            {
                continue;
            }
            let released = self.requests.carry_out(order, self.has_program());
            if released.program_stop {
                self.track.pass_stop();
            }
            if released.block_end {
                self.single_block_stop.skip();
                self.track.hold_at_block_end(None);
            }
        }
    }

    /// Carries out what a command is to the jog. Returns whether it is one to the program, too.
    fn is_for_program(&mut self, command: Command) -> bool {
        match command {
            Command::Hold => self.jog.stop(),
            Command::Abort | Command::Disable => {
                self.jog.stop();
                self.joint_mover.cancel();
                if command == Command::Abort && !self.has_program() {
                    self.stops.ask(StopCause::Abort);
                }
            }
            Command::Return => {
                let around = self.jog_context(0, false);
                self.jog.go_back(&around);
            }
            Command::JogOverride(ratio) => self.jog.set_override(ratio),
            Command::Acknowledge { event, done } => {
                self.wait.acknowledge(event, done);
                return false;
            }
            // The path begins where the axes are not.
            Command::Resume | Command::Step => return !self.jog.owns_axes(),
            Command::Ping
            | Command::FeedOverride(_)
            | Command::RapidOverride(_)
            | Command::SpindleOverride(_)
            | Command::StopAtEndOfBlock
            | Command::SingleBlock(_)
            | Command::Reset
            | Command::Enable
            | Command::SetPosition { .. }
            | Command::Home(_)
            | Command::Unhome(_)
            | Command::Reverse
            | Command::Forward
            | Command::Job { .. }
            | Command::Tell => {}
        }
        true
    }

    /// Takes the demands for a jog. They count from rest only, with a program held or none, and as
    /// long as no program is about to begin.
    pub(super) fn hear_demands(&mut self, now_ns: u64, inputs: &mut Inputs<'_>) {
        if self.requests.is_stopping() {
            self.jog.cancel();
        }
        let is_free = if self.is_open() {
            let state = self.statistics.state();
            let is_held = matches!(
                state,
                MachineState::Held | MachineState::ProgramStop | MachineState::Awaiting
            );
            is_held && self.is_standing()
        } else {
            let state = self.statistics.state();
            matches!(state, MachineState::Idle | MachineState::NotHomed)
                && self.drives.following() == 0
                && !self.joint_mover.is_active()
                && !self.requests.is_prepared()
                && inputs.frames.peek().is_none()
        };
        let may_start = is_free && !self.requests.is_stopping();
        while let Some(demand) = inputs.demands.dequeue() {
            if let Some(superposed) = &mut self.superposed {
                superposed.turn(&demand, now_ns);
            }
            let around = self.jog_context(now_ns, may_start);
            if self.jog.hear(&demand, &around) && self.is_open() {
                // Whatever it is held for may end: it goes on when the operator says so.
                self.requests.hold();
            }
        }
    }

    /// Whether joints may be moved each for itself: nothing else moves, or is about to.
    fn may_move_joints(&self) -> bool {
        let is_free =
            !self.has_program() && !self.jog.owns_axes() && self.requests.fault().is_none();
        let is_free = is_free && !self.requests.is_prepared();
        is_free && self.drives.are_on() && self.output.published().is_at_rest()
    }

    /// Writes the setpoint of joints that are moved each for itself.
    pub(super) fn follow_mover(&mut self, tick: u64, setpoint: &mut Setpoint) {
        if self.requests.fault().is_some() {
            self.joint_mover.cancel();
        }
        let motion = self.joint_mover.step();
        let output = &mut self.output;
        let written = output.write_by_joints(self.epoch, &self.passed, &motion, setpoint);
        self.judge(written, tick);
        if written == Written::Nothing {
            // Joints are axes wherever they are moved so, so this cannot be; if it were, standing
            // still is all that is left.
            self.fail(FaultCause::Output);
            self.joint_mover.end();
            self.write_standing(setpoint);
            self.write_joints(tick, setpoint);
        }
        setpoint.index = self.joint_mover.index();
        if !self.joint_mover.is_active() {
            self.output.keep_joints();
        }
    }

    fn jog_context(&self, now_ns: u64, may_start: bool) -> JogContext {
        JogContext {
            now_ns,
            position: self.output.published().position(),
            may_start,
            is_on_path: self.is_open(),
            homed: self.drives.homed(),
        }
    }

    /// Writes the setpoint of axes that a jog moves, or has moved away from the path.
    pub(super) fn follow_jog(&mut self, due: &Wake, setpoint: &mut Setpoint) {
        let motion = self.jog.step(due.scheduled_ns);
        let (output, away) = (&mut self.output, self.jog.away());
        let written = output.write_by_hand(self.epoch, &self.passed, &motion, &away, setpoint);
        if self.is_open() {
            self.place_held(setpoint);
        }
        self.judge(written, due.tick);
    }

    /// Writes into a setpoint of axes moved by hand where in the program the motion is held: between two frames in
    /// general.
    #[cold]
    #[inline(never)]
    fn place_held(&self, setpoint: &mut Setpoint) {
        if let Some(path) = self.track.path(self.rate.now().time) {
            setpoint.path_s = path.path_s;
        }
        if self.requests.retraces() {
            let fraction = setpoint.fraction;
            self.place_retraced(setpoint);
            setpoint.fraction = fraction;
        }
    }

    /// Sees to what the drives say.
    pub(super) fn attend_to_drives(&mut self, inputs: &mut Inputs<'_>) {
        let is_open = self.is_open();
        // Without a program nothing that happens is of a line.
        let place = if self.has_program() {
            (self.passed.line, self.passed.sequence)
        } else {
            (0, 0)
        };
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
        self.stops.ask(StopCause::Disable);
        self.jog.end();
        self.joint_mover.end();
        if self.has_program() {
            self.close(EndOfEpoch::Faulted);
        }
        self.output.rest();
    }

    /// Writes into a setpoint what stops now, if nothing moves any more.
    #[cold]
    #[inline(never)]
    pub(super) fn tell_stops(&mut self, setpoint: &mut Setpoint) {
        if self.is_open() || self.moves_by_hand() {
            return;
        }
        if let Some(event) = self.stops.take() {
            let _has_room = setpoint.tell(EventRecord::new(event, 0));
            self.tell_spindle(setpoint);
        }
    }

    /// The drives lose their power at once; where they are is where they were last seen.
    fn lose_power(&mut self) {
        self.drives.cut();
        self.output.begin_reference();
        self.end_motion();
    }

    /// Writes the setpoint of a machine whose joints are where the drives say.
    pub(super) fn write_following(&mut self, setpoint: &mut Setpoint) {
        let (seen, follows) = (self.drives.seen(), self.drives.following());
        if let Some(superposed) = &mut self.superposed {
            superposed.forget();
            self.offset_moves = false;
            setpoint.superposed = [0.0; AXES];
        }
        self.output
            .write_following(self.epoch, &self.passed, seen, follows, setpoint);
    }
}
