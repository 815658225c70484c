//! The share of each joint's limits that a period uses, by finite differences of the positions, where joints are not the
//! axes.

use crate::joints::{JOINTS, JointBounds};

/// Follows the positions of joints.
#[derive(Debug)]
pub(super) struct JointDifferences {
    /// Largest differences of first, second and third order, of each joint.
    most: Vec<[f64; 3]>,
    position: [f64; JOINTS],
    /// Those of the last period.
    differences: [[f64; JOINTS]; 3],
    has_position: bool,
}

impl JointDifferences {
    /// Joints beyond the most that a machine has are left out.
    pub(super) fn new(bounds: &[JointBounds], period_t: f64) -> Self {
        let of_joint = |bounds: &JointBounds| {
            let [velocity, acceleration, jerk] = bounds.rates;
            [
                velocity * period_t,
                acceleration * period_t.powi(2),
                jerk * period_t.powi(3),
            ]
        };
        Self {
            most: bounds.iter().take(JOINTS).map(of_joint).collect(),
            position: [0.0; JOINTS],
            differences: [[0.0; JOINTS]; 3],
            has_position: false,
        }
    }

    /// The positions at the next frame; before the first the machine was at rest there.
    pub(super) fn next(&mut self, positions: &[f64]) {
        let joints = self.most.len();
        for (joint, position) in positions.iter().enumerate().take(joints) {
            if !self.has_position {
                self.position[joint] = *position;
            }
            let [first, second, third] = &mut self.differences;
            let now = position - self.position[joint];
            let bent = now - first[joint];
            third[joint] = bent - second[joint];
            (first[joint], second[joint]) = (now, bent);
            self.position[joint] = *position;
        }
        self.has_position = true;
    }

    /// At rest where it is: how it came there does not count.
    pub(super) fn rest(&mut self) {
        self.differences = [[0.0; JOINTS]; 3];
    }

    /// The joint that uses most of its velocity, acceleration and jerk in the period, and what share.
    pub(super) fn ratios(&self) -> [Option<(usize, f64)>; 3] {
        core::array::from_fn(|order| {
            let shares = self.most.iter().enumerate();
            shares
                .map(|(joint, most)| (joint, self.differences[order][joint].abs() / most[order]))
                .reduce(|a, b| if b.1 > a.1 { b } else { a })
        })
    }
}
