//! `[interpolator]`: the real-time side.

use super::horizon::{self, LONGEST_PERIOD_US};
use super::stops;
use super::values::{Judge, Range};
use crate::config::raw::{RawAxis, RawInterpolator};
use crate::config::settings::{AxisConfig, InterpolatorConfig};
use glidepath_kinematics::JointLimits;
use toml::Spanned;

impl Judge {
    pub(super) fn interpolator(
        &mut self,
        raw: &RawInterpolator,
        (axes, joints): (&[AxisConfig], &JointLimits),
        raw_axes: &[&RawAxis],
    ) -> InterpolatorConfig {
        let range = Range {
            min: 0.05,
            max: 60.0,
            unit: "s",
            help: "longer outlasts slower input, shorter answers an override sooner",
        };
        let period_us = raw.period_us.as_ref().map_or(Some(4000), |value| {
            self.whole(
                "interpolator.period_us",
                value,
                (250, LONGEST_PERIOD_US),
                "µs between two setpoints",
            )
        });
        let shortest_t = horizon::shortest_t(axes, joints);
        let horizon_t = horizon::default_t(shortest_t);
        let horizon_t = self.number_or("interpolator.horizon_s", &raw.horizon_s, &range, horizon_t);
        // What follows has no part in how the motion stops.
        let times_are_good = !self.has_found(&["interpolator"]);
        let priority = raw.priority.as_ref().map_or(Some(80), |value| {
            self.whole(
                "interpolator.priority",
                value,
                (1, 99),
                "the SCHED_FIFO priority",
            )
        });
        let cpu = raw.cpu.as_ref().and_then(|value| {
            self.whole(
                "interpolator.cpu",
                value,
                (0, 1023),
                "the number of a CPU of this host",
            )
        });
        let missed = raw.max_missed_ticks.as_ref().map_or(Some(10), |value| {
            let help = "ticks missed within a second before the motion stops with a fault";
            self.whole("interpolator.max_missed_ticks", value, (0, 1_000_000), help)
        });
        let config = InterpolatorConfig {
            // A value that does not fit was found already: the configuration is refused.
            period_us: period_us.unwrap_or(4000),
            priority: priority.unwrap_or(80),
            cpu,
            max_missed_ticks: missed.unwrap_or(10),
            horizon_t,
        };
        // Only numbers that are good by themselves can be judged together.
        if times_are_good {
            self.stops(axes, raw_axes, &config);
        }
        if times_are_good
            && !self.has_found(&["axis", "joint", "machine"])
            && let Some(mut diagnostic) = horizon::diagnostic(&config, shortest_t)
        {
            let (horizon, period) = (raw.horizon_s.as_ref(), raw.period_us.as_ref());
            let span = horizon
                .map(Spanned::span)
                .filter(|_| diagnostic.key.ends_with("horizon_s"));
            diagnostic.span = span.or_else(|| period.map(Spanned::span));
            self.diagnostics.push(diagnostic);
        }
        config
    }

    /// Axes that take longer to stop than can be planned ahead.
    fn stops(
        &mut self,
        axes: &[AxisConfig],
        raw_axes: &[&RawAxis],
        interpolator: &InterpolatorConfig,
    ) {
        for (axis, raw) in axes.iter().zip(raw_axes) {
            if self.has_found(&[&format!("axis.{}", axis.axis)]) {
                continue;
            }
            if axis.has_own != [true; 3] {
                continue;
            }
            if let Some(mut diagnostic) = stops::diagnostic(axis, interpolator) {
                let is_jerk = diagnostic.key.ends_with("max_jerk");
                let value = if is_jerk {
                    &raw.max_jerk
                } else {
                    &raw.max_velocity
                };
                diagnostic.span = value.as_ref().map(Spanned::span);
                self.diagnostics.push(diagnostic);
            }
        }
    }
}
