//! The smoothness figures of a motion in reports.

use super::quantity::{counted, grouped};
use core::fmt::Write as _;
use glidepath_audit::smoothness::{Figures, RINGING_HZ};
use glidepath_geometry::Axis;
use serde::Serialize;
use std::collections::BTreeMap;

/// The smoothness of a motion, or of a part of it.
#[derive(Debug, Clone, Serialize)]
pub struct SmoothnessFigures {
    /// Number of periods.
    pub periods: u64,
    /// Mean distance from the programmed path at the setpoints, mm.
    pub mean_deviation_mm: f64,
    /// Rms distance from the programmed path at the setpoints, mm.
    pub rms_deviation_mm: f64,
    /// By axis letter.
    pub axes: BTreeMap<String, AxisFigures>,
}

/// The smoothness of an axis; degrees instead of mm where it is rotary.
#[derive(Debug, Clone, Serialize)]
pub struct AxisFigures {
    /// The unit of its position: "mm" or "°".
    #[serde(skip)]
    pub unit: &'static str,
    /// Rms jerk, mm/s³.
    pub rms_jerk: f64,
    /// Largest jerk, mm/s³.
    pub peak_jerk: f64,
    /// Rms acceleration above 30 Hz, mm/s².
    pub acceleration_above_30_hz: f64,
    /// How often the axis turned round.
    pub reversals: u64,
}

impl SmoothnessFigures {
    /// The figures of the axes that a machine has.
    #[must_use]
    pub fn new(figures: &Figures, axes: &[Axis]) -> Self {
        let of = |axis: &Axis| {
            let index = axis.index();
            let figures = AxisFigures {
                unit: if axis.is_rotary() { "°" } else { "mm" },
                rms_jerk: figures.rms_jerk_j[index],
                peak_jerk: figures.peak_jerk_j[index],
                acceleration_above_30_hz: figures.ringing_a[index],
                reversals: figures.reversals[index],
            };
            (axis.to_string(), figures)
        };
        Self {
            periods: figures.periods,
            mean_deviation_mm: figures.mean_deviation_mm,
            rms_deviation_mm: figures.rms_deviation_mm,
            axes: axes.iter().map(of).collect(),
        }
    }

    /// The figures for people, a line an axis; nothing where there are no periods.
    pub(super) fn text(&self, title: &str) -> String {
        let mut text = String::new();
        if self.periods == 0 {
            return text;
        }
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "rounded, for display; a cast saturates"
        )]
        let whole = |value: f64| grouped(value.round() as u64);
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "  {title:<13} {} setpoints, off the path by {:.4} mm in the mean, {:.4} rms",
            grouped(self.periods),
            self.mean_deviation_mm,
            self.rms_deviation_mm
        );
        for (axis, figures) in &self.axes {
            let unit = figures.unit;
            let _ = writeln!(
                text,
                "    {axis}           jerk {} {unit}/s³ rms, {} peak; acceleration above {RINGING_HZ} Hz {:.1} {unit}/s² rms; {}",
                whole(figures.rms_jerk),
                whole(figures.peak_jerk),
                figures.acceleration_above_30_hz,
                counted(figures.reversals, "reversal")
            );
        }
        text
    }
}
