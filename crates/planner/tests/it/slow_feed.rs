//! Tests of effort "optimal" where the feed is slow beside the tolerance: engraving, plunges from
//! rapid moves.

#![allow(
    clippy::expect_used,
    reason = "test code, which clippy does not see as such"
)]

use crate::support::family::audited;
use glidepath_program::{Effort, Limits, Settings, Smoothing};
use std::fmt::Write as _;

/// Short strokes at 2.5 mm/s, which is a tolerance in 8 ms, and a rapid move with a plunge to each
/// figure.
fn engraving() -> String {
    let mut text = "G21 G90 G94 G17 G64 P0.02 F150\nG0 X0 Y0 Z2\n".to_owned();
    for figure in 0..6_u32 {
        let turn = |k: u32| f64::from(7 * figure + k) * 2.4;
        let at = f64::from(figure);
        let (mut x, mut y) = (1.3 * at, 4.0 * turn(0).sin());
        writeln!(text, "G0 X{x:.3} Y{y:.3}\nG1 Z0").expect("a string");
        for k in 1..=6 {
            let (sin, cos) = turn(k).sin_cos();
            x += 0.3 * cos;
            y += 0.3 * sin;
            writeln!(text, "G1 X{x:.3} Y{y:.3} Z{:.3}", -0.1 + 0.1 * sin).expect("a string");
        }
        text.push_str("G0 Z2\n");
    }
    text
}

/// A slow motion can go anywhere in the tube between two samples on its way; for want of one that
/// passes it would stop at each corner.
#[test]
fn slow_strokes_do_not_stop_at_every_corner() {
    let settings = |effort| Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort,
    };
    let text = engraving();
    let time = |effort| audited("engraving", &text, settings(effort), |_| {}).cycle_time_s;
    let ratio = time(Effort::Optimal) / time(Effort::Fast);
    assert!(ratio < 0.95, "{ratio:.4} of the time on the given path");
}
