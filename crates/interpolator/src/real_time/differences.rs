//! The limits on finite differences of the published positions: what a drive sees. Of joints that are not the
//! axes, too.
//!
//! With positions x one period T apart, every axis obeys |Δx| ≤ V·T, |Δ²x| ≤ A·T², |Δ³x| ≤ J·T³.
//! The differences are averages of the derivatives of any motion through the positions, so a motion
//! inside its limits is inside these.

use crate::real_time::pairs::{self, PAIRS, Pair, larger, smaller, sub};
use crate::real_time::quintic::Quintic;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::JointVector;
use glidepath_program::Limits;

/// Share of a limit that may be lost to rounding; half of what an audit allows.
const ALLOWANCE: f64 = 5e-7;
/// Rounding of a third difference of positions of up to a metre, mm.
const ROUNDING: f64 = 1e-12;

/// The limits on one, two and three differences, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Allowed {
    axes: AllowedPairs,
    /// Those of joints that are not the axes; of no pair where they are.
    joints: AllowedPairs,
}

#[derive(Debug, Clone, Copy)]
struct AllowedPairs {
    pairs: [[Pair; 3]; PAIRS],
    /// Pairs with limits. The others are not looked at.
    used: usize,
}

impl Allowed {
    /// The limits of axes, and those of joints that are not these.
    pub(crate) fn new(axes: &Limits, joints: Option<&Limits>, period_t: f64) -> Self {
        Self {
            axes: AllowedPairs::new(axes, period_t),
            joints: joints.map_or(AllowedPairs::NONE, |joints| {
                AllowedPairs::new(joints, period_t)
            }),
        }
    }
}

impl AllowedPairs {
    const NONE: Self = Self {
        pairs: [[[f64::INFINITY; 2]; 3]; PAIRS],
        used: 0,
    };

    fn new(limits: &Limits, period_t: f64) -> Self {
        let t = period_t;
        let raw = [
            limits.velocity * t,
            limits.acceleration * (t * t),
            limits.jerk * (t * t * t),
        ];
        let raw = raw.map(|limit| limit * (1.0 + ALLOWANCE) + AxisVector::repeat(ROUNDING));
        let mut all = Self::NONE.pairs;
        for (k, limit) in raw.iter().enumerate() {
            for (slots, pair) in all.iter_mut().zip(pairs::pairs(limit.as_slice())) {
                if let Some(slot) = slots.get_mut(k) {
                    *slot = pair;
                }
            }
        }
        Self {
            pairs: all,
            used: pairs::in_use(limits),
        }
    }

    fn used(&self) -> &[[Pair; 3]] {
        self.pairs.get(..self.used).unwrap_or(&self.pairs)
    }
}

/// The last published position of a pair of axes and its differences.
#[derive(Debug, Clone, Copy)]
struct Past {
    position: Pair,
    first: Pair,
    second: Pair,
}

impl Past {
    /// Adds one more position. What is inside keeps its 1, what is not gets 0.
    fn append(&mut self, position: Pair, most: &[Pair; 3], inside: Pair) -> Pair {
        let [velocity, acceleration, jerk] = *most;
        let first = sub(position, self.position);
        let second = sub(first, self.first);
        let third = sub(second, self.second);
        *self = Self {
            position,
            first,
            second,
        };
        let mut inside = inside;
        for i in 0..2 {
            // Not one after the other: that would be a branch for each.
            let is_inside = (first[i].abs() <= velocity[i])
                & (second[i].abs() <= acceleration[i])
                & (third[i].abs() <= jerk[i]);
            inside[i] = if is_inside { inside[i] } else { 0.0 };
        }
        inside
    }
}

const INSIDE: Pair = [1.0; 2];

/// Where the axes are, and the joints that are not these; zero without such joints.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MachinePosition {
    pub(crate) axes: AxisVector,
    pub(crate) joints: JointVector,
}

/// The last published position and its differences.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Differences {
    axes: [Past; PAIRS],
    /// Of joints that are not the axes.
    joints: [Past; PAIRS],
}

impl Differences {
    /// At rest at zero.
    pub(crate) const NONE: Self = {
        let none = [Past {
            position: [0.0; 2],
            first: [0.0; 2],
            second: [0.0; 2],
        }; PAIRS];
        Self {
            axes: none,
            joints: none,
        }
    };

    /// At rest for ever.
    pub(crate) fn at_rest(place: &MachinePosition) -> Self {
        let mut still = Self::NONE;
        let all = [
            (&mut still.axes, &place.axes),
            (&mut still.joints, &place.joints),
        ];
        for (pasts, position) in all {
            for (past, position) in pasts.iter_mut().zip(pairs::pairs(position.as_slice())) {
                past.position = position;
            }
        }
        still
    }

    pub(crate) fn position(&self) -> AxisVector {
        pairs::axes(&self.axes.map(|past| past.position))
    }

    pub(crate) fn place(&self) -> MachinePosition {
        MachinePosition {
            axes: self.position(),
            joints: pairs::axes(&self.joints.map(|past| past.position)),
        }
    }

    /// Whether the last three positions are the same.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.axes.iter().all(|past| {
            let moves = pairs::zip(past.first, past.second, |one, other| {
                larger(one.abs(), other.abs())
            });
            moves.iter().all(|d| *d <= ROUNDING)
        })
    }

    /// Adds one more position, wherever it is.
    pub(crate) fn go_to(&mut self, position: &AxisVector) {
        go_to(&mut self.axes, position);
    }

    /// The same of joints that are not the axes.
    pub(crate) fn joints_go_to(&mut self, joints: &JointVector) {
        go_to(&mut self.joints, joints);
    }

    /// Whether one more position is within the limits.
    pub(crate) fn allows(&self, position: &AxisVector, allowed: &Allowed) -> bool {
        let positions = pairs::pairs(position.as_slice());
        let mut inside = INSIDE;
        for ((past, position), most) in self.axes.iter().zip(positions).zip(allowed.axes.used()) {
            inside = { *past }.append(position, most, inside);
        }
        inside == INSIDE
    }

    /// The same of joints that are not the axes.
    pub(crate) fn allows_joints(&self, joints: &JointVector, allowed: &Allowed) -> bool {
        let mut pasts = self.joints;
        append(&mut pasts, joints, &allowed.joints)
    }

    /// Adds one more position; returns whether it is within the limits. Of axes without limits
    /// nothing is kept.
    pub(crate) fn append(&mut self, position: &AxisVector, allowed: &Allowed) -> bool {
        append(&mut self.axes, position, &allowed.axes)
    }

    /// The same of joints that are not the axes.
    pub(crate) fn append_joints(&mut self, joints: &JointVector, allowed: &Allowed) -> bool {
        append(&mut self.joints, joints, &allowed.joints)
    }

    /// Appends a position between two frames: most of the work of a tick that looks for a stop.
    pub(crate) fn append_at(&mut self, quintic: &Quintic, u: f64, allowed: &Allowed) -> bool {
        append_at(&mut self.axes, quintic, u, &allowed.axes)
    }

    /// The same of joints that are not the axes.
    pub(crate) fn append_joints_at(
        &mut self,
        quintic: &Quintic,
        u: f64,
        allowed: &Allowed,
    ) -> bool {
        append_at(&mut self.joints, quintic, u, &allowed.joints)
    }

    /// From where to where the next position may be moved until a limit is reached, from one
    /// between two frames along the velocity there, in parts of that. Exact where the motion is
    /// straight.
    pub(crate) fn room(&self, quintic: &Quintic, u: f64, allowed: &Allowed) -> (f64, f64) {
        room(&self.axes, quintic, u, &allowed.axes)
    }

    /// The same of joints that are not the axes.
    pub(crate) fn joint_room(&self, quintic: &Quintic, u: f64, allowed: &Allowed) -> (f64, f64) {
        room(&self.joints, quintic, u, &allowed.joints)
    }

    /// Largest ratio to any limit one more position would have; not a number if one is none.
    #[cold]
    pub(crate) fn ratio(&self, position: &AxisVector, allowed: &Allowed) -> f64 {
        ratio(&self.axes, position, &allowed.axes)
    }

    /// The same of joints that are not the axes.
    #[cold]
    pub(crate) fn joint_ratio(&self, joints: &JointVector, allowed: &Allowed) -> f64 {
        ratio(&self.joints, joints, &allowed.joints)
    }
}

fn go_to(pasts: &mut [Past; PAIRS], position: &AxisVector) {
    for (past, position) in pasts.iter_mut().zip(pairs::pairs(position.as_slice())) {
        let first = sub(position, past.position);
        *past = Past {
            position,
            first,
            second: sub(first, past.first),
        };
    }
}

fn append(pasts: &mut [Past; PAIRS], position: &AxisVector, allowed: &AllowedPairs) -> bool {
    let positions = pairs::pairs(position.as_slice());
    let mut inside = INSIDE;
    for ((past, position), most) in pasts.iter_mut().zip(positions).zip(allowed.used()) {
        inside = past.append(position, most, inside);
    }
    inside == INSIDE
}

#[inline]
fn append_at(pasts: &mut [Past; PAIRS], quintic: &Quintic, u: f64, allowed: &AllowedPairs) -> bool {
    let mut inside = INSIDE;
    for ((past, pair), most) in pasts.iter_mut().zip(quintic.pairs()).zip(allowed.used()) {
        inside = past.append(pair.position(u), most, inside);
    }
    inside == INSIDE
}

#[inline]
fn room(pasts: &[Past; PAIRS], quintic: &Quintic, u: f64, allowed: &AllowedPairs) -> (f64, f64) {
    let (mut low, mut high) = ([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
    for ((past, pair), most) in pasts.iter().zip(quintic.pairs()).zip(allowed.used()) {
        let (position, velocity) = pair.motion(u);
        let first = sub(position, past.position);
        let second = sub(first, past.first);
        let third = sub(second, past.second);
        let scale = pairs::map(velocity, |v| v.abs().recip());
        for (difference, most) in [first, second, third].into_iter().zip(*most) {
            // What the differences are along the velocity v: −most ≤ d + x·v ≤ most is an interval of x, whose
            // ends are (∓most − d)/v, exchanged where v is below zero. With |v| and d's part along v no case is
            // left. An axis that stands is not limited by it.
            let along = pairs::zip(difference, velocity, |d, v| d.copysign(d * v));
            let lowest = pairs::zip(most, along, |most, along| -most - along);
            let highest = sub(most, along);
            low = pairs::zip(pairs::zip(lowest, scale, |l, s| l * s), low, larger);
            high = pairs::zip(pairs::zip(highest, scale, |h, s| h * s), high, smaller);
        }
    }
    let ([low, other_low], [high, other_high]) = (low, high);
    (larger(low, other_low), smaller(high, other_high))
}

fn ratio(pasts: &[Past; PAIRS], position: &AxisVector, allowed: &AllowedPairs) -> f64 {
    let positions = pairs::pairs(position.as_slice());
    let mut most_ratio = [0.0_f64; 2];
    for ((past, position), most) in pasts.iter().zip(positions).zip(allowed.used()) {
        let first = sub(position, past.position);
        let second = sub(first, past.first);
        let third = sub(second, past.second);
        for (difference, most) in [first, second, third].into_iter().zip(*most) {
            // The last axis has a neighbour that does not exist: 0 of 0 is nothing.
            let ratio = pairs::zip(difference, most, |d, most| {
                if d == 0.0 { 0.0 } else { d.abs() / most }
            });
            most_ratio = pairs::zip(ratio, most_ratio, |ratio, most| {
                if ratio <= most || most.is_nan() {
                    most
                } else {
                    ratio
                }
            });
        }
    }
    let [one, other] = most_ratio;
    if one <= other || other.is_nan() {
        other
    } else {
        one
    }
}
