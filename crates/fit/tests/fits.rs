//! Tests of fits against reference figures and against brute force.
#![allow(clippy::expect_used, reason = "a test that fails may panic")]

mod samples;

use glidepath_fit::{Fit, FitError, Method, Point, Settings, fit};
use proptest::prelude::*;
use samples::{circle, curve, reference};

fn quietly(points: &[Point], settings: &Settings) -> Fit {
    fit(points, settings, &mut |_| {}).expect("a fit")
}

#[test]
fn the_butterfly_needs_no_more_points_than_the_reference() {
    for result in reference("fit_vectors")["results"]
        .as_array()
        .expect("results")
    {
        let number = |key: &str| result[key].as_f64();
        let (Some(spacing_mm), Some(tolerance_mm)) = (number("spacing"), number("tol")) else {
            continue;
        };
        let points = curve("butterfly", spacing_mm);
        let fit = quietly(&points, &Settings::new(tolerance_mm));
        let count = fit.curve.control_points().len() as f64;
        let reference = number("control_points").expect("count");
        // At 2 µm the chords of the tips are no longer that near to any smooth curve: more corners.
        let allowed = if tolerance_mm < 0.01 {
            1.05 * reference
        } else {
            reference
        };
        assert!(
            count <= allowed,
            "{spacing_mm} {tolerance_mm}: {count} for {reference}"
        );
        assert!(
            fit.deviation.points_to_curve_mm <= tolerance_mm,
            "{:?}",
            fit.deviation
        );
        if tolerance_mm >= 0.01 {
            assert!(
                fit.deviation.max_mm() <= tolerance_mm,
                "{:?}",
                fit.deviation
            );
        }
    }
}

#[test]
fn a_circle_a_line_and_two_points() {
    let round = quietly(&circle(50.0, 0.1), &Settings::new(0.001));
    assert!(round.curve.control_points().len() <= 32);
    assert!(round.deviation.max_mm() <= 0.001, "{:?}", round.deviation);

    let line: Vec<Point> = (0..500)
        .map(|i| Point::new(0.3, 0.4, 1.2) * f64::from(i))
        .collect();
    let straight = quietly(&line, &Settings::new(0.001));
    assert_eq!(straight.curve.control_points().len(), 4);
    assert!(straight.deviation.max_mm() < 1e-9);
    let ends = quietly(&[line[0], line[499]], &Settings::new(0.001));
    assert_eq!(ends.curve.control_points().len(), 4);
}

#[test]
fn corners_and_ends_stay_exactly() {
    // Two quarter circles that meet at a right angle.
    let quarter = |i: i32| (f64::from(i) / 400.0 * core::f64::consts::FRAC_PI_2).sin_cos();
    let first = (0..=400)
        .map(quarter)
        .map(|(s, c)| Point::new(20.0 * s, 20.0 * (1.0 - c), 0.0));
    let second = (1..=400)
        .map(quarter)
        .map(|(s, c)| Point::new(20.0 - 20.0 * s, 40.0 - 20.0 * c, s));
    let points: Vec<Point> = first.chain(second).collect();
    let fit = quietly(&points, &Settings::new(0.005));
    assert_eq!(fit.corners(), 1);
    assert!(fit.deviation.max_mm() <= 0.005, "{:?}", fit.deviation);
    let (from, to) = fit.curve.domain();
    let at = |u: f64| fit.curve.jet(u).position.fixed_rows::<3>(0).into_owned();
    let knots = fit.curve.knots();
    let corner = knots
        .windows(3)
        .skip(4)
        .find(|k| k[0].to_bits() == k[2].to_bits());
    let corner = corner.expect("a triple knot")[0];
    for (actual, expected) in [
        (at(from), points[0]),
        (at(corner), points[400]),
        (at(to), points[800]),
    ] {
        assert!(
            (actual - expected).norm() < 1e-12,
            "{actual} for {expected}"
        );
    }
}

#[test]
fn points_that_repeat_are_one_point() {
    let points = curve("needle", 0.5);
    let twice: Vec<Point> = points.iter().flat_map(|p| [*p, *p]).collect();
    let settings = Settings::new(0.01);
    assert_eq!(quietly(&points, &settings), quietly(&twice, &settings));
}

#[test]
fn bad_points_are_refused() {
    let settings = Settings::new(0.01);
    let refused = |points: &[Point]| fit(points, &settings, &mut |_| {}).expect_err("refused");
    let here = Point::new(1.0, 2.0, 3.0);
    assert_eq!(refused(&[]), FitError::TooFewPoints { points: 0 });
    assert_eq!(refused(&[here, here]), FitError::TooFewPoints { points: 1 });
    assert_eq!(
        refused(&[here, here * f64::NAN]),
        FitError::NotFinite { index: 1 }
    );
    // A zigzag is all corners.
    let zigzag: Vec<Point> = (0..9)
        .map(|i| Point::new(f64::from(i), f64::from(i % 2), 0.0))
        .collect();
    let error = refused(&zigzag);
    assert!(
        matches!(error, FitError::NotDense { points: 9, .. }),
        "{error}"
    );
}

#[test]
fn the_searches_repeat_themselves_and_never_beat_least_squares() {
    let points = curve("needle", 0.25);
    let settings = |method, seed| Settings {
        method,
        seed,
        ..Settings::new(0.005)
    };
    let exact = quietly(&points, &settings(Method::LeastSquares, 0));
    for method in [Method::Foraging, Method::Hybrid] {
        let once = quietly(&points, &settings(method, 3));
        assert_eq!(once, quietly(&points, &settings(method, 3)));
        if method == Method::Hybrid {
            assert!(once.curve.control_points().len() <= exact.curve.control_points().len());
            assert!(once.deviation.max_mm() <= 0.005, "{:?}", once.deviation);
            continue;
        }
        assert_ne!(once, quietly(&points, &settings(method, 4)));
        for part in &once.parts {
            let search = part.search.expect("a search");
            assert_eq!(search.iterations, 496);
            // A straight part is as good at the start as it can be.
            let straight = search.start_mm2 < 1e-20;
            assert!(straight || part.squares_mm2 < search.start_mm2, "{part:?}");
            let least_mm2 = search.least_squares_mm2 * (1.0 + 1e-12);
            assert!(straight || part.squares_mm2 >= least_mm2, "{part:?}");
        }
        assert!(once.parts.iter().any(|part| part.squares_mm2 > 1e-6));
    }
}

#[test]
fn progress_ascends_to_the_end() {
    let mut seen = vec![0.0];
    let settings = Settings {
        method: Method::Foraging,
        ..Settings::new(0.01)
    };
    fit(&curve("needle", 1.0), &settings, &mut |done| {
        seen.push(done);
    })
    .expect("a fit");
    assert!(
        seen.windows(2)
            .all(|pair| pair[0] <= pair[1] && pair[1] <= 1.0)
    );
    assert!(seen.len() > 490 && seen.last() >= Some(&1.0));
}

/// Distance of every point of `from` from the nearest chord of `to`.
fn farthest(from: &[Point], to: &[Point]) -> f64 {
    let to_chord = |p: &Point, a: &Point, b: &Point| {
        let share = ((p - a).dot(&(b - a)) / (b - a).norm_squared()).clamp(0.0, 1.0);
        (p - (a + (b - a) * share)).norm()
    };
    let nearest = |p: &Point| {
        let chords = to.windows(2).map(|pair| to_chord(p, &pair[0], &pair[1]));
        chords.fold(f64::INFINITY, f64::min)
    };
    from.iter().map(nearest).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn the_deviation_is_true_and_control_points_are_fewer_than_points(
        waves in prop::collection::vec((0.5..6.0_f64, 0.0..3.0_f64), 3),
        count in 40..200_i32,
        micrometres in prop_oneof![Just(1.0), Just(5.0), Just(50.0)],
    ) {
        // Open waves in space: no part of the curve comes near another.
        let points: Vec<Point> = (0..count).map(|i| {
            let x = f64::from(i) * 60.0 / f64::from(count);
            let wave = |(size, phase): (f64, f64), length: f64| size * (x / length + phase).sin();
            Point::new(x, wave(waves[0], 6.0) + wave(waves[1], 9.0), wave(waves[2], 11.0))
        }).collect();
        let fit = match fit(&points, &Settings::new(micrometres * 1e-3), &mut |_| {}) {
            Ok(fit) => fit,
            Err(FitError::NotDense { .. }) => return Ok(()),
            Err(error) => panic!("{error}"),
        };
        prop_assert!(fit.curve.control_points().len() <= points.len());
        // However far apart the points are, the curve does not swing out between them.
        let longest = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).fold(0.0, f64::max);
        prop_assert!(fit.deviation.max_mm() < 0.25 * longest, "{:?}", fit.deviation);
        let (from, to) = fit.curve.domain();
        let samples: Vec<Point> = (0..=20_000).map(|i| {
            let u = from + (to - from) * f64::from(i) / 20_000.0;
            fit.curve.jet(u).position.fixed_rows::<3>(0).into_owned()
        }).collect();
        // Samples miss the extreme by little, and chords of samples leave the curve by little.
        let slack = 1e-4 + 0.01 * fit.deviation.max_mm();
        prop_assert!((farthest(&points, &samples) - fit.deviation.points_to_curve_mm).abs() < slack);
        prop_assert!((farthest(&samples, &points) - fit.deviation.curve_to_points_mm).abs() < slack);
    }
}
