//! The three previews against reference values, dense sampling, and each other.

pub(crate) mod curves;
mod random;
mod table;

use curves::{definition, numbers, path, reference};
use glidepath_geometry::{AxisVector, Nurbs, NurbsPath};
use glidepath_motion::preview::{
    AdvanceRetreat, Certified, Demand, Method, Minimum, Traditional, preview,
};

#[test]
fn regions_and_minima_are_the_reference() {
    let vectors = reference("preview_vectors");
    for case in vectors["cases"].as_array().expect("cases") {
        let name = case["curve"].as_str().expect("name");
        let number = |key: &str| case[key].as_f64().expect("number");
        let demand = Demand::chord(number("F"), number("T"), number("delta"));
        let critical = number("rho_crit");
        assert!((demand.critical_radius_mm() / critical - 1.0).abs() < 1e-14);
        let found = preview(&path(name), &demand, &Certified);
        let regions = case["regions"].as_array().expect("regions");
        assert_eq!(found.regions.len(), regions.len(), "{name} {}", number("T"));
        for (region, expected) in found.regions.iter().zip(regions) {
            let expected = numbers(expected);
            assert!((region.from_u - expected[0]).abs() < 1e-8, "{name}");
            assert!((region.to_u - expected[1]).abs() < 1e-8, "{name}");
        }
        let minima = found.regions.iter().flat_map(|region| &region.minima);
        let expected = case["critical"].as_array().expect("critical");
        assert_eq!(minima.clone().count(), expected.len(), "{name}");
        for (minimum, expected) in minima.zip(expected) {
            let expected = numbers(expected);
            assert!(
                (minimum.u - expected[0]).abs() < 1e-8,
                "{name} {}",
                minimum.u
            );
            assert!((minimum.radius_mm / expected[1] - 1.0).abs() < 1e-9);
            assert!((minimum.cap_v / expected[2] - 1.0).abs() < 1e-9);
        }
    }
}

/// A demand whose critical radius is this.
fn below_radius(radius_mm: f64) -> Demand {
    let (period_t, chord_mm) = (0.001, 1e-6);
    let feed_v = (8.0 * chord_mm * (radius_mm - 0.5 * chord_mm)).sqrt() / period_t;
    Demand::chord(feed_v, period_t, chord_mm)
}

#[test]
fn every_curvature_maximum_of_the_reference_curves() {
    let all = reference("curve_reference");
    let mut more = 0;
    for (name, expected) in all["curves"].as_object().expect("curves") {
        let Some(expected) = expected["curvature_maxima"].as_array() else {
            continue;
        };
        let path = path(name);
        let found = preview(&path, &below_radius(1e9), &Certified);
        let mut minima: Vec<_> = found.regions.iter().flat_map(|r| &r.minima).collect();
        for expected in expected {
            let (u, rho) = (expected["u"].as_f64(), expected["rho_mm"].as_f64());
            let (u, rho) = (u.expect("u"), rho.expect("rho"));
            let same =
                |m: &&Minimum| (m.u - u).abs() < 1e-8 && (m.radius_mm / rho - 1.0).abs() < 1e-9;
            let index = minima.iter().position(same);
            minima.remove(index.unwrap_or_else(|| panic!("{name}: nothing at {u}")));
        }
        // The reference leaves out a maximum with a larger one beyond the next inflection.
        for minimum in minima {
            let around = [-1e-5, 1e-5].map(|du| path.curve().curvature(minimum.u + du));
            assert!(
                around.iter().all(|k| *k * minimum.radius_mm < 1.0),
                "{name} {minimum:?}"
            );
            more += 1;
        }
    }
    assert_eq!(more, 11, "one of the fan, ten of the star");
}

#[test]
fn the_table_in_the_documentation_is_what_the_methods_do() {
    let shown = include_str!("../../../src/preview/table.md");
    assert_eq!(shown, table::markdown(), "run the example preview_table");
}

#[test]
fn a_circle_is_sensitive_as_a_whole_or_not_at_all() {
    let circle = path("circle");
    let slow = preview(&circle, &below_radius(49.999), &Certified);
    assert_eq!(slow.regions, []);
    let fast = preview(&circle, &below_radius(50.001), &Certified);
    assert_eq!(fast.regions.len(), 1);
    let region = &fast.regions[0];
    assert!(region.from_u <= 0.0 && region.to_u >= 1.0);
    assert_eq!(region.minima.len(), 1, "a plateau is one minimum");
    assert!((region.minima[0].radius_mm - 50.0).abs() < 1e-9);
}

#[test]
fn a_line_needs_no_evaluation() {
    let points: Vec<AxisVector> = (0..6)
        .map(|i| AxisVector::repeat(1.0) * f64::from(i))
        .collect();
    let knots = [0.0, 0.0, 0.0, 0.0, 0.3, 0.5, 1.0, 1.0, 1.0, 1.0];
    let line = Nurbs::new(3, &points, &[1.0, 2.0, 1.0, 3.0, 1.0, 1.0], &knots).expect("valid");
    let found = preview(&NurbsPath::new(line), &below_radius(1e6), &Certified);
    assert_eq!((found.points_evaluated, found.regions.len()), (0, 0));
}

#[test]
fn cusps_and_corners_are_places_to_stop() {
    let flat = |points: &[[f64; 2]]| -> Vec<AxisVector> {
        let over_axes = |p: &[f64; 2]| {
            let mut point = AxisVector::zeros();
            (point[0], point[1]) = (p[0], p[1]);
            point
        };
        points.iter().map(over_axes).collect()
    };
    // (t², t³) from -1 to 1 with its cusp at u = ½.
    let third = 1.0 / 3.0;
    let cusp = flat(&[[1.0, -1.0], [-third, 1.0], [-third, -1.0], [1.0, 1.0]]);
    let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let cusp = Nurbs::new(3, &cusp, &[1.0; 4], &knots).expect("valid");
    let found = preview(&NurbsPath::new(cusp), &below_radius(0.1), &Certified);
    assert_eq!(found.regions.len(), 1);
    let minimum = found.regions[0].minima[0];
    assert!((minimum.u - 0.5).abs() < 1e-4, "{minimum:?}");
    assert!(minimum.cap_v <= 0.0, "{minimum:?}");

    let zigzag = flat(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [2.0, 1.0], [3.0, 1.0]]);
    let knots = [0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0];
    let zigzag = Nurbs::new(1, &zigzag, &[1.0; 5], &knots).expect("valid");
    let found = preview(&NurbsPath::new(zigzag), &below_radius(0.1), &Certified);
    let corners: Vec<f64> = found.regions.iter().map(|r| r.minima[0].u).collect();
    assert_eq!(corners, [1.0, 2.0], "the third knot is straight on");
    assert!(found.regions.iter().all(|r| r.minima[0].cap_v <= 0.0));
}

#[test]
fn limits_of_acceleration_and_jerk_make_the_same_kind_of_threshold() {
    let mut demand = Demand::chord(100.0, 0.001, 0.01);
    assert!(demand.critical_radius_mm() < 0.2);
    demand.normal_a = 2000.0;
    assert!((demand.critical_radius_mm() - 5.0).abs() < 1e-12);
    assert!((demand.cap_v(1.25) - 50.0).abs() < 1e-12);
    demand.normal_j = 40_000.0;
    assert!((demand.critical_radius_mm() - 5.0).abs() < 1e-12);
    assert!((demand.cap_v(1.0) - 40_000.0_f64.cbrt()).abs() < 1e-12);
    assert!((demand.cap_v(f64::INFINITY) - 100.0).abs() < 1e-12);
}

#[test]
fn the_threshold_is_where_the_chord_error_is_the_tolerance() {
    for (feed_v, period_t) in [(100.0, 0.001), (100.0, 0.004), (1.0, 0.01)] {
        let demand = Demand::chord(feed_v, period_t, 0.001);
        let radius_mm = demand.critical_radius_mm();
        assert!((demand.chord_error_mm(feed_v, radius_mm) / 0.001 - 1.0).abs() < 1e-12);
        assert!((demand.cap_v(radius_mm) / feed_v - 1.0).abs() < 1e-12);
        for radius_mm in [0.0005, 0.01, 1.0, 19.0] {
            let cap_v = demand.cap_v(radius_mm);
            assert!(demand.chord_error_mm(cap_v, radius_mm) <= 0.001 * (1.0 + 1e-9));
        }
    }
}

#[test]
fn advance_and_retreat_finds_what_its_step_cannot_pass_over() {
    // Steps no longer than the first: as good as reading every tick.
    let careful = AdvanceRetreat {
        max_growth: 1.0,
        ..AdvanceRetreat::default()
    };
    let butterfly = path("butterfly");
    let demand = Demand::chord(100.0, 0.001, 0.001);
    let truth = preview(&butterfly, &demand, &Certified);
    let found = preview(&butterfly, &demand, &careful);
    assert_eq!(found.missed(&truth), 0);
    assert_eq!(found.regions.len(), truth.regions.len());
    for (found, truth) in found.regions.iter().zip(&truth.regions) {
        let (found, truth) = (found.minima[0], truth.minima[0]);
        assert!(
            (found.cap_v - truth.cap_v).abs() < 0.02,
            "{found:?} {truth:?}"
        );
    }
}

#[test]
fn all_methods_count_through_the_same_probe() {
    let star = path("star");
    let demand = Demand::chord(100.0, 0.001, 0.001);
    let patent = AdvanceRetreat::default();
    let methods: [&dyn Method; 3] = [&Traditional, &patent, &Certified];
    let counts = methods.map(|method| preview(&star, &demand, method).points_evaluated);
    assert!(
        counts[0] > counts[1] && counts[1] > counts[2] && counts[2] > 0,
        "{counts:?}"
    );
    let (_, points, _, _) = definition("star");
    assert!(counts[2] < 20 * points.len() as u64);
}
