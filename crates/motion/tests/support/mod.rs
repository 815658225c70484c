//! The helpers of tests of whole plans.

#![allow(dead_code, reason = "each test binary uses a part of it")]

use glidepath_geometry::AxisVector;
use glidepath_program::{Effort, Limits, PathMode, Settings, Smoothing};
use proptest::prelude::ProptestConfig;

/// G64 without P.
pub(crate) const FREE: PathMode = PathMode::Continuous { tolerance_mm: None };

/// A milling machine with a period of 4 ms.
pub(crate) fn mill() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Sextic,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Fast,
    }
}

/// The same machine planned with either effort.
pub(crate) fn efforts() -> [Settings; 2] {
    [mill(), optimal()]
}

/// The same machine planned optimally.
pub(crate) fn optimal() -> Settings {
    Settings {
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        effort: Effort::Optimal,
        ..mill()
    }
}

/// A point in the XY plane.
pub(crate) fn at(x: f64, y: f64) -> AxisVector {
    let mut point = AxisVector::zeros();
    point[0] = x;
    point[1] = y;
    point
}

/// A seeded sample for every run; `PROPTEST_CASES` sets how many for a long one.
pub(crate) fn cases(number: u32) -> ProptestConfig {
    let long = std::env::var_os("PROPTEST_CASES").is_some();
    if long {
        ProptestConfig::default()
    } else {
        ProptestConfig::with_cases(number)
    }
}
