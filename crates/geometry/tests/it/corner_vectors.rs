//! Tests of every transition family against reference values computed with 34 digits.

#[allow(clippy::unwrap_used, reason = "a test")]
mod vectors {
    use glidepath_geometry::{AxisVector, BezierPair, Blend, Jet, PairShape, Transition, Turn};
    use serde_json::Value;

    const TEXT: &str = include_str!(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../tests/data/method/corner-vectors.json"
    ));

    struct Corner {
        value: Value,
        name: String,
        d: f64,
        t1: AxisVector,
        t2: AxisVector,
        turn: Turn,
    }

    fn corners() -> Vec<Corner> {
        let file: Value = serde_json::from_str(TEXT).unwrap();
        let all = file["vectors"].as_array().unwrap();
        assert_eq!(all.len(), 48);
        all.iter()
            .map(|value| {
                let (t1, t2) = (vector(&value["T1"]), vector(&value["T2"]));
                Corner {
                    name: format!("{} d={}", value["theta"], value["d"]),
                    d: number(&value["d"]),
                    t1,
                    t2,
                    turn: Turn::between(&t1, &t2),
                    value: value.clone(),
                }
            })
            .collect()
    }

    fn number(value: &Value) -> f64 {
        value.as_f64().unwrap()
    }

    fn numbers(value: &Value) -> Vec<f64> {
        value.as_array().unwrap().iter().map(number).collect()
    }

    fn vector(value: &Value) -> AxisVector {
        let plane = numbers(value);
        let mut vector = AxisVector::zeros();
        vector[0] = plane[0];
        vector[1] = plane[1];
        vector
    }

    #[track_caller]
    fn close(what: &str, got: f64, want: &Value, relative: f64, absolute: f64) {
        let want = number(want);
        assert!(
            (got - want).abs() <= relative * want.abs() + absolute,
            "{what}: {got:e}, wanted {want:e}"
        );
    }

    fn cross(a: &AxisVector, b: &AxisVector) -> f64 {
        a[0] * b[1] - a[1] * b[0]
    }

    fn curvature(jet: &Jet) -> f64 {
        cross(&jet.d1, &jet.d2) / jet.d1.norm().powi(3)
    }

    /// dk/ds.
    fn curvature_rate(jet: &Jet) -> f64 {
        let speed = jet.d1.norm();
        (cross(&jet.d1, &jet.d3) / speed.powi(3)
            - 3.0 * cross(&jet.d1, &jet.d2) * jet.d1.dot(&jet.d2) / speed.powi(5))
            / speed
    }

    fn check_point(what: &str, got: &AxisVector, want: &Value, d: f64) {
        let want = vector(want);
        assert!(
            (got - want).norm() <= 2e-14 * d.max(1.0),
            "{what}: {got} {want}"
        );
    }

    #[test]
    fn turns() {
        for corner in corners() {
            let Corner {
                value, name, turn, ..
            } = &corner;
            close(name, turn.sb, &value["sin_half"], 1e-12, 0.0);
            close(name, turn.cb, &value["cos_half"], 1e-12, 1e-16);
            close(name, turn.theta_rad(), &value["theta_rad"], 1e-12, 0.0);
        }
    }

    #[test]
    fn uniform_blends() {
        for corner in corners() {
            let want = &corner.value["blend6"];
            if !want.is_null() {
                check_blend(&corner, want);
            }
        }
    }

    fn check_blend(corner: &Corner, want: &Value) {
        let &Corner {
            d, t1, t2, turn, ..
        } = corner;
        let name = &format!("{} blend", corner.name);
        let blend = Blend::new(AxisVector::zeros(), t1, t2, d);
        close(
            name,
            Blend::deviation(d, turn.sb),
            &want["deviation"],
            1e-12,
            0.0,
        );
        close(
            name,
            blend.jet(d).position.norm(),
            &want["deviation"],
            1e-10,
            1e-16,
        );
        close(name, blend.arc_length(), &want["arc_length"], 1e-12, 0.0);
        if let Some(points) = want["control"].as_array() {
            check_point(name, &blend.jet(0.0).position, &points[0], d);
            check_point(
                name,
                &blend.jet(2.0 * d).position,
                &points[points.len() - 1],
                d,
            );
        }
        if !want["kappa_max"].is_null() {
            close(
                name,
                Blend::max_curvature(d, turn),
                &want["kappa_max"],
                1e-12,
                0.0,
            );
            for (i, k) in want["kappa_u"].as_array().unwrap().iter().enumerate() {
                let u = f64::from(u32::try_from(i).unwrap()) / 10.0;
                close(name, curvature(&blend.jet(2.0 * d * u)), k, 1e-9, 1e-13);
            }
        }
        let end_rate = curvature_rate(&blend.jet(0.0));
        close(name, end_rate, &want["dkds_start"], 1e-9, 1e-12);
        check_point(name, &blend.jet(0.5 * d).position, &want["point_u025"], d);
        let caps = [
            Blend::acceleration_cap(d, turn.sb, 1e4),
            Blend::jerk_cap(d, turn.sb, 1e6),
        ];
        close(name, caps[0], &want["V_cap_A1e4"], 1e-12, 0.0);
        close(name, caps[1], &want["V_cap_J1e6"], 1e-12, 0.0);
        if !want["dkds_u025"].is_null() {
            close(
                name,
                curvature_rate(&blend.jet(0.5 * d)),
                &want["dkds_u025"],
                1e-9,
                0.0,
            );
        }
    }

    #[test]
    fn pairs() {
        for corner in corners() {
            let Corner {
                value, d, t1, t2, ..
            } = &corner;
            for key in ["pair", "pair_rational"] {
                let want = &value[key];
                if want.is_null() {
                    // Only the reversal has none; there the pair is refused.
                    let refused =
                        BezierPair::new(AxisVector::zeros(), *t1, *t2, *d, PairShape::CUBIC);
                    assert!(refused.is_err(), "{}", corner.name);
                } else {
                    check_pair(&corner, want);
                }
            }
        }
    }

    fn check_pair(corner: &Corner, want: &Value) {
        let &Corner {
            d, t1, t2, turn, ..
        } = corner;
        let name = &format!("{} pair {}", corner.name, want["sigma"]);
        let sigma = numbers(&want["sigma"]);
        let shape = PairShape {
            s1: sigma[0],
            s2: sigma[1],
        };
        let pair = BezierPair::new(AxisVector::zeros(), t1, t2, d, shape).unwrap();
        let length = pair.length();
        close(
            name,
            PairShape::deviation(d, turn.sb),
            &want["deviation"],
            1e-12,
            0.0,
        );
        close(
            name,
            pair.jet(0.5 * length).position.norm(),
            &want["deviation"],
            1e-10,
            1e-15,
        );
        close(name, length, &want["arc_length"], 1e-12, 0.0);
        close(
            name,
            shape.junction_curvature(d, turn),
            &want["kappa_max"],
            1e-12,
            0.0,
        );
        for (i, k) in want["kappa_u"].as_array().unwrap().iter().enumerate() {
            let t = f64::from(u32::try_from(i).unwrap()) / 5.0;
            let s = if t <= 1.0 {
                pair.arc_length_at(t)
            } else {
                length - pair.arc_length_at(2.0 - t)
            };
            close(name, curvature(&pair.jet(s)), k, 1e-9, 1e-11);
        }
        let rate = shape.end_curvature_rate(d, turn);
        close(name, rate, &want["dkds_start"], 1e-12, 0.0);
        close(
            name,
            curvature_rate(&pair.jet(0.0)),
            &want["dkds_start"],
            1e-9,
            0.0,
        );
        if !want["dkds_end"].is_null() {
            close(
                name,
                curvature_rate(&pair.jet(length)),
                &want["dkds_end"],
                1e-9,
                0.0,
            );
        }
        check_pair_points(corner, want, &pair);
        check_junction(corner, shape, &pair);
    }

    fn check_pair_points(corner: &Corner, want: &Value, pair: &BezierPair) {
        let (name, d, length) = (&corner.name, corner.d, pair.length());
        if let Some(half) = want["half_a"].as_array() {
            check_point(name, &pair.jet(0.0).position, &half[0], d);
            check_point(name, &pair.jet(0.5 * length).position, &half[3], d);
        }
        for key in ["point_u025", "point_t05"] {
            if !want[key].is_null() {
                let s = pair.arc_length_at(0.5);
                check_point(name, &pair.jet(s).position, &want[key], d);
            }
        }
    }

    fn check_junction(corner: &Corner, shape: PairShape, pair: &BezierPair) {
        let &Corner { d, turn, .. } = corner;
        assert!(shape.is_smooth_at_junction());
        // Zero up to the rounding of the terms that cancel there.
        let scale = turn.sb / (d * d * turn.cb.powi(3));
        assert!(
            shape.junction_curvature_rate(d, turn).abs() <= 1e-13 * scale,
            "{}",
            corner.name
        );
        let measured = curvature_rate(&pair.jet(0.5 * pair.length()));
        assert!(
            measured.abs() <= 1e-10 * scale / turn.cb,
            "{}: {measured}",
            corner.name
        );
    }

    #[test]
    fn hermite_between_lines_is_the_sextic() {
        for corner in corners() {
            let &Corner { d, t1, t2, .. } = &corner;
            let at =
                AxisVector::from_column_slice(&[10.0, -3.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let sextic = Transition::sextic(at, t1, t2, d);
            let hermite = Transition::hermite(&sextic.jet(0.0), &sextic.jet(2.0 * d), 2.0 * d);
            for i in 0..=16 {
                let s = 2.0 * d * f64::from(i) / 16.0;
                let (a, b) = (sextic.jet(s), hermite.jet(s));
                assert!(
                    (a.position - b.position).amax() < 1e-14 * 10.0,
                    "{}",
                    corner.name
                );
                assert!((a.d1 - b.d1).amax() < 1e-12, "{}", corner.name);
                assert!((a.d2 - b.d2).amax() < 1e-11 / d, "{}", corner.name);
                assert!((a.d3 - b.d3).amax() < 1e-10 / (d * d), "{}", corner.name);
            }
        }
    }
}
