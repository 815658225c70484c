//! The limits that can bind, each with an index.

use crate::joints::JOINTS;
use core::fmt;
use glidepath_geometry::{AXES, Axis};

/// A limit that keeps a motion from being faster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binding {
    /// The machine rests: a dwell, a stop, a reversal.
    Rest,
    /// The programmed feedrate, or the override of rapids.
    Feed,
    /// An axis is as fast as it can be.
    Velocity(Axis),
    /// An axis accelerates or brakes as hard as it can.
    Acceleration(Axis),
    /// The acceleration of an axis changes as fast as it can.
    Jerk(Axis),
    /// A joint is as fast as it can be, J0 by 0.
    JointVelocity(usize),
    /// A joint accelerates or brakes as hard as it can.
    JointAcceleration(usize),
    /// The acceleration of a joint changes as fast as it can.
    JointJerk(usize),
    /// The motion is as far from the programmed path as it may be.
    Tolerance,
    /// The straight line between two setpoints is as far from the path as it may be: the period is
    /// too long for this speed on this curve.
    ChordError,
    /// No limit is used fully: a reserve of the planner.
    None,
}

/// Number of different bindings.
pub(super) const COUNT: usize = 5 + 3 * AXES + 3 * JOINTS;

impl Binding {
    /// All of them, in the order of [`Binding::index`].
    pub(super) fn all() -> impl Iterator<Item = Self> {
        let per_axis = |of: fn(Axis) -> Self| Axis::ALL.into_iter().map(of);
        let per_joint = |of: fn(usize) -> Self| (0..JOINTS).map(of);
        [Self::Rest, Self::Feed]
            .into_iter()
            .chain(per_axis(Self::Velocity))
            .chain(per_axis(Self::Acceleration))
            .chain(per_axis(Self::Jerk))
            .chain([Self::Tolerance, Self::ChordError, Self::None])
            .chain(per_joint(Self::JointVelocity))
            .chain(per_joint(Self::JointAcceleration))
            .chain(per_joint(Self::JointJerk))
    }

    /// A number of its own, from 0, below `COUNT`.
    pub(super) const fn index(self) -> usize {
        match self {
            Self::Rest => 0,
            Self::Feed => 1,
            Self::Velocity(axis) => 2 + axis.index(),
            Self::Acceleration(axis) => 2 + AXES + axis.index(),
            Self::Jerk(axis) => 2 + 2 * AXES + axis.index(),
            Self::Tolerance => 2 + 3 * AXES,
            Self::ChordError => 3 + 3 * AXES,
            Self::None => 4 + 3 * AXES,
            Self::JointVelocity(joint) => 5 + 3 * AXES + joint,
            Self::JointAcceleration(joint) => 5 + 3 * AXES + JOINTS + joint,
            Self::JointJerk(joint) => 5 + 3 * AXES + 2 * JOINTS + joint,
        }
    }
}

impl fmt::Display for Binding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Rest => write!(f, "rest"),
            Self::Feed => write!(f, "feed"),
            Self::Velocity(axis) => write!(f, "velocity {axis}"),
            Self::Acceleration(axis) => write!(f, "acceleration {axis}"),
            Self::Jerk(axis) => write!(f, "jerk {axis}"),
            Self::JointVelocity(joint) => write!(f, "velocity J{joint}"),
            Self::JointAcceleration(joint) => write!(f, "acceleration J{joint}"),
            Self::JointJerk(joint) => write!(f, "jerk J{joint}"),
            Self::Tolerance => write!(f, "tolerance"),
            Self::ChordError => write!(f, "chord error"),
            Self::None => write!(f, "none"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_binding_has_a_number_of_its_own() {
        let numbers: Vec<_> = Binding::all().map(Binding::index).collect();
        assert_eq!(numbers, (0..COUNT).collect::<Vec<_>>());
    }
}
