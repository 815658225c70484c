//! The compressor against brute force: distances both ways by dense sampling, derivatives and
//! joints by evaluation.

#![allow(
    clippy::expect_used,
    clippy::panic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test that fails may panic, and counts are small"
)]

use super::*;
use crate::programmed_rate::ProgrammedRate;
use glidepath_geometry::{AxisVector, Cubic, LINEAR_XYZ, Segment, feed_length};
use glidepath_program::{Effort, Limits, ProgramLine, Rate, Settings, Smoothing};
use proptest::prelude::*;

const TOLERANCE_MM: f64 = 0.02;

fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: TOLERANCE_MM,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Sextic,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Fast,
    }
}

fn at(x: f64, y: f64) -> AxisVector {
    let mut point = AxisVector::zeros();
    (point[0], point[1]) = (x, y);
    point
}

fn change(feed_v: f64) -> Option<Change> {
    Some(Change {
        rate: ProgrammedRate {
            rate: Rate::Feed(feed_v),
            axes_v: f64::INFINITY,
        },
        events: Vec::new(),
    })
}

/// The parts of a path through points; block i ends at point i.
fn compress(points: &[AxisVector], is_linear: bool) -> Vec<SplinePart> {
    compress_at(100.0, points, is_linear)
}

fn compress_at(feed_v: f64, points: &[AxisVector], is_linear: bool) -> Vec<SplinePart> {
    let mut compressor =
        Compressor::new(points[0], LINEAR_XYZ, is_linear, TOLERANCE_MM, &settings());
    let mut parts = Vec::new();
    for (i, pair) in points.windows(2).enumerate() {
        if (pair[1] - pair[0]).amax() < 1e-6 {
            continue;
        }
        let first = if i == 0 { change(feed_v) } else { None };
        let line = ProgramLine {
            number: i as u32 + 1,
            block: 0,
        };
        compressor.push(&pair[1], line, first);
        parts.extend(compressor.parts());
    }
    compressor.finish();
    parts.extend(compressor.parts());
    parts
}

fn cubic(part: &SplinePart) -> Option<(Cubic, f64)> {
    match &part.shape {
        PartShape::Span { control, error_mm } => {
            let cubic = Cubic::new(*control, LINEAR_XYZ).expect("a regular span");
            Some((cubic, *error_mm))
        }
        _ => None,
    }
}

/// Points along the parts, close together.
fn sampled(parts: &[SplinePart]) -> Vec<AxisVector> {
    let mut points = Vec::new();
    for part in parts {
        match &part.shape {
            PartShape::Line { start, end, .. } => {
                let count = (50.0_f64).min((end - start).norm() / 0.001).ceil();
                let line = Segment::line(*start, *end);
                points.extend(
                    (0..=count as u32)
                        .map(|i| line.jet(line.length() * f64::from(i) / count).position),
                );
            }
            PartShape::Span { .. } => {
                let (cubic, _) = cubic(part).expect("a span");
                points.extend(
                    (0..=16).map(|i| cubic.jet(cubic.length() * f64::from(i) / 16.0).position),
                );
            }
            PartShape::Stop => {}
        }
    }
    points
}

fn distance(point: &AxisVector, a: &AxisVector, b: &AxisVector) -> f64 {
    let (ab, ap) = (b - a, point - a);
    let u = (ap.dot(&ab) / ab.dot(&ab).max(1e-300)).clamp(0.0, 1.0);
    glidepath_program::tolerance_norm(&(ap - ab * u), 1.0)
}

/// Largest distance of points from a polyline, by trying all of it near the same share of length.
fn farthest(points: &[AxisVector], polyline: &[AxisVector]) -> f64 {
    let lengths = |line: &[AxisVector]| -> Vec<f64> {
        let mut sum = 0.0;
        let mut all = vec![0.0];
        all.extend(line.windows(2).map(|p| {
            sum += (p[1] - p[0]).norm();
            sum
        }));
        all
    };
    let (of_points, of_line) = (lengths(points), lengths(polyline));
    let total = of_line[of_line.len() - 1];
    let scale = total / of_points[of_points.len() - 1];
    let reach = 0.5 + 0.05 * total;
    points
        .iter()
        .zip(of_points)
        .map(|(point, s)| {
            let low = of_line.partition_point(|&l| l < s * scale - reach).max(1);
            let high = of_line.partition_point(|&l| l < s * scale + reach);
            (low..=high.min(polyline.len() - 1))
                .map(|i| distance(point, &polyline[i - 1], &polyline[i]))
                .fold(f64::INFINITY, f64::min)
        })
        .fold(0.0, f64::max)
}

/// Checks everything that must hold for any input, and counts spans, lines and stops.
fn judged(points: &[AxisVector], parts: &[SplinePart]) -> (usize, usize, usize) {
    let motion = sampled(parts);
    let certified_mm = parts
        .iter()
        .filter_map(|part| match part.shape {
            PartShape::Span { error_mm, .. } | PartShape::Line { error_mm, .. } => Some(error_mm),
            PartShape::Stop => None,
        })
        .fold(0.0, f64::max);
    assert!(certified_mm <= TOLERANCE_MM, "{certified_mm}");
    let there = farthest(&motion, points);
    let back = farthest(points, &motion);
    // The sampled motion has chords of its own.
    let worst = there.max(back);
    assert!(
        worst <= certified_mm + 2e-4,
        "{there} {back} against {certified_mm}"
    );
    assert!((motion[0] - points[0]).amax() < 1e-12, "start");
    let (last, end) = (motion[motion.len() - 1], points[points.len() - 1]);
    assert!((last - end).amax() < 1e-12, "end");
    joints(parts);
    let count = |of: fn(&PartShape) -> bool| parts.iter().filter(|part| of(&part.shape)).count();
    (
        count(|shape| matches!(shape, PartShape::Span { .. })),
        count(|shape| matches!(shape, PartShape::Line { .. })),
        count(|shape| matches!(shape, PartShape::Stop)),
    )
}

/// Neighbours meet, and where no corner is, with the same derivatives.
fn joints(parts: &[SplinePart]) {
    let ends = |part: &SplinePart| match &part.shape {
        PartShape::Line { start, end, .. } => {
            let line = Segment::line(*start, *end);
            Some([line.jet(0.0), line.jet(line.length())])
        }
        PartShape::Span { .. } => {
            let (cubic, _) = cubic(part).expect("a span");
            Some([cubic.jet(0.0), cubic.jet(cubic.length())])
        }
        PartShape::Stop => None,
    };
    let is_span = |part: &SplinePart| matches!(part.shape, PartShape::Span { .. });
    for pair in parts.windows(2) {
        let (Some([_, before]), Some([after, _])) = (ends(&pair[0]), ends(&pair[1])) else {
            continue;
        };
        assert!((before.position - after.position).amax() < 1e-9, "a gap");
        if is_span(&pair[0]) || is_span(&pair[1]) {
            let bend = before.d2.norm().max(after.d2.norm());
            assert!((before.d1 - after.d1).amax() < 1e-7, "tangents {pair:?}");
            let step = (before.d2 - after.d2).amax();
            assert!(step < 1e-5 * (1.0 + bend), "curvatures {step} of {bend}");
        }
    }
}

fn circle(radius_mm: f64, chord_mm: f64, digits: Option<i32>) -> Vec<AxisVector> {
    let count = (core::f64::consts::TAU * radius_mm / chord_mm).round();
    (0..=count as u32)
        .map(|i| {
            let phi = f64::from(i) / count * core::f64::consts::TAU;
            rounded(&at(radius_mm * phi.cos(), radius_mm * phi.sin()), digits)
        })
        .collect()
}

fn rounded(point: &AxisVector, digits: Option<i32>) -> AxisVector {
    digits.map_or(*point, |digits| {
        let unit = 10_f64.powi(-digits);
        point.map(|x| (x / unit).round() * unit)
    })
}

#[test]
fn a_circle_becomes_a_smooth_circle() {
    for (chord_mm, digits) in [(0.1, None), (0.1, Some(3)), (0.01, None), (0.01, Some(3))] {
        let points = circle(10.0, chord_mm, digits);
        let parts = compress(&points, true);
        let (spans, lines, stops) = judged(&points, &parts);
        assert_eq!((lines, stops), (2, 0), "{chord_mm} {digits:?}");
        assert!(spans < 400, "{spans} spans");
        let mut s = 0.0;
        for (cubic, _) in parts.iter().filter_map(cubic) {
            s += cubic.length();
            // It starts and ends on a line, and swings in from there.
            if s > 10.0 && s < 50.0 {
                let bounds = cubic.bounds();
                let middle = cubic.jet(0.5 * cubic.length());
                assert!(
                    (middle.d2.norm() - 0.1).abs() < 0.005,
                    "{} at {s}",
                    middle.d2.norm()
                );
                assert!(bounds.d3.norm() < 0.0125, "{} at {s}", bounds.d3);
            }
        }
    }
}

/// Where the feed binds, nothing is gained inside a curve; where the curve binds, speed is.
#[test]
fn a_circle_keeps_its_radius_where_the_feed_binds() {
    for (radius_mm, chord_mm, digits) in [(0.5, 0.01, None), (3.0, 0.1, Some(3)), (10.0, 0.1, None)]
    {
        let points = circle(radius_mm, chord_mm, digits);
        let mean_mm = |feed_v| {
            let places = sampled(&compress_at(feed_v, &points, true));
            // Without what swings in and out of the lines that it starts and ends on.
            let off = places.iter().filter(|place| place[0] < 0.0);
            let off: Vec<f64> = off
                .map(|place| place[0].hypot(place[1]) - radius_mm)
                .collect();
            off.iter().sum::<f64>() / off.len() as f64
        };
        let bound_v = 200.0 * radius_mm.sqrt();
        let (held_mm, spent_mm) = (mean_mm(0.05 * bound_v), mean_mm(bound_v));
        assert!(held_mm.abs() < 3e-4, "R {radius_mm}: {held_mm} mm off");
        assert!(spent_mm < -2.5e-3, "R {radius_mm}: {spent_mm} mm off");
    }
}

#[test]
fn noise_becomes_a_line_and_shape_stays() {
    let zigzag = |height: f64| -> Vec<AxisVector> {
        (0..=200)
            .map(|i| at(0.1 * f64::from(i), if i % 2 == 0 { 0.0 } else { height }))
            .collect()
    };
    let most_bent = |parts: &[SplinePart]| {
        let spans = parts.iter().filter_map(cubic);
        spans.map(|(c, _)| c.bounds().d2.norm()).fold(0.0, f64::max)
    };
    let noise = zigzag(0.01);
    let parts = compress(&noise, true);
    judged(&noise, &parts);
    assert!(most_bent(&parts) < 1.5, "{}", most_bent(&parts));
    let shape = zigzag(0.05);
    let parts = compress(&shape, true);
    judged(&shape, &parts);
    assert!(most_bent(&parts) > 4.0, "{}", most_bent(&parts));
}

#[test]
fn corners_are_kept_to_the_bit() {
    let mut points: Vec<_> = (0..=100).map(|i| at(0.1 * f64::from(i), 0.0)).collect();
    points.extend((1..=100).map(|i| at(10.0, 0.13 * f64::from(i))));
    let parts = compress(&points, true);
    judged(&points, &parts);
    let lines: Vec<_> = parts
        .iter()
        .filter_map(|part| match part.shape {
            PartShape::Line { start, end, .. } => Some((start, end)),
            _ => None,
        })
        .collect();
    assert!(
        lines
            .windows(2)
            .any(|p| p[0].1 == at(10.0, 0.0) && p[1].0 == at(10.0, 0.0))
    );
}

#[test]
fn difficult_paths_stay_in_the_tube() {
    let step: Vec<_> = (0..=200)
        .map(|i| at(0.1 * f64::from(i), if i < 100 { 0.0 } else { 0.1 }))
        .collect();
    let spiral: Vec<_> = (0..=3000)
        .map(|i| {
            let phi = 0.02 * f64::from(i);
            at(0.05 * phi * phi.cos(), 0.05 * phi * phi.sin())
        })
        .collect();
    let wave: Vec<_> = (0..=2000)
        .map(|i| at(0.02 * f64::from(i), 0.4 * (0.2 * f64::from(i)).sin()))
        .collect();
    let tiny: Vec<_> = (0..=5000).map(|i| at(2e-6 * f64::from(i), 0.0)).collect();
    let mut twice = spiral.clone();
    twice = twice.iter().flat_map(|p| [*p, *p]).collect();
    for points in [&step, &spiral, &wave, &tiny, &twice] {
        judged(points, &compress(points, true));
    }
    assert_eq!(compress(&twice, true).len(), compress(&spiral, true).len());
}

#[test]
fn every_block_is_told_once_and_in_order() {
    let points = circle(10.0, 0.1, Some(3));
    let mut lines = Vec::new();
    for part in compress(&points, true) {
        assert!(
            part.cuts[0].from_u == 0.0 && part.cuts.windows(2).all(|c| c[0].from_u < c[1].from_u)
        );
        lines.extend(part.cuts.iter().map(|cut| cut.line.number));
    }
    lines.dedup();
    let all: Vec<u32> = (1..points.len() as u32).collect();
    assert_eq!(lines, all);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn any_dense_path_stays_in_the_tube(
        chord_mm in (-2.3..0.5_f64).prop_map(|x| 10_f64.powf(x)),
        digits in prop::option::of(2..6_i32),
        (waves, height_mm) in (1.0..12.0_f64, 0.0..4.0_f64),
        (turn, sway) in (0.0..20.0_f64, 0.0..3.0_f64),
        noise_mm in prop::collection::vec(-0.015..0.015_f64, 50),
        is_noisy in any::<bool>(),
        is_linear in any::<bool>(),
        jumps in prop::collection::vec((0.0..1.0_f64, -2.0..2.0_f64), 0..4),
    ) {
        let count = (12.0 / chord_mm) as u32;
        let points: Vec<_> = (0..=count.max(2))
            .map(|i| {
                let t = f64::from(i) / f64::from(count.max(2));
                let jump: f64 = jumps.iter().filter(|c| c.0 < t).map(|c| c.1).sum();
                let mut point = at(12.0 * t, height_mm * (waves * t).sin() + jump);
                if is_noisy {
                    point[1] += noise_mm[i as usize % 50];
                }
                point[2] = 0.2 * (3.0 * waves * t).cos();
                if !is_linear {
                    point[3] = turn * t;
                    point[7] = sway * (waves * t).sin();
                }
                rounded(&point, digits)
            })
            .collect();
        let moves = points.windows(2).all(|p| feed_length(&(p[1] - p[0])) > 1e-6);
        prop_assume!(moves);
        judged(&points, &compress(&points, is_linear));
    }
}
