//! Tests of arcs: flattened finely enough, of the right radius, with all their turns.

use crate::{TOLERANCE, audit, audit_within, item, kinds, point};
use glidepath_audit::ViolationKind;
use glidepath_geometry::{Arc, AxisVector, Plane, Segment};
use std::f64::consts::TAU;

fn helix(radius: f64, turns: f64, rise: f64) -> Arc {
    let mut end = point(radius * (TAU * turns).cos(), radius * (TAU * turns).sin());
    end[2] = rise;
    Arc {
        start: point(radius, 0.0),
        end,
        plane: Plane::Xy,
        center: [0.0, 0.0],
        sweep_rad: TAU * turns,
    }
}

/// Samples of a helix at equal angles, at `factor` of its radius.
fn sampled(arc: &Arc, count: u32, factor: f64) -> Vec<AxisVector> {
    let length = arc.length();
    let mut samples: Vec<_> = (0..=count)
        .map(|k| {
            let mut p = arc.jet(length * f64::from(k) / f64::from(count)).position;
            p[0] *= factor;
            p[1] *= factor;
            p
        })
        .collect();
    samples[0] = arc.start;
    if let Some(last) = samples.last_mut() {
        *last = arc.end;
    }
    samples
}

#[test]
fn the_deviation_of_chords_from_an_arc_is_their_sagitta() {
    for (radius, turns, rise, count) in [
        (10.0, 1.0, 0.0, 400),
        (50.0, 3.25, 2.0, 3000),
        (0.3, 0.7, 0.0, 60),
    ] {
        let arc = helix(radius, turns, rise);
        let report = audit(&[item(1, Segment::Arc(arc))], &sampled(&arc, count, 1.0));
        let sagitta = radius * (1.0 - (TAU * turns / f64::from(count) / 2.0).cos());
        assert!(
            report.is_clean() && report.is_complete,
            "{:?}",
            report.violations
        );
        let error = report.max_deviation_mm - sagitta;
        assert!(
            error.abs() < 2e-5 * TOLERANCE + 1e-6,
            "{error} of {sagitta}"
        );
    }
}

/// The chords that stand for an arc are on both sides of it, at most 1e-5 of the tolerance away
/// (half as much again at its ends).
#[test]
fn an_arc_is_flattened_on_both_sides() {
    let arc = helix(10.0, 1.0, 0.0);
    let report = audit_within(
        10.0,
        &[item(1, Segment::Arc(arc))],
        &sampled(&arc, 100_000, 1.0),
    );
    assert!(
        report.max_deviation_mm < 1.6e-4,
        "{}",
        report.max_deviation_mm
    );
}

#[test]
fn an_arc_of_the_wrong_radius_is_found() {
    let arc = helix(10.0, 1.0, 0.0);
    let program = [item(1, Segment::Arc(arc))];
    assert!(audit(&program, &sampled(&arc, 4000, 1.0 + 0.0019)).is_clean());
    let report = audit(&program, &sampled(&arc, 4000, 1.0 + 0.00202));
    assert!(
        matches!(kinds(&report)[..], [ViolationKind::Deviation { .. }]),
        "{:?}",
        kinds(&report)
    );
    assert!((report.max_deviation_mm - 0.0202).abs() < 1e-6);
}

/// A circle is passed twice where the program does so, and once is not enough.
#[test]
fn the_turns_of_a_circle_count() {
    let (once, twice) = (helix(10.0, 1.0, 0.0), helix(10.0, 2.0, 0.0));
    let program = [item(1, Segment::Arc(twice))];
    assert!(audit(&program, &sampled(&twice, 800, 1.0)).is_clean());
    let report = audit(&program, &sampled(&once, 400, 1.0));
    assert!(report.max_deviation_mm > 9.0, "{report:?}");
}
