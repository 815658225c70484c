//! The published pair of rational cubics: its curvature and where that is smooth.

use glidepath_geometry::{AxisVector, Jet, PairShape, Transition, Turn};

fn planar(theta: f64) -> (AxisVector, AxisVector) {
    let mut t1 = AxisVector::zeros();
    let mut t2 = AxisVector::zeros();
    t1[0] = 1.0;
    (t2[0], t2[1]) = (theta.cos(), theta.sin());
    (t1, t2)
}

fn planar_curvature(jet: &Jet) -> f64 {
    (jet.d1[0] * jet.d2[1] - jet.d1[1] * jet.d2[0]) / jet.d1.norm().powi(3)
}

#[test]
fn the_cubic_pair_is_one_cubic() {
    let (t1, t2) = planar(1.2);
    let pair = Transition::bezier_pair(AxisVector::zeros(), t1, t2, 2.0, PairShape::CUBIC);
    let Ok(Transition::BezierPair(pair)) = pair else {
        unreachable!("not a reversal")
    };
    for i in 0..=20 {
        let u = f64::from(i) / 20.0;
        let s = if u <= 0.5 {
            pair.arc_length_at(2.0 * u)
        } else {
            pair.length() - pair.arc_length_at(2.0 - 2.0 * u)
        };
        let want = t1 * (-2.0 * (1.0 - u).powi(3)) + t2 * (2.0 * u.powi(3));
        assert!((pair.jet(s).position - want).norm() < 1e-13, "u {u}");
    }
}

#[test]
fn curvature_of_the_cubic_pair_peaks_at_the_junction() {
    for degrees in 1..179 {
        let (t1, t2) = planar(f64::from(degrees).to_radians());
        let turn = Turn::between(&t1, &t2);
        let pair = Transition::bezier_pair(AxisVector::zeros(), t1, t2, 1.0, PairShape::CUBIC);
        let Ok(Transition::BezierPair(pair)) = pair else {
            unreachable!("not a reversal")
        };
        let peak = PairShape::CUBIC.junction_curvature(1.0, turn);
        for i in 0..=100 {
            let s = pair.arc_length_at(f64::from(i) / 100.0);
            assert!(
                planar_curvature(&pair.jet(s)) <= peak * (1.0 + 1e-11),
                "{degrees} {i}"
            );
        }
    }
}

/// Shapes on both sides of the smooth family, and where its curvature peaks.
#[test]
fn only_the_family_is_smooth_at_the_junction() {
    let turn = Turn::between(&planar(1.0).0, &planar(1.0).1);
    for s1 in [0.05, 0.2, 0.6, 1.0, 2.0, 3.5] {
        let smooth = PairShape {
            s1,
            s2: 3.0 / (4.0 - s1),
        };
        assert!(smooth.is_smooth_at_junction());
        assert!(
            smooth.junction_curvature_rate(1.0, turn).abs() < 1e-13 * smooth.s2.powi(2) * 100.0
        );
        for factor in [0.9, 1.1] {
            let other = PairShape {
                s1,
                s2: smooth.s2 * factor,
            };
            assert!(!other.is_smooth_at_junction());
        }
    }
    // The conditions printed for the pair accept this one; its curvature has a corner.
    let printed = PairShape { s1: 0.5, s2: 1.0 };
    assert!(!printed.is_smooth_at_junction());
    let (t1, t2) = planar(1.0);
    let pair = Transition::bezier_pair(AxisVector::zeros(), t1, t2, 1.0, printed);
    let Ok(pair) = pair else {
        unreachable!("not a reversal")
    };
    let middle = 0.5 * pair.length();
    let h = 1e-6;
    let k = |s: f64| planar_curvature(&pair.jet(s));
    let rates = [
        (k(middle) - k(middle - h)) / h,
        (k(middle + h) - k(middle)) / h,
    ];
    let formula = 16.0 / 3.0 * turn.sb / turn.cb.powi(3);
    assert!((printed.junction_curvature_rate(1.0, turn) / formula - 1.0).abs() < 1e-12);
    assert!(
        (rates[0] / formula - 1.0).abs() < 1e-3,
        "{rates:?} {formula}"
    );
    assert!(
        (rates[1] / formula + 1.0).abs() < 1e-3,
        "{rates:?} {formula}"
    );
}

#[test]
fn the_test_for_a_peak_at_the_junction_is_right() {
    for s1 in [0.02_f64, 0.1, 0.2, 0.3, 0.4] {
        let shape = PairShape {
            s1,
            s2: 3.0 / (4.0 - s1),
        };
        for degrees in [1.0_f64, 5.0, 10.0, 15.0, 25.0, 60.0] {
            let (t1, t2) = planar(degrees.to_radians());
            let turn = Turn::between(&t1, &t2);
            let pair = Transition::bezier_pair(AxisVector::zeros(), t1, t2, 1.0, shape);
            let Ok(Transition::BezierPair(pair)) = pair else {
                unreachable!("not a reversal")
            };
            let highest = (0..=2000)
                .map(|i| planar_curvature(&pair.jet(pair.arc_length_at(f64::from(i) / 2000.0))))
                .fold(0.0, f64::max);
            let excess = highest / shape.junction_curvature(1.0, turn) - 1.0;
            let peaks = excess < 1e-8;
            assert_eq!(
                peaks,
                shape.peaks_at_junction(turn),
                "s1 {s1}, {degrees}: {excess:e}"
            );
            assert!(excess < 0.003);
        }
    }
}
