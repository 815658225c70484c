//! What is made of segments: distances, order, lines.

use super::*;
use crate::in_tube::work_queue::WorkQueue;
use glidepath_geometry::{Arc, AxisVector, Plane};
use glidepath_program::{Effort, ItemKind, Limits, PathMode, Rate, Smoothing};

fn settings() -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing: Smoothing::Auto,
        corners: glidepath_program::Corners::default(),
        period_t: 0.004,
        effort: Effort::Optimal,
    }
}

fn pieces(segments: &[Segment]) -> Vec<(LedgerEntry, Reference)> {
    let start = segments[0].start();
    let (mut work_queue, mut chords) = (
        WorkQueue::new(settings(), start),
        Flattener::new(settings()),
    );
    for (line, segment) in (1..).zip(segments) {
        let kind = ItemKind::Move {
            segment: *segment,
            rate: Rate::Feed(50.0),
            mode: PathMode::Continuous { tolerance_mm: None },
        };
        assert_eq!(
            work_queue.push(&Item {
                line,
                block: 0,
                kind
            }),
            Ok(())
        );
    }
    work_queue.finish();
    let mut pieces = Vec::new();
    while let Some(product) = chords.next(&mut work_queue) {
        if let Product::Piece(entry, reference) = product {
            pieces.push((entry, reference));
        }
    }
    pieces
}

fn distance_mm(a: &AxisVector, b: &AxisVector, point: &AxisVector) -> f64 {
    let along = b - a;
    let u = (along.dot(&(point - a)) / along.norm_squared()).clamp(0.0, 1.0);
    (point - (a + along * u)).norm()
}

#[test]
fn chords_of_a_helix_and_their_tolerance_stay_within_that_of_the_program() {
    let mut start = AxisVector::zeros();
    start[0] = 10.0;
    let mut end = start;
    end[2] = 3.0;
    let arc = Arc {
        start,
        end,
        plane: Plane::Xy,
        center: [0.0, 0.0],
        sweep_rad: core::f64::consts::TAU * 2.0,
    };
    let pieces = pieces(&[Segment::Arc(arc)]);
    let mut from = start;
    let mut worst_mm = 0.0_f64;
    for (entry, reference) in &pieces {
        assert_eq!(entry.line.number, 1);
        let left_mm = reference.tolerance_mm;
        for k in 0..=2000 {
            let at = arc.jet(arc.length() * f64::from(k) / 2000.0).position;
            // Only the turn the chord belongs to is near it.
            let gap_mm = distance_mm(&from, &reference.end, &at);
            let along = (at - from).norm() + (at - reference.end).norm();
            if along < 1.001 * (reference.end - from).norm() {
                worst_mm = worst_mm.max(gap_mm);
                assert!(gap_mm + left_mm <= 0.02 + 1e-12, "{gap_mm} and {left_mm}");
            }
        }
        assert!(left_mm >= 0.018);
        from = reference.end;
    }
    assert_eq!(from, end);
    assert!(
        worst_mm > 0.5e-3,
        "the tolerance of flattening is used: {worst_mm}"
    );
    assert!(pieces.len() < 600, "{}", pieces.len());
}

#[test]
fn dense_chords_merge_and_tell_their_lines() {
    let point = |i: u32| {
        let mut point = AxisVector::zeros();
        let x = 0.01 * f64::from(i);
        (point[0], point[1]) = (x, 0.02 * x * x);
        point
    };
    let segments: Vec<_> = (0..500)
        .map(|i| Segment::line(point(i), point(i + 1)))
        .collect();
    let pieces = pieces(&segments);
    assert!(pieces.len() < 60, "{}", pieces.len());
    let (mut from, mut next_line) = (point(0), 1);
    for (entry, reference) in &pieces {
        let lines = [(0.0, entry.line)]
            .into_iter()
            .chain(entry.lines.iter().copied());
        for (start_s, line) in lines {
            assert_eq!(line.number, next_line, "every block in order");
            let vertex = point(line.number - 1);
            let gap_mm = distance_mm(&from, &reference.end, &vertex);
            assert!(gap_mm + reference.tolerance_mm <= 0.02 + 1e-12, "{gap_mm}");
            assert!(((vertex - from).norm() - start_s).abs() < 1e-3, "{start_s}");
            next_line += 1;
        }
        from = reference.end;
    }
    assert_eq!(next_line, 501);
}

#[test]
fn what_moves_too_short_have_left_belongs_to_the_last_piece() {
    let at = |x: f64| {
        let mut point = AxisVector::zeros();
        point[0] = x;
        point
    };
    let ends = [0.0, 2.5, 0.0, 2.5e-8];
    let segments: Vec<_> = ends
        .windows(2)
        .map(|ends| Segment::line(at(ends[0]), at(ends[1])))
        .collect();
    let pieces = pieces(&segments);
    let ends: Vec<_> = pieces.iter().map(|(_, piece)| piece.end[0]).collect();
    assert_eq!(ends, [2.5, 2.5e-8]);
    let lines: Vec<_> = pieces[1]
        .0
        .lines
        .iter()
        .map(|(s, line)| (*s, line.number))
        .collect();
    assert_eq!(lines, [(2.5, 3)]);
    assert!(pieces[1].1.tolerance_mm <= 0.02 - 2.5e-8);
}
