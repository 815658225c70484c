//! The compensation of a joint: the errors of its screw and its play, taken out of where it is told to be.
//!
//! ```text
//! m = q + c(q) + d·h(q)      q: where the joint is to be     m: what its drive is told
//!                            c: correction, mean of both ways  h: half of what both ways differ by
//!                            d: from −1 (play taken up downwards) to 1 (upwards)
//! ```
//!
//! Corrections are natural cubic [splines](spline) through what was measured. Play is half of h; the other half is
//! what the two directions of a table differ by. Who moves the joint turns d from one side to the other when the
//! joint turns round, inside the [share](TAKE_UP) of each limit that is kept for it.
//!
//! **The limits hold for what the drive is told.** By the chain rule m has more velocity, acceleration and jerk than
//! q, by the largest derivatives of c and h and by the share of the take-up. What is [left](JointCompensation::left)
//! is what q may do; a plan inside of it keeps the drive inside its own limits, whatever the plan is.

mod spline;
mod table;

use crate::JointLimit;
pub(crate) use spline::Spline;
pub use table::{CompensationError, CompensationPoint, MOST_POINTS};
pub(crate) use table::{STEEPEST, ascends};

/// Share of the velocity, acceleration and jerk of a joint with play that taking it up may use. A play of b takes
/// 4 ∛(b / 2j): of the three only jerk costs time. A quarter of it takes 55 ms for 50 µm on a mill of 40 m/s³.
pub const TAKE_UP: [f64; 3] = [0.03, 0.1, 0.25];
/// Less than this of a limit is no limit to plan with: the table is rough, or its points are too near each other.
pub(crate) const LEAST_LEFT: f64 = 0.2;
/// What two ways may differ by the wrong way round, mm or degrees: what a gauge is off.
const GAUGE: f64 = 2e-3;
/// A little of each limit, for the rounding of positions and their differences.
pub(crate) const SPARE: f64 = 1e-4;
/// Newton's steps from m to q: each squares the error, and the first guess is off by a hundredth at most.
const STEPS: usize = 4;

/// The compensation of one joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointCompensation {
    /// What is added whichever way the joint goes.
    mean: Spline,
    /// What is added on the way up and taken away on the way down.
    half: Spline,
    /// At least the largest amount of that inside the table.
    most_half: f64,
    /// What its drive can do.
    drive: JointLimit,
    /// What the joint may do, so that its drive keeps to that.
    left: JointLimit,
}

impl JointCompensation {
    /// The compensation by a table, which may be empty, and a play (mm or degrees, ≥ 0), for a drive with limits.
    ///
    /// # Errors
    /// The table is none, or it leaves too little of a limit.
    pub fn new(
        points: &[CompensationPoint],
        backlash: f64,
        drive: &JointLimit,
    ) -> Result<Self, CompensationError> {
        if points.len() == 1 || points.len() > MOST_POINTS {
            return Err(CompensationError::Points(points.len()));
        }
        ascends(points.iter().map(|at| at.position))?;
        let of = |value: &dyn Fn(&CompensationPoint) -> f64| {
            let points: Vec<_> = points.iter().map(|at| (at.position, value(at))).collect();
            points
        };
        let mean = of(&|at| f64::midpoint(at.up, at.down));
        let mut half = of(&|at| 0.5 * (at.up - at.down) + 0.5 * backlash);
        if half.is_empty() && backlash > 0.0 {
            half = vec![(0.0, 0.5 * backlash), (1.0, 0.5 * backlash)];
        }
        // Play makes the way up longer; what is measured without any differs by the gauge.
        if let Some((at, _)) = half.iter().find(|(_, half)| *half < -GAUGE) {
            return Err(CompensationError::Exchanged(*at));
        }
        let half = Spline::through(&half);
        let mut it = Self {
            mean: Spline::through(&mean),
            most_half: half.bound(),
            half,
            drive: *drive,
            left: *drive,
        };
        let steepest = it.steepness()[0];
        if steepest > STEEPEST {
            return Err(CompensationError::TooSteep(steepest));
        }
        it.left = it.judge()?;
        Ok(it)
    }

    /// What its drive can do.
    #[must_use]
    pub const fn drive(&self) -> &JointLimit {
        &self.drive
    }

    /// What the joint may do so that its drive keeps its limits, whatever the motion and the take-up.
    #[must_use]
    pub const fn left(&self) -> &JointLimit {
        &self.left
    }

    /// Whether the two ways differ.
    #[must_use]
    pub const fn has_play(&self) -> bool {
        self.most_half > 0.0
    }

    /// How fast d may change, by s, s² and s³, so that the take-up keeps to its share of the joint's limits.
    #[must_use]
    pub fn side_limits(&self) -> [f64; 3] {
        let of_joint = [
            self.drive.velocity,
            self.drive.acceleration,
            self.drive.jerk,
        ];
        core::array::from_fn(|k| TAKE_UP[k] * of_joint[k] / self.most_half)
    }

    /// What the drive is told for a place of the joint, and a side.
    #[must_use]
    pub fn compensated(&self, q: f64, side: f64) -> f64 {
        q + self.mean.at(q).value + side * self.half.at(q).value
    }

    /// Position, velocity and acceleration of the drive for those of the joint, and of the side.
    #[must_use]
    pub fn compensated_rates(&self, [q, v, a]: [f64; 3], [d, d_v, d_a]: [f64; 3]) -> [f64; 3] {
        let (mean, half) = (self.mean.at(q), self.half.at(q));
        let slope = 1.0 + mean.first + d * half.first;
        [
            q + mean.value + d * half.value,
            slope * v + d_v * half.value,
            slope * a
                + (mean.second + d * half.second) * v * v
                + 2.0 * d_v * half.first * v
                + d_a * half.value,
        ]
    }

    /// Where the joint is when its drive says that it is at m.
    #[must_use]
    pub fn nominal(&self, m: f64, side: f64) -> f64 {
        let mut q = m;
        for _ in 0..STEPS {
            let (mean, half) = (self.mean.at(q), self.half.at(q));
            let beyond = q + mean.value + side * half.value - m;
            q -= beyond / (1.0 + mean.first + side * half.first);
        }
        q
    }

    /// Velocity and acceleration of the joint for those of its drive, at rest of the side.
    #[must_use]
    pub fn nominal_rates(&self, q: f64, [v, a]: [f64; 2], side: f64) -> [f64; 2] {
        let (mean, half) = (self.mean.at(q), self.half.at(q));
        let slope = 1.0 + mean.first + side * half.first;
        let own_v = v / slope;
        [
            own_v,
            (a - (mean.second + side * half.second) * own_v * own_v) / slope,
        ]
    }

    /// The derivation is in the module's text: m′ = (1 + c′ + d h′) q′ + d′ h, and so on twice more, with every term at
    /// its largest amount.
    fn judge(&self) -> Result<JointLimit, CompensationError> {
        let drive = &self.drive;
        let [s1, s2, s3] = self.steepness();
        let share = if self.has_play() { TAKE_UP } else { [0.0; 3] };
        let of_half = self.half.most().map(|most| {
            if self.has_play() {
                most / self.most_half
            } else {
                0.0
            }
        });
        let [taken_v, taken_a, taken_j] = [
            share[0] * drive.velocity,
            share[1] * drive.acceleration,
            share[2] * drive.jerk,
        ];
        let [h1, h2, _] = of_half;
        let all = 1.0 - SPARE;
        let v = (all * drive.velocity - taken_v) / (1.0 + s1);
        let bent_a = s2 * v * v + 2.0 * h1 * taken_v * v;
        let a = (all * drive.acceleration - taken_a - bent_a) / (1.0 + s1);
        let bent_j = 3.0 * s2 * v * a
            + s3 * v * v * v
            + 3.0 * taken_v * (h2 * v * v + h1 * a)
            + 3.0 * taken_a * h1 * v;
        let j = (all * drive.jerk - taken_j - bent_j) / (1.0 + s1);
        for (quantity, left, of) in [
            ("velocity", v, drive.velocity),
            ("acceleration", a, drive.acceleration),
            ("jerk", j, drive.jerk),
        ] {
            if left < LEAST_LEFT * of {
                let left_percent = 100.0 * left.max(0.0) / of;
                return Err(CompensationError::TooRough {
                    quantity,
                    left_percent,
                });
            }
        }
        Ok(JointLimit {
            velocity: v,
            acceleration: a,
            jerk: j,
            ..*drive
        })
    }

    /// The largest first, second and third derivative of what is added, on either side.
    fn steepness(&self) -> [f64; 3] {
        let (mean, half) = (self.mean.most(), self.half.most());
        core::array::from_fn(|k| mean[k] + half[k])
    }
}

#[cfg(test)]
mod tests;
