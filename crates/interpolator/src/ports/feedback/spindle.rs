//! The spindle watch: angle and speed of the spindle from samples of its angle.
//!
//! A filter with three states, critically damped: it has no error at a constant acceleration, and
//! smooths what an encoder rounds. It is fed with every record of the stack that measures the angle,
//! so the more often that sends, the less noise is left.

use crate::shared::message::observation::Turn;
use glidepath_link::{Feedback, SpindleFlags};

/// How long the filter remembers, s: the time in which what a sample says falls to 1/e. Longer, it
/// would be late with a load that slows the spindle; shorter, it would follow the counts.
const MEMORY_T: f64 = 0.006;
/// How long it takes until what it says is good, ns.
const SETTLED_NS: u64 = 48_000_000;
/// A pause between two samples after which it begins anew, s.
const PAUSE_T: f64 = 0.1;
/// How far a sample may be from what was expected, in revolutions, before it begins anew: nothing
/// that turns does that.
const JUMP: f64 = 0.5;

/// The spindle of the stack that measures its angle.
#[derive(Debug, Default)]
pub(super) struct SpindleWatch {
    /// The life of the stack.
    boot_id: u64,
    filter: AngleFilter,
    index_count: Option<u64>,
}

impl SpindleWatch {
    /// Takes what a stack sends. The first one that measures the angle is listened to, as long as
    /// it does.
    pub(super) fn take(&mut self, feedback: &Feedback) {
        let flags = feedback.spindle();
        let is_other = self.filter.samples > 0 && self.boot_id != feedback.boot_id;
        let age_ns = feedback.sample_ns.saturating_sub(self.filter.sample_ns);
        if !flags.contains(SpindleFlags::ANGLE) || (is_other && age_ns < LOST_NS) {
            return;
        }
        if is_other {
            self.filter = AngleFilter::default();
        }
        self.boot_id = feedback.boot_id;
        let counts = flags.contains(SpindleFlags::INDEX);
        self.index_count = counts.then_some(feedback.spindle_index_count);
        self.filter.take(feedback.sample_ns, feedback.spindle_angle);
    }

    /// What is known of it.
    pub(super) const fn turn(&self) -> Turn {
        let filter = &self.filter;
        Turn {
            sample_ns: filter.sample_ns,
            angle: filter.angle,
            speed: filter.speed,
            acceleration: filter.acceleration,
            is_settled: filter.sample_ns.saturating_sub(filter.since_ns) >= SETTLED_NS,
            index_count: self.index_count,
        }
    }
}

/// A stack that has not told the angle for so long is not listened to any more, ns.
const LOST_NS: u64 = 1_000_000_000;

/// Angle (revolutions), speed (rev/s) and acceleration (rev/s²) at the time of the last sample.
#[derive(Debug, Clone, Copy, Default)]
struct AngleFilter {
    angle: f64,
    speed: f64,
    acceleration: f64,
    sample_ns: u64,
    /// When the first sample was measured.
    since_ns: u64,
    samples: u32,
}

impl AngleFilter {
    /// Takes a sample, unless it is older than the one that was taken last.
    #[allow(clippy::cast_precision_loss, reason = "moments near each other")]
    fn take(&mut self, sample_ns: u64, angle: f64) {
        if sample_ns <= self.sample_ns {
            return;
        }
        let t = (sample_ns - self.sample_ns) as f64 * 1e-9;
        self.sample_ns = sample_ns;
        let expected = self.angle + t * (self.speed + 0.5 * t * self.acceleration);
        let off = angle - expected;
        if self.samples == 0 || t > PAUSE_T || (self.samples > 1 && off.abs() > JUMP) {
            *self = Self {
                angle,
                sample_ns,
                since_ns: sample_ns,
                samples: 1,
                ..Self::default()
            };
            return;
        }
        if self.samples == 1 {
            self.speed = (angle - self.angle) / t;
            self.angle = angle;
        } else {
            // Gains of a fading memory: three equal poles at θ.
            let theta = (-t / MEMORY_T).exp();
            let new = 1.0 - theta;
            self.angle = expected + (1.0 - theta.powi(3)) * off;
            self.speed += t * self.acceleration + 1.5 * new * new * (1.0 + theta) / t * off;
            self.acceleration += new.powi(3) / (t * t) * off;
        }
        self.samples = self.samples.saturating_add(1);
    }
}

#[cfg(test)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test: times are small and not negative"
)]
mod tests {
    use super::*;
    use bytemuck::Zeroable as _;

    const START_NS: u64 = 5_000_000_000;

    fn record(t: f64, angle: f64) -> Feedback {
        Feedback {
            boot_id: 3,
            sample_ns: START_NS + (t * 1e9).round() as u64,
            spindle_angle: angle,
            spindle_flags: SpindleFlags::ANGLE.0,
            ..Feedback::zeroed()
        }
    }

    /// Samples every millisecond, from 1 ms on.
    fn watched(samples: u32, angle: impl Fn(f64) -> f64) -> SpindleWatch {
        let mut watch = SpindleWatch::default();
        for k in 1..=samples {
            let t = f64::from(k) * 0.001;
            watch.take(&record(t, angle(t)));
        }
        watch
    }

    fn at(t: f64) -> u64 {
        START_NS + (t * 1e9).round() as u64
    }

    #[test]
    fn constant_speed_and_acceleration_are_known_without_error() {
        for acceleration in [0.0, -10.0, 40.0] {
            let angle = |t: f64| 7.0 + t * (16.0 + 0.5 * acceleration * t);
            let turn = watched(240, angle).turn();
            assert!(turn.is_settled);
            let (found, speed) = turn.at(at(0.252));
            assert!((found - angle(0.252)).abs() < 1e-6, "{found}");
            let wanted = 16.0 + 0.252 * acceleration;
            assert!((speed - wanted).abs() < 1e-3, "{speed}");
        }
    }

    #[test]
    fn counts_are_smoothed() {
        let exact = |t: f64| 16.37 * t;
        let counted = |t: f64| (exact(t) * 4096.0).floor() / 4096.0;
        let mut worst = 0.0_f64;
        for samples in 100..400 {
            let turn = watched(samples, counted).turn();
            let t = f64::from(samples) * 0.001 + 0.009;
            let off = turn.at(at(t)).0 - exact(t) + 0.5 / 4096.0;
            worst = worst.max(off.abs());
        }
        // Two periods ahead it is off by little more than the encoder itself.
        assert!(worst < 1.5 / 4096.0, "{}", worst * 4096.0);
    }

    #[test]
    fn a_jump_or_a_pause_begins_anew_and_another_stack_is_not_heard() {
        for (t, angle) in [(0.101, 0.0), (0.3, 3.0)] {
            let mut watch = watched(100, |t| 10.0 * t);
            assert!(watch.turn().is_settled);
            watch.take(&record(t, angle));
            assert!(!watch.turn().is_settled, "{t}");
        }
        let mut watch = watched(100, |t| 10.0 * t);
        let before = watch.turn();
        watch.take(&Feedback {
            boot_id: 4,
            ..record(0.101, 77.0)
        });
        assert_eq!(watch.turn(), before);
    }
}
