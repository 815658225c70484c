//! `[feedback]`: what the drives say of themselves.

use super::values::{Judge, Range};
use crate::config::raw::RawFeedback;
use crate::config::settings::{FeedbackConfig, HomingBy};

impl Judge {
    pub(super) fn feedback(&mut self, raw: RawFeedback) -> FeedbackConfig {
        let error = Range {
            min: 1e-6,
            max: 1e3,
            unit: "mm or °",
            help: "a few times what the drives are behind when all is well",
        };
        let time = |help| Range {
            min: 1e-3,
            max: 10.0,
            unit: "s",
            help,
        };
        let stale = time("a few periods, and more than the drives take between two samples");
        let off = time("longer than what stops the motion");
        let stale_t = raw
            .stale_s
            .as_ref()
            .map(|value| self.number("feedback.stale_s", value, &stale));
        FeedbackConfig {
            is_expected: self.choice(
                "feedback.source",
                raw.source,
                &[("none", false), ("drives", true)],
            ),
            homing: self.choice(
                "feedback.homing",
                raw.homing,
                &[
                    ("none", HomingBy::Nobody),
                    ("drive", HomingBy::Drive),
                    ("controller", HomingBy::Controller),
                ],
            ),
            following_error: self.number_or(
                "feedback.following_error",
                &raw.following_error,
                &error,
                1.0,
            ),
            min_following_error: self.number_or(
                "feedback.min_following_error",
                &raw.min_following_error,
                &error,
                0.1,
            ),
            stale_t,
            off_t: self.number_or("feedback.off_s", &raw.off_s, &off, 0.1),
        }
    }
}
