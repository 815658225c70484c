//! The motion between two frames: that of every axis is the quintic polynomial that has their position,
//! velocity and acceleration at both ends.

use super::Track;
use crate::real_time::differences::{Allowed, Differences, MachinePosition};
use crate::real_time::pairs::{larger, smaller};
use crate::real_time::program_time::ProgramTime;
use crate::real_time::quintic::{Kinematic, Quintic};
use glidepath_geometry::AxisVector;
use glidepath_kinematics::JointVector;

/// Path position and its rate by program time in periods.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathState {
    pub(crate) path_s: f64,
    pub(crate) path_v: f64,
}

impl Track {
    /// Planned position at a time; `None` outside the owned frames.
    pub(crate) fn position(&self, time: ProgramTime) -> Option<AxisVector> {
        let frame = self.frame(time.sequence)?;
        if time.fraction <= 0.0 {
            return Some(AxisVector::from(frame.position));
        }
        Some(self.quintic(time.sequence)?.position(time.fraction))
    }

    /// Whether joints that are not the axes are known along the frames.
    pub(crate) const fn has_joints(&self) -> bool {
        self.joints.is_some()
    }

    /// Planned position at a time with that of joints that are not the axes; `None` outside the owned
    /// frames.
    pub(crate) fn whereabouts(&self, time: ProgramTime) -> Option<MachinePosition> {
        let axes = self.position(time)?;
        let joints = match (&self.joints, time.fraction <= 0.0) {
            (None, _) => JointVector::zeros(),
            (Some((joints, _)), true) => *joints.position(Self::slot(time.sequence))?,
            (Some(_), false) => self.joint_quintic(time.sequence)?.position(time.fraction),
        };
        Some(MachinePosition { axes, joints })
    }

    /// The motion from a frame to the next; `None` outside the owned frames.
    fn quintic(&self, sequence: u64) -> Option<&Quintic> {
        let offset = sequence.checked_sub(self.oldest)?;
        if offset + 1 < self.len as u64 {
            self.quintics.get(Self::slot(sequence))
        } else {
            None
        }
    }

    /// The joints from a frame to the next, where they are not the axes; for whoever knows that both are
    /// owned.
    fn joint_quintic(&self, sequence: u64) -> Option<&Quintic> {
        let (joints, _) = self.joints.as_ref()?;
        joints.quintic(Self::slot(sequence))
    }

    /// Appends the planned position at a time to others; returns whether it is within the limits,
    /// and within the owned frames.
    pub(crate) fn append_to(
        &self,
        published: &mut Differences,
        time: ProgramTime,
        allowed: &Allowed,
    ) -> bool {
        if let Some(quintic) = self.quintic(time.sequence) {
            let is_inside = published.append_at(quintic, time.fraction, allowed);
            return match self.joint_quintic(time.sequence) {
                None => is_inside,
                Some(joints) => {
                    is_inside & published.append_joints_at(joints, time.fraction, allowed)
                }
            };
        }
        let position = self.position(time);
        let is_inside = position.is_some_and(|position| published.append(&position, allowed));
        let joints = self.joints.as_ref();
        match joints.and_then(|(joints, _)| joints.position(Self::slot(time.sequence))) {
            None => is_inside,
            Some(joints) => is_inside && published.append_joints(joints, allowed),
        }
    }

    /// By how much the planned position at a time may be moved along the path: see
    /// [`Differences::room`]. Up to the newest frame but one; `None` outside the owned frames.
    pub(crate) fn room(
        &self,
        time: ProgramTime,
        published: &Differences,
        allowed: &Allowed,
    ) -> Option<(f64, f64)> {
        let quintic = self.quintic(time.sequence)?;
        let room = published.room(quintic, time.fraction, allowed);
        let Some(joints) = self.joint_quintic(time.sequence) else {
            return Some(room);
        };
        let of_joints = published.joint_room(joints, time.fraction, allowed);
        Some((larger(room.0, of_joints.0), smaller(room.1, of_joints.1)))
    }

    /// Position and derivatives between frames; `None` outside the owned frames.
    pub(crate) fn kinematic(&self, time: ProgramTime) -> Option<Kinematic> {
        let frame = self.frame(time.sequence)?;
        if time.fraction <= 0.0 {
            return Some(Kinematic {
                position: AxisVector::from(frame.position),
                velocity: AxisVector::from(frame.velocity) * self.period_t,
                acceleration: AxisVector::from(frame.acceleration)
                    * (self.period_t * self.period_t),
            });
        }
        Some(self.quintic(time.sequence)?.kinematic(time.fraction))
    }

    /// Path position and rate, by the cubic through both frames; `None` outside the owned frames.
    pub(crate) fn path(&self, time: ProgramTime) -> Option<PathState> {
        let from = self.frame(time.sequence)?;
        let (u, v0) = (time.fraction, from.path_v * self.period_t);
        if u <= 0.0 {
            return Some(PathState {
                path_s: from.path_s,
                path_v: v0,
            });
        }
        let to = self.frame(time.sequence + 1)?;
        let (step, v1) = (to.path_s - from.path_s, to.path_v * self.period_t);
        let c2 = 3.0 * step - 2.0 * v0 - v1;
        let c3 = v0 + v1 - 2.0 * step;
        Some(PathState {
            path_s: ((c3 * u + c2) * u + v0) * u + from.path_s,
            path_v: (3.0 * c3 * u + 2.0 * c2) * u + v0,
        })
    }
}
