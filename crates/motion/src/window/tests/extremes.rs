//! Extreme paths and machines: nothing panics, nothing sticks, everything is kept.

use super::*;

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

#[test]
fn in_micrometres_the_same_motion_takes_the_same_time() {
    let case = Case::mill(plane(&[
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (3.0, 1.3),
        (3.1, 0.0),
    ]));
    let mut scaled = case.clone();
    scaled.limits = Limits::uniform(200e3, 2000e3, 40_000e3);
    scaled.tolerance_mm *= 1e3;
    scaled.feed_v *= 1e3;
    for point in &mut scaled.points {
        *point *= 1e3;
    }
    assert_eq!(case.plan().len(), scaled.plan().len());
}
