//! Tests of NURBS cut into pieces by path position: near the curve, smooth, of unit speed.

#![allow(
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails may panic"
)]

use crate::support;

use crate::support::definition;
use glidepath_geometry::{AxisVector, Nurbs, NurbsPath, Segment};
use proptest::prelude::*;

fn path(name: &str) -> NurbsPath {
    let (degree, points, weights, knots) = definition(name);
    NurbsPath::new(Nurbs::new(degree, &points, &weights, &knots).expect("valid"))
}

/// What rounding of path positions of a few hundred millimetres makes of a place.
const ROUNDING_MM: f64 = 2e-10;

/// Path position, near one, where the curve comes nearest to a point.
fn next_to(path: &NurbsPath, point: &AxisVector, near_s: f64) -> f64 {
    let mut s = near_s;
    for _ in 0..4 {
        let here = path.jet(s);
        s += (point - here.position).dot(&here.d1);
    }
    let gap_mm = |s: f64| (point - path.jet(s).position).norm();
    if gap_mm(s) < gap_mm(near_s) {
        s
    } else {
        near_s
    }
}

/// Checks the segments of a curve at many places; gives how many there are.
fn judge(path: &NurbsPath, tolerance_mm: f64) -> usize {
    let segments = path.segments(tolerance_mm);
    let mut s = 0.0;
    // How far path positions of the segments may be from those of the curve.
    let mut slack_mm = 2.0 * tolerance_mm;
    let mut at = path.jet(0.0).position;
    for segment in &segments {
        assert_eq!(segment.start(), at, "a gap");
        let length = segment.length();
        for k in 0..=64 {
            let share = f64::from(k) / 64.0;
            let here = segment.jet(share * length);
            let exact_s = next_to(path, &here.position, s + share * length);
            assert!((exact_s - s - share * length).abs() <= slack_mm, "at {s}");
            let gap_mm = (here.position - path.jet(exact_s).position).norm();
            if let Segment::Curve(curve) = segment {
                assert!(gap_mm <= curve.error_mm + ROUNDING_MM, "{gap_mm} at {s}");
                assert!(
                    (here.d1.norm() - 1.0).abs() < 5e-5,
                    "speed {}",
                    here.d1.norm()
                );
            }
            assert!(
                gap_mm <= tolerance_mm + ROUNDING_MM,
                "{gap_mm} of {tolerance_mm} at {s}"
            );
            let (low, high) = segment.bounding_box();
            let slack = AxisVector::repeat(1e-12 * (1.0 + here.position.amax()));
            assert!(here.position >= low - slack && here.position <= high + slack);
        }
        s += length;
        at = segment.end();
        if matches!(segment, Segment::Line(_)) {
            // Next to a cusp: shorter than the curve, which goes there and back.
            slack_mm += 2.0 * tolerance_mm;
        }
    }
    assert!(
        (s - path.length()).abs() < slack_mm + 1e-9 * (1.0 + s),
        "{s}"
    );
    assert!((at - path.jet(path.length()).position).norm() < 1e-12);
    segments.len()
}

#[test]
fn the_reference_curves_are_met_everywhere_with_few_pieces() {
    // Published: 574 pieces of this kind for the butterfly at a micrometre of a thousandth.
    for (name, most) in [
        ("butterfly", 620),
        ("star", 440),
        ("helix3d", 170),
        ("infinity", 290),
        ("needle", 60),
        ("circle", 80),
    ] {
        let count = judge(&path(name), 1e-6);
        assert!(count <= most, "{name}: {count} pieces");
    }
}

#[test]
fn pieces_of_a_smooth_curve_join_without_a_step_in_direction_or_curvature() {
    let segments = path("helix3d").segments(1e-6);
    for pair in segments.windows(2) {
        let (end, start) = (pair[0].jet(pair[0].length()), pair[1].jet(0.0));
        assert!((end.d1 - start.d1).norm() < 1e-11);
        assert!((end.d2 - start.d2).norm() < 1e-9);
    }
}

#[test]
fn derivatives_are_those_of_the_positions_and_stay_within_their_bounds() {
    for segment in path("star").segments(1e-5) {
        let Segment::Curve(curve) = segment else {
            panic!("smooth");
        };
        let bounds = curve.bounds();
        let h = 1e-4 * curve.length;
        for k in 1..20 {
            let s = curve.length * f64::from(k) / 20.0;
            let [before, here, after] = [s - h, s, s + h].map(|s| curve.jet(s));
            let first = (after.position - before.position) / (2.0 * h);
            assert!(
                (first - here.d1).norm() < 1e-6,
                "{}",
                (first - here.d1).norm()
            );
            let second = (after.d1 - before.d1) / (2.0 * h);
            assert!((second - here.d2).norm() < 1e-5 * (1.0 + here.d2.norm()));
            let third = (after.d2 - before.d2) / (2.0 * h);
            assert!((third - here.d3).norm() < 1e-4 * (1.0 + here.d3.norm()));
            assert!(here.d1.abs() <= bounds.d1 * (1.0 + 1e-12));
            assert!(here.d2.abs() <= bounds.d2 * (1.0 + 1e-12));
            assert!(here.d3.abs() <= bounds.d3 * (1.0 + 1e-12));
        }
        let middle = 0.3 * curve.length;
        let rest = curve.after(middle, curve.jet(middle).position);
        let at = 0.4 * curve.length;
        let gap = rest.jet(at).position - curve.jet(middle + at).position;
        assert!(gap.norm() < 1e-12, "{}", gap.norm());
    }
}

#[test]
fn curves_with_rotary_axes_come_in_chords() {
    let (degree, mut points, weights, knots) = definition("infinity");
    for (point, angle) in points
        .iter_mut()
        .zip([0.0, 30.0, 10.0, 90.0, 70.0, 20.0, 45.0])
    {
        point[3] = angle;
    }
    let path = NurbsPath::new(Nurbs::new(degree, &points, &weights, &knots).expect("valid"));
    let segments = path.segments(0.01);
    assert!(segments.iter().all(|s| matches!(s, Segment::Line(_))));
    // Both the linear and the rotary axes are near the curve.
    let mut s = 0.0;
    for segment in &segments {
        let length = segment.length();
        let middle = path.jet(s + 0.5 * length).position;
        let gap = middle - segment.jet(0.5 * length).position;
        assert!(gap.amax() < 0.02, "{}", gap.amax());
        s += length;
    }
    assert!(s <= path.length() && s > 0.9999 * path.length(), "{s}");
}

#[test]
fn a_small_curve_comes_in_few_pieces() {
    // A bend that is nearly a cusp, from kilometres down to ten nanometres.
    let shape = [[0.0, 0.0], [1.0, 1.0], [2.0, 1.0], [1.0, 1.0]];
    for size_mm in [1e-5, 1e-4, 1e-3, 1e-2, 1.0, 1e3] {
        let points = shape.map(|[x, y]| {
            let mut point = AxisVector::zeros();
            (point[0], point[1]) = (x * size_mm, y * size_mm);
            point
        });
        let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
        let path = NurbsPath::new(Nurbs::new(3, &points, &[1.0; 4], &knots).expect("valid"));
        let segments = path.segments(1e-3);
        assert!(segments.len() < 200, "{} of {size_mm} mm", segments.len());
        assert!(segments.iter().all(|s| matches!(s, Segment::Curve(_))));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn random_curves_are_met_everywhere(definition in support::random_definition()) {
        let (degree, points, weights, knots) = definition;
        // A span of one point, which only shrinking makes.
        let Ok(curve) = Nurbs::new(degree, &points, &weights, &knots) else {
            return Ok(());
        };
        judge(&NurbsPath::new(curve), 1e-5);
    }
}
