//! Check vectors, computed with forty digits, and machines to test with.

#![allow(dead_code, reason = "every test program uses a part of it")]
#![allow(clippy::unwrap_used, reason = "the vectors are well formed")]

use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::*;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

const VECTORS: &str = include_str!(concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../tests/data/method/parallel-vectors.json"
));

/// One check vector.
pub(crate) struct Vector {
    pub(crate) id: String,
    pub(crate) input: Value,
    pub(crate) expect: Value,
    pub(crate) tolerance: f64,
}

/// The vectors of a kind, at least one.
pub(crate) fn vectors(kind: &str) -> Vec<Vector> {
    let all: Value = serde_json::from_str(VECTORS).unwrap();
    let found: Vec<Vector> = all["vectors"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|v| v["kind"] == kind)
        .map(|v| Vector {
            id: v["id"].as_str().unwrap().to_owned(),
            input: v["input"].clone(),
            expect: v["expect"].clone(),
            tolerance: v["tol_abs"].as_f64().unwrap(),
        })
        .collect();
    assert!(!found.is_empty(), "no vector of kind {kind}");
    found
}

impl Vector {
    pub(crate) fn close(&self, got: &[f64], want: &Value) {
        let want = numbers(want);
        assert_eq!(got.len(), want.len(), "{}", self.id);
        for (got, want) in got.iter().zip(&want) {
            assert!(
                (got - want).abs() <= self.tolerance,
                "{}: {got} is not {want} within {}",
                self.id,
                self.tolerance
            );
        }
    }
}

pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().map(|v| v.as_f64().unwrap()).collect(),
        one => vec![one.as_f64().unwrap()],
    }
}

pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

pub(crate) fn point(value: &Value) -> Vector3<f64> {
    Vector3::from_column_slice(&numbers(value))
}

/// X Y Z A B C.
pub(crate) fn axes(values: &[f64]) -> AxisVector {
    let mut axes = AxisVector::zeros();
    for (i, value) in values.iter().enumerate() {
        axes[i] = *value;
    }
    axes
}

/// Orientation as a matrix, given as quaternion, rotation vector or not at all.
pub(crate) fn orientation(input: &Value) -> Matrix3<f64> {
    if let Some(Value::Array(_)) = input.get("quat_wxyz") {
        let q = numbers(&input["quat_wxyz"]);
        let q = Quaternion::new(q[0], q[1], q[2], q[3]);
        return UnitQuaternion::from_quaternion(q)
            .to_rotation_matrix()
            .into_inner();
    }
    if let Some(Value::Array(_)) = input.get("rotation_vector_deg") {
        let v = point(&input["rotation_vector_deg"]).map(f64::to_radians);
        return nalgebra::Rotation3::new(v).into_inner();
    }
    Matrix3::identity()
}

/// A, B, C in degrees of R = Rz(C) Ry(B) Rx(A).
pub(crate) fn angles_deg(r: &Matrix3<f64>) -> [f64; 3] {
    let (a, b, c) = nalgebra::Rotation3::from_matrix_unchecked(*r).euler_angles();
    [a, b, c].map(f64::to_degrees)
}

pub(crate) fn pose(input: &Value) -> AxisVector {
    let p = point(&input["p"]);
    let [a, b, c] = angles_deg(&orientation(input));
    axes(&[p.x, p.y, p.z, a, b, c])
}

/// Two similar regular hexagons, read as a hexapod: the published, singular geometry.
pub(crate) fn similar_hexagons() -> Hexapod {
    let on = |radius: f64| {
        core::array::from_fn(|k| {
            let (sin, cos) = (60.0 * f64::from(u8::try_from(k).unwrap()))
                .to_radians()
                .sin_cos();
            Vector3::new(radius * cos, radius * sin, 0.0)
        })
    };
    Hexapod {
        base: on(400.0),
        platform: on(150.0),
        tool: Vector3::zeros(),
        guards: Guards::NONE,
    }
}

pub(crate) fn translational() -> TranslationalHexapod {
    TranslationalHexapod {
        radius_difference_mm: 250.0,
        base_z_mm: 0.0,
    }
}

pub(crate) fn delta() -> LinearDelta {
    LinearDelta::new(
        269.0,
        130.25,
        [90.0, 210.0, 330.0],
        &[Axis::X, Axis::Y, Axis::Z],
    )
}

pub(crate) fn rotary_delta() -> RotaryDelta {
    RotaryDelta {
        base_radius_mm: 90.0,
        platform_radius_mm: 40.0,
        upper_arm_mm: 120.0,
        forearm_mm: 260.0,
        arm_deg: [0.0, 120.0, 240.0],
    }
}

pub(crate) fn five_bar() -> FiveBar {
    FiveBar::new(200.0, 250.0, 350.0, &[Axis::X, Axis::Y, Axis::Z])
}

pub(crate) fn scara(elbow: Elbow) -> Scara {
    Scara {
        upper_arm_mm: 340.0,
        forearm_mm: 250.0,
        tool_mm: 50.0,
        height_mm: 490.0 + 50.0 - 50.0,
        elbow,
    }
}

pub(crate) fn table_table(tilt: Tilt, reversed: bool) -> FiveAxis {
    FiveAxis {
        rotaries: Rotaries::TableTable {
            tilt_point: Vector3::new(0.0, 0.0, -50.0),
            rotary_point: match tilt {
                Tilt::A => Vector3::new(0.0, 20.0, 0.0),
                Tilt::B | Tilt::Skewed(_) => Vector3::new(20.0, 0.0, 0.0),
            },
        },
        tilt,
        tilt_reversed: reversed,
        rotary_reversed: reversed,
        tool_mm: 80.0,
    }
}

pub(crate) fn head_head(tilt: Tilt, reversed: (bool, bool)) -> FiveAxis {
    FiveAxis {
        rotaries: Rotaries::HeadHead {
            rotary_to_tilt: Vector3::zeros(),
            tilt_to_spindle: Vector3::zeros(),
        },
        tilt,
        tilt_reversed: reversed.0,
        rotary_reversed: reversed.1,
        tool_mm: 250.0,
    }
}

/// A point of the unit cube; those of the numbers from 1 on fill it evenly.
pub(crate) fn halton_place<const N: usize>(number: u32) -> [f64; N] {
    const BASES: [u32; 6] = [2, 3, 5, 7, 11, 13];
    core::array::from_fn(|axis| {
        let (mut index, mut share, mut sum) = (number, 1.0, 0.0);
        while index > 0 {
            share /= f64::from(BASES[axis]);
            sum += share * f64::from(index % BASES[axis]);
            index /= BASES[axis];
        }
        sum
    })
}

/// Right-handed about x, y or z, by an angle in degrees.
pub(crate) fn about(axis: usize, degrees: f64) -> Matrix3<f64> {
    let (s, c) = degrees.to_radians().sin_cos();
    match axis {
        0 => Matrix3::new(1., 0., 0., 0., c, -s, 0., s, c),
        1 => Matrix3::new(c, 0., s, 0., 1., 0., -s, 0., c),
        _ => Matrix3::new(c, -s, 0., s, c, 0., 0., 0., 1.),
    }
}

/// A tilt axis of a letter about a direction.
pub(crate) fn skewed(axis: Axis, direction: [f64; 3]) -> Tilt {
    Tilt::Skewed(SkewedTilt::new(axis, &direction.into()).unwrap())
}
