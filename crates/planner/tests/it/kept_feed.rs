//! Tests of effort "optimal" where nothing but the feed binds: a move that has come to its feed is run at it to its end.

use crate::support::family::audited;
use glidepath_audit::ViolationKind;
use glidepath_program::{Corners, DirectionTolerance, Effort, Limits, Settings, Smoothing};

/// How often the motion slows down in the middle of a move, with where and to what.
#[track_caller]
fn keeps_the_feed(text: &str) {
    let settings = Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: Corners::Inner,
        period_t: 0.004,
        effort: Effort::Optimal,
    };
    let report = audited("kept feed", text, settings, |_| {});
    let slow = report
        .tremors
        .iter()
        .filter(|tremor| matches!(tremor.kind, ViolationKind::SlowedDown { .. }));
    let slow: Vec<_> = slow.collect();
    assert!(slow.is_empty(), "{slow:#?}");
}

/// A plate with a half circle out of each corner. Up to 60° from the corner in front of it the motion is to be outside
/// of the circle, then it may cut it: where the border ended at once, no window at the feed led past that end, and the
/// motion went down to 15.8 of 20 mm/s.
#[test]
fn half_circles_out_of_corners_are_run_at_the_feed() {
    keeps_the_feed(
        "G21 G90 G64\nG0 Z5\nG0 X0 Y5.5255\nG1 Z-0.8 F300\nF1200\nG1 X0 Y45.4745\n\
         G2 X4.5255 Y50 I2.2627 J2.2627\nG1 X65.4745\nG2 X70 Y45.4745 I2.2627 J-2.2627\nG1 Y5.5255\n\
         G2 X65.4745 Y1 I-2.2627 J-2.2627\nG1 X10\nM2\n",
    );
}

/// A row of a relief in arcs and lines. The corner at the end of a bend came into sight when the motion was behind the
/// middle of it, and on the outer side of that corner: it had to stop there.
#[test]
fn a_bend_whose_end_is_seen_late_is_run_at_the_feed() {
    keeps_the_feed(
        "G21 G90 G18 G64\nG0 X49.2 Y40 Z0\nG1 Z-4.0471 F600\nF1200\n\
         X48.4 Z-4.1882\nX48 Z-4.2353\nX47.6 Z-4.3765\nG3 X46.8 Z-4.7294 I-2.1491 K3.7882\nG1 X46.6 Z-4.7765\n\
         X46.2 Z-4.8\nG2 X45.8 Z-4.7294 I-0.5083 K-1.7118\nG1 X44.6 Z-4.3765\nX42.8 Z-3.9765\nX42 Z-3.6941\n\
         G2 X41.6 Z-3.5294 I-1.0163 K-1.9\nG1 X41.4 Z-3.4118\nX40.2 Z-2.9176\nG3 X39.4 Z-2.6588 I0.7914 K3.8118\n\
         G3 X38.8 Z-2.4235 I0.8661 K3.0912\nG2 X38 Z-2.2353 I-1.2415 K-3.4824\n\
         G3 X36.6 Z-2.0941 I0.5083 K12.0529\nG1 X36.2 Z-2\nX35.2 Z-1.8824\nX35 Z-1.8118\nX34.8\nX34.6 Z-1.7647\n\
         X34.2\nX33.8 Z-1.6706\nX33 Z-1.6235\nG0 Z5\nM2\n",
    );
}

/// An arc at 5 mm/s from a corner on. Windows were tried while a leg to the end of a chord was about to come to the feed,
/// and were faster than that at once: all legs were driven, each to its stop.
#[test]
fn an_arc_that_begins_with_legs_is_run_at_the_feed() {
    keeps_the_feed(
        "G20 G90 G64 P0.001\nG0 Z0.1\nG18 F12\nG0 X-0.1225 Y1.152\nG2 X0 Z0 R0.125\nF40\nG1 X2.264\nF12\n\
         G0 Z0.1\nX-0.1225 Y1.12\nG2 X0 Z0 R0.125\nF40\nG1 X2.264\nG0 Z0.1\nM2\n",
    );
}
