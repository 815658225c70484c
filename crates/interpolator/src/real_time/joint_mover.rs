//! The mover of joints each for itself: the real-time thread's side of homing.

use crate::shared::config::Config;
use crate::shared::message::joints_order::{JointsOrder, Moved};
use crate::shared::tracker::{Bounds, Motion, Target, Tracker};
use glidepath_kinematics::{JOINTS, JointMotion, JointVector};

/// Share of its limits that a compensated joint uses on its way home: what is moved here is its drive, and its axis, which
/// may be a hundredth faster, keeps the limits of axes.
const COMPENSATED: f64 = 0.95;

/// What moves the joints, each for itself.
#[derive(Debug)]
pub(crate) struct JointMover {
    bounds: [Bounds; JOINTS],
    trackers: [Tracker; JOINTS],
    is_active: bool,
    /// The joints are given back once they are at rest.
    ends: bool,
    number: u64,
    /// The joints whose drives are to keep where their next index pulse is.
    index: u32,
    period_t: f64,
}

impl JointMover {
    pub(crate) fn new(config: &Config) -> Self {
        Self {
            bounds: bounds(config),
            trackers: [Tracker::new(Motion::at(0.0)); JOINTS],
            is_active: false,
            ends: false,
            number: 0,
            index: 0,
            period_t: config.period_t(),
        }
    }

    /// Whether the setpoints are the mover's.
    pub(crate) const fn is_active(&self) -> bool {
        self.is_active
    }

    /// Carries out an order. `stands` are the joints as they stand, if they do and are nobody
    /// else's.
    pub(crate) fn take(&mut self, order: &JointsOrder, stands: Option<&JointVector>) {
        if order.begins
            && let Some(joints) = stands.filter(|_| !self.is_active)
        {
            for (tracker, place) in self.trackers.iter_mut().zip(joints) {
                *tracker = Tracker::new(Motion::at(*place));
            }
            (self.is_active, self.ends) = (true, false);
        }
        if !self.is_active || self.ends {
            return;
        }
        self.number = order.number;
        self.ends |= order.ends;
        self.index = if self.ends { 0 } else { order.index };
        let joints = self.trackers.iter_mut().zip(&self.bounds);
        let aims = order.place.iter().zip(&order.v);
        for (joint, ((tracker, bounds), (place, v))) in joints.zip(aims).enumerate() {
            if order.stop & (1 << joint) != 0 {
                brake(tracker, bounds);
            } else if order.go & (1 << joint) != 0 {
                tracker.aim(Target::Rest(*place), bounds.with_speed(v.min(bounds.v)));
            }
        }
    }

    /// All joints come to rest, and are given back.
    pub(crate) fn cancel(&mut self) {
        if !self.is_active {
            return;
        }
        (self.ends, self.index) = (true, 0);
        for (tracker, bounds) in self.trackers.iter_mut().zip(&self.bounds) {
            brake(tracker, bounds);
        }
    }

    /// The drives have lost their power: there is nothing to move.
    pub(crate) const fn end(&mut self) {
        (self.is_active, self.index) = (false, 0);
    }

    /// The joints whose drives are to keep where their next index pulse is, one bit each.
    pub(crate) const fn index(&self) -> u32 {
        self.index
    }

    /// One period of the motion.
    pub(crate) fn step(&mut self) -> JointMotion {
        let mut motion = JointMotion {
            position: JointVector::zeros(),
            velocity: JointVector::zeros(),
            acceleration: JointVector::zeros(),
        };
        let slots = motion
            .position
            .iter_mut()
            .zip(motion.velocity.iter_mut())
            .zip(motion.acceleration.iter_mut());
        for (tracker, ((x, v), a)) in self.trackers.iter_mut().zip(slots) {
            let now = if is_at_rest(tracker) {
                tracker.now()
            } else {
                tracker.advance(self.period_t)
            };
            (*x, *v, *a) = (now.x, now.v, now.a);
        }
        if self.ends && self.trackers.iter().all(is_at_rest) {
            self.is_active = false;
        }
        motion
    }

    /// What became of the orders.
    pub(crate) fn moved(&self) -> Moved {
        if !self.is_active {
            return Moved {
                number: self.number,
                ..Moved::default()
            };
        }
        let resting = self.trackers.iter().enumerate();
        Moved {
            is_active: self.is_active,
            number: self.number,
            rests: resting
                .filter(|(_, tracker)| is_at_rest(tracker))
                .fold(0, |mask, (joint, _)| mask | 1 << joint),
        }
    }
}

fn brake(tracker: &mut Tracker, bounds: &Bounds) {
    // One that stands may be one that the machine does not have, without limits.
    if !is_at_rest(tracker) {
        tracker.aim(Target::Speed(0.0), *bounds);
    }
}

fn bounds(config: &Config) -> [Bounds; JOINTS] {
    let mut bounds = config.joint_bounds().map(|bounds| Bounds {
        v: bounds.velocity,
        a: bounds.acceleration,
        j: bounds.jerk,
    });
    let is_crossed = config.mechanism.cross().is_some();
    let compensated = bounds.iter_mut().zip(&config.compensation);
    for (bounds, _) in compensated.filter(|(_, made)| is_crossed || made.is_some()) {
        for limit in [&mut bounds.v, &mut bounds.a, &mut bounds.j] {
            *limit *= COMPENSATED;
        }
    }
    bounds
}

fn is_at_rest(tracker: &Tracker) -> bool {
    let now = tracker.now();
    tracker.has_arrived() && now.v == 0.0 && now.a == 0.0
}
