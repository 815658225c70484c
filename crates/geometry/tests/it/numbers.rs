//! Tests of numbers with derivatives and enclosures against finite differences and sampling.

use glidepath_geometry::number::{Gradient, Interval, Number, Series};
use proptest::prelude::*;

/// A formula with every operation in it.
fn formula<T: Number>(x: T, y: T, z: T) -> T {
    let (sin, cos) = (x * y).sin_cos();
    let root = (x.square() + y.square() + T::constant(1.0)).sqrt();
    sin.atan2(root) + cos / root + (z.scale(0.3) - x).exp() + (root + z.square()).ln() - y.powi(-3)
}

fn along(t: f64) -> [f64; 3] {
    [0.4 + t, 1.3 - 0.5 * t * t, 0.2 * t]
}

fn series_along(t: f64) -> Series<4> {
    let t = Series::<4>::variable(t);
    formula(
        t + Series::constant(0.4),
        Series::constant(1.3) - t.square().scale(0.5),
        t.scale(0.2),
    )
}

#[test]
fn series_agree_with_differences_of_one_order_less() {
    let h = 1e-4;
    for step in 0..20 {
        let t = -0.7 + 0.07 * f64::from(step);
        let [x, y, z] = along(t);
        let at = series_along(t);
        assert!((at.value() - formula(x, y, z)).abs() < 1e-14);
        for k in 0..3 {
            let slope =
                (series_along(t + h).derivative(k) - series_along(t - h).derivative(k)) / (2.0 * h);
            let exact = at.derivative(k + 1);
            assert!(
                (slope - exact).abs() < 1e-6 * exact.abs().max(1.0),
                "{k}: {slope} {exact}"
            );
        }
    }
}

#[test]
fn gradients_chain_to_series() {
    for step in 0..20 {
        let t = -0.7 + 0.07 * f64::from(step);
        let [x, y, z] = Gradient::variables(along(t));
        let gradient = formula(x, y, z);
        let velocity = [1.0, -t, 0.2];
        let rate: f64 = gradient
            .partial
            .iter()
            .zip(velocity)
            .map(|(p, v)| p * v)
            .sum();
        assert!((rate - series_along(t).derivative(1)).abs() < 1e-12);
    }
}

#[test]
fn what_is_not_defined_is_not_finite() {
    assert!(!Number::is_finite(Interval::new(-1.0, 4.0).sqrt()));
    assert!(!Number::is_finite(Interval::new(0.0, 4.0).ln()));
    assert!(!Number::is_finite(
        Interval::constant(1.0) / Interval::new(-1.0, 1.0)
    ));
    assert!(!Number::is_finite(Series::<2>::variable(-1.0).sqrt()));
    assert!(!Number::is_finite(Series::<2>::variable(0.0).ln()));
}

proptest! {
    #[test]
    fn intervals_hold_every_value(
        x in -3.0..3.0_f64, y in 0.5..3.0_f64, z in -2.0..2.0_f64,
        wide in prop::array::uniform3(0.0..0.5_f64),
        inside in prop::array::uniform3(0.0..1.0_f64),
    ) {
        let low = [x, y, z];
        let boxed: [Interval; 3] = core::array::from_fn(|i| Interval::new(low[i], low[i] + wide[i]));
        let point: [f64; 3] = core::array::from_fn(|i| low[i] + inside[i] * wide[i]);
        let enclosure = formula(boxed[0], boxed[1], boxed[2]);
        prop_assert!(enclosure.contains(formula(point[0], point[1], point[2])));
        let [bx, by, bz] = Gradient::variables(boxed);
        let [px, py, pz] = Gradient::variables(point);
        let (bounds, exact) = (formula(bx, by, bz), formula(px, py, pz));
        for i in 0..3 {
            prop_assert!(bounds.partial[i].contains(exact.partial[i]));
        }
    }

    #[test]
    fn sine_and_cosine_of_intervals(low in -20.0..20.0_f64, wide in 0.0..8.0_f64, inside in 0.0..1.0_f64) {
        let (sin, cos) = Interval::new(low, low + wide).sin_cos();
        let (s, c) = (low + inside * wide).sin_cos();
        prop_assert!(sin.contains(s) && cos.contains(c));
        // Sharp: never wider than the change of the angle.
        prop_assert!(sin.width() <= wide + 1e-14 && cos.width() <= wide + 1e-14);
    }
}
