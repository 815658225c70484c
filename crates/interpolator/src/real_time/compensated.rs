//! The joints whose errors are taken out of where they are told to be: screws that are not even, and play.
//!
//! Everything before the last step of a tick, and everything that people see, is about where joints are to be. What
//! drives are told differs from that by the compensation, and what they report is turned back by it. So whatever
//! moves the machine, by program or by hand, moves it compensated, and nothing jumps where the compensation sets in: a
//! hand-over turns the drives' position into the one that gives just that.
//!
//! **Play** is taken up by a motion of its own on top of that of the joint, from −1 to 1 or back, when the joint
//! has come back by [`TURNED`] from the farthest place of its way. It keeps to its share of the joint's limits, also
//! where the joint turns round again before it has ended. On which of its sides a joint stands after a hand-over nobody
//! knows; until its first motion it is taken for the middle.
//!
//! Along frames, which are known ahead, the turn is looked for half the time of the take-up ahead: begun at the turn
//! itself, the take-up leaves twice the error behind it. What is ahead is counted in frames, so that slower
//! program time changes when the take-up is, and not where on the path.

use crate::real_time::track::Track;
use crate::shared::config::Config;
use crate::shared::tracker::{Bounds, Motion, Target, Tracker};
use glidepath_geometry::{AXES, Axis};
use glidepath_kinematics::{JOINTS, JointCompensation, JointMotion, JointVector, Kinematics as _};

/// How far a joint has to come back to have turned round, mm or degrees: more than rounding, less than anybody
/// measures. What a shorter way back leaves, and what tables are off by between their points, are a micrometre together.
const TURNED: f64 = 0.9e-3;

/// No take-up is looked for further ahead, frames: beyond what is published ahead nothing is known.
const MOST_AHEAD: f64 = 1000.0;

/// The side of its play that a joint is on, and its motion to the other.
#[derive(Debug, Clone, Copy)]
struct Side {
    bounds: Bounds,
    /// The farthest place of the way that it goes.
    farthest: f64,
    /// 1 on the way up, −1 on the way down, 0 before the first.
    way: f64,
    tracker: Tracker,
    /// How many frames ahead a turn is looked for.
    ahead: u64,
}

impl Side {
    fn new([v, a, j]: [f64; 3], farthest: f64, period_t: f64) -> Self {
        let bounds = Bounds { v, a, j };
        let mut whole = Tracker::new(Motion::at(-1.0));
        whole.aim(Target::Rest(1.0), bounds);
        Self {
            bounds,
            ahead: half_in_periods(whole.duration_t(), period_t),
            farthest,
            way: 0.0,
            tracker: Tracker::new(Motion::at(0.0)),
        }
    }

    /// Nobody knows on which side it is, and it stands there.
    fn forget(&mut self, q: f64) {
        (self.farthest, self.way) = (q, 0.0);
        self.tracker = Tracker::new(Motion::at(0.0));
    }

    /// A period. `q` is where the joint is, or will be some frames ahead.
    fn step(&mut self, q: f64, period_t: f64) -> Motion {
        let beyond = q - self.farthest;
        if beyond * self.way >= 0.0 && self.way != 0.0 {
            self.farthest = q;
        } else if beyond.abs() > TURNED {
            self.farthest = q;
            self.way = 1.0_f64.copysign(beyond);
            self.tracker.aim(Target::Rest(self.way), self.bounds);
        }
        if self.is_at_rest() {
            Motion::at(self.tracker.now().x)
        } else {
            self.tracker.advance(period_t)
        }
    }

    fn is_at_rest(&self) -> bool {
        self.tracker.has_arrived()
    }
}

/// One joint with a compensation.
#[derive(Debug, Clone, Copy)]
struct Compensated {
    joint: usize,
    axis: Option<Axis>,
    by: &'static JointCompensation,
    side: Option<Side>,
    /// How far its axis will be from here some frames ahead.
    ahead: f64,
}

impl Compensated {
    fn now(&self) -> f64 {
        self.side.map_or(0.0, |side| side.tracker.now().x)
    }
}

/// The joints with a compensation; none on most machines.
#[derive(Debug)]
pub(crate) struct CompensatedJoints {
    joints: heapless::Vec<Compensated, JOINTS>,
    period_t: f64,
}

impl CompensatedJoints {
    pub(crate) fn new(config: &Config) -> Self {
        let axes = config.axis_of_joint().unwrap_or_default();
        let start = config.mechanism.inverse(&config.start_position);
        let start = start.unwrap_or_else(|_| JointVector::zeros());
        let start = |axis: Option<Axis>| {
            let first = axes.iter().position(|of| of.is_some() && *of == axis);
            first
                .and_then(|first| start.get(first))
                .copied()
                .unwrap_or(0.0)
        };
        let of_joint = |joint: usize, by: &'static JointCompensation| Compensated {
            joint,
            axis: axes.get(joint).copied().flatten(),
            by,
            ahead: 0.0,
            side: by.has_play().then(|| {
                Side::new(
                    by.side_limits(),
                    start(axes.get(joint).copied().flatten()),
                    config.period_t(),
                )
            }),
        };
        let all = config.compensation.iter().enumerate();
        Self {
            joints: all
                .filter_map(|(joint, by)| Some(of_joint(joint, (*by)?)))
                .collect(),
            period_t: config.period_t(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.joints.is_empty()
    }

    /// Looks ahead along the frames of a program for where joints turn round. Until the next setpoint.
    pub(crate) fn look_ahead(&mut self, track: &Track, sequence: u64, position: &[f64; AXES]) {
        for joint in &mut self.joints {
            let (Some(side), Some(axis)) = (&joint.side, joint.axis) else {
                continue;
            };
            let frame = track
                .frame(sequence + side.ahead)
                .or_else(|| track.newest());
            let at = |position: &[f64; AXES]| position.get(axis.index()).copied().unwrap_or(0.0);
            joint.ahead = frame.map_or(0.0, |frame| at(&frame.position) - at(position));
        }
    }

    /// Turns where joints are to be into what their drives are told, in the machine's count. One period of the
    /// take-up goes by.
    pub(crate) fn compensate(&mut self, motion: &mut JointMotion) {
        for joint in &mut self.joints {
            let Some([q, v, a]) = rates(motion, joint.joint) else {
                continue;
            };
            let ahead = q + core::mem::take(&mut joint.ahead);
            let side = match &mut joint.side {
                Some(side) => side.step(ahead, self.period_t),
                None => Motion::default(),
            };
            let told = joint
                .by
                .compensated_rates([q, v, a], [side.x, side.v, side.a]);
            set_rates(motion, joint.joint, told);
        }
    }

    /// Turns what joints are told that are moved each for itself into where they are, at the present sides.
    pub(crate) fn restore(&self, motion: &mut JointMotion) {
        for joint in &self.joints {
            let Some([m, m_v, m_a]) = rates(motion, joint.joint) else {
                continue;
            };
            let side = joint.now();
            let q = joint.by.nominal(m, side);
            let [v, a] = joint.by.nominal_rates(q, [m_v, m_a], side);
            set_rates(motion, joint.joint, [q, v, a]);
        }
    }

    /// The place of a joint in the machine's count as its drive is told it, at its present side; it stands there.
    pub(crate) fn stand(&mut self, joints: &mut JointVector) {
        for joint in &mut self.joints {
            let now = joint.now();
            let Some(place) = joints.get_mut(joint.joint) else {
                continue;
            };
            if let Some(side) = &mut joint.side {
                side.farthest = *place;
            }
            *place = joint.by.compensated(*place, now);
        }
    }

    /// The position is taken over: on which side of their play joints stand is not known. Writes where they are.
    pub(crate) fn take_over(&mut self, joints: &mut JointVector) {
        for joint in &mut self.joints {
            let now = joint.now();
            let Some(place) = joints.get_mut(joint.joint) else {
                continue;
            };
            if let Some(side) = &mut joint.side {
                *place = joint.by.nominal(joint.by.compensated(*place, now), 0.0);
                side.forget(*place);
            }
        }
    }

    /// Whether no play is being taken up.
    pub(crate) fn rest(&self) -> bool {
        let mut sides = self.joints.iter().filter_map(|joint| joint.side.as_ref());
        sides.all(Side::is_at_rest)
    }

    /// Writes the present sides.
    pub(crate) fn write_sides(&self, sides: &mut JointVector) {
        for joint in &self.joints {
            if let Some(slot) = sides.get_mut(joint.joint) {
                *slot = joint.now();
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "some tens of periods, and never below 0"
)]
fn half_in_periods(whole_t: f64, period_t: f64) -> u64 {
    (0.5 * whole_t / period_t).round().min(MOST_AHEAD) as u64
}

fn rates(motion: &JointMotion, joint: usize) -> Option<[f64; 3]> {
    Some([
        *motion.position.get(joint)?,
        *motion.velocity.get(joint)?,
        *motion.acceleration.get(joint)?,
    ])
}

fn set_rates(motion: &mut JointMotion, joint: usize, [x, v, a]: [f64; 3]) {
    let slots = [
        motion.position.get_mut(joint),
        motion.velocity.get_mut(joint),
        motion.acceleration.get_mut(joint),
    ];
    for (slot, value) in slots.into_iter().zip([x, v, a]) {
        if let Some(slot) = slot {
            *slot = value;
        }
    }
}
