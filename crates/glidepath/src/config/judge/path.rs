//! `[path]`: the tolerance, how it is used, and limits along the path, which a machine may have
//! beside those of its axes.

use super::values::{Judge, Range};
use crate::config::diagnostic::ConfigDiagnostic;
use crate::config::raw::{Optional, RawPath};
use crate::config::settings::PathConfig;
use glidepath_geometry::Axis;
use glidepath_program::{Corners, Effort, Limits, PathBounds, Smoothing};
use toml::Spanned;

pub(super) const TOLERANCE: Range = Range {
    min: 1e-5,
    max: 10.0,
    unit: "mm",
    help: "how far the motion may leave the programmed path",
};

pub(super) const EFFORTS: [(&str, Effort); 2] = [
    (Effort::Optimal.name(), Effort::Optimal),
    (Effort::Fast.name(), Effort::Fast),
];

pub(super) const CORNERS: [(&str, Corners); 2] =
    [("inner", Corners::Inner), ("either", Corners::Either)];

impl Judge {
    pub(super) fn path(&mut self, raw: RawPath, axes: &[Axis]) -> PathConfig {
        let feed = Range {
            min: 1e-3,
            max: 1e7,
            unit: "mm/min",
            help: "the feedrate where the program has no F",
        };
        PathConfig {
            bounds: self.bounds(&raw),
            tolerance_mm: self.number_or("path.tolerance", &raw.tolerance, &TOLERANCE, 0.02),
            direction_deg: self.direction_deg(raw.direction_tolerance.as_ref(), axes),
            smoothing: self.choice(
                "path.smoothing",
                raw.smoothing,
                &[
                    ("auto", Smoothing::default()),
                    ("sextic", Smoothing::Sextic),
                    ("bezier-pair", Smoothing::BezierPair),
                    ("exact-stop", Smoothing::ExactStop),
                ],
            ),
            corners: self.choice("path.corners", raw.corners, &CORNERS),
            effort: self.choice("path.effort", raw.effort, &EFFORTS),
            default_feed: raw
                .default_feed
                .map(|value| self.number("path.default_feed", &value, &feed)),
        }
    }

    fn direction_deg(&mut self, value: Option<&Spanned<f64>>, axes: &[Axis]) -> Option<f64> {
        const KEY: &str = "path.direction_tolerance";
        let range = Range {
            min: 1e-5,
            max: 10.0,
            unit: "°",
            help: "how far the direction of the tool may be from the programmed one",
        };
        let value = value?;
        if !axes.iter().any(|axis| axis.is_rotary()) {
            self.diagnostics.push(ConfigDiagnostic {
                key: KEY.to_owned(),
                message: format!("{KEY} on a machine without a rotary axis"),
                help: Some("leave it out, or add the table of A, B or C".to_owned()),
                span: Some(value.span()),
            });
        }
        Some(self.number(KEY, value, &range))
    }

    fn bounds(&mut self, raw: &RawPath) -> PathBounds {
        let mut limit = |key, value: &Optional<f64>, unit, help| {
            let range = Range {
                min: 1e-3,
                max: 1e9,
                unit,
                help,
            };
            self.number_or(key, value, &range, Limits::UNLIMITED)
        };
        PathBounds {
            tangential_a: limit(
                "path.max_tangential_acceleration",
                &raw.max_tangential_acceleration,
                "mm/s²",
                "how fast the speed along the path may change; leave it out for no such limit",
            ),
            normal_a: limit(
                "path.max_normal_acceleration",
                &raw.max_normal_acceleration,
                "mm/s²",
                "the acceleration across the path in curves; leave it out for no such limit",
            ),
            jerk_j: limit(
                "path.max_jerk",
                &raw.max_jerk,
                "mm/s³",
                "how fast the acceleration may change; leave it out for no such limit",
            ),
        }
    }
}
