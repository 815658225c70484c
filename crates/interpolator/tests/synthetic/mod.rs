//! Synthetic trajectories, at their limits as often as not: every axis by itself makes one
//! point-to-point move after the other, with phases of whole periods and the jerk at its limit or
//! zero. Jerk is constant inside every period, so the quintic between two frames is the motion.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    clippy::float_cmp,
    clippy::unwrap_used,
    unreachable_pub,
    reason = "a test: numbers are small, bits are compared on purpose, failures are panics"
)]
#![allow(dead_code, reason = "each test binary uses its part")]

use glidepath_geometry::{AXES, AxisVector};
use glidepath_kinematics::{Hexapod, Mechanism};
use glidepath_link::SetpointFrame;
use glidepath_program::{Frame, FrameEvents, FrameFlags, Limits};

/// The default machine: 200 mm/s, 2000 mm/s², 40000 mm/s³ on every axis.
pub fn mill() -> Limits {
    Limits::uniform(200.0, 2_000.0, 40_000.0)
}

/// A hexapod that is large beside the motions here, with its base below them.
pub fn hexapod() -> Mechanism {
    let mut hexapod = Hexapod::paired(4_000.0, 1_500.0, 15.0);
    for joint in &mut hexapod.base {
        joint.z = -5_000.0;
    }
    Mechanism::Hexapod(hexapod)
}

/// A small generator of numbers (xorshift64*), so that a plan is a function of its seed.
#[derive(Debug, Clone)]
pub struct Numbers(u64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11
    }

    /// From `low` to `high`, both included.
    pub fn whole(&mut self, low: u64, high: u64) -> u64 {
        low + self.next() % (high - low + 1)
    }

    /// 0 ≤ x < 1.
    pub fn unit(&mut self) -> f64 {
        self.next() as f64 / (1_u64 << 53) as f64
    }
}

/// Jerk of one move, period by period, in units of the limit.
fn one_move(numbers: &mut Numbers, v: f64, a: f64, j: f64, t: f64) -> Vec<f64> {
    let whole = |x: f64| (x * (1.0 + 1e-12)).floor() as u64;
    let bend = numbers.whole(1, whole(a / (j * t)).max(1));
    let jerk = (a / (bend as f64 * t)).min(j) / j;
    // Peak speed is jerk · bend · (bend + keep) periods squared.
    let most = whole(v / (jerk * j * t * t * bend as f64));
    let keep = if most > bend {
        numbers.whole(0, most - bend)
    } else {
        0
    };
    let jerk = jerk.min(v / (j * t * t * (bend * (bend + keep)) as f64));
    let cruise = if numbers.unit() < 0.5 {
        0
    } else {
        numbers.whole(1, 60)
    };
    let sign = if numbers.unit() < 0.5 { -jerk } else { jerk };
    let mut jerks = Vec::new();
    for (value, count) in [
        (sign, bend),
        (0.0, keep),
        (-sign, bend),
        (0.0, cruise),
        (-sign, bend),
        (0.0, keep),
        (sign, bend),
        (
            0.0,
            if numbers.unit() < 0.5 {
                0
            } else {
                numbers.whole(0, 40)
            },
        ),
    ] {
        jerks.extend(std::iter::repeat_n(value, count as usize));
    }
    jerks
}

/// At least `ticks` periods of motion of the first `axes` axes, from `start` at rest to rest.
pub fn plan(
    seed: u64,
    axes: usize,
    ticks: usize,
    limits: &Limits,
    period_t: f64,
    start: AxisVector,
) -> Vec<Frame> {
    let mut numbers = Numbers::new(seed + 1);
    let mut jerks: Vec<Vec<f64>> = vec![Vec::new(); AXES];
    for (i, axis) in jerks.iter_mut().enumerate().take(axes) {
        while axis.len() < ticks {
            let (v, a, j) = (limits.velocity[i], limits.acceleration[i], limits.jerk[i]);
            axis.extend(
                one_move(&mut numbers, v, a, j, period_t)
                    .iter()
                    .map(|x| x * j),
            );
        }
    }
    integrate(&jerks, period_t, start)
}

/// Moves along straight lines in random directions, one after the other: what a planner makes of a
/// program with exact stops. The axis with the largest part is at its limits, the others follow.
pub fn lines(seed: u64, axes: usize, ticks: usize, limits: &Limits, period_t: f64) -> Vec<Frame> {
    let mut numbers = Numbers::new(seed + 1);
    let mut jerks: Vec<Vec<f64>> = vec![Vec::new(); AXES];
    while jerks[0].len() < ticks {
        let (v, a, j) = (limits.velocity[0], limits.acceleration[0], limits.jerk[0]);
        let along = one_move(&mut numbers, v, a, j, period_t);
        for (i, axis) in jerks.iter_mut().enumerate().take(axes) {
            let part = if i == 0 {
                1.0
            } else {
                2.0 * numbers.unit() - 1.0
            };
            axis.extend(along.iter().map(|x| x * j * part));
        }
    }
    integrate(&jerks, period_t, AxisVector::zeros())
}

/// Frames of a motion with the given jerks per axis and period, at rest at both ends.
pub fn integrate(jerks: &[Vec<f64>], period_t: f64, start: AxisVector) -> Vec<Frame> {
    let end = jerks.iter().map(Vec::len).max().unwrap_or(0);
    let t = period_t;
    let (mut p, mut v, mut a) = (start, AxisVector::zeros(), AxisVector::zeros());
    let mut path_s = 0.0;
    let mut frames = Vec::with_capacity(end + 1);
    for k in 0..=end {
        let mut flags = FrameFlags::default();
        if k == 0 {
            flags = flags.with(FrameFlags::FIRST);
        }
        if k == end {
            flags = flags.with(FrameFlags::LAST);
            (v, a) = (AxisVector::zeros(), AxisVector::zeros());
        }
        frames.push(Frame {
            block: 0,
            sequence: k as u64,
            line: k as u32 / 50 + 1,
            flags,
            events: FrameEvents::NONE,
            planned_override: 1.0,
            programmed_v: 0.0,
            path_v: v.norm(),
            path_s,
            position: p,
            velocity: v,
            acceleration: a,
        });
        let before = p;
        for i in 0..AXES {
            let j = jerks
                .get(i)
                .and_then(|axis| axis.get(k))
                .copied()
                .unwrap_or(0.0);
            p[i] += t * (v[i] + t * (a[i] / 2.0 + t * j / 6.0));
            v[i] += t * (a[i] + t * j / 2.0);
            a[i] += t * j;
        }
        path_s += (p - before).norm();
    }
    frames
}

/// The records of frames.
pub fn records(frames: &[Frame], epoch: u64, period_ns: u64) -> Vec<SetpointFrame> {
    frames
        .iter()
        .map(|f| SetpointFrame::from_frame(f, epoch, period_ns))
        .collect()
}

/// Largest ratio of a difference of positions to its limit: velocity, acceleration, jerk.
pub fn audit(positions: &[AxisVector], limits: &Limits, period_t: f64) -> [f64; 3] {
    let t = period_t;
    let mut worst = [0.0_f64; 3];
    let mut differences = positions.to_vec();
    for (order, limit) in [limits.velocity, limits.acceleration, limits.jerk]
        .iter()
        .enumerate()
    {
        let scale = t.powi(order as i32 + 1);
        differences = differences.windows(2).map(|w| w[1] - w[0]).collect();
        for d in &differences {
            worst[order] = worst[order].max((d / scale).component_div(limit).amax());
        }
    }
    worst
}
