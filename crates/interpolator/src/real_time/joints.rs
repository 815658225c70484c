//! The motion of the joints: the mechanism's inverse, at every tick.
//!
//! The setpoint leaves the real-time thread whole, so what a drive gets depends on no other thread.
//! The inverse is bounded work without allocation, a closed form for every mechanism.

use crate::real_time::compensated::CompensatedJoints;
use crate::real_time::track::Track;
use crate::shared::config::Config;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{
    JOINTS, JointMotion, JointVector, Kinematics as _, KinematicsError, Mechanism,
};
use glidepath_link::Setpoint;

/// The joints of the machine.
#[derive(Debug)]
pub(crate) struct Joints {
    mechanism: Mechanism,
    /// Where they were told to be last, as the drives count.
    last: JointVector,
    /// What is added to the drives' count to have the machine's.
    offset: JointVector,
    has_offset: bool,
    /// The second joints of axes, each with the joint that it follows. A list, because every tick
    /// walks along it, and few machines have any.
    second: heapless::Vec<(usize, usize), JOINTS>,
    /// How far a second joint is beside the first, in the machine's count. It stays so: nothing
    /// squares a machine but its way home.
    beside: JointVector,
    compensated: CompensatedJoints,
}

impl Joints {
    pub(crate) fn new(config: &Config) -> Self {
        let pairs = config
            .second_joints()
            .map(|(joint, gantry)| (joint, gantry.master));
        Self {
            mechanism: config.mechanism,
            second: pairs.take(JOINTS).collect(),
            beside: JointVector::zeros(),
            last: JointVector::zeros(),
            offset: JointVector::zeros(),
            has_offset: false,
            compensated: CompensatedJoints::new(config),
        }
    }

    /// What is added to the drives' count from now on.
    pub(crate) fn count_from(&mut self, offset: &JointVector) {
        self.offset = *offset;
        self.has_offset = offset.iter().any(|offset| *offset != 0.0);
    }

    /// Looks ahead along the frames of a program for where joints turn round.
    pub(crate) fn look_ahead(&mut self, track: &Track, sequence: u64, setpoint: &Setpoint) {
        self.compensated
            .look_ahead(track, sequence, &setpoint.position);
    }

    /// Whether no play of a joint is being taken up.
    pub(crate) fn rest(&self) -> bool {
        self.compensated.rest()
    }

    /// Writes on which side of its play each joint is.
    pub(crate) fn write_sides(&self, sides: &mut JointVector) {
        self.compensated.write_sides(sides);
    }

    /// The position is taken over from the drives: on which side of their play joints stand is not known any more.
    /// Writes where joints and axes are then.
    pub(crate) fn take_over(&mut self, joints: &mut JointVector, axes: &mut AxisVector) {
        if self.compensated.is_empty() {
            return;
        }
        self.compensated.take_over(joints);
        if let Ok(moved) = self.mechanism.forward(joints, axes) {
            *axes = moved;
        }
    }

    /// Writes into a setpoint where joints are, of which those in `follows` may have moved by
    /// themselves; the others stay where they were told to be.
    pub(crate) fn repeat(&mut self, joints: &JointVector, follows: u32, setpoint: &mut Setpoint) {
        let mut told = *joints;
        self.compensated.stand(&mut told);
        let counted = told - self.offset;
        let places = self.last.iter_mut().zip(counted.iter()).enumerate();
        for (_, (last, counted)) in places.filter(|(joint, _)| follows & (1 << joint) != 0) {
            *last = *counted;
        }
        setpoint.joint_position = self.last.into();
        setpoint.joint_velocity = JointVector::zeros().into();
        setpoint.joint_acceleration = JointVector::zeros().into();
    }

    /// Where they were told to be last, as the drives count.
    pub(crate) const fn last(&self) -> &JointVector {
        &self.last
    }

    /// Writes into a setpoint what joints do that are moved each for itself, as the drives count.
    /// Returns where the axes are then, and how they move.
    pub(crate) fn write(
        &mut self,
        motion: &JointMotion,
        setpoint: &mut Setpoint,
    ) -> Result<[AxisVector; 3], KinematicsError> {
        self.last = motion.position;
        setpoint.joint_position = self.last.into();
        setpoint.joint_velocity = motion.velocity.into();
        setpoint.joint_acceleration = motion.acceleration.into();
        let mut motion = *motion;
        motion.position += self.offset;
        self.compensated.restore(&mut motion);
        let near = AxisVector::from(setpoint.position);
        self.mechanism.axes_motion(&motion, &near)
    }

    /// A second joint does what the first one of its axis does.
    fn add_second_joints(&self, motion: &mut JointMotion) {
        for &(joint, master) in &self.second {
            for rates in [
                &mut motion.position,
                &mut motion.velocity,
                &mut motion.acceleration,
            ] {
                let leads = rates.get(master).copied().unwrap_or(0.0);
                if let Some(slot) = rates.get_mut(joint) {
                    *slot = leads;
                }
            }
            if let (Some(slot), Some(beside)) =
                (motion.position.get_mut(joint), self.beside.get(joint))
            {
                *slot += beside;
            }
        }
    }

    /// The joints stand there, in the machine's count; second joints stay where they are beside the
    /// first ones.
    pub(crate) fn stand(&mut self, joints: &JointVector) {
        for &(joint, master) in &self.second {
            let at = |joint: usize| joints.get(joint).copied().unwrap_or(0.0);
            if let Some(slot) = self.beside.get_mut(joint) {
                *slot = at(joint) - at(master);
            }
        }
    }

    /// The same where they were told to be last.
    pub(crate) fn stand_there(&mut self) {
        let mut motion = JointMotion {
            position: self.last + self.offset,
            velocity: JointVector::zeros(),
            acceleration: JointVector::zeros(),
        };
        self.compensated.restore(&mut motion);
        self.stand(&motion.position);
    }

    /// Writes into a setpoint what the joints are to do for its axes. Returns where they are then, in the
    /// machine's count.
    ///
    /// # Errors
    /// The mechanism cannot be there. The joints are told to stay where they were.
    pub(crate) fn follow(
        &mut self,
        setpoint: &mut Setpoint,
    ) -> Result<JointVector, KinematicsError> {
        let motion = self.mechanism.motion(
            &setpoint.position.into(),
            &setpoint.velocity.into(),
            &setpoint.acceleration.into(),
        );
        match motion {
            Ok(mut motion) => {
                self.add_second_joints(&mut motion);
                let joints = motion.position;
                if !self.compensated.is_empty() {
                    self.compensated.compensate(&mut motion);
                }
                self.last = if self.has_offset {
                    motion.position - self.offset
                } else {
                    motion.position
                };
                setpoint.joint_position = self.last.into();
                setpoint.joint_velocity = motion.velocity.into();
                setpoint.joint_acceleration = motion.acceleration.into();
                Ok(joints)
            }
            Err(error) => {
                setpoint.joint_position = self.last.into();
                setpoint.joint_velocity = JointVector::zeros().into();
                setpoint.joint_acceleration = JointVector::zeros().into();
                Err(error)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::float_cmp, reason = "a test")]

    use super::*;
    use crate::shared::config::Config;
    use crate::testing::{Rig, hexapod, lines, mill, records};
    use glidepath_kinematics::{AxisList, LinearDelta};
    use glidepath_link::{Command, FaultCause, MachineState};

    #[test]
    fn a_setpoint_leaves_the_tick_with_joints() {
        let mechanism = hexapod();
        let mut rig = Rig::new(Config {
            mechanism,
            ..Config::new(mill(), 4_000_000)
        });
        rig.feed = records(&lines(4, 3, 900, &mill(), 0.004), 1, 4_000_000).into();
        rig.run(100);
        rig.command(Command::FeedOverride(0.37));
        rig.run(100);
        rig.command(Command::Hold);
        assert!(rig.run_until(2_000, |s| s.state() == Ok(MachineState::Held)));
        for s in &rig.setpoints {
            let joints = mechanism.inverse(&s.position.into()).unwrap();
            assert_eq!(s.joint_position, <[f64; 9]>::from(joints));
        }
        // Velocities and accelerations are those of the positions: the differences are off by J T²
        // / 6 and, where jerk steps, J T / 3, with the jerk J of three axes together.
        for window in rig.setpoints.windows(3).filter(|w| w[1].number > 130) {
            let [a, b, c] = [0, 1, 2].map(|k| JointVector::from(window[k].joint_position));
            let rate = (c - a) / 0.008 - JointVector::from(window[1].joint_velocity);
            assert!(rate.amax() < 0.2, "{rate:?}");
            let second = (a - b * 2.0 + c) / 1.6e-5;
            let beyond = second - JointVector::from(window[1].joint_acceleration);
            assert!(beyond.amax() < 100.0, "{beyond:?}");
        }
        let fastest = rig.setpoints.iter().map(|s| s.joint_velocity[0].abs());
        assert!(fastest.fold(0.0, f64::max) > 10.0);
    }

    #[test]
    fn joints_stay_and_the_motion_ends_where_the_mechanism_cannot_be() {
        let mut rig = Rig::new(Config {
            mechanism: Mechanism::LinearDelta(LinearDelta {
                rod_mm: 100.0,
                radius_mm: 90.0,
                tower_deg: [90.0, 210.0, 330.0],
                others: AxisList::new(&[]),
            }),
            ..Config::new(mill(), 4_000_000)
        });
        // Nobody judges these frames.
        let frames = lines(1, 1, 3_000, &mill(), 0.004);
        let farthest = frames
            .iter()
            .map(|f| f.position[0].abs())
            .fold(0.0, f64::max);
        assert!(farthest > 100.0, "out of reach: {farthest}");
        rig.feed = records(&frames, 1, 4_000_000).into();
        assert!(rig.run_until(5_000, |s| s.state() == Ok(MachineState::Faulted)));
        let fault = rig.last.unwrap().fault.unwrap();
        assert_eq!(fault.cause, FaultCause::Output);
        let (last, before) = rig.setpoints.split_last().unwrap();
        let reached = |s: &&Setpoint| rig.config.mechanism.inverse(&s.position.into()).is_ok();
        let reached = before.iter().rev().find(reached).unwrap();
        assert_eq!(last.joint_position, reached.joint_position);
        assert_eq!(last.joint_velocity, [0.0; 9]);
        assert!(rig.worst_ratio() <= 1.0 + 1e-6);
    }
}
