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

use crate::JointLimit;
use spline::Spline;

/// Share of the velocity, acceleration and jerk of a joint with play that taking it up may use. A play of b takes
/// 4 ∛(b / 2j): of the three only jerk costs time. A quarter of it takes 55 ms for 50 µm on a mill of 40 m/s³.
pub const TAKE_UP: [f64; 3] = [0.03, 0.1, 0.25];
/// The steepest correction, mm by mm: more is no error of a screw but a wrong scale or a wrong unit.
const STEEPEST: f64 = 0.01;
/// The most points of a table.
pub const MOST_POINTS: usize = 256;
/// Less than this of a limit is no limit to plan with: the table is rough, or its points are too near each other.
const LEAST_LEFT: f64 = 0.2;
/// What two ways may differ by the wrong way round, mm or degrees: what a gauge is off.
const GAUGE: f64 = 2e-3;
/// A little of each limit, for the rounding of positions and their differences.
const SPARE: f64 = 1e-4;
/// Newton's steps from m to q: each squares the error, and the first guess is off by a hundredth at most.
const STEPS: usize = 4;

/// A measured point of a joint: what is added to where it is to be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompensationPoint {
    /// Where the joint is to be, mm or degrees.
    pub position: f64,
    /// What is added on the way up, mm or degrees.
    pub up: f64,
    /// What is added on the way down.
    pub down: f64,
}

/// What is wrong with the compensation of a joint.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum CompensationError {
    /// A single point is no table.
    #[error("a table has two points at least, and {MOST_POINTS} at most; this one has {0}")]
    Points(usize),
    /// The positions do not ascend.
    #[error("positions ascend; {1} comes behind {0}")]
    Order(f64, f64),
    /// More is added on the way down than on the way up.
    #[error(
        "at {0} more is added on the way down than on the way up: are the two columns exchanged?"
    )]
    Exchanged(f64),
    /// A correction is too steep.
    #[error(
        "the corrections change by {0:.4} mm in a mm at most, and {STEEPEST} are taken: \
         a wrong unit, or measured positions in place of corrections?"
    )]
    TooSteep(f64),
    /// Too little of a limit is left.
    #[error(
        "the corrections leave {left_percent:.0} % of the joint's {quantity} at its highest speed: they are rough, or their points too near each other"
    )]
    TooRough {
        /// The limit.
        quantity: &'static str,
        /// What is left of it, %.
        left_percent: f64,
    },
}

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
        for pair in points.windows(2) {
            if let [one, other] = pair
                && one.position >= other.position
            {
                return Err(CompensationError::Order(one.position, other.position));
            }
        }
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
mod tests {
    #![allow(clippy::unwrap_used, clippy::float_cmp, reason = "a test")]

    use super::*;

    const DRIVE: JointLimit = JointLimit {
        velocity: 200.0,
        acceleration: 2_000.0,
        jerk: 40_000.0,
        ..JointLimit::NONE
    };

    /// A screw measured every 25 mm, both ways.
    fn screw(backlash: f64) -> JointCompensation {
        let points: Vec<_> = (0..13)
            .map(|k| {
                let up = 0.006 * (1.3 * f64::from(k)).sin();
                CompensationPoint {
                    position: 25.0 * f64::from(k),
                    up,
                    down: up - 0.004 + 0.001 * (0.9 * f64::from(k)).cos(),
                }
            })
            .collect();
        JointCompensation::new(&points, backlash, &DRIVE).unwrap()
    }

    #[test]
    fn what_is_meant_is_what_was_told() {
        let screw = screw(0.02);
        for k in -50..350 {
            let q = f64::from(k) + 0.31;
            for side in [-1.0, -0.3, 0.0, 1.0] {
                let m = screw.compensated(q, side);
                assert!((screw.nominal(m, side) - q).abs() < 1e-12, "{q} {side}");
                let [_, m_v, m_a] = screw.compensated_rates([q, 130.0, -900.0], [side, 0.0, 0.0]);
                let [v, a] = screw.nominal_rates(q, [m_v, m_a], side);
                assert!((v - 130.0).abs() < 1e-9 && (a + 900.0).abs() < 1e-7);
            }
        }
    }

    #[test]
    fn a_table_of_zeros_is_none_to_the_bit() {
        let zero = [0.0, 40.0, 90.0].map(|position| CompensationPoint {
            position,
            up: 0.0,
            down: 0.0,
        });
        let none = JointCompensation::new(&zero, 0.0, &DRIVE).unwrap();
        assert!(!none.has_play());
        for q in [-3.7, 0.1, 55.123_456, 1e3] {
            assert_eq!(none.compensated(q, 0.0).to_bits(), q.to_bits());
            assert_eq!(none.nominal(q, 0.0).to_bits(), q.to_bits());
        }
    }

    /// A motion that is driven by jerks from one of its limits to another: each step the jerk that a random bit wants,
    /// if it can still be taken back before the next limit.
    #[derive(Default)]
    struct Driven {
        x: f64,
        v: f64,
        a: f64,
    }

    impl Driven {
        fn step(&mut self, wanted: f64, [v, a, j]: [f64; 3], t: f64) {
            let keeps = |jerk: f64| {
                let next_a = self.a + jerk * t;
                let next_v = self.v + t * (self.a + next_a) / 2.0;
                let last_v = next_v + next_a * next_a.abs() / (2.0 * j);
                next_a.abs() <= a && last_v.abs() <= v
            };
            let jerk = [wanted * j, 0.0, -wanted * j]
                .into_iter()
                .find(|jerk| keeps(*jerk))
                .unwrap_or(-self.a.signum() * j);
            self.x += t * (self.v + t * (self.a / 2.0 + t * jerk / 6.0));
            self.v += t * (self.a + t * jerk / 2.0);
            self.a += t * jerk;
        }
    }

    #[test]
    fn a_drive_keeps_its_limits_whatever_its_joint_does_inside_what_is_left() {
        let screw = screw(0.05);
        let left = *screw.left();
        let joint_limits = [left.velocity, left.acceleration, left.jerk];
        let side_limits = screw.side_limits();
        let (mut joint, mut side) = (
            Driven {
                x: 150.0,
                ..Driven::default()
            },
            Driven::default(),
        );
        let t = 1e-4;
        let (mut state, mut before, mut most) = (7_u64, 0.0, [0.0_f64; 3]);
        let mut wanted = [1.0, 1.0];
        for step in 0..400_000_u64 {
            if step % 97 == 0 {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                wanted =
                    [state >> 40, state >> 45].map(|bits| if bits & 1 == 0 { 1.0 } else { -1.0 });
            }
            // Inside the table, where it bends.
            let inwards = if joint.x > 300.0 {
                -1.0
            } else if joint.x < 0.0 {
                1.0
            } else {
                wanted[0]
            };
            joint.step(inwards, joint_limits, t);
            let back = if side.x > 1.0 {
                -1.0
            } else if side.x < -1.0 {
                1.0
            } else {
                wanted[1]
            };
            side.step(back, side_limits, t);
            let [_, v, a] = screw.compensated_rates(
                [joint.x, joint.v, joint.a],
                [side.x.clamp(-1.0, 1.0), side.v, side.a],
            );
            let j = if step == 0 { 0.0 } else { (a - before) / t };
            before = a;
            for (most, rate) in most.iter_mut().zip([v, a, j]) {
                *most = most.max(rate.abs());
            }
        }
        for (most, limit) in most
            .into_iter()
            .zip([DRIVE.velocity, DRIVE.acceleration, DRIVE.jerk])
        {
            assert!(most <= limit * (1.0 + 1e-6), "{most} of {limit}");
            assert!(
                most > 0.8 * limit,
                "the test does not come near: {most} of {limit}"
            );
        }
    }

    #[test]
    fn what_is_no_table_is_refused() {
        let at = |position, up| CompensationPoint {
            position,
            up,
            down: up,
        };
        let refused =
            |points: &[CompensationPoint]| JointCompensation::new(points, 0.0, &DRIVE).unwrap_err();
        assert_eq!(refused(&[at(0.0, 0.0)]), CompensationError::Points(1));
        assert_eq!(
            refused(&[at(0.0, 0.0), at(0.0, 0.1)]),
            CompensationError::Order(0.0, 0.0)
        );
        // Measured positions in place of corrections.
        let measured = refused(&[at(0.0, 0.0), at(100.0, 100.003)]);
        assert!(
            matches!(measured, CompensationError::TooSteep(_)),
            "{measured}"
        );
        let exchanged = [0.0, 50.0].map(|position| CompensationPoint {
            position,
            up: 0.0,
            down: 0.012,
        });
        assert_eq!(refused(&exchanged), CompensationError::Exchanged(0.0));
        let rough: Vec<_> = (0..40)
            .map(|k| at(f64::from(k), 0.003 * f64::from(k % 2)))
            .collect();
        assert!(matches!(
            refused(&rough),
            CompensationError::TooRough { .. }
        ));
    }
}
