//! The check of the joints' limits, where joints are not the axes: by finite differences of their
//! positions, and their ranges.
//!
//! Where the joints are, whoever feeds the audit says: what the drives are told, or what a mechanism makes
//! of a plan. Nothing that limited the motion is asked.

use crate::violation::{JointRate, ViolationKind, ViolationList};

/// Most joints of a machine.
pub(crate) const JOINTS: usize = 9;

/// A limit counts as kept up to this factor.
const SLACK: f64 = 1.0 + 1e-6;

/// What a joint can do: mm or degrees, and their derivatives by s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointBounds {
    /// Lowest and highest position, infinite where there is no end.
    pub range: [f64; 2],
    /// Largest velocity, acceleration and jerk, > 0.
    pub rates: [f64; 3],
}

/// The largest share of a limit of a joint, and where it was met.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WorstJoint {
    /// The quantity over its limit; above 1 is too much.
    pub ratio: f64,
    /// The joint, 0 for J0.
    pub joint: usize,
    /// Tick of the sample.
    pub tick: u64,
    /// Source line of the sample.
    pub line: u32,
}

/// State of the check of one joint.
#[derive(Debug, Clone, Copy)]
struct Past {
    /// The last three positions, newest first.
    recent: [f64; 3],
    /// Largest |q| so far, for the rounding of differences.
    magnitude: f64,
}

/// State of the check.
#[derive(Debug)]
pub(crate) struct JointAudit {
    bounds: Vec<JointBounds>,
    period_t: f64,
    pasts: Vec<Past>,
    /// The last sample: its tick and line.
    last: Option<(u64, u32)>,
    pub(crate) worst: [WorstJoint; 3],
    pub(crate) violations: ViolationList,
}

impl JointAudit {
    pub(crate) fn new(bounds: Vec<JointBounds>, period_t: f64) -> Self {
        Self {
            bounds,
            period_t,
            pasts: Vec::new(),
            last: None,
            worst: [WorstJoint::default(); 3],
            violations: ViolationList::default(),
        }
    }

    /// Takes the positions of all joints at a tick. Before the first one the machine was at rest there; what
    /// follows a gap is as if it were.
    pub(crate) fn sample(&mut self, tick: u64, line: u32, positions: &[f64]) {
        let follows = self
            .last
            .is_some_and(|(last, _)| last.checked_add(1) == Some(tick));
        if !follows {
            let at_rest = |position: &f64| Past {
                recent: [*position; 3],
                magnitude: position.abs(),
            };
            self.pasts = positions.iter().map(at_rest).collect();
        }
        self.last = Some((tick, line));
        for (joint, position) in positions.iter().enumerate().take(self.bounds.len()) {
            self.judge(joint, *position, (tick, line));
        }
    }

    /// At rest after the last sample.
    pub(crate) fn finish(&mut self) {
        let Some((tick, line)) = self.last else {
            return;
        };
        for k in 1..=3 {
            for joint in 0..self.pasts.len().min(self.bounds.len()) {
                let [position, ..] = self.pasts[joint].recent;
                self.judge(joint, position, (tick.saturating_add(k), line));
            }
        }
    }

    fn judge(&mut self, joint: usize, position: f64, (tick, line): (u64, u32)) {
        let JointBounds { range, rates } = self.bounds[joint];
        if !position.is_finite() {
            self.violations.push(tick, line, ViolationKind::NotFinite);
            return;
        }
        let end = position.clamp(range[0], range[1]);
        if !(range[0]..=range[1]).contains(&position) {
            let kind = ViolationKind::JointRange {
                joint,
                position,
                end,
            };
            self.violations.push(tick, line, kind);
        }
        let Past { recent, magnitude } = &mut self.pasts[joint];
        let [a, b, c] = *recent;
        *recent = [position, a, b];
        *magnitude = magnitude.max(position.abs());
        let differences = [
            position - a,
            position - 2.0 * a + b,
            position - 3.0 * a + 3.0 * b - c,
        ];
        // Each position is rounded to half a unit in its last place.
        let mut rounding = f64::EPSILON * *magnitude;
        let mut divisor = 1.0;
        for (order, rate) in JointRate::ALL.into_iter().enumerate() {
            divisor *= self.period_t;
            let (size, limit) = (differences[order].abs() / divisor, rates[order]);
            let ratio = size / limit;
            let worst = &mut self.worst[order];
            if ratio > worst.ratio {
                *worst = WorstJoint {
                    ratio,
                    joint,
                    tick,
                    line,
                };
            }
            if size > limit * SLACK + rounding / divisor {
                let kind = ViolationKind::Joint { joint, rate, ratio };
                self.violations.push(tick, line, kind);
            }
            rounding *= 2.0;
        }
    }
}
