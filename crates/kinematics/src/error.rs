//! The errors of the maps between axes and joints: why a position has no joints, or joints no
//! position.

use thiserror::Error;

/// The reason why a map failed, or why a position is forbidden.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum KinematicsError {
    /// No position of the joints brings the tool there.
    #[error("joint J{joint} cannot reach the position")]
    Unreachable {
        /// The joint that falls short.
        joint: usize,
    },
    /// No position of the tool fits the joints.
    #[error("no position of the tool fits the joints")]
    NoPosition,
    /// Forward kinematics did not settle on a position near the given one.
    #[error("forward kinematics did not converge from the last known position")]
    NotConverged,
    /// Too near a singularity: joints no longer hold the tool in every direction.
    #[error("near a singularity: {condition:.1} times stiffer in one direction than in another")]
    Singular {
        /// Ratio of largest to smallest singular value of the scaled Jacobian.
        condition: f64,
    },
    /// A strut's universal joint would have to tilt too far.
    #[error("the joint of strut J{joint} would tilt by {angle_deg:.2}°")]
    Tilted {
        /// The strut.
        joint: usize,
        /// Angle from the normal of base or platform, degrees.
        angle_deg: f64,
    },
    /// Two struts would come too near to each other.
    #[error("struts J{first} and J{second} would be {distance_mm:.2} mm apart")]
    Colliding {
        /// One.
        first: usize,
        /// The other.
        second: usize,
        /// Distance of their centre lines, mm.
        distance_mm: f64,
    },
}
