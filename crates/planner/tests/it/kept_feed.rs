//! Tests of effort "optimal" where nothing but the feed binds: a move that has come to its feed is run at it to its end.

use crate::support::family::audited;
use glidepath_audit::ViolationKind;
use glidepath_geometry::AxisVector;
use glidepath_program::{Corners, DirectionTolerance, Effort, Limits, Settings, Smoothing, Travel};

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

/// A mill, with ends of travel if there are any.
fn mill(travel: Option<Travel>) -> Settings {
    let mut limits = Limits::uniform(200.0, 2000.0, 40_000.0);
    limits.travel = travel.unwrap_or(limits.travel);
    Settings {
        limits,
        tolerance_mm: 0.02,
        direction: DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: Corners::Inner,
        period_t: 0.004,
        effort: Effort::Optimal,
    }
}

/// That the motion slows down nowhere in the middle of a move.
#[track_caller]
fn keeps_the_feed(text: &str) {
    keeps_the_feed_with(text, mill(None));
}

#[track_caller]
fn keeps_the_feed_with(text: &str, settings: Settings) {
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

/// Lines of 1.4 mm between corners: X goes 1.4 µm back along the third, and the motion is 7.5 µm beside it, on the inner
/// side of the corner before. It was not to turn round there, so no window found the inner side of the next corner, and
/// it stopped.
#[test]
fn an_axis_beyond_the_end_of_its_run_may_come_back() {
    let mut travel = Travel {
        lowest: AxisVector::zeros(),
        highest: AxisVector::zeros(),
    };
    travel.lowest[0] = -51.593_786;
    travel.highest[1] = 101.230_482;
    travel.highest[2] = 15.573_872;
    keeps_the_feed_with(
        "G21 G90 G94 G17 F328\nG1 X-51.304599 Y72.668246 Z6.529558\nG1 X-51.593786 Y73.309075 Z6.721894\n\
         G1 X-49.797322 Y91.983160 Z15.573872\nG1 X-49.378367 Y93.354362 Z15.248732\n\
         G1 X-49.379747 Y94.752028 Z14.672637\nG1 X-49.203881 Y97.372399 Z14.672637\n\
         G1 X-49.119390 Y97.849311 Z14.672637\nG1 X-46.505537 Y100.670380 Z14.672637\n\
         G1 X-46.375257 Y101.230482 Z14.204981\nM2\n",
        mill(Some(travel)),
    );
}

/// A line that X goes with A. A was ahead of X by half the tolerance behind the corner, which counted as progress, until
/// the next window took it back with a jerk.
#[test]
fn a_rotary_axis_that_is_ahead_gains_nothing() {
    let text = "G21 G90 G94 G17 F742\nG1 X6.33387 Y-0.75935 A0\nG1 X7.23763 Y-0.38892\n\
                G1 X22.51367 A-13.1396\nM2\n";
    let report = audited("ahead", text, mill(None), |_| {});
    assert!(report.tremors.is_empty(), "{:#?}", report.tremors);
}

/// X goes 10 µm while A turns by 20°, as fast as it can. X may be as fast as the feed allows beside that: it could not
/// come back to its line, and windows led nowhere.
#[test]
fn what_a_rotary_axis_holds_up_does_not_bind_the_others() {
    let text = "G21 G90 G94 G17 F3209\nG1 A69.25231\nG1 A80.04606\nG1 X0.01064 A60.58166\nG1 A-61.50708\n\
                G1 X0.13262 A-59.97085\nG1 X5.35468 A-72.3381\nG1 A-900\nM2\n";
    let mut travel = Travel {
        lowest: AxisVector::zeros(),
        highest: AxisVector::zeros(),
    };
    (travel.lowest[3], travel.highest[3], travel.highest[0]) = (-900.0, 80.04606, 5.35468);
    let mut limits = Limits::uniform(100.0, 10_000.0, 1e6);
    limits.travel = travel;
    let periods = |effort| {
        let settings = Settings {
            limits,
            tolerance_mm: 0.05,
            effort,
            ..mill(None)
        };
        let mut count = 0_u32;
        let report = audited("held up", text, settings, |_| count += 1);
        assert!(report.is_clean(), "{report:#?}");
        count
    };
    let (optimal, fast) = (periods(Effort::Optimal), periods(Effort::Fast));
    assert!(optimal <= fast, "{optimal} periods, fast {fast}");
}
