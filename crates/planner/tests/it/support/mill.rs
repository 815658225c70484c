//! A milling machine with a period of 4 ms.

use glidepath_program::{Effort, Limits, Settings, Smoothing};

pub(crate) fn mill(effort: Effort) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort,
    }
}
