//! Extreme paths and machines: nothing panics, nothing sticks, everything is kept.

use super::*;
use glidepath_geometry::feed_length;

fn drive(case: &Case) {
    let periods = case.plan();
    assert_clean(case, &periods);
}

#[test]
fn tiny_and_huge_pieces_go_together() {
    let far = [
        0.0,
        1e-9,
        1.0,
        1.0 + 1e-9,
        1.0 + 1e-7,
        1.0 + 1e-5,
        1.001,
        30.0,
        30.0,
    ];
    let points: Vec<_> = far.iter().map(|&x| (x, 0.1 * x)).collect();
    drive(&Case::mill(plane(&points)));
}

#[test]
fn a_path_may_go_back_and_forth_on_itself() {
    let points = [
        (0.0, 0.0),
        (3.0, 0.0),
        (1.0, 0.0),
        (4.0, 0.0),
        (3.99, 0.0),
        (4.0, 0.0),
        (0.0, 0.0),
    ];
    drive(&Case::mill(plane(&points)));
}

#[test]
fn tolerances_and_feeds_may_be_extreme() {
    let corner = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.3), (0.7, 0.35)];
    for tolerance_mm in [1e-4, 1.0] {
        for feed_v in [1.0, 1000.0] {
            drive(&Case {
                tolerance_mm,
                feed_v,
                ..Case::mill(plane(&corner))
            });
        }
    }
    let short = [(0.0, 0.0), (0.003, 0.0), (0.003, 0.002)];
    drive(&Case {
        feed_v: 0.01,
        ..Case::mill(plane(&short))
    });
}

#[test]
fn any_period_will_do() {
    for period_t in [2.5e-4, 1e-3, 1e-2] {
        drive(&Case {
            period_t,
            ..Case::mill(plane(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (2.0, 1.2)]))
        });
    }
}

#[test]
fn no_path_is_over_at_once() {
    let mut case = Case::mill(plane(&[(1.0, 1.0), (1.0, 1.0)]));
    assert!(case.plan().is_empty());
    case.points.truncate(1);
    assert!(case.plan().is_empty());
}

/// The same case in a unit that many times smaller. A power of two, so that every product of
/// lengths is scaled exactly, and the motions must be alike to the bit.
fn in_smaller_unit(case: &Case, factor: f64) -> Case {
    let mut scaled = case.clone();
    let limits = &mut scaled.limits;
    for of_axes in [
        &mut limits.velocity,
        &mut limits.acceleration,
        &mut limits.jerk,
    ] {
        *of_axes *= factor;
    }
    scaled.tolerance_mm *= factor;
    scaled.feed_v *= factor;
    scaled.beyond_mm *= factor;
    scaled.straight_mm = scaled.straight_mm.map(|beside_mm| beside_mm * factor);
    for point in &mut scaled.points {
        *point *= factor;
    }
    scaled
}

proptest! {
    #![proptest_config(cases(4))]
    #[test]
    fn in_another_unit_it_is_the_same_motion(seed: u64, is_light: bool) {
        let case = Case { straight_mm: Some(1e-3), ..random_case(seed, is_light) };
        let plain = case.plan();
        for factor in [1024.0, 1.0 / 1024.0] {
            let scaled = in_smaller_unit(&case, factor).plan();
            assert_eq!(plain.len(), scaled.len());
            for (a, b) in plain.iter().zip(&scaled) {
                assert_eq!(a.position * factor, b.position);
            }
        }
    }
}

#[test]
fn legs_go_to_the_very_end_of_a_last_piece_shorter_than_the_tolerance() {
    let case = Case::mill(plane(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.005)]));
    let mut planner = case.planner();
    for reference in case.references() {
        planner.push(reference);
    }
    planner.finish();
    let leg = planner.state.leg_from(case.points[0], 0).expect("a leg");
    planner.state.active = ActiveMotion::Legs {
        leg: Some(Box::new(leg)),
        leg_t: 0.0,
        wait: usize::MAX,
        is_stale: false,
    };
    let periods: Vec<_> = core::iter::from_fn(|| planner.next_period()).collect();
    assert_clean(&case, &periods);
    assert_eq!(
        periods.last().map(|last| last.position),
        Some(case.points[2])
    );
}

#[test]
fn nine_axes_go_together() {
    let mut points = vec![AxisVector::zeros()];
    for (k, length) in [3.0, 0.4, 5.0, 2.0].into_iter().enumerate() {
        let step = AxisVector::from_fn(|i, _| f64::from(((i + 2) * (k + 3) % 7) as u8) / 3.0 - 1.0);
        points.push(points[k] + step * length);
    }
    let case = Case::mill(points);
    let periods = case.plan();
    assert_clean(&case, &periods);
    assert!((periods.len() as f64) * case.period_t < 0.95 * bench::exact_stop_t(&case));
}

#[test]
fn pieces_may_be_metres_long() {
    let case = Case {
        feed_v: 200.0,
        ..Case::mill(plane(&[(0.0, 0.0), (1e4, 0.0), (1e4, 30.0), (9e3, 31.0)]))
    };
    let periods = case.plan();
    assert_clean(&case, &periods);
    assert!((periods.len() as f64) * case.period_t < bench::exact_stop_t(&case));
}

/// A thousandth of it, or all of it with `GLIDEPATH_LONG`.
#[test]
fn a_hundred_thousand_blocks_go_through() {
    let is_long = std::env::var_os("GLIDEPATH_LONG").is_some();
    let count = if is_long { 100_000 } else { 100 };
    let points: Vec<_> = (0..=count)
        .map(|k| {
            let x = f64::from(k);
            (0.4 * x, 0.3 * (0.7 * x).sin() + 0.1 * f64::from(k % 3))
        })
        .collect();
    let case = Case::mill(plane(&points));
    let mut planner = case.planner();
    let mut periods = Vec::new();
    for reference in case.references() {
        planner.push(reference);
        periods.extend(core::iter::from_fn(|| planner.next_period()));
        assert!(planner.state.reference_path.end() - planner.state.follower.first() < 2000);
    }
    planner.finish();
    periods.extend(core::iter::from_fn(|| planner.next_period()));
    assert_clean(&case, &periods);
}

/// Chords of a helix, slower than it needs any axis to be.
#[test]
fn a_slow_helix_is_passed_without_stops() {
    let points = (0..=40).map(|k| {
        let angle = 0.0345 * f64::from(k);
        let mut point = AxisVector::zeros();
        (point[0], point[1]) = (-7.0 * angle.sin(), 7.0 * angle.cos());
        point[2] = -0.0219 * f64::from(k);
        point
    });
    let case = Case {
        feed_v: 100.0 / 60.0,
        tolerance_mm: 0.019,
        ..Case::mill(points.collect())
    };
    let periods = case.plan();
    assert_clean(&case, &periods);
    let length_s = 40.0 * feed_length(&(case.points[1] - case.points[0]));
    let time = periods.len() as f64 * case.period_t;
    let feed_t = length_s / case.feed_v;
    assert!(time < feed_t + 0.05, "{time} s, {feed_t} s at the feed");
}
