//! Tests of cubic spans: path position, derivatives and their bounds against finite differences.

#![allow(clippy::expect_used, reason = "a test that fails may panic")]

use glidepath_geometry::{AxisVector, Cubic, LINEAR_XYZ};
use proptest::prelude::*;

/// A span about 1 mm long that does not turn back, with a rotary axis along.
fn spans() -> impl Strategy<Value = Cubic> {
    let offsets = prop::collection::vec(-0.1..0.1_f64, 16);
    (offsets, -3.0..1.0_f64, 0.0..500.0_f64).prop_filter_map("a cusp", |(o, size, far)| {
        let size = 10_f64.powf(size);
        let control = core::array::from_fn(|i| {
            let mut point = AxisVector::zeros();
            for (k, axis) in [0, 1, 2, 4].into_iter().enumerate() {
                point[axis] = far + size * o[4 * i + k];
            }
            point[0] += size * i as f64 / 3.0;
            point
        });
        Cubic::new(control, LINEAR_XYZ)
    })
}

fn linear(v: &AxisVector) -> f64 {
    v.fixed_rows::<3>(0).norm()
}

proptest! {
    #[test]
    fn path_position_is_the_length_driven(span in spans()) {
        let length = span.length();
        let points: Vec<_> = (0..=2000)
            .map(|i| span.jet(length * f64::from(i) / 2000.0).position)
            .collect();
        for pair in points.windows(2) {
            let step = linear(&(pair[1] - pair[0]));
            prop_assert!((step / (length / 2000.0) - 1.0).abs() < 1e-4, "{step}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_position(span in spans(), at in 0.05..0.95_f64) {
        let (s, h) = (span.length() * at, span.length() * 1e-3);
        let [before, here, after] = [s - h, s, s + h].map(|s| span.jet(s));
        let bounds = span.bounds();
        let slack = |bound: &AxisVector| linear(bound) * 2e-3 + 1e-9;
        let d1 = (after.position - before.position) / (2.0 * h);
        prop_assert!((d1 - here.d1).amax() < slack(&bounds.d1), "{d1} {}", here.d1);
        let d2 = (after.d1 - before.d1) / (2.0 * h);
        prop_assert!((d2 - here.d2).amax() < slack(&bounds.d2) + bounds.d3.amax() * h, "{d2} {}", here.d2);
        let d3 = (after.d2 - before.d2) / (2.0 * h);
        prop_assert!((d3 - here.d3).amax() < 0.05 * linear(&bounds.d3) + 1e-6 / h / h, "{d3} {}", here.d3);
    }

    #[test]
    fn bounds_hold_and_are_near(span in spans()) {
        let bounds = span.bounds();
        let mut most = [AxisVector::zeros(); 3];
        for i in 0..=500 {
            let s = span.length() * f64::from(i) / 500.0;
            let (jet, state) = (span.jet(s), span.state(s));
            prop_assert_eq!([state.position, state.d1, state.d2], [jet.position, jet.d1, jet.d2]);
            for (most, d) in most.iter_mut().zip([jet.d1, jet.d2, jet.d3]) {
                *most = most.sup(&d.abs());
            }
        }
        let rounding = 1e-9 * (1.0 + bounds.d3.amax());
        for (bound, most) in [bounds.d1, bounds.d2, bounds.d3].iter().zip(most) {
            prop_assert!(most.iter().zip(bound).all(|(m, b)| *m <= b * (1.0 + 1e-6) + rounding), "{most} {bound}");
        }
        prop_assert!(bounds.d2.norm() <= 3.0 * most[1].norm() + 1e-6, "{} {}", bounds.d2, most[1]);
    }

    #[test]
    fn ends_are_met_to_the_bit_of_the_control_points(span in spans()) {
        let (start, end) = (span.jet(0.0), span.jet(span.length()));
        prop_assert!((span.jet(span.length() * 1e-12).position - start.position).amax() < 1e-10);
        prop_assert!((span.jet(span.length() * (1.0 - 1e-12)).position - end.position).amax() < 1e-10);
        prop_assert!((linear(&start.d1) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn a_cusp_is_refused() {
    let at = |x: f64, y: f64| {
        let mut point = AxisVector::zeros();
        (point[0], point[1]) = (x, y);
        point
    };
    let cusp = [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0), at(1.0, 0.0)];
    assert_eq!(Cubic::new(cusp, LINEAR_XYZ), None);
    assert_eq!(Cubic::new([at(1.0, 0.0); 4], LINEAR_XYZ), None);
}
