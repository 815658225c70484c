//! Tests of properties of the transitions over all nine axes.

use glidepath_geometry::{
    AXES, AxisVector, Blend, Jet, LINEAR_XYZ, PairShape, Transition, Turn, feed_length,
    limit_along, tolerance_half_turn,
};
use proptest::prelude::*;

fn vector(range: core::ops::Range<f64>) -> impl Strategy<Value = AxisVector> {
    prop::array::uniform9(range).prop_map(|a| AxisVector::from_column_slice(&a))
}

/// A direction of unit feed length: XYZ always moves, other axes at times.
fn direction() -> impl Strategy<Value = AxisVector> {
    (vector(-1.0..1.0), prop::array::uniform9(any::<bool>())).prop_filter_map(
        "too short",
        |(mut v, keep)| {
            for axis in 3..AXES {
                if !keep[axis] {
                    v[axis] = 0.0;
                }
            }
            (v.rows(0, 3).norm() > 0.1).then(|| v / feed_length(&v))
        },
    )
}

fn corner() -> impl Strategy<Value = (AxisVector, AxisVector, AxisVector, f64)> {
    (vector(-300.0..300.0), direction(), direction(), 0.01..5.0)
}

/// The curves by arc length have no limit of sharpness but the reversal; at 170° their own figures
/// span four orders of magnitude, which is enough to ask of a finite difference.
fn all_families(p: AxisVector, t1: AxisVector, t2: AxisVector, d: f64) -> Vec<Transition> {
    let mut all = vec![Transition::sextic(p, t1, t2, d)];
    if Turn::between(&t1, &t2).cb > 0.09 {
        for shape in [
            PairShape::CUBIC,
            PairShape::SMOOTH,
            PairShape { s1: 0.5, s2: 1.0 },
        ] {
            all.extend(Transition::bezier_pair(p, t1, t2, d, shape));
        }
    }
    // A bend at the start, as where an arc arrives.
    let bend = (t2 - t1 * t1.dot(&t2) / t1.norm_squared()) * (0.3 / d);
    let from = Jet {
        position: p - t1 * d,
        d1: t1,
        d2: bend,
        d3: t1 * (-0.1 / (d * d)),
    };
    let to = Jet {
        position: p + t2 * d,
        d1: t2,
        d2: bend * 0.5,
        d3: bend * (0.2 / d),
    };
    all.push(Transition::hermite(&from, &to, 2.0 * d));
    all
}

proptest! {
    #[test]
    fn meet_the_lines((p, t1, t2, d) in corner()) {
        for curve in all_families(p, t1, t2, d) {
            let (start, end) = (curve.jet(0.0), curve.jet(curve.length()));
            prop_assert!((start.position - (p - t1 * d)).amax() < 1e-12);
            prop_assert!((end.position - (p + t2 * d)).amax() < 1e-12);
            prop_assert!((start.d1 - t1).amax() < 1e-10 * t1.amax());
            prop_assert!((end.d1 - t2).amax() < 1e-10 * t2.amax());
            if !matches!(curve, Transition::Hermite(_)) {
                prop_assert!(start.d2.amax() < 1e-9 / d && end.d2.amax() < 1e-9 / d);
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_position((p, t1, t2, d) in corner(), x in 0.01..0.99_f64) {
        for curve in all_families(p, t1, t2, d) {
            let bounds = curve.bounds();
            let length = curve.length();
            // Away from the junction of the pair, where its third derivative may jump.
            if (x - 0.5).abs() < 0.01 {
                continue;
            }
            let s = x * length;
            let h = 2e-6 * length;
            let (before, at, after) = (curve.jet(s - h), curve.jet(s), curve.jet(s + h));
            for axis in 0..AXES {
                for (low, value, high, scale) in [
                    (before.position, at.d1, after.position, bounds.d1),
                    (before.d1, at.d2, after.d1, bounds.d2),
                    (before.d2, at.d3, after.d2, bounds.d3),
                ] {
                    let difference = (high[axis] - low[axis]) / (2.0 * h);
                    let rounding = 1e-15 * (1.0 + low[axis].abs().max(high[axis].abs())) / h;
                    prop_assert!(
                        (difference - value[axis]).abs() <= 1e-4 * scale[axis] + 2.0 * rounding,
                        "axis {axis}: {difference} against {} (scale {})", value[axis], scale[axis]
                    );
                }
            }
        }
    }

    #[test]
    fn the_deviation_is_that_of_the_formula((p, t1, t2, d) in corner()) {
        let turn = Turn::between(&t1, &t2);
        let distance = |jet: Jet| (jet.position - p).rows(0, 3).norm();
        let nearest = nearest(&Transition::sextic(p, t1, t2, d), distance);
        let formula = Blend::deviation(d, turn.sb);
        prop_assert!((nearest - formula).abs() < 1e-9 * d, "{nearest} {formula}");
        prop_assert!((Blend::distance_for(formula, turn.sb) / d - 1.0).abs() < 1e-12);
        // Over mixed axes the formula holds for the worst tolerance group.
        let worst = Blend::deviation(d, tolerance_half_turn(&t1, &t2, 1.0));
        let middle = Transition::sextic(p, t1, t2, d).jet(d).position - p;
        let groups = [0, 3, 6].map(|first| middle.rows(first, 3).norm());
        let groups = groups.into_iter().fold(0.0, f64::max);
        prop_assert!((groups - worst).abs() < 1e-10 * (1.0 + worst));
    }

    #[test]
    fn an_unequal_blend_deviates_no_more_than_the_mean_one(
        (p, t1, t2, d) in corner(), ratio in 1.0..20.0_f64,
    ) {
        let blend = Blend::asymmetric(p, t1, t2, [d, d * ratio]);
        let turn = Turn::between(&t1, &t2);
        let bound = Blend::deviation(d * ratio.sqrt(), turn.sb);
        let nearest = nearest(&Transition::Blend(blend), |jet| (jet.position - p).rows(0, 3).norm());
        prop_assert!(nearest <= bound * (1.0 + 1e-9), "{nearest} {bound}");
        prop_assert!((blend.length() - d * (1.0 + ratio)).abs() < 1e-12 * blend.length());
    }

    #[test]
    fn one_axis_reaches_its_limit_at_the_cap((_, t1, t2, d) in corner(), limit in vector(10.0..1e4)) {
        let turn = Turn::between(&t1, &t2);
        prop_assume!(turn.sb > 1e-3);
        let normal = (t2 - t1) / (2.0 * turn.sb);
        let along = limit_along(&normal, &limit);
        let bounds = Transition::sextic(AxisVector::zeros(), t1, t2, d).bounds();
        let v = Blend::acceleration_cap(d, turn.sb, along);
        let used = (0..AXES).map(|i| v * v * bounds.d2[i] / limit[i]).fold(0.0, f64::max);
        prop_assert!((used - 1.0).abs() < 1e-12, "{used}");
        let v = Blend::jerk_cap(d, turn.sb, along);
        let used = (0..AXES).map(|i| v.powi(3) * bounds.d3[i] / limit[i]).fold(0.0, f64::max);
        prop_assert!((used - 1.0).abs() < 1e-12, "{used}");
        prop_assert!((Blend::peak_jerk(d, turn.sb, v) / along - 1.0).abs() < 1e-12);
        // The length that just allows a speed.
        let d_min = Blend::distance_for_speed(turn.sb, v, along, along);
        let cap = Blend::acceleration_cap(d_min, turn.sb, along)
            .min(Blend::jerk_cap(d_min, turn.sb, along));
        prop_assert!((cap / v - 1.0).abs() < 1e-12);
    }
}

proptest! {
    // Each case looks at thousands of points.
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn bounds_enclose_and_are_tight((p, t1, t2, d) in corner()) {
        for curve in all_families(p, t1, t2, d) {
            let bounds = curve.bounds();
            let mut seen = [AxisVector::zeros(); 3];
            let scan = (0..=2000).map(|i| f64::from(i) / 2000.0);
            // Closer towards the middle, where a sharp corner has its peaks and jumps.
            let close = (-300..=300).map(|i| 0.5 + 0.5 * (f64::from(i) / 300.0).powi(5));
            for x in scan.chain(close) {
                let jet = curve.jet(curve.length() * x);
                for (seen, value) in seen.iter_mut().zip([jet.d1, jet.d2, jet.d3]) {
                    *seen = seen.sup(&value.abs());
                }
            }
            for (seen, bound) in seen.iter().zip([bounds.d1, bounds.d2, bounds.d3]) {
                // The jets themselves are rounded, the more the farther from the origin.
                let slack = 1e-9 * bound.amax();
                prop_assert!((0..AXES).all(|i| seen[i] <= bound[i] * (1.0 + 1e-9) + slack));
                // Axes that hardly move count by the one that moves most.
                let floor = 2e-3 * bound.amax();
                prop_assert!(
                    (0..AXES).all(|i| bound[i] <= 1.05 * seen[i] + floor),
                    "{seen} {bound} {curve:?}"
                );
            }
        }
    }
}

/// Distance of the nearest point, by golden section after a scan.
fn nearest(curve: &Transition, distance: impl Fn(Jet) -> f64) -> f64 {
    let at = |x: f64| distance(curve.jet(curve.length() * x));
    let best = (0..=200)
        .map(f64::from)
        .min_by(|a, b| at(a / 200.0).total_cmp(&at(b / 200.0)));
    let best = best.unwrap_or(0.0);
    let (mut low, mut high) = ((best - 1.0) / 200.0, (best + 1.0) / 200.0);
    for _ in 0..80 {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if at(a) < at(b) {
            high = b;
        } else {
            low = a;
        }
    }
    at(0.5 * (low + high))
}

fn planar(theta: f64) -> (AxisVector, AxisVector) {
    let mut t1 = AxisVector::zeros();
    let mut t2 = AxisVector::zeros();
    t1[0] = 1.0;
    (t2[0], t2[1]) = (theta.cos(), theta.sin());
    (t1, t2)
}

/// At a constant rate of path position the acceleration and the jerk of a blend keep one direction,
/// and their largest values are those of the formulas.
#[test]
fn a_blend_accelerates_in_one_direction() {
    const V: f64 = 30.0;
    for theta in [0.01, 1.0, 2.0, 3.1] {
        let (t1, t2) = planar(theta);
        let turn = Turn::between(&t1, &t2);
        let normal = (t2 - t1) / (2.0 * turn.sb);
        let blend = Blend::new(AxisVector::zeros(), t1, t2, 0.4);
        let (mut peak_a, mut peak_j) = (0.0_f64, 0.0_f64);
        for i in 0..=20_000 {
            let jet = blend.jet(blend.length() * f64::from(i) / 20_000.0);
            let (a, j) = (jet.d2 * V.powi(2), jet.d3 * V.powi(3));
            assert!((a - normal * a.dot(&normal)).norm() <= 1e-12 * a.norm());
            assert!((j - normal * j.dot(&normal)).norm() <= 1e-12 * j.norm());
            (peak_a, peak_j) = (peak_a.max(a.norm()), peak_j.max(j.norm()));
        }
        let formulas = (
            Blend::peak_acceleration(0.4, turn.sb, V),
            Blend::peak_jerk(0.4, turn.sb, V),
        );
        assert!(
            (peak_a / formulas.0 - 1.0).abs() < 1e-6,
            "{peak_a} {formulas:?}"
        );
        assert!(
            (peak_j / formulas.1 - 1.0).abs() < 1e-6,
            "{peak_j} {formulas:?}"
        );
        // Slowest in the middle: cos β of the rate.
        let middle = blend.jet(0.4).d1.norm();
        assert!((middle - turn.cb).abs() < 1e-12, "{middle}");
    }
}

#[test]
fn a_reversal_turns_back_smoothly() {
    let (t1, _) = planar(0.0);
    let blend = Blend::new(AxisVector::zeros(), t1, -t1, 2.0);
    assert!((blend.arc_length() - 11.0 * 2.0 / 8.0).abs() < 1e-13);
    assert!((blend.jet(2.0).position[0] + Blend::deviation(2.0, 1.0)).abs() < 1e-14);
    for shape in [PairShape::CUBIC, PairShape::SMOOTH] {
        assert!(Transition::bezier_pair(AxisVector::zeros(), t1, -t1, 1.0, shape).is_err());
    }
}

#[test]
fn feed_in_other_axes_needs_a_blend() {
    let mut t1 = AxisVector::zeros();
    let mut t2 = AxisVector::zeros();
    t1[0] = 1.0;
    t2[3] = 1.0;
    assert!(Transition::bezier_pair(AxisVector::zeros(), t1, t2, 1.0, PairShape::CUBIC).is_err());
    let blend = Transition::sextic(AxisVector::zeros(), t1, t2, 1.0);
    assert!((blend.jet(2.0).position - t2).amax() < 1e-15);
    assert!((tolerance_half_turn(&t1, &t2, 1.0) - 0.5).abs() < 1e-15);
}

/// What rounding leaves in X does not hide a reversal of A.
#[test]
fn rounding_in_another_group_is_no_motion() {
    let mut t1 = AxisVector::zeros();
    t1[3] = 1.0;
    let mut t2 = -t1;
    t2[0] = 1e-9;
    let turn = Turn::between(&t1, &t2);
    assert!((turn.sb - 1.0).abs() < 1e-15 && turn.cb < 1e-15, "{turn:?}");
    let blend = Blend::asymmetric(AxisVector::zeros(), t1, t2, [1.0, 9.0]);
    assert!(blend.arc_length() > 1.0);
}

/// The same corner turned into space has the same figures.
#[test]
fn rotation_changes_nothing() {
    let (t1, t2) = planar(2.0);
    let turn = Turn::between(&t1, &t2);
    // An orthogonal map of the plane into XYZ.
    let (a, b) = (
        [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0],
        [2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0],
    );
    let map = |t: &AxisVector| {
        let mut image = AxisVector::zeros();
        for i in LINEAR_XYZ {
            image[i] = a[i] * t[0] + b[i] * t[1];
        }
        image
    };
    let (m1, m2) = (map(&t1), map(&t2));
    let mapped = Turn::between(&m1, &m2);
    assert!((mapped.sb - turn.sb).abs() < 1e-15 && (mapped.cb - turn.cb).abs() < 1e-15);
    for (plain, turned) in all_families(AxisVector::zeros(), t1, t2, 0.7)
        .iter()
        .zip(all_families(AxisVector::zeros(), m1, m2, 0.7))
    {
        assert!((plain.length() - turned.length()).abs() < 1e-14);
        for i in 0..=10 {
            let (p, t) = (
                plain.jet(0.14 * f64::from(i)),
                turned.jet(0.14 * f64::from(i)),
            );
            assert!((map(&p.position) - t.position).norm() < 1e-13);
            assert!((map(&p.d3) - t.d3).norm() < 1e-10);
        }
    }
}
