//! The check of limits along the path: acceleration and jerk of path position by finite
//! differences, acceleration across the path from the reported state.

use crate::sample::Seen;
use crate::settings::AuditSettings;
use crate::violation::{ViolationKind, ViolationList, Worst};
use glidepath_geometry::feed_length;
use glidepath_program::PathBounds;

/// A limit counts as kept up to this factor.
const SLACK: f64 = 1.0 + 1e-6;

/// State of the check.
#[derive(Debug)]
pub(crate) struct AlongAudit {
    bounds: PathBounds,
    period_t: f64,
    /// The last path positions, newest first; only the first `known` count.
    recent: [f64; 4],
    known: usize,
    tick: u64,
    /// Acceleration along and across the path, jerk.
    pub(crate) worst: [Worst; 3],
    pub(crate) violations: ViolationList,
}

impl AlongAudit {
    pub(crate) fn new(settings: &AuditSettings) -> Self {
        Self {
            bounds: settings.limits.path,
            period_t: settings.period_t,
            recent: [0.0; 4],
            known: 0,
            tick: 0,
            worst: [Worst::default(); 3],
            violations: ViolationList::default(),
        }
    }

    pub(crate) fn sample(&mut self, sample: &Seen<'_>, path_s: f64) {
        if self.known > 0 && sample.tick != self.tick + 1 {
            // Differences across the gap would mean nothing; it is reported elsewhere.
            self.known = 0;
        }
        self.tick = sample.tick;
        if self.bounds.is_none() {
            // Nothing to keep but to be a number; whether the state is one is judged with the axes.
            if !path_s.is_finite() {
                let kind = ViolationKind::AlongPath { ratio: path_s };
                self.violations.push(sample.tick, sample.line, kind);
            }
            return;
        }
        let [s1, s2, s3, _] = self.recent;
        self.recent = [path_s, s1, s2, s3];
        self.known = (self.known + 1).min(4);
        let t = self.period_t;
        let rounding = 4.0 * f64::EPSILON * path_s.abs();
        if self.known > 2 {
            let along_a = (path_s - 2.0 * s1 + s2).abs() / (t * t);
            let allowed = (self.bounds.tangential_a, rounding / (t * t));
            self.judge(0, along_a, allowed, sample);
        }
        if self.known > 3 {
            let jerk_j = (path_s - 3.0 * (s1 - s2) - s3).abs() / t.powi(3);
            let allowed = (self.bounds.jerk_j, 2.0 * rounding / t.powi(3));
            self.judge(2, jerk_j, allowed, sample);
        }
        if let Some([velocity, acceleration]) = sample.reported {
            let speed_v = feed_length(velocity);
            if speed_v > 0.0 {
                let along = velocity * (acceleration.dot(velocity) / velocity.norm_squared());
                let across_a = feed_length(&(acceleration - along));
                self.judge(1, across_a, (self.bounds.normal_a, 0.0), sample);
            }
        }
    }

    fn judge(&mut self, which: usize, value: f64, allowed: (f64, f64), sample: &Seen<'_>) {
        let (limit, rounding) = allowed;
        let ratio = value / limit;
        if ratio > self.worst[which].ratio {
            self.worst[which] = Worst {
                ratio,
                axis: None,
                tick: sample.tick,
                line: sample.line,
            };
        }
        // Also refuses what is not a number.
        let is_kept = value <= limit * SLACK + rounding;
        if !is_kept {
            let kind = match which {
                0 => ViolationKind::AlongPath { ratio },
                1 => ViolationKind::AcrossPath { ratio },
                _ => ViolationKind::PathJerk { ratio },
            };
            self.violations.push(sample.tick, sample.line, kind);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::Sample;
    use glidepath_geometry::AxisVector;
    use glidepath_program::Limits;

    #[test]
    fn every_limit_is_found_broken_and_kept() {
        let mut limits = Limits::uniform(1e9, 1e9, 1e12);
        limits.path = PathBounds {
            tangential_a: 100.0,
            normal_a: 200.0,
            jerk_j: 1000.0,
        };
        let settings = AuditSettings {
            limits,
            period_t: 0.01,
            tolerance_mm: 0.01,
            direction: glidepath_program::DirectionTolerance::default(),
            corners: glidepath_program::Corners::default(),
        };
        // A circle of radius 2 at a speed, with jerk along it.
        let found = |speed_v: f64, accel_a: f64, jerk_j: f64| {
            let mut audit = AlongAudit::new(&settings);
            for tick in 0..20_u32 {
                let t = 0.01 * f64::from(tick);
                let (mut velocity, mut acceleration) = (AxisVector::zeros(), AxisVector::zeros());
                velocity[0] = speed_v;
                (acceleration[0], acceleration[1]) = (7.0, 0.5 * speed_v * speed_v);
                let sample = Sample {
                    tick: tick.into(),
                    line: 1,
                    position: AxisVector::zeros(),
                    reported: Some([velocity, acceleration]),
                    is_between_frames: false,
                };
                let s = t * (speed_v + t * (0.5 * accel_a + t * jerk_j / 6.0));
                audit.sample(&Seen::from(&sample), s);
            }
            let kinds = audit.violations.kept.iter().map(|v| match v.kind {
                ViolationKind::AlongPath { .. } => 'a',
                ViolationKind::AcrossPath { .. } => 'n',
                _ => 'j',
            });
            let mut kinds: Vec<char> = kinds.collect();
            kinds.sort_unstable();
            kinds.dedup();
            kinds.into_iter().collect::<String>()
        };
        assert_eq!(found(19.9, 99.0, 0.0), "");
        assert_eq!(found(20.1, 99.0, 0.0), "n");
        assert_eq!(found(5.0, 101.0, 0.0), "a");
        assert_eq!(found(15.0, -95.0, 990.0), "");
        assert_eq!(found(15.0, -95.0, 1010.0), "j");
    }
}
