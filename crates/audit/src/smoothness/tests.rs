//! Tests of the figures of motions whose figures are known.

use super::{Figures, Smoothness};
use core::f64::consts::{SQRT_2, TAU};
use glidepath_geometry::AxisVector;

const PERIOD_T: f64 = 0.004;

/// The figures of X moving as a function of time, and of Y beside it.
fn figures(count: u32, position: impl Fn(f64) -> [f64; 2]) -> Figures {
    let mut smoothness = Smoothness::new(PERIOD_T);
    for tick in 0..count {
        let mut at = AxisVector::zeros();
        [at[0], at[1]] = position(f64::from(tick) * PERIOD_T);
        smoothness.next(&at, tick % 2 == 0, 0.003);
    }
    let report = smoothness.report();
    assert_eq!(report.whole.periods, u64::from(count) - 1);
    assert_eq!(report.at_feed.periods, (u64::from(count) - 1) / 2);
    report.whole
}

/// The gain of n backward differences in a row at an angular frequency, over that of derivatives.
fn differences(order: i32, omega: f64) -> f64 {
    let half = 0.5 * omega * PERIOD_T;
    (half.sin() / half).powi(order)
}

/// X swings at a frequency with an amplitude in acceleration of 100 mm/s², which it reaches in two
/// seconds of 800.
fn swinging(frequency_hz: f64) -> (f64, Figures) {
    let omega = TAU * frequency_hz;
    let amplitude_mm = 100.0 / (omega * omega);
    let seen = figures(200_000, |t| {
        let u = (0.5 * t).min(1.0);
        let share = u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u);
        [share * amplitude_mm * (omega * t).sin(), 0.0]
    });
    (omega, seen)
}

#[test]
fn a_swing_has_the_jerk_that_it_has() {
    for frequency_hz in [0.7, 5.0, 40.0] {
        let (omega, seen) = swinging(frequency_hz);
        let peak_j = 100.0 * omega * differences(3, omega);
        assert!(
            (seen.rms_jerk_j[0] * SQRT_2 / peak_j - 1.0).abs() < 1e-2,
            "{seen:?}"
        );
        assert!(seen.rms_jerk_j[1].abs() < f64::MIN_POSITIVE);
        let turns = 2.0 * frequency_hz * 200_000.0 * PERIOD_T;
        #[allow(clippy::cast_precision_loss, reason = "a few thousand")]
        let found = seen.reversals[0] as f64;
        assert!((found - turns).abs() <= 2.0, "{found} {turns}");
        assert_eq!(seen.reversals[1], 0);
    }
}

#[test]
fn what_is_slower_than_the_corner_does_not_ring() {
    // |H|² of a Butterworth high pass of fourth order, its frequencies warped by the sampling.
    let warped = |hz: f64| (0.5 * TAU * hz * PERIOD_T).tan();
    for frequency_hz in [3.0, 10.0, 29.9, 60.0, 110.0] {
        let (omega, seen) = swinging(frequency_hz);
        let slower = (warped(super::RINGING_HZ) / warped(frequency_hz)).powi(8);
        let rms_a = 100.0 / SQRT_2 * differences(2, omega) / (1.0 + slower).sqrt();
        assert!(
            (seen.ringing_a[0] - rms_a).abs() < 0.01 * rms_a,
            "{frequency_hz} {rms_a} {seen:?}"
        );
    }
}

#[test]
fn an_axis_at_constant_speed_has_no_figures_but_its_start() {
    let seen = figures(10_000, |t| [60.0 * t, 7.25]);
    // From rest to speed within a period, and back to no acceleration in the next.
    let step_j = 60.0 / PERIOD_T.powi(2);
    assert!(
        (seen.peak_jerk_j[0] / (2.0 * step_j) - 1.0).abs() < 1e-6
            || (seen.peak_jerk_j[0] / step_j - 1.0).abs() < 1e-6
    );
    let rms_j = step_j * (2.0 / 9_999.0_f64).sqrt();
    assert!((seen.rms_jerk_j[0] / rms_j - 1.0).abs() < 1e-3, "{seen:?}");
    assert_eq!((seen.reversals[0], seen.peak_jerk_j[1]), (0, 0.0));
    assert!((seen.mean_deviation_mm - 0.003).abs() < 1e-12);
    assert!((seen.rms_deviation_mm - 0.003).abs() < 1e-12);
}

#[test]
fn an_axis_that_stops_and_goes_back_turned_once() {
    let seen = figures(300, |t| [(t - 0.5).max(0.0) - (0.3 - t).max(0.0), 0.0]);
    // there: −0.3 to 0 forwards, a rest, forwards again: no reversal
    assert_eq!(seen.reversals[0], 0);
    let seen = figures(300, |t| [(t - 0.5).max(0.0) + (0.3 - t).max(0.0), 0.0]);
    assert_eq!(seen.reversals[0], 1);
}
