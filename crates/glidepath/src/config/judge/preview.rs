//! The parameters of the preview by advance and retreat.

use super::values::{Judge, Range};
use crate::config::raw::RawPreview;
use glidepath_motion::preview::AdvanceRetreat;

impl Judge {
    pub(super) fn preview(&mut self, raw: &RawPreview) -> AdvanceRetreat {
        let default = AdvanceRetreat::default();
        let growth = Range {
            min: 1.01,
            max: 100.0,
            unit: "",
            help: "the factor of a step that went well",
        };
        let max_growth = Range {
            min: 1.0,
            max: 1e6,
            unit: "",
            help: "the longest step in first steps; the longer, the more regions are passed over",
        };
        AdvanceRetreat {
            growth: self.number_or("preview.growth", &raw.growth, &growth, default.growth),
            max_growth: self.number_or(
                "preview.max_growth",
                &raw.max_growth,
                &max_growth,
                default.max_growth,
            ),
        }
    }
}
