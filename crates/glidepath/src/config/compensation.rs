//! The compensation of a machine's joints.

use glidepath_geometry::Axis;
use glidepath_kinematics::{JOINTS, JointCompensation, JointLimit};

/// What is taken out of where each joint is told to be.
///
/// Made when a configuration is loaded, and never given back: the real-time thread reads the tables as long as the
/// process lives, and must not be the one that frees them. A process loads few configurations.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Compensation([Option<&'static JointCompensation>; JOINTS]);

impl Compensation {
    /// Of each joint, J0 first.
    #[must_use]
    pub const fn joints(&self) -> [Option<&'static JointCompensation>; JOINTS] {
        self.0
    }

    pub(super) fn set(&mut self, joint: usize, made: JointCompensation) {
        if let Some(slot) = self.0.get_mut(joint) {
            *slot = Some(Box::leak(Box::new(made)));
        }
    }

    /// What the drives of an axis can do, if a joint of it is compensated; `of_joint` is the axis of each joint.
    #[must_use]
    pub fn drive(&self, axis: Axis, of_joint: &[Axis]) -> Option<JointLimit> {
        let mut joints = self.0.iter().zip(of_joint);
        joints.find_map(|(made, of)| made.filter(|_| *of == axis).map(|made| *made.drive()))
    }
}
