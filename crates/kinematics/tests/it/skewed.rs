//! Tests of skewed tilt axes: how far they lean the tool, what happens there and at the pole, and what is none.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::float_cmp,
    reason = "a test; C stays as it is"
)]

use crate::support::*;
use glidepath_geometry::Axis;
use glidepath_kinematics::*;
use nalgebra::Vector3;

fn nutating(direction: [f64; 3]) -> FiveAxis {
    FiveAxis {
        tilt: skewed(Axis::B, direction),
        ..head_head(Tilt::B, (false, false))
    }
}

/// A direction that leans by an angle from z, towards a heading.
fn leaning(lean_deg: f64, heading_deg: f64) -> Vector3<f64> {
    about(2, heading_deg) * about(1, lean_deg) * Vector3::z()
}

#[test]
fn half_a_turn_leans_by_twice_the_skew() {
    for (skew_deg, most_deg) in [
        (45.0, 90.0),
        (30.0, 60.0),
        (60.0, 120.0),
        (135.0, 90.0),
        (90.0, 180.0),
    ] {
        let direction = leaning(skew_deg, 90.0);
        let machine = nutating(direction.into());
        let Tilt::Skewed(tilt) = machine.tilt else {
            panic!("it is skewed");
        };
        assert!((tilt.most_lean_deg() - most_deg).abs() < 1e-9);
        let tool = machine.tool_axis(180.0, 0.0);
        let lean_deg = tool.z.clamp(-1.0, 1.0).acos().to_degrees();
        assert!((lean_deg - most_deg).abs() < 1e-5, "{skew_deg}: {lean_deg}");
        for heading in [0.0, 77.0, 200.0] {
            let inside = machine.branches_deg(&leaning(most_deg - 1e-3, heading), 0.0);
            assert!(inside.is_some(), "{skew_deg}");
            let beyond = machine.branches_deg(&leaning(most_deg + 1e-3, heading), 0.0);
            assert_eq!(beyond.is_none(), most_deg < 180.0, "{skew_deg}");
            let angles = machine.angles_deg(&leaning(most_deg + 1e-3, heading), (0.0, 0.0));
            assert_eq!(angles.is_none(), most_deg < 180.0);
        }
    }
}

#[test]
fn at_the_most_both_ways_are_one() {
    let machine = nutating([0.0, 1.0, 1.0]);
    // Half a turn about (0, 1, 1) brings z to y.
    let [one, other] = machine.branches_deg(&Vector3::y(), 10.0).unwrap();
    for (tilt, rotary) in [one, other] {
        assert!(
            (tilt.abs() - 180.0).abs() < 1e-5 && rotary.abs() < 1e-5,
            "{tilt} {rotary}"
        );
    }
    // A third of a turn leans by the angle whose half has the sine sin 45° sin 60°.
    let lean_deg = 2.0 * (0.5_f64.sqrt() * 0.75_f64.sqrt()).asin().to_degrees();
    let [(tilt, _), (back, _)] = machine.branches_deg(&leaning(lean_deg, 33.0), 0.0).unwrap();
    assert!((tilt - 120.0).abs() < 1e-9 && (back + 120.0).abs() < 1e-9);
}

#[test]
fn along_the_axis_of_c_it_stays() {
    for direction in [[0.0, 1.0, 1.0], [1.0, 0.3, -0.5], [1.0, 1.0, 0.0]] {
        let machine = nutating(direction);
        let up = machine.branches_deg(&Vector3::z(), 77.0).unwrap();
        assert_eq!(up.map(|(_, rotary)| rotary), [77.0; 2]);
        assert!(up.iter().all(|(tilt, _)| tilt.abs() < 1e-9));
        let near = machine.branches_deg(&leaning(1e-5, 20.0), 77.0).unwrap();
        for (tilt, rotary) in near {
            let tool = machine.tool_axis(tilt, rotary);
            assert!(
                (tool - leaning(1e-5, 20.0)).norm() < 1e-13,
                "{tilt} {rotary}"
            );
        }
    }
    let down = nutating([1.0, 1.0, 0.0])
        .branches_deg(&-Vector3::z(), 12.0)
        .unwrap();
    assert_eq!(down, [(180.0, 12.0), (-180.0, 12.0)]);
}

#[test]
fn a_skewed_axis_along_x_or_y_is_the_plain_one() {
    for (plain, axis, direction) in [
        (Tilt::A, Axis::A, [1.0, 0.0, 0.0]),
        (Tilt::B, Axis::B, [0.0, 1.0, 0.0]),
    ] {
        for make in [
            table_table as fn(Tilt, bool) -> FiveAxis,
            |tilt, reversed| head_head(tilt, (reversed, false)),
        ] {
            for reversed in [false, true] {
                let machine = make(plain, reversed);
                let other = FiveAxis {
                    tilt: skewed(axis, direction),
                    ..machine
                };
                assert_eq!(other.tilt_axis(), machine.tilt_axis());
                for number in 1..=1000 {
                    let [x, y, z, tilt, c, _] =
                        halton_place::<6>(number).map(|unit| 340.0 * unit - 170.0);
                    let at = if axis == Axis::A {
                        axes(&[x, y, z, tilt, 0.0, c])
                    } else {
                        axes(&[x, y, z, 0.0, tilt, c])
                    };
                    let (one, two) = (machine.inverse(&at).unwrap(), other.inverse(&at).unwrap());
                    assert!((one - two).amax() < 1e-10);
                    let tool = machine.tool_axis(tilt, c);
                    let both =
                        [&machine, &other].map(|machine| machine.branches_deg(&tool, c).unwrap());
                    for (one, two) in both[0].iter().zip(&both[1]) {
                        // Half a turn from where C was, both ways to count it are as near.
                        let apart = one.1 - two.1;
                        let apart = apart - 360.0 * (apart / 360.0).round();
                        assert!(
                            (one.0 - two.0).abs() < 1e-9 && apart.abs() < 1e-9,
                            "{both:?}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn directions_that_tilt_nothing_are_none() {
    let new = |axis, direction: [f64; 3]| SkewedTilt::new(axis, &direction.into());
    for direction in [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.05, -1.0],
        [f64::NAN, 1.0, 1.0],
        [0.0, f64::INFINITY, 1.0],
        [1e-300, 0.0, 0.0],
    ] {
        assert_eq!(new(Axis::B, direction), None, "{direction:?}");
    }
    assert_eq!(new(Axis::C, [0.0, 1.0, 1.0]), None);
    let long = new(Axis::B, [0.0, 500.0, 500.0]).unwrap();
    let wanted = Vector3::new(0.0, 0.5_f64.sqrt(), 0.5_f64.sqrt());
    assert!((long.direction() - wanted).norm() < 1e-15);
}
