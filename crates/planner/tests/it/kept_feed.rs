//! Tests of effort "optimal" where nothing but the feed binds: a move that has come to its feed is run at it to its end.

use crate::support::family::audited;
use glidepath_audit::ViolationKind;
use glidepath_program::{Corners, DirectionTolerance, Effort, Limits, Settings, Smoothing};

/// A row of a relief, in arcs and lines.
const ROW: &str = "G21
G0 Z3.0000
G17 G40
G80 G90 G94
S12000 M3
G64 P0.0200
F1200.0000
G18
F300.0000
G0 X51.9250 Y40.0000
G1 Z-4.2985
G3 X51.800000 Z-4.423530 R0.125000
F1200.0000
G1 X51.6000 Z-4.4706
 X51.2000 Z-4.4941
 X50.6000 Z-4.4706
 X49.2000 Z-4.3294
 X49.0000 Z-4.2588
 X48.4000 Z-4.1882
 X48.0000 Z-4.2353
 X47.6000 Z-4.3765
G3 X46.8000 Y40.0000 Z-4.7294 I-2.1491 K3.7882
G1 X46.6000 Z-4.7765
 X46.2000 Z-4.8000
G2 X45.8000 Y40.0000 Z-4.7294 I-0.5083 K-1.7118
G1 X44.6000 Z-4.3765
 X42.8000 Z-3.9765
 X42.0000 Z-3.6941
G2 X41.6000 Y40.0000 Z-3.5294 I-1.0163 K-1.9000
G1 X41.4000 Z-3.4118
 X40.2000 Z-2.9176
G3 X39.4000 Y40.0000 Z-2.6588 I0.7914 K3.8118
G3 X38.8000 Y40.0000 Z-2.4235 I0.8661 K3.0912
G2 X38.0000 Y40.0000 Z-2.2353 I-1.2415 K-3.4824
G3 X36.6000 Y40.0000 Z-2.0941 I0.5083 K12.0529
G1 X36.2000 Z-2.0000
 X35.2000 Z-1.8824
 X35.0000 Z-1.8118
 X34.8000
 X34.0000 Z-1.6471
 X33.6000 Z-1.6000
 X32.8000 Z-1.6471
 X32.0000 Z-1.8353
M2
";

/// The first rows of another one, in inches, each with an arc to its depth.
const ROWS: &str = "G20 G90
G0 Z0.1000
G64 P0.0010
F40.0000
G18
F12.0000
G0 X-0.1225 Y1.1520
G2 X0.000000 Z0.000000 R0.125000
F40.0000
G1 X2.2640
F12.0000
G0 Z0.1000
 X-0.1225 Y1.1200
G2 X0.000000 Z0.000000 R0.125000
F40.0000
G1 X2.2640
F12.0000
G0 Z0.1000
 X-0.1225 Y1.0880
G2 X0.000000 Z0.000000 R0.125000
M2
";

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

/// The corner at the end of a bend came into sight when the motion was behind the
/// middle of it, and on the outer side of that corner: it had to stop there.
#[test]
fn a_bend_whose_end_is_seen_late_is_run_at_the_feed() {
    keeps_the_feed(ROW);
}

/// An arc at 5 mm/s from a corner on. Windows were tried while a leg to the end of a chord was about to come to the feed,
/// and were faster than that at once: all legs were driven, each to its stop.
#[test]
fn an_arc_that_begins_with_legs_is_run_at_the_feed() {
    keeps_the_feed(ROWS);
}
