//! The settings of the drives' feedback: what is expected of it.

use crate::shared::config::homing::JointHoming;
use core::time::Duration;
use glidepath_kinematics::JOINTS;

/// The settings of one joint's feedback.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointFeedback {
    /// How far the joint may be from where it is to be at rest and when it is slow, mm or degrees,
    /// > 0.
    pub min_following_error: f64,
    /// The same at `max_velocity`; in between in proportion to the speed, but never less than the
    /// former.
    pub following_error: f64,
    /// The joint's highest speed, mm/s or °/s, > 0.
    pub max_velocity: f64,
    /// Whether the drive has to say that the joint knows where it is before a program may start.
    pub homes: bool,
    /// How the controller finds the joint's home; `None` if its drive does, or nobody.
    pub homing: Option<JointHoming>,
}

/// The input that a probe is connected to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProbeInput {
    /// Its number, 0 to 63.
    pub number: u8,
    /// What it is while the probe touches.
    pub high: bool,
    /// A contact outside of a search stops whatever moves.
    pub protects: bool,
}

/// The input that slows programs down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdaptiveFeed {
    /// Its number, 0 to 7.
    pub input: u8,
    /// What it says where the program is to stand.
    pub at_zero: f64,
    /// What it says where the program is to run as fast as the override lets it.
    pub at_full: f64,
    /// It does so at all times, and not only from M52 P1 to M52 P0.
    pub always: bool,
    /// Below the value that stands the motion goes back along the path: as fast as the plan as far
    /// below it as the full value is above.
    pub backwards: bool,
}

/// The settings by which the feedback of the drives is judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedbackSettings {
    /// Feedback older than this stops the motion.
    pub stale_after: Duration,
    /// Feedback older than this takes the power from the drives.
    pub off_after: Duration,
    /// Where a probe is connected, if there is one.
    pub probe: Option<ProbeInput>,
    /// What slows programs down, if anything does.
    pub adaptive: Option<AdaptiveFeed>,
    /// The joints; those the machine does not have mean nothing.
    pub joints: [JointFeedback; JOINTS],
}

impl FeedbackSettings {
    /// Three periods until the motion stops, 100 ms until power goes, and the same for all joints.
    #[must_use]
    pub fn new(period_ns: u64, joint: JointFeedback) -> Self {
        Self {
            stale_after: Duration::from_nanos(3 * period_ns),
            off_after: Duration::from_millis(100).max(Duration::from_nanos(6 * period_ns)),
            probe: None,
            adaptive: None,
            joints: [joint; JOINTS],
        }
    }
}
