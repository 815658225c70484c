//! The mechanism of a machine: one of all, chosen by the configuration.

use crate::machine::{AxisSeries, Conditioning, JointMotion, JointSeries, JointVector, Kinematics};
use crate::{
    CoreXy, CrossCompensation, FiveAxis, FiveBar, Hexapod, KinematicsError, LinearDelta,
    RotaryDelta, Scara, TranslationalHexapod, Trivial,
};
use glidepath_geometry::AxisVector;
use glidepath_geometry::number::Number;

/// A machine's mechanism: plain data, copied to whoever needs it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(
    clippy::large_enum_variant,
    reason = "a machine has one, and the real-time thread owns it without a heap"
)]
pub enum Mechanism {
    /// Each axis has a drive of its own.
    Trivial(Trivial),
    /// One belt for X and Y.
    CoreXy(CoreXy),
    /// Carriages on vertical towers.
    LinearDelta(LinearDelta),
    /// Swinging arms.
    RotaryDelta(RotaryDelta),
    /// Two arms in the plane.
    Scara(Scara),
    /// Two arms side by side in the plane.
    FiveBar(FiveBar),
    /// Two rotary axes with tool centre point.
    FiveAxis(FiveAxis),
    /// Six struts, six degrees of freedom.
    Hexapod(Hexapod),
    /// Six struts, translation only.
    Translational(TranslationalHexapod),
}

macro_rules! each {
    ($mechanism:expr, $machine:ident => $call:expr) => {
        match $mechanism {
            Mechanism::Trivial($machine) => $call,
            Mechanism::CoreXy($machine) => $call,
            Mechanism::LinearDelta($machine) => $call,
            Mechanism::RotaryDelta($machine) => $call,
            Mechanism::Scara($machine) => $call,
            Mechanism::FiveBar($machine) => $call,
            Mechanism::FiveAxis($machine) => $call,
            Mechanism::Hexapod($machine) => $call,
            Mechanism::Translational($machine) => $call,
        }
    };
}

impl Mechanism {
    /// What is added to axes by where others are, where joints are axes.
    #[must_use]
    pub const fn cross(&self) -> Option<&'static CrossCompensation> {
        match self {
            Self::Trivial(trivial) => trivial.cross,
            _ => None,
        }
    }

    /// Position, velocity and acceleration of the axes for those of joints that are moved each for itself. Only where
    /// joints are axes do rates go the same way as positions.
    ///
    /// # Errors
    /// No position fits the joints.
    pub fn axes_motion(
        &self,
        joints: &JointMotion,
        near: &AxisVector,
    ) -> Result<[AxisVector; 3], KinematicsError> {
        if let Self::Trivial(trivial) = self {
            return Ok(trivial.axes_motion(joints));
        }
        let axes = |joints: &JointVector| self.forward(joints, near);
        Ok([
            axes(&joints.position)?,
            axes(&joints.velocity)?,
            axes(&joints.acceleration)?,
        ])
    }
}

impl Kinematics for Mechanism {
    fn joints(&self) -> usize {
        each!(self, machine => machine.joints())
    }

    fn inverse_series<const N: usize, T: Number>(
        &self,
        axes: &AxisSeries<N, T>,
    ) -> Result<JointSeries<N, T>, KinematicsError> {
        each!(self, machine => machine.inverse_series(axes))
    }

    fn motion(
        &self,
        position: &AxisVector,
        velocity: &AxisVector,
        acceleration: &AxisVector,
    ) -> Result<JointMotion, KinematicsError> {
        each!(self, machine => machine.motion(position, velocity, acceleration))
    }

    fn forward(
        &self,
        joints: &JointVector,
        near: &AxisVector,
    ) -> Result<AxisVector, KinematicsError> {
        each!(self, machine => machine.forward(joints, near))
    }

    fn conditioning(&self, axes: &AxisVector) -> Result<Conditioning, KinematicsError> {
        each!(self, machine => machine.conditioning(axes))
    }

    fn admit(&self, axes: &AxisVector) -> Result<(), KinematicsError> {
        each!(self, machine => machine.admit(axes))
    }

    fn admitted(&self, axes: &AxisVector) -> Result<JointVector, KinematicsError> {
        each!(self, machine => machine.admitted(axes))
    }
}
