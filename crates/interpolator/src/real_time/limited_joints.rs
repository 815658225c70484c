//! The joints as limits of the motion along frames, where they are not the axes.
//!
//! Whatever the rate of program time is, the joints have limits of their own, and a plan may be at these all
//! the time. So ramps and stops are played through in joints, too: their positions between two frames are
//! those of the quintic through both, like the axes'. That costs one inverse a frame, not one for each
//! position that is tried. It is beside the exact position by less than the sixth derivative of a joint times
//! T⁶/46 080; setpoints themselves are exact.

use crate::real_time::quintic::{MotionState, Quintic};
use crate::shared::config::Config;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::{JointLimits, JointMotion, JointVector, Kinematics as _, Mechanism};
use glidepath_link::SetpointFrame;
use glidepath_program::{Limits, PathBounds, Travel};

/// A mechanism and what its joints can do.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LimitedJoints {
    mechanism: Mechanism,
    /// Of joints, J0 in the place of X and so on.
    pub(crate) limits: Limits,
}

impl LimitedJoints {
    /// The joints of a machine whose motion is limited beside that of the axes.
    pub(crate) fn of(config: &Config) -> Option<Self> {
        let is_trivial = matches!(config.mechanism, Mechanism::Trivial(_));
        (!is_trivial).then(|| Self::new(config.mechanism, &config.joint_limits))
    }

    pub(crate) fn new(mechanism: Mechanism, limits: &JointLimits) -> Self {
        let of = |limit: [f64; glidepath_kinematics::JOINTS]| {
            AxisVector::from(limit.map(|limit| limit.min(Limits::UNLIMITED)))
        };
        Self {
            mechanism,
            limits: Limits {
                velocity: of(limits.0.map(|limit| limit.velocity)),
                acceleration: of(limits.0.map(|limit| limit.acceleration)),
                jerk: of(limits.0.map(|limit| limit.jerk)),
                path: PathBounds::NONE,
                travel: Travel::unlimited(),
            },
        }
    }

    /// Where the joints are; not numbers where the mechanism cannot be.
    pub(crate) fn at(&self, axes: &AxisVector) -> JointVector {
        let nowhere = |_| JointVector::repeat(f64::NAN);
        self.mechanism.inverse(axes).unwrap_or_else(nowhere)
    }

    /// The joints at a frame; not numbers where the mechanism cannot be, so that no ramp passes there.
    fn motion(&self, frame: &SetpointFrame) -> JointMotion {
        let nowhere = JointMotion {
            position: JointVector::repeat(f64::NAN),
            velocity: JointVector::repeat(f64::NAN),
            acceleration: JointVector::repeat(f64::NAN),
        };
        let axes = [frame.position, frame.velocity, frame.acceleration].map(AxisVector::from);
        let [position, velocity, acceleration] = &axes;
        self.mechanism
            .motion(position, velocity, acceleration)
            .unwrap_or(nowhere)
    }
}

/// The joints along the frames of a track.
#[derive(Debug)]
pub(crate) struct JointTrack {
    joints: LimitedJoints,
    /// In the slot of a frame: the joints at it, and their motion from it to the next.
    motions: Box<[JointMotion]>,
    quintics: Box<[Quintic]>,
}

impl JointTrack {
    /// Without frames, with room for so many. Allocates all it will ever use.
    pub(crate) fn new(joints: LimitedJoints, capacity: usize) -> Self {
        let still = JointMotion {
            position: JointVector::zeros(),
            velocity: JointVector::zeros(),
            acceleration: JointVector::zeros(),
        };
        Self {
            joints,
            motions: vec![still; capacity].into_boxed_slice(),
            quintics: vec![Quintic::zeros(); capacity].into_boxed_slice(),
        }
    }

    /// Takes a frame into a slot, and the motion up to it into that of the frame before, if there is
    /// one. Returns how fast the joints are at it.
    pub(crate) fn own(
        &mut self,
        frame: &SetpointFrame,
        slot: usize,
        before: Option<usize>,
        period_t: f64,
    ) -> JointVector {
        let motion = self.joints.motion(frame);
        if let Some(before) = before
            && let Some(from) = self.motions.get(before)
            && let Some(quintic) = self.quintics.get_mut(before)
        {
            quintic.set(&state(from), &state(&motion), period_t);
        }
        if let Some(slot) = self.motions.get_mut(slot) {
            *slot = motion;
        }
        motion.velocity
    }

    /// Where the joints are at the frame in a slot.
    pub(crate) fn position(&self, slot: usize) -> Option<&JointVector> {
        self.motions.get(slot).map(|motion| &motion.position)
    }

    /// The joints from the frame in a slot to the next.
    pub(crate) fn quintic(&self, slot: usize) -> Option<&Quintic> {
        self.quintics.get(slot)
    }
}

const fn state(motion: &JointMotion) -> MotionState<'_> {
    let [position] = &motion.position.data.0;
    let [velocity] = &motion.velocity.data.0;
    let [acceleration] = &motion.acceleration.data.0;
    MotionState {
        position,
        velocity,
        acceleration,
    }
}
