//! The demands of the joints, kept for as long as feedback may be on its way.

use glidepath_kinematics::JOINTS;
use glidepath_link::Setpoint;
use glidepath_link::servo::{JointState, quintic};

/// Setpoints that are kept: a quarter of a second at 4 ms.
const KEPT: usize = 64;

#[derive(Debug, Clone, Copy)]
struct Demand {
    apply_ns: u64,
    joints: [JointState; JOINTS],
}

/// The demands of the last setpoints, of one reference.
#[derive(Debug)]
pub(super) struct Demands {
    kept: Vec<Demand>,
    /// Where the next one goes.
    next: usize,
    reference: u64,
    since_ns: u64,
}

impl Demands {
    pub(super) fn new() -> Self {
        Self {
            kept: Vec::with_capacity(KEPT),
            next: 0,
            reference: 0,
            since_ns: 0,
        }
    }

    /// Keeps a setpoint. One of a new reference says nothing about those before.
    pub(super) fn push(&mut self, setpoint: &Setpoint) {
        if setpoint.reference != self.reference {
            self.kept.clear();
            self.next = 0;
            (self.reference, self.since_ns) = (setpoint.reference, setpoint.apply_ns);
        }
        let mut joints = [JointState::default(); JOINTS];
        for (joint, state) in joints.iter_mut().enumerate() {
            *state = JointState {
                position: setpoint.joint_position[joint],
                velocity: setpoint.joint_velocity[joint],
                acceleration: setpoint.joint_acceleration[joint],
            };
        }
        let demand = Demand {
            apply_ns: setpoint.apply_ns,
            joints,
        };
        if self.kept.len() < KEPT {
            self.kept.push(demand);
        } else if let Some(place) = self.kept.get_mut(self.next) {
            *place = demand;
        }
        self.next = (self.next + 1) % KEPT;
    }

    /// Since when the demands continue each other, ns.
    pub(super) const fn since_ns(&self) -> u64 {
        self.since_ns
    }

    /// What a joint was to do at a time; `None` before the first and after the last setpoint.
    #[allow(
        clippy::cast_precision_loss,
        reason = "differences of a few periods are exact"
    )]
    pub(super) fn at(&self, joint: usize, time_ns: u64) -> Option<JointState> {
        let before = |demand: &&Demand| demand.apply_ns <= time_ns;
        let from = self.kept.iter().filter(before).max_by_key(|d| d.apply_ns)?;
        let after = |demand: &&Demand| demand.apply_ns > time_ns;
        let to = self.kept.iter().filter(after).min_by_key(|d| d.apply_ns);
        let state = |demand: &Demand| demand.joints.get(joint).copied();
        let Some(to) = to else {
            return (from.apply_ns == time_ns).then(|| state(from)).flatten();
        };
        let seconds = |ns: u64| ns as f64 * 1e-9;
        Some(quintic(
            &state(from)?,
            &state(to)?,
            seconds(to.apply_ns - from.apply_ns),
            seconds(time_ns - from.apply_ns),
        ))
    }
}
