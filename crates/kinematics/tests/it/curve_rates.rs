//! Tests of the joints' rates along curves, by vectors with forty digits and by differences.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test")]

use crate::support::*;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::*;
use nalgebra::Vector3;
use serde_json::Value;

const VECTORS: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/data/method/joints-vectors.json"
));

/// The mechanisms of the vectors.
fn mechanism(name: &str) -> Mechanism {
    let five_axis = |rotaries, tilt, tool_mm| {
        Mechanism::FiveAxis(FiveAxis {
            rotaries,
            tilt,
            tilt_reversed: false,
            rotary_reversed: false,
            tool_mm,
        })
    };
    let rotary_point = Vector3::zeros();
    match name {
        "corexy" => Mechanism::CoreXy(CoreXy::new(&[Axis::X, Axis::Y])),
        "linear-delta" => Mechanism::LinearDelta(delta()),
        "rotary-delta" => Mechanism::RotaryDelta(RotaryDelta {
            arm_deg: [90.0, 210.0, 330.0],
            ..rotary_delta()
        }),
        "scara" => Mechanism::Scara(Scara {
            tool_mm: 0.0,
            height_mm: 200.0,
            ..scara(Elbow::Positive)
        }),
        "hexapod" => Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0)),
        "translational-hexapod" => Mechanism::Translational(translational()),
        "table-table-ac" => five_axis(
            Rotaries::TableTable {
                tilt_point: Vector3::new(0.0, 0.0, -50.0),
                rotary_point,
            },
            Tilt::A,
            0.0,
        ),
        "table-head-bc" => five_axis(Rotaries::TableHead { rotary_point }, Tilt::B, 150.0),
        "head-head" => Mechanism::FiveAxis(head_head(Tilt::A, (false, true))),
        "trivial" => Mechanism::Trivial(Trivial::new(AxisList::new(&[Axis::X, Axis::Z]))),
        other => panic!("no mechanism {other}"),
    }
}

/// Position, velocity, acceleration and jerk of the axes.
fn curve(vector: &Value) -> [AxisVector; 4] {
    ["x", "v", "a", "j"].map(|key| axes(&numbers(&vector[key])))
}

#[test]
fn rates_of_joints_are_those_of_the_vectors() {
    let all: Value = serde_json::from_str(VECTORS).unwrap();
    let all = all.as_object().unwrap();
    assert_eq!(all.len(), 8);
    for (name, vector) in all {
        let rates = CurveRates::<6>::at(&mechanism(name), &curve(vector)).unwrap();
        for (joint, expected) in vector["joints"].as_array().unwrap().iter().enumerate() {
            for (rate, key) in rates.derivatives.iter().zip(["q", "v", "a", "j"]) {
                let expected = number(&expected[key]);
                assert!(
                    (rate[joint] - expected).abs() <= 1e-12 * expected.abs().max(1e3),
                    "{name} J{joint} {key}: {} is not {expected}",
                    rate[joint]
                );
            }
        }
    }
}

/// A curve that a control point of the `a`-th axis has moved: by its basis function times a length.
fn moved(curve: &[AxisVector; 4], (axis, by): (usize, f64), basis: &[f64; 4]) -> [AxisVector; 4] {
    let mut moved = *curve;
    for (derivative, basis) in moved.iter_mut().zip(basis) {
        derivative[axis] += by * basis;
    }
    moved
}

#[test]
fn rows_of_control_points_are_central_differences() {
    const STEP: f64 = 1e-3;
    // A cubic B-spline's basis function and its derivatives at a place, with the parameter in
    // periods of 4 ms.
    let basis = [0.6, 0.4 / 0.004, -0.9 / 1.6e-5, 1.0 / 6.4e-8];
    let all: Value = serde_json::from_str(VECTORS).unwrap();
    let mut curves: Vec<(&str, [AxisVector; 4])> = all
        .as_object()
        .unwrap()
        .iter()
        .map(|(name, vector)| (name.as_str(), curve(vector)))
        .collect();
    let turning = curve(&all["table-table-ac"]);
    curves.extend([("head-head", turning), ("trivial", turning)]);
    for (name, curve) in curves {
        let machine = mechanism(name);
        let rates = CurveRates::<6>::at(&machine, &curve).unwrap();
        let rows = rates.by_control_point(&basis);
        for axis in 0..6 {
            let [after, before] = [STEP, -STEP].map(|by| {
                let moved = moved(&curve, (axis, by), &basis);
                CurveRates::<6>::at(&machine, &moved).unwrap().derivatives
            });
            for (r, row) in rows.iter().enumerate() {
                let by_differences = (after[r] - before[r]) / (2.0 * STEP);
                let scale = row.amax().max(basis[r].abs());
                let error = (row.column(axis) - by_differences).amax();
                assert!(error <= 1e-6 * scale, "{name} axis {axis} r {r}: {error}");
            }
        }
    }
}

#[test]
fn a_place_out_of_reach_has_no_rates() {
    let mut curve = [AxisVector::zeros(); 4];
    curve[0][0] = 500.0;
    assert!(CurveRates::<3>::at(&delta(), &curve).is_err());
}
