//! The simulated servo stack with its machine: joints, spindle and probe together, and the faults
//! that tests inject.

use crate::joint::{Joint, JointSettings};
use crate::spindle::{Spindle, SpindleSettings};
use bytemuck::Zeroable as _;
use glidepath_link::servo::{JointState, JointStates};
use glidepath_link::{DriveState, EventRecord, Feedback, LatchKind, Setpoint};
use glidepath_program::Event;
use std::collections::VecDeque;

/// Setpoints that have stayed away for so long are those of nobody, ns.
const SILENT_NS: u64 = 500_000_000;

/// The input of the index pulse of joint 0; those of the others follow.
pub const INDEX_INPUT: u32 = 16;

/// A fault of the machine, or the end of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InjectedFault {
    /// The emergency stop takes the power from all drives, or is released.
    EmergencyStop(bool),
    /// A joint has lost its power, or may have it again.
    PowerLost(usize, bool),
    /// A drive reports a fault with this number; 0 clears it.
    DriveFault(usize, u32),
    /// Nothing moves the joint any more, or it moves again.
    Stuck(usize, bool),
    /// The feedback stays away, or comes again.
    Dropout(bool),
    /// The contact of a home switch never closes (false), or never opens (true), or works again.
    Contact(usize, Option<bool>),
    /// Somebody moves a joint by hand, by this much.
    Pushed(usize, f64),
    /// A digital input from 1 to 63 is high or low; 0 is the contact of the probe.
    Input(u32, bool),
    /// The spindle turns at this part of the speed it was told: a load, a potentiometer.
    SpindlePart(f64),
    /// The spindle is stopped by force, or may turn again.
    SpindleStuck(bool),
    /// The index pulses of the spindle stay away, or come again.
    IndexLost(bool),
    /// The encoder of the spindle does not count any more, or does again.
    EncoderLost(bool),
    /// What an analog input says, by its number.
    Analog(usize, f64),
}

/// A servo stack with its machine.
#[derive(Debug, Clone)]
pub struct Plant {
    boot_id: u64,
    number: u64,
    joints: Vec<Joint>,
    spindle: Spindle,
    has_emergency: bool,
    is_silent: bool,
    now_ns: u64,
    /// Time a record takes to be sent, ns.
    latency_ns: u64,
    under_way: VecDeque<Feedback>,
    reference: u64,
    setpoint_number: u64,
    /// The joint and position below which the probe is in contact.
    probe: Option<(usize, f64)>,
    /// How long its contact bounces after each change, ns, and still does.
    bounce_ns: u64,
    bounces_ns: u64,
    /// The tip is deflected, and what the contact says.
    is_deflected: bool,
    /// Digital inputs, but for that of the probe.
    inputs: u64,
    analog: [f64; 8],
    touches: bool,
    touch_count: u64,
    touched: ([f64; 9], u64),
    /// The setpoint whose event was carried out last.
    carried_out: Option<(u64, u64)>,
}

impl Plant {
    /// A machine with these joints, at most nine. `boot_id` tells one stack from another.
    #[must_use]
    pub fn new(boot_id: u64, joints: &[JointSettings]) -> Self {
        Self {
            boot_id,
            number: 0,
            joints: joints.iter().take(9).map(Joint::new).collect(),
            spindle: Spindle::default(),
            has_emergency: false,
            is_silent: false,
            now_ns: 0,
            latency_ns: 0,
            under_way: VecDeque::new(),
            reference: 0,
            setpoint_number: 0,
            probe: None,
            bounce_ns: 0,
            bounces_ns: 0,
            is_deflected: false,
            inputs: 0,
            analog: [0.0; 8],
            touches: false,
            touch_count: 0,
            touched: ([0.0; 9], 0),
            carried_out: None,
        }
    }

    /// Feedback arrives so much after it was measured.
    #[must_use]
    pub const fn with_latency(mut self, latency_ns: u64) -> Self {
        self.latency_ns = latency_ns;
        self
    }

    /// A probe that touches where a joint is at or below a position; its contact is input 0.
    #[must_use]
    pub const fn with_probe(mut self, joint: usize, position: f64) -> Self {
        self.probe = Some((joint, position));
        self
    }

    /// The contact of the probe bounces so long after each change.
    #[must_use]
    pub const fn with_bounce(mut self, bounce_ns: u64) -> Self {
        self.bounce_ns = bounce_ns;
        self
    }

    /// A spindle other than the usual one.
    #[must_use]
    pub fn with_spindle(mut self, settings: SpindleSettings) -> Self {
        self.spindle = Spindle::new(settings);
        self
    }

    /// Angle and speed of the spindle as they are, revolutions and rev/s.
    #[must_use]
    pub const fn spindle(&self) -> (f64, f64) {
        (self.spindle.angle, self.spindle.speed)
    }

    /// Injects a fault, or ends one.
    pub fn inject(&mut self, upset: InjectedFault) {
        match upset {
            InjectedFault::EmergencyStop(pressed) => self.has_emergency = pressed,
            InjectedFault::Dropout(silent) => self.is_silent = silent,
            InjectedFault::PowerLost(joint, lost) => {
                self.joint(joint, |joint| joint.has_power_source = !lost);
            }
            InjectedFault::DriveFault(joint, code) => {
                self.joint(joint, |joint| joint.fault_code = code);
            }
            InjectedFault::Stuck(joint, stuck) => self.joint(joint, |joint| joint.is_stuck = stuck),
            InjectedFault::Contact(joint, contact) => {
                self.joint(joint, |joint| joint.contact = contact);
            }
            InjectedFault::Input(number, is_high) => {
                let bit = 1 << (number & 63) & !1;
                self.inputs = (self.inputs & !bit) | if is_high { bit } else { 0 };
            }
            InjectedFault::Analog(number, value) => {
                if let Some(input) = self.analog.get_mut(number) {
                    *input = value;
                }
            }
            InjectedFault::Pushed(joint, distance) => {
                self.joint(joint, |joint| joint.push(distance));
            }
            InjectedFault::SpindlePart(part) => self.spindle.part = part,
            InjectedFault::SpindleStuck(stuck) => self.spindle.is_stuck = stuck,
            InjectedFault::IndexLost(lost) => self.spindle.is_index_lost = lost,
            InjectedFault::EncoderLost(lost) => self.spindle.is_encoder_lost = lost,
        }
    }

    fn joint(&mut self, joint: usize, change: impl FnOnce(&mut Joint)) {
        if let Some(joint) = self.joints.get_mut(joint) {
            change(joint);
        }
    }

    /// Carries out the events of a setpoint that has arrived, once. Where several arrive between two steps, each is to
    /// be heard in its order: [`step`](Self::step) is given the last of them alone.
    pub fn hear(&mut self, setpoint: &Setpoint) {
        let which = (setpoint.boot_id, setpoint.number);
        if self.carried_out == Some(which) {
            return;
        }
        if self.carried_out.is_some_and(|(life, _)| life != which.0) {
            // What another life of the interpolator has told is nobody's any more.
            self.spindle.take(Event::MCode(5));
        }
        self.carried_out = Some(which);
        for event in setpoint.events().iter().flat_map(EventRecord::event) {
            self.spindle.take(event);
        }
    }

    /// The spindle turns at so many times the speed that programs tell it: the override of the auxiliary record.
    pub const fn override_spindle(&mut self, ratio: f64) {
        self.spindle.ratio = ratio;
    }

    /// Goes on to a time, ns of the clock by which feedback is stamped. `setpoint` is the last one
    /// that arrived, `demand` what the servo library makes of it.
    #[allow(
        clippy::cast_precision_loss,
        reason = "a step of milliseconds is exact"
    )]
    pub fn step(&mut self, now_ns: u64, setpoint: Option<&Setpoint>, demand: Option<&JointStates>) {
        let step_ns = now_ns.saturating_sub(self.now_ns);
        let is_first = self.number == 0;
        self.now_ns = now_ns;
        let (enable, home) = setpoint.map_or((0, 0), |s| (s.enable, s.home));
        let enable = if self.has_emergency { 0 } else { enable };
        if let Some(setpoint) = setpoint {
            (self.reference, self.setpoint_number) = (setpoint.reference, setpoint.number);
            self.hear(setpoint);
            if now_ns > setpoint.apply_ns.saturating_add(SILENT_NS) {
                // Nobody is there who could stop it.
                self.spindle.take(Event::MCode(5));
            }
        }
        if !is_first && step_ns > 0 {
            let step_t = step_ns as f64 * 1e-9;
            for (index, joint) in self.joints.iter_mut().enumerate() {
                let bit = 1 << index;
                let wanted: Option<JointState> =
                    demand.and_then(|demand| demand.get(index).copied());
                joint.keep_index(setpoint.is_some_and(|s| s.index & bit != 0), step_ns);
                joint.step(step_t, enable & bit != 0, home & bit != 0, wanted);
            }
            self.spindle.step(step_t);
        }
        self.feel(step_ns);
        let sample = self.measured();
        self.under_way.push_back(sample);
        self.number += 1;
    }

    fn feel(&mut self, step_ns: u64) {
        let Some((joint, at)) = self.probe else {
            return;
        };
        let is_deflected = self.joints.get(joint).is_some_and(|j| j.position() <= at);
        let touches = if is_deflected != self.is_deflected {
            self.bounces_ns = self.bounce_ns;
            is_deflected
        } else if self.bounces_ns > 0 {
            !self.touches
        } else {
            is_deflected
        };
        self.bounces_ns = self.bounces_ns.saturating_sub(step_ns);
        self.is_deflected = is_deflected;
        if touches && !self.touches {
            self.touch_count += 1;
            self.touched = (self.positions(), self.now_ns);
        }
        self.touches = touches;
    }

    fn positions(&self) -> [f64; 9] {
        let mut positions = [0.0; 9];
        for (position, joint) in positions.iter_mut().zip(&self.joints) {
            *position = joint.position();
        }
        positions
    }

    /// The feedback that is measured now, whether or not it will arrive.
    #[must_use]
    #[allow(
        clippy::cast_possible_truncation,
        reason = "there are nine joints at most"
    )]
    pub fn measured(&self) -> Feedback {
        let mask = |is: &dyn Fn(&Joint) -> bool| {
            let joints = self.joints.iter().enumerate();
            joints
                .filter(|(_, joint)| is(joint))
                .fold(0, |mask, (index, _)| mask | 1 << index)
        };
        let mut feedback = Feedback {
            boot_id: self.boot_id,
            number: self.number,
            sample_ns: self.now_ns,
            reference: self.reference,
            setpoint_number: self.setpoint_number,
            joints: mask(&|_| true),
            enabled: mask(&Joint::is_enabled),
            homed: mask(&Joint::is_homed),
            homing: mask(&Joint::is_homing),
            fault: mask(&|joint| joint.fault_code != 0),
            limit_low: mask(&|joint| joint.limits().0),
            limit_high: mask(&|joint| joint.limits().1),
            home_switch: mask(&Joint::is_at_home_switch),
            position: self.positions(),
            digital_in: self.inputs | u64::from(self.touches),
            spindle_angle: self.spindle.counted(),
            analog_in: self.analog,
            spindle_v: self.spindle.speed,
            spindle_index_count: self.spindle.index_count,
            spindle_flags: self.spindle.flags().0,
            ..Feedback::zeroed()
        };
        for (index, joint) in self.joints.iter().enumerate() {
            feedback.velocity[index] = joint.velocity();
            let (is_armed, kept) = joint.kept_index();
            feedback.index_armed |= u32::from(is_armed) << index;
            feedback.index_kept |= u32::from(kept.is_some()) << index;
            feedback.index_position[index] = kept.unwrap_or(0.0);
            feedback.fault_code[index] = joint.fault_code;
            feedback.drive_state[index] = if joint.fault_code != 0 {
                DriveState::Fault
            } else if joint.is_enabled() {
                DriveState::OperationEnabled
            } else {
                DriveState::Ready
            }
            .code();
        }
        let [latch, indices @ ..] = &mut feedback.latch;
        latch.rising = 1;
        (latch.position, latch.latch_ns) = self.touched;
        latch.count = self.touch_count;
        if self.touch_count > 0 {
            latch.kind = LatchKind::Drive.code();
        }
        let with_index = self.joints.iter().enumerate();
        let with_index = with_index.filter(|(_, joint)| joint.has_index());
        for (latch, (index, joint)) in indices.iter_mut().zip(with_index) {
            (latch.input, latch.rising) = (INDEX_INPUT + index as u32, 1);
            latch.kind = LatchKind::Drive.code();
            (latch.count, latch.position[index]) = joint.index;
        }
        feedback
    }

    /// The newest feedback that has arrived, `None` if there is none or it stays away.
    pub fn feedback(&mut self) -> Option<Feedback> {
        let mut newest = None;
        while let Some(first) = self.under_way.front()
            && first.sample_ns + self.latency_ns <= self.now_ns
        {
            newest = self.under_way.pop_front();
        }
        newest.filter(|_| !self.is_silent)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glidepath_link::SpindleFlags;

    /// The plant with its spindle at speed, told by a setpoint that applies at a time.
    fn turning(apply_ns: u64) -> (Plant, Setpoint) {
        let mut plant = Plant::new(1, &[JointSettings::default()]);
        let mut setpoint = Setpoint::zeroed();
        (setpoint.boot_id, setpoint.number, setpoint.apply_ns) = (7, 1, apply_ns);
        for event in [Event::SpindleSpeed(600.0), Event::MCode(3)] {
            assert!(setpoint.tell(EventRecord::new(event, 0)));
        }
        for ms in 0..300 {
            plant.step(apply_ns + ms * 1_000_000, Some(&setpoint), None);
        }
        assert!((plant.spindle().1 - 10.0).abs() < 1e-9);
        (plant, setpoint)
    }

    #[test]
    fn a_spindle_stops_when_nobody_is_there_who_could_stop_it() {
        let begin_ns = 5_000_000_000;
        let (mut plant, setpoint) = turning(begin_ns);
        for ms in 300..490 {
            plant.step(begin_ns + ms * 1_000_000, Some(&setpoint), None);
        }
        assert!(plant.spindle().1 > 9.0, "setpoints may be late");
        for ms in 490..1000 {
            plant.step(begin_ns + ms * 1_000_000, Some(&setpoint), None);
        }
        assert!(plant.spindle().1.abs() < 1e-9);

        let (mut plant, setpoint) = turning(begin_ns);
        let mut next = Setpoint::zeroed();
        (next.boot_id, next.number) = (setpoint.boot_id + 1, 0);
        for ms in 300..600 {
            next.apply_ns = begin_ns + ms * 1_000_000;
            plant.step(next.apply_ns, Some(&next), None);
        }
        assert!(
            plant.spindle().1.abs() < 1e-9,
            "another life has not told it to turn"
        );
    }

    #[test]
    fn a_spindle_turns_at_its_override() {
        let begin_ns = 5_000_000_000;
        let (mut plant, setpoint) = turning(begin_ns);
        plant.override_spindle(0.8);
        for ms in 300..400 {
            plant.step(begin_ns + ms * 1_000_000, Some(&setpoint), None);
        }
        assert!((plant.spindle().1 - 8.0).abs() < 1e-9);
        let flags = SpindleFlags(plant.feedback().unwrap().spindle_flags);
        assert!(flags.contains(SpindleFlags::AT_SPEED));
    }

    #[test]
    fn what_setpoints_tell_that_arrive_together_is_all_carried_out() {
        let begin_ns = 5_000_000_000;
        let (mut plant, setpoint) = turning(begin_ns);
        let mut next = setpoint;
        (next.number, next.event_count) = (2, 0);
        assert!(next.tell(EventRecord::new(Event::MCode(5), 0)));
        let mut last = next;
        (last.number, last.event_count) = (3, 0);
        plant.hear(&next);
        for ms in 300..1000 {
            last.apply_ns = begin_ns + ms * 1_000_000;
            plant.hear(&last);
            plant.step(last.apply_ns, Some(&last), None);
        }
        assert!(plant.spindle().1.abs() < 1e-9, "M5 was told in between");
    }
}
