//! Tests by every check vector of a mechanism.

#![allow(clippy::unwrap_used, reason = "a test")]

use crate::support::*;
use glidepath_geometry::{Axis, AxisVector, Jet};
use glidepath_kinematics::*;
use nalgebra::{Matrix3, Vector3};
use serde_json::{Value, json};

fn first<const COUNT: usize>(joints: &JointVector) -> Vec<f64> {
    joints.iter().take(COUNT).copied().collect()
}

#[test]
fn translation_inverse_forward_and_closure() {
    let machine = translational();
    for v in vectors("hexapod_ik_translation") {
        let joints = machine.inverse(&pose(&v.input)).unwrap();
        v.close(&first::<6>(&joints), &v.expect["lengths"]);
        // The same struts read as a hexapod have the same lengths.
        let joints = similar_hexagons().inverse(&pose(&v.input)).unwrap();
        v.close(&first::<6>(&joints), &v.expect["lengths"]);
    }
    for v in vectors("hexapod_fk_translation") {
        let lengths = axes(&numbers(&v.input["lengths"]));
        let back = machine.forward(&lengths, &AxisVector::zeros()).unwrap();
        v.close(&back.as_slice()[..3], &v.expect["p"]);
    }
    for v in vectors("hexapod_closure") {
        let joints = machine.inverse(&pose(&v.input)).unwrap();
        for k in 0..3 {
            let sum = joints[k].powi(2) + joints[k + 3].powi(2);
            v.close(&[sum], &v.expect["opposite_sum"]);
        }
        assert!(machine.closure_mm(&joints) < 1e-10);
        let mut wrong = joints;
        wrong[2] += 0.1;
        assert!(machine.closure_mm(&wrong) > 0.05);
    }
}

#[test]
fn rates_along_a_line() {
    for v in vectors("hexapod_line_rates") {
        let velocity = axes(&numbers(&v.input["v"]));
        let series = axis_series::<4>(&[pose(&v.input), velocity]);
        let joints = translational().inverse_series(&series).unwrap();
        for (k, key) in ["lengths", "rates", "accels", "jerks"]
            .into_iter()
            .enumerate()
        {
            if let Some(want) = v.expect.get(key) {
                let got: Vec<f64> = joints.iter().take(6).map(|s| s.derivative(k)).collect();
                v.close(&got, want);
            }
        }
    }
}

#[test]
fn error_of_straight_joint_motion() {
    for v in vectors("strut_linear_interp_error") {
        let lengths = |p: &AxisVector| translational().inverse(p).unwrap();
        let (a, b) = (
            axes(&numbers(&v.input["pa"])),
            axes(&numbers(&v.input["pb"])),
        );
        let error = (lengths(&a) + lengths(&b)) * 0.5 - lengths(&((a + b) * 0.5));
        v.close(&first::<6>(&error), &v.expect["error_at_middle"]);
        let bound = number(&v.expect["bound_L2_8l"]);
        assert!(error.iter().all(|e| *e >= 0.0 && *e <= bound));
    }
}

#[test]
fn pose_inverse_and_jacobian() {
    let machine = Hexapod::paired(400.0, 150.0, 15.0);
    for v in vectors("hexapod_ik_pose") {
        for (i, want) in v.input["geometry"]["base_points"]
            .as_array()
            .unwrap()
            .iter()
            .enumerate()
        {
            v.close(machine.base[i].as_slice(), want);
        }
        for (i, want) in v.input["geometry"]["platform_points"]
            .as_array()
            .unwrap()
            .iter()
            .enumerate()
        {
            v.close(machine.platform[i].as_slice(), want);
        }
        let axes = pose(&v.input);
        v.close(
            &first::<6>(&machine.inverse(&axes).unwrap()),
            &v.expect["lengths"],
        );
        let jacobian = machine.strut_jacobian(&axes);
        for (i, want) in v.expect["jacobian"].as_array().unwrap().iter().enumerate() {
            let row: Vec<f64> = jacobian.row(i).iter().copied().collect();
            v.close(&row, want);
        }
    }
}

/// Angular velocity of R = Rz(C) Ry(B) Rx(A) per rate of A, B and C, rad per degree.
fn rate_map(axes: &AxisVector) -> Matrix3<f64> {
    let (b, c) = (axes[4].to_radians(), axes[5].to_radians());
    let by_a = Vector3::new(b.cos() * c.cos(), b.cos() * c.sin(), -b.sin());
    let by_b = Vector3::new(-c.sin(), c.cos(), 0.0);
    Matrix3::from_columns(&[by_a, by_b, Vector3::z()]) * 1.0_f64.to_radians()
}

#[test]
fn pose_rates_and_accelerations() {
    let machine = Hexapod::paired(400.0, 150.0, 15.0);
    for v in vectors("hexapod_rates") {
        let position = pose(&v.input);
        let (omega, alpha) = (point(&v.input["omega"]), point(&v.input["alpha"]));
        let map = rate_map(&position);
        let angle_rates = map.try_inverse().unwrap() * omega;
        // α = E ä + Ė ȧ; Ė by central differences of the exact E.
        let at = |h: f64| {
            let mut moved = position;
            for i in 0..3 {
                moved[3 + i] += h * angle_rates[i];
            }
            rate_map(&moved)
        };
        let h = 1e-4;
        let map_rate = (at(h) - at(-h)) / (2.0 * h);
        let angle_accelerations = map.try_inverse().unwrap() * (alpha - map_rate * angle_rates);
        let join = |p: &Value, a: Vector3<f64>| {
            let p = point(p);
            axes(&[p.x, p.y, p.z, a.x, a.y, a.z])
        };
        let velocity = join(&v.input["v"], angle_rates);
        let acceleration = join(&v.input["a"], angle_accelerations);
        let motion = machine.motion(&position, &velocity, &acceleration).unwrap();
        v.close(&first::<6>(&motion.velocity), &v.expect["rates"]);
        // The differences above are good to 1e-7.
        let accelerations = first::<6>(&motion.acceleration);
        for (got, want) in accelerations.iter().zip(numbers(&v.expect["accels"])) {
            assert!((got - want).abs() < 1e-6, "{got} {want}");
        }
    }
}

#[test]
fn pose_forward() {
    let machine = Hexapod::paired(400.0, 150.0, 15.0);
    for v in vectors("hexapod_fk_newton") {
        let lengths = axes(&numbers(&v.input["lengths"]));
        let start = axes(&numbers(&v.input["start_p"]));
        let got = machine.forward(&lengths, &start).unwrap();
        v.close(&got.as_slice()[..3], &v.expect["p"]);
        let want = angles_deg(&orientation(&v.expect));
        for i in 0..3 {
            assert!((got[3 + i] - want[i]).abs() < 1e-8);
        }
    }
}

#[test]
fn singular_geometries_and_poses() {
    for v in vectors("hexapod_rank") {
        let machine = if v.input["geometry"]["base"].is_string() {
            similar_hexagons()
        } else {
            Hexapod::paired(400.0, 150.0, 15.0)
        };
        let axes = pose(&v.input);
        let mut jacobian = machine.strut_jacobian(&axes);
        let mut rotations = jacobian.fixed_columns_mut::<3>(3);
        rotations /= number(&v.input["rotation_scale"]);
        let mut values: Vec<f64> = jacobian.singular_values().iter().copied().collect();
        values.sort_by(|a, b| b.total_cmp(a));
        v.close(&values, &v.expect["singular_values"]);
        let rank = values.iter().filter(|s| **s > 1e-9).count();
        assert_eq!(json!(rank), v.expect["rank"], "{}", v.id);
        let admitted = machine.admit(&axes);
        if rank == 6 {
            let conditioning = machine.conditioning(&axes).unwrap();
            v.close(&[conditioning.condition], &v.expect["cond"]);
            assert_eq!(admitted, Ok(()));
        } else {
            assert!(matches!(admitted, Err(KinematicsError::Singular { .. })));
        }
    }
}

#[test]
fn angles_of_struts() {
    for v in vectors("hexapod_joint_angles") {
        let wanted = numbers(&v.expect["base_u_joint_deg"]);
        let mut machine = similar_hexagons();
        // Struts parallel to those of the similar hexagons, on a hexapod that is not singular.
        let paired = Hexapod::paired(400.0, 150.0, 15.0);
        let struts = |m: &Hexapod, p: Vector3<f64>| {
            core::array::from_fn::<_, 6, _>(|i| p + m.platform[i] - m.base[i])
        };
        let p = point(&v.input["p"]);
        let got: Vec<f64> = struts(&machine, p)
            .iter()
            .map(|s| s.angle(&Vector3::z()).to_degrees())
            .collect();
        v.close(&got, &v.expect["base_u_joint_deg"]);
        // The guard refuses just below the largest angle of the machine it guards.
        let steepest = struts(&paired, p)
            .iter()
            .map(|s| s.angle(&Vector3::z()).to_degrees())
            .fold(0.0, f64::max);
        machine = paired;
        for (most, fine) in [(steepest + 1e-6, true), (steepest - 1e-6, false)] {
            machine.guards.max_base_angle_deg = most;
            assert_eq!(machine.admit(&pose(&v.input)).is_ok(), fine);
        }
        assert_eq!(wanted.len(), 6);
    }
}

#[test]
fn speed_caps_of_struts() {
    for v in vectors("hexapod_path_caps") {
        let jet = Jet {
            position: pose(&v.input),
            d1: axes(&numbers(&v.input["dp_ds"])),
            d2: axes(&numbers(&v.input["d2p_ds2"])),
            d3: AxisVector::zeros(),
        };
        let rates = PathRates::at(&translational(), &jet).unwrap();
        v.close(&first::<6>(&rates.d1), &v.expect["l1"]);
        v.close(&first::<6>(&rates.d2), &v.expect["l2"]);
        let limit = JointLimit {
            velocity: number(&v.input["rate_limit"]),
            acceleration: number(&v.input["accel_limit"]),
            ..JointLimit::NONE
        };
        let limits = JointLimits([limit; JOINTS]);
        let caps = rates.caps(&limits);
        v.close(&[caps.velocity], &v.expect["cap_rate"]);
        v.close(&[caps.acceleration], &v.expect["cap_mvc"]);
        v.close(
            &[caps.acceleration_steady],
            &v.expect["cap_accel_at_zero_sddot"],
        );
        assert!(
            rates
                .accelerations(&limits, caps.acceleration * (1.0 - 1e-9))
                .is_some()
        );
        assert!(
            rates
                .accelerations(&limits, caps.acceleration * 1.0001)
                .is_none()
        );
    }
}

#[test]
fn core_xy() {
    let machine = CoreXy::new(&[Axis::X, Axis::Y, Axis::Z]);
    for v in vectors("corexy") {
        let position = axes(&[number(&v.input["x"]), number(&v.input["y"]), 7.0]);
        let joints = machine.inverse(&position).unwrap();
        v.close(&joints.as_slice()[..1], &v.expect["a"]);
        v.close(&joints.as_slice()[1..2], &v.expect["b"]);
        assert_eq!(machine.forward(&joints, &position).unwrap(), position);
    }
}

#[test]
fn deltas() {
    for v in vectors("linear_delta") {
        let joints = delta().inverse(&axes(&numbers(&v.input["p"]))).unwrap();
        v.close(&first::<3>(&joints), &v.expect["carriage"]);
    }
    for v in vectors("linear_delta_rates") {
        let (p, velocity) = (axes(&numbers(&v.input["p"])), axes(&numbers(&v.input["v"])));
        let motion = delta().motion(&p, &velocity, &AxisVector::zeros()).unwrap();
        v.close(&first::<3>(&motion.velocity), &v.expect["rates"]);
        v.close(&first::<3>(&motion.acceleration), &v.expect["accels"]);
    }
    for v in vectors("rotary_delta") {
        let joints = rotary_delta()
            .inverse(&axes(&numbers(&v.input["p"])))
            .unwrap();
        v.close(&first::<3>(&joints), &v.expect["theta_deg"]);
    }
}

#[test]
fn five_bars() {
    for v in vectors("five_bar") {
        let at = |key: &str| number(&v.input[key]);
        let machine = FiveBar::new(at("d"), at("a"), at("f"), &[Axis::X, Axis::Y]);
        let joints = machine.inverse(&axes(&[at("x"), at("y")])).unwrap();
        v.close(&first::<2>(&joints), &v.expect["joints"]);
    }
}

#[test]
fn scara_both_elbows() {
    for v in vectors("scara") {
        let at = |key: &str| number(&v.input[key]);
        let position = axes(&[at("x"), at("y"), at("z"), 0.0, 0.0, at("c_deg")]);
        for (elbow, key) in [
            (Elbow::Positive, "joints_q1_positive"),
            (Elbow::Negative, "joints_q1_negative"),
        ] {
            let joints = scara(elbow).inverse(&position).unwrap();
            v.close(&first::<4>(&joints), &v.expect[key]);
        }
    }
}
