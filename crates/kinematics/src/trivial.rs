//! Trivial kinematics: each axis has a drive of its own.
//!
//! Where the axes are not quite square or straight, joints are beside them by what is [compensated](CrossCompensation).

use crate::machine::{AxisSeries, Conditioning, JointMotion, JointSeries, JointVector, Kinematics};
use crate::{AxisList, CrossCompensation, JOINTS, KinematicsError};
use glidepath_geometry::number::{Number, Series};
use glidepath_geometry::{AXES, AxisVector};

/// Joint 0 is the machine's first axis, joint 1 its second, and so on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trivial {
    /// The machine's axes.
    pub axes: AxisList,
    /// What is added to each by where others are. It lives as long as the process: the real-time thread must not be
    /// the one that frees it.
    pub cross: Option<&'static CrossCompensation>,
}

impl Trivial {
    /// Joints that are the axes.
    #[must_use]
    pub const fn new(axes: AxisList) -> Self {
        Self { axes, cross: None }
    }

    /// Position, velocity and acceleration of the axes for those of their joints.
    #[must_use]
    pub fn axes_motion(&self, motion: &JointMotion) -> [AxisVector; 3] {
        let joints = [&motion.position, &motion.velocity, &motion.acceleration];
        let told = joints.map(|joints| {
            let mut axes = AxisVector::zeros();
            pass_back(self.axes, joints.as_slice(), &mut axes);
            axes
        });
        match self.cross {
            Some(cross) => cross.nominal([&told[0], &told[1], &told[2]]),
            None => told,
        }
    }
}

impl Kinematics for Trivial {
    fn joints(&self) -> usize {
        self.axes.len()
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        let mut joints = [Series::constant(0.0); JOINTS];
        match self.cross {
            Some(cross) => pass_through(self.axes, &cross.told_series(axes), &mut joints),
            None => pass_through(self.axes, axes, &mut joints),
        }
        Ok(joints)
    }

    /// What is true of positions is true of their derivatives, and tables have theirs: no series is needed.
    fn motion(
        &self,
        position: &AxisVector,
        velocity: &AxisVector,
        acceleration: &AxisVector,
    ) -> Result<JointMotion, KinematicsError> {
        let mut motion = JointMotion {
            position: JointVector::zeros(),
            velocity: JointVector::zeros(),
            acceleration: JointVector::zeros(),
        };
        let told;
        let [position, velocity, acceleration] = match self.cross {
            Some(cross) => {
                told = cross.told([position, velocity, acceleration]);
                [&told[0], &told[1], &told[2]]
            }
            None => [position, velocity, acceleration],
        };
        let mut joint = 0;
        for axis in 0..AXES {
            if joint < JOINTS && self.axes.has(axis) {
                motion.position[joint] = position[axis];
                motion.velocity[joint] = velocity[axis];
                motion.acceleration[joint] = acceleration[axis];
                joint += 1;
            }
        }
        Ok(motion)
    }

    fn forward(
        &self,
        joints: &JointVector,
        _near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        let mut axes = AxisVector::zeros();
        pass_back(self.axes, joints.as_slice(), &mut axes);
        let rest = AxisVector::zeros();
        Ok(match self.cross {
            Some(cross) => cross.nominal([&axes, &rest, &rest])[0],
            None => axes,
        })
    }

    fn conditioning(&self, _axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        Ok(Conditioning::PERFECT)
    }
}

/// Copies axes to the joints at the beginning of `joints`.
pub(crate) fn pass_through<const N: usize, T: Number>(
    list: AxisList,
    axes: &AxisSeries<N, T>,
    joints: &mut [Series<N, T>],
) {
    for (joint, axis) in joints.iter_mut().zip(list.iter()) {
        *joint = axes[axis.index()];
    }
}

/// Copies joints from the beginning of `joints` back to their axes.
pub(crate) fn pass_back(list: AxisList, joints: &[f64], axes: &mut AxisVector) {
    for (joint, axis) in joints.iter().zip(list.iter()) {
        axes[axis.index()] = *joint;
    }
}
