//! Limits of the axes by finite differences, consistency of reports, gaps, and times of motion.

use super::report::{Inconsistency, ViolationKind, ViolationList, Worst};
use super::{AuditSettings, Sample};
use crate::Limits;
use glidepath_geometry::{AXES, Axis, AxisVector};

/// A limit counts as kept up to this factor.
const SLACK: f64 = 1.0 + 1e-6;

/// State of the check.
#[derive(Debug)]
pub(super) struct LimitAudit {
    limits: Limits,
    period_t: f64,
    /// The last positions, newest first; only the first `known` count.
    recent: [AxisVector; 4],
    known: usize,
    previous: Option<Sample>,
    /// Largest |p| so far, for the rounding of differences.
    magnitude: f64,
    pub(super) samples: u64,
    pub(super) worst: [Worst; 3],
    pub(super) maxima: [AxisVector; 3],
    pub(super) first_motion_tick: Option<u64>,
    pub(super) last_motion_tick: u64,
    pub(super) violations: ViolationList,
}

impl LimitAudit {
    pub(super) fn new(settings: &AuditSettings) -> Self {
        Self {
            limits: settings.limits,
            period_t: settings.period_t,
            recent: [AxisVector::zeros(); 4],
            known: 0,
            previous: None,
            magnitude: 0.0,
            samples: 0,
            worst: [Worst::default(); 3],
            maxima: [AxisVector::zeros(); 3],
            first_motion_tick: None,
            last_motion_tick: 0,
            violations: ViolationList::default(),
        }
    }

    pub(super) fn sample(&mut self, sample: &Sample) {
        self.samples += 1;
        if !sample.position.iter().all(|p| p.is_finite()) {
            self.violations
                .push(sample.tick, sample.line, ViolationKind::NotFinite);
            return;
        }
        match self.previous {
            // At rest before the first sample.
            None => {
                self.recent = [sample.position; 4];
                self.known = 3;
            }
            Some(previous) if previous.tick.checked_add(1) == Some(sample.tick) => {
                self.consistency(&previous, sample);
            }
            Some(previous) => {
                let kind = ViolationKind::Gap {
                    after: previous.tick,
                };
                self.violations.push(sample.tick, sample.line, kind);
                // Differences across the gap would mean nothing.
                self.known = 0;
            }
        }
        if let Some(previous) = self.previous
            && previous.position != sample.position
        {
            self.first_motion_tick.get_or_insert(previous.tick);
            self.last_motion_tick = sample.tick;
        }
        self.push(sample);
        self.previous = Some(*sample);
    }

    /// At rest after the last sample.
    pub(super) fn finish(&mut self) {
        if let Some(last) = self.previous {
            for k in 1..=3 {
                self.push(&Sample {
                    tick: last.tick.saturating_add(k),
                    ..last
                });
            }
        }
    }

    /// Seconds from the first to the last motion.
    pub(super) fn cycle_time_s(&self) -> f64 {
        let ticks = self
            .first_motion_tick
            .map_or(0, |first| self.last_motion_tick - first);
        #[expect(
            clippy::cast_precision_loss,
            reason = "exact for two million years of ticks"
        )]
        let ticks = ticks as f64;
        ticks * self.period_t
    }

    pub(super) fn last_position(&self) -> AxisVector {
        self.previous
            .map_or_else(AxisVector::zeros, |sample| sample.position)
    }

    fn push(&mut self, sample: &Sample) {
        self.recent = [
            sample.position,
            self.recent[0],
            self.recent[1],
            self.recent[2],
        ];
        self.known = (self.known + 1).min(4);
        self.magnitude = self.magnitude.max(sample.position.amax());
        let [p0, p1, p2, p3] = self.recent;
        let t = self.period_t;
        let differences = [
            (p0 - p1) / t,
            (p0 - 2.0 * p1 + p2) / (t * t),
            (p0 - 3.0 * p1 + 3.0 * p2 - p3) / (t * t * t),
        ];
        let allowed = [
            self.limits.velocity,
            self.limits.acceleration,
            self.limits.jerk,
        ];
        for order in 0..3.min(self.known.saturating_sub(1)) {
            self.check(order, &differences[order], &allowed[order], sample);
        }
    }

    /// Judges the difference of order `order` + 1.
    fn check(&mut self, order: usize, value: &AxisVector, limit: &AxisVector, sample: &Sample) {
        // Each position is rounded to half a unit in its last place.
        let weights = [2.0, 4.0, 8.0];
        let divisors = [self.period_t, self.period_t.powi(2), self.period_t.powi(3)];
        let rounding = weights[order] * 0.5 * f64::EPSILON * self.magnitude / divisors[order];
        for axis in Axis::ALL {
            let i = axis.index();
            let size = value[i].abs();
            if size > self.maxima[order][i] {
                self.maxima[order][i] = size;
            }
            let ratio = size / limit[i];
            if ratio > self.worst[order].ratio {
                self.worst[order] = Worst {
                    ratio,
                    axis: Some(axis),
                    tick: sample.tick,
                    line: sample.line,
                };
            }
            if size > limit[i] * SLACK + rounding {
                let kind = match order {
                    0 => ViolationKind::Velocity { axis, ratio },
                    1 => ViolationKind::Acceleration { axis, ratio },
                    _ => ViolationKind::Jerk { axis, ratio },
                };
                self.violations.push(sample.tick, sample.line, kind);
            }
        }
    }

    /// With jerk of at most J, a period's motion differs from that with none by at most J·T³/6 in
    /// position, J·T²/2 in velocity, J·T in acceleration.
    fn consistency(&mut self, previous: &Sample, sample: &Sample) {
        let (Some([v0, a0]), Some([v1, a1])) = (previous.reported, sample.reported) else {
            return;
        };
        let t = self.period_t;
        let position = sample.position - previous.position - v0 * t - a0 * (0.5 * t * t);
        let velocity = v1 - v0 - a0 * t;
        let acceleration = a1 - a0;
        for axis in Axis::ALL {
            let i = axis.index();
            let jerk_j = self.limits.jerk[i] * SLACK;
            let rounding = 4.0 * f64::EPSILON * (self.magnitude + v0[i].abs() * t);
            let checks = [
                (
                    position[i],
                    jerk_j * t * t * t / 6.0,
                    rounding,
                    Inconsistency::Position,
                ),
                (
                    velocity[i],
                    jerk_j * t * t / 2.0,
                    rounding / t,
                    Inconsistency::Velocity,
                ),
                (
                    acceleration[i],
                    jerk_j * t,
                    rounding / (t * t),
                    Inconsistency::Acceleration,
                ),
            ];
            for (value, allowed, rounding, what) in checks {
                // Also refuses what is not a number.
                let fits = value.abs() <= allowed + rounding;
                if !fits {
                    let kind = ViolationKind::Inconsistent { axis, what };
                    self.violations.push(sample.tick, sample.line, kind);
                }
            }
        }
    }
}

const _: () = assert!(AXES == Axis::ALL.len());
