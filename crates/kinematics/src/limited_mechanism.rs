//! A mechanism with what its joints can do.

use crate::{JointLimits, Mechanism};

/// A mechanism and the limits of its joints, from which motion is planned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedMechanism {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What its joints can do.
    pub limits: JointLimits,
}
