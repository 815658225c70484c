//! The machines that programs are planned for.

use crate::arguments::Setup;
use glidepath_program::{Effort, Limits, Settings, Smoothing};

/// A machine, all of its axes alike.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Machine {
    pub(crate) name: &'static str,
    pub(crate) velocity_v: f64,
    pub(crate) acceleration_a: f64,
    pub(crate) jerk_j: f64,
    pub(crate) tolerance_mm: f64,
}

/// All of them: the milling machine and the light one of the benchmark, and a milling machine whose
/// jerk is next to unlimited.
pub(crate) const MACHINES: [Machine; 3] = [
    Machine {
        name: "mill",
        velocity_v: 200.0,
        acceleration_a: 2000.0,
        jerk_j: 4e4,
        tolerance_mm: 0.02,
    },
    Machine {
        name: "seed",
        velocity_v: 100.0,
        acceleration_a: 1e4,
        jerk_j: 1e6,
        tolerance_mm: 0.05,
    },
    Machine {
        name: "stiff",
        velocity_v: 200.0,
        acceleration_a: 2000.0,
        jerk_j: 1e6,
        tolerance_mm: 0.02,
    },
];

impl Machine {
    /// What a program is planned with.
    pub(crate) fn settings(&self, effort: Effort, setup: &Setup) -> Settings {
        Settings {
            limits: Limits::uniform(self.velocity_v, self.acceleration_a, self.jerk_j),
            tolerance_mm: setup.tolerance_mm(),
            direction: glidepath_program::DirectionTolerance::default(),
            smoothing: Smoothing::Auto,
            corners: setup.corners,
            period_t: setup.period_t,
            effort,
        }
    }

    /// The time that a circle takes along the exact curve, s: at the speed that feed, acceleration
    /// and jerk of an axis allow on it, v = min(F, √(aR), ∛(jR²)), with a run-up and a stop along
    /// its length. An estimate: it asks the limits for the run-up as if the path were straight.
    pub(crate) fn circle_t(&self, radius_mm: f64, length_mm: f64, feed_v: f64) -> f64 {
        let steady_v = feed_v
            .min(self.velocity_v)
            .min((self.acceleration_a * radius_mm).sqrt())
            .min((self.jerk_j * radius_mm * radius_mm).cbrt());
        let ramp_t = |speed_v: f64| {
            if speed_v * self.jerk_j > self.acceleration_a.powi(2) {
                speed_v / self.acceleration_a + self.acceleration_a / self.jerk_j
            } else {
                2.0 * (speed_v / self.jerk_j).sqrt()
            }
        };
        // Both ramps together take as far as the speed goes in the time of one.
        let (mut low_v, mut high_v) = (0.0, steady_v);
        if steady_v * ramp_t(steady_v) > length_mm {
            for _ in 0..60 {
                let speed_v = 0.5 * (low_v + high_v);
                if speed_v * ramp_t(speed_v) > length_mm {
                    high_v = speed_v;
                } else {
                    low_v = speed_v;
                }
            }
        }
        length_mm / high_v + ramp_t(high_v)
    }
}
