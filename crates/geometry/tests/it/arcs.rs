//! Tests of arcs and helices: derivatives against finite differences, boxes and lengths against
//! sampling.

use glidepath_geometry::{AXES, Arc, AxisVector, Plane, Segment};
use proptest::prelude::*;
use std::f64::consts::TAU;

const PLANES: [Plane; 6] = [
    Plane::Xy,
    Plane::Zx,
    Plane::Yz,
    Plane::Uv,
    Plane::Wu,
    Plane::Vw,
];

/// An arc of up to three turns in any plane, every other axis going along, the end radius off by
/// up to a thousandth (`spread`) of the start radius.
fn arc(spread: f64) -> impl Strategy<Value = Arc> {
    (
        prop::sample::select(&PLANES[..]),
        prop::array::uniform9(-50.0..50.0_f64),
        prop::array::uniform9(-20.0..20.0_f64),
        0.1..80.0_f64,
        0.0..TAU,
        prop_oneof![0.05..3.0 * TAU, -3.0 * TAU..-0.05],
        -spread..=spread,
    )
        .prop_map(
            |(plane, start, displacement, radius, angle, sweep_rad, growth)| {
                let mut start = AxisVector::from_column_slice(&start);
                let mut end = start + AxisVector::from_column_slice(&displacement);
                let (first, second) = plane.axes();
                let center = [start[first.index()], start[second.index()]];
                let end_radius = radius * (1.0 + growth);
                for (at, radius, angle) in [
                    (&mut start, radius, angle),
                    (&mut end, end_radius, angle + sweep_rad),
                ] {
                    at[first.index()] = center[0] + radius * angle.cos();
                    at[second.index()] = center[1] + radius * angle.sin();
                }
                Arc {
                    start,
                    end,
                    plane,
                    center,
                    sweep_rad,
                }
            },
        )
}

/// Path length in the axes of the plane and its normal, by many chords.
fn sampled_length(arc: &Arc) -> f64 {
    const CHORDS: u32 = 20_000;
    let (first, second) = arc.plane.axes();
    let axes = [first, second, arc.plane.normal()].map(glidepath_geometry::Axis::index);
    let at = |k: u32| {
        arc.jet(arc.length() * f64::from(k) / f64::from(CHORDS))
            .position
    };
    (0..CHORDS)
        .map(|k| {
            let chord = at(k + 1) - at(k);
            axes.iter()
                .map(|&i| chord[i] * chord[i])
                .sum::<f64>()
                .sqrt()
        })
        .sum()
}

proptest! {
    #[test]
    fn both_ends_are_met_exactly(arc in arc(1e-3)) {
        prop_assert!((arc.jet(0.0).position - arc.start).amax() < 1e-12);
        prop_assert_eq!(arc.jet(arc.length()).position, arc.end);
    }

    #[test]
    fn derivatives_are_those_of_the_position(arc in arc(1e-3), x in 0.0..1.0_f64) {
        let length = arc.length();
        let h = 1e-4 / arc.sweep_rad.abs() * length;
        let s = h + x * (length - 2.0 * h);
        let (before, at, after) = (arc.jet(s - h), arc.jet(s), arc.jet(s + h));
        prop_assert_eq!(arc.prepared().position(s), at.position);
        let curvature = (arc.sweep_rad / length).abs();
        for (low, value, high, order) in [
            (before.position, at.d1, after.position, 0),
            (before.d1, at.d2, after.d1, 1),
            (before.d2, at.d3, after.d2, 2),
        ] {
            let difference = (high - low) / (2.0 * h);
            // Truncation: (angle per h)²/6 of the derivative; rounding: 1e-14 of the value over h.
            let scale = at.d1.amax() * curvature.powi(order);
            let rounding = 1e-14 * (low.amax() + 1.0) / h;
            prop_assert!((difference - value).amax() <= 1e-8 * scale + rounding);
        }
    }

    #[test]
    fn the_radius_stays_the_same(arc in arc(0.0), x in 0.0..1.0_f64) {
        let (first, second) = arc.plane.axes();
        let p = arc.jet(x * arc.length()).position;
        let radius = (p[first.index()] - arc.center[0]).hypot(p[second.index()] - arc.center[1]);
        prop_assert!((radius / arc.start_radius() - 1.0).abs() < 1e-12);
        prop_assert!((radius / arc.end_radius() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn other_axes_go_in_proportion(arc in arc(1e-3), x in 0.0..1.0_f64) {
        let (first, second) = arc.plane.axes();
        let p = arc.jet(x * arc.length()).position;
        let straight = arc.start + (arc.end - arc.start) * x;
        for i in (0..AXES).filter(|&i| i != first.index() && i != second.index()) {
            prop_assert!((p[i] - straight[i]).abs() < 1e-12);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_length_is_that_of_many_chords(arc in arc(0.0)) {
        let want = sampled_length(&arc);
        // A chord falls short by (angle)²/24.
        let angle = arc.sweep_rad / 20_000.0;
        prop_assert!((arc.length() / want - 1.0).abs() < angle * angle / 20.0 + 1e-11);
        prop_assert!((Segment::Arc(arc).length() - arc.length()).abs() < 1e-15);
    }

    #[test]
    fn the_box_is_that_of_many_points(arc in arc(1e-4)) {
        const POINTS: u32 = 20_000;
        let (low, high) = arc.bounding_box();
        let (mut seen_low, mut seen_high) = (arc.start, arc.start);
        for k in 0..=POINTS {
            let p = arc.jet(arc.length() * f64::from(k) / f64::from(POINTS)).position;
            (seen_low, seen_high) = (seen_low.inf(&p), seen_high.sup(&p));
        }
        // What the points miss.
        let angle = arc.sweep_rad / f64::from(POINTS);
        let radius = arc.start_radius().max(arc.end_radius());
        let slack = radius * (angle * angle + 1e-12) + 1e-12;
        prop_assert!((0..AXES).all(|i| low[i] <= seen_low[i] + slack && high[i] >= seen_high[i] - slack));
        prop_assert!((0..AXES).all(|i| low[i] >= seen_low[i] - slack && high[i] <= seen_high[i] + slack));
    }
}
