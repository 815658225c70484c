//! Limits along the path, which a machine may have beside those of its axes.

use super::judge::{Judge, Range};
use super::raw::{Optional, RawPath};
use glidepath_program::{Limits, PathBounds};

impl Judge {
    pub(super) fn bounds(&mut self, raw: &RawPath) -> PathBounds {
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
