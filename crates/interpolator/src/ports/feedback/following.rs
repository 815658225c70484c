//! The following error of each joint: how far it is from where it was to be.
//!
//! The error is the demand at the moment of the sample less the sample: a drive that does what the
//! setpoints say has none, however late its feedback comes. What is allowed grows with the speed of
//! the demand, as in LinuxCNC: the larger of `min_following_error` and `following_error · |v| /
//! v_max`.

use crate::shared::config::feedback::JointFeedback;
use glidepath_kinematics::JOINTS;
use glidepath_link::servo::JointState;

/// Share of what is allowed at which somebody is told.
const WARNING_R: f64 = 0.5;
/// Share at which the power goes.
const CUT_R: f64 = 2.0;
/// By how much the share may grow after the motion began to stop.
const GROWTH_R: f64 = 0.5;

/// The judgement of a joint's error, with the error and what is allowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Finding {
    /// Tell somebody; once since power came on.
    Warn(f64, f64),
    /// Stop on the path.
    Stop(f64, f64),
    /// Take the power, at once.
    Cut(f64, f64),
}

/// The following error of a joint.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Following {
    error: f64,
    /// What is allowed of it now.
    limit: f64,
    peak: f64,
    /// The share of what is allowed when the motion began to stop for it.
    stopped_r: Option<f64>,
    is_warned: bool,
}

/// The following errors of all joints.
#[derive(Debug, Default)]
pub(super) struct FollowingErrors([Following; JOINTS]);

impl FollowingErrors {
    /// Power came on: what was before does not count.
    pub(super) fn begin(&mut self) {
        self.0 = [Following::default(); JOINTS];
    }

    pub(super) fn errors(&self) -> [f64; JOINTS] {
        self.0.map(|joint| joint.error)
    }

    pub(super) fn peaks(&self) -> [f64; JOINTS] {
        self.0.map(|joint| joint.peak)
    }

    /// No joint is judged now.
    pub(super) fn rest(&mut self) {
        for joint in &mut self.0 {
            joint.error = 0.0;
        }
    }

    /// Whether the error of a joint is more than is allowed now.
    pub(super) fn is_beyond(&self) -> bool {
        let mut joints = self.0.iter();
        joints.any(|following| following.error.abs() > following.limit)
    }

    /// Judges a joint by its demand at the moment of its sample. `is_stopping` once a fault is
    /// latched.
    pub(super) fn judge(
        &mut self,
        joint: usize,
        demand: &JointState,
        position: f64,
        allowed: &JointFeedback,
        is_stopping: bool,
    ) -> Option<Finding> {
        let following = self.0.get_mut(joint)?;
        let error = demand.position - position;
        let ramp = allowed.following_error * demand.velocity.abs() / allowed.max_velocity;
        let limit = ramp.max(allowed.min_following_error);
        let share_r = error.abs() / limit;
        (following.error, following.limit) = (error, limit);
        following.peak = following.peak.max(error.abs());
        if !is_stopping {
            following.stopped_r = None;
        }
        let grew = following
            .stopped_r
            .is_some_and(|before| share_r > before + GROWTH_R);
        if share_r > CUT_R || grew {
            return Some(Finding::Cut(error.abs(), limit));
        }
        if share_r > 1.0 {
            following.stopped_r.get_or_insert(share_r);
            return (!is_stopping).then_some(Finding::Stop(error.abs(), limit));
        }
        if share_r > WARNING_R && !following.is_warned {
            following.is_warned = true;
            return Some(Finding::Warn(error.abs(), limit));
        }
        None
    }
}
