//! The diagnosis in reports: what keeps a motion from being faster.

use super::quantity::seconds;
use super::shape::ShapeFigures;
use super::smoothness::SmoothnessFigures;
use crate::config::MachineConfig;
use core::fmt::Write as _;
use glidepath_audit::diagnosis::{SlowPlace, Summary};
use serde::Serialize;
use std::collections::BTreeMap;

/// Places in the text; all of them are in the object.
const SHOWN: usize = 5;
/// Limits that bind for less than this share of the time are left out of the text.
const WORTH_R: f64 = 0.005;

/// The diagnosis of a motion: which limits bind, and where time is lost.
#[derive(Debug, Clone, Serialize)]
pub struct DiagnosisReport {
    /// Share of the time, 0 to 1, by limit: `feed`, `velocity X`, `acceleration X`, `jerk X`, of a joint
    /// `velocity J0`, `acceleration J0`, `jerk J0`, `tolerance`, `chord error`, `rest`, `none`.
    pub binding: BTreeMap<String, f64>,
    /// Where most time is lost against the programmed feed, the worst first.
    pub slowest: Vec<PlaceReport>,
    /// How smooth the motion is: `whole`, and `at_feed`, where the programmed feed binds.
    pub smoothness: BTreeMap<&'static str, SmoothnessFigures>,
    /// How true its shape is.
    pub shape: ShapeFigures,
}

/// A place where time is lost.
#[derive(Debug, Clone, Serialize)]
pub struct PlaceReport {
    /// Source line where it is slowest.
    pub line: u32,
    /// Source line where it begins.
    pub first_line: u32,
    /// Source line where it ends.
    pub last_line: u32,
    /// When it begins, s.
    pub start_s: f64,
    /// How long it lasts, s.
    pub duration_s: f64,
    /// Lowest speed, mm/s.
    pub speed_mm_s: f64,
    /// Programmed feed there, mm/s.
    pub feed_mm_s: f64,
    /// What binds for most of it.
    pub limit: String,
    /// Time lost against the programmed feed, s.
    pub lost_s: f64,
}

impl From<&SlowPlace> for PlaceReport {
    fn from(place: &SlowPlace) -> Self {
        Self {
            line: place.line,
            first_line: place.first_line,
            last_line: place.last_line,
            start_s: place.start_t,
            duration_s: place.duration_t,
            speed_mm_s: place.speed_v,
            feed_mm_s: place.feed_v,
            limit: place.binding.to_string(),
            lost_s: place.lost_t,
        }
    }
}

impl DiagnosisReport {
    /// The report of what was found on a machine.
    #[must_use]
    pub fn new(summary: &Summary, config: &MachineConfig) -> Self {
        let shares = summary.shares.iter();
        let axes: Vec<_> = config.axes.iter().map(|axis| axis.axis).collect();
        let smoothness = [
            ("whole", &summary.smoothness.whole),
            ("at_feed", &summary.smoothness.at_feed),
        ];
        Self {
            binding: shares
                .map(|(binding, share)| (binding.to_string(), *share))
                .collect(),
            slowest: summary.slowest.iter().map(PlaceReport::from).collect(),
            smoothness: smoothness
                .map(|(part, figures)| (part, SmoothnessFigures::new(figures, &axes)))
                .into(),
            shape: ShapeFigures::new(&summary.shape, &axes),
        }
    }

    /// The report for people. Lines end with a line feed.
    #[must_use]
    pub fn text(&self) -> String {
        let mut shares: Vec<_> = self.binding.iter().collect();
        shares.sort_by(|a, b| b.1.total_cmp(a.1));
        let shares: Vec<_> = shares
            .into_iter()
            .filter(|(_, share)| **share >= WORTH_R)
            .map(|(limit, share)| format!("{limit} {:.1} %", share * 100.0))
            .collect();
        let mut text = format!("  bound by      {}\n", shares.join(", "));
        for place in self.slowest.iter().take(SHOWN) {
            // Writing to a String does not fail.
            let _ = writeln!(
                text,
                "  time lost     {} at line {}: {:.1} of {:.1} mm/s, bound by {}",
                seconds(place.lost_s),
                place.line,
                place.speed_mm_s,
                place.feed_mm_s,
                place.limit
            );
        }
        for (title, part) in [("smoothness", "whole"), ("  at feed", "at_feed")] {
            if let Some(figures) = self.smoothness.get(part) {
                text.push_str(&figures.text(title));
            }
        }
        text.push_str(&self.shape.text());
        text
    }
}
