//! Tests by check vectors of five-axis machines.

#![allow(clippy::unwrap_used, reason = "a test")]

use crate::support::*;
use glidepath_geometry::AxisVector;
use glidepath_kinematics::*;
use nalgebra::Vector3;
use serde_json::Value;

fn first<const COUNT: usize>(joints: &JointVector) -> Vec<f64> {
    joints.iter().take(COUNT).copied().collect()
}

/// Position of the axes of a five-axis vector.
fn tip(input: &Value, tilt: Tilt) -> AxisVector {
    let w = point(&input["w"]);
    let angle = ["tilt_deg", "A_deg", "B_deg"]
        .iter()
        .find_map(|key| input.get(*key))
        .map(number)
        .unwrap();
    let (a, b) = match tilt {
        Tilt::A => (angle, 0.0),
        Tilt::B | Tilt::Skewed(_) => (0.0, angle),
    };
    axes(&[w.x, w.y, w.z, a, b, number(&input["C_deg"])])
}

fn check_five_axis(v: &Vector, machine: &FiveAxis) {
    let axes = tip(&v.input, machine.tilt);
    let joints = machine.inverse(&axes).unwrap();
    v.close(&first::<3>(&joints), &v.expect["xyz"]);
    let tool = machine.tool_axis(joints[3], joints[4]);
    for key in ["tool_axis", "tool_axis_in_work"] {
        if let Some(want) = v.expect.get(key) {
            v.close(tool.as_slice(), want);
        }
    }
    let back = machine.forward(&joints, &axes).unwrap();
    assert!((back - axes).amax() < 1e-12 * 300.0, "{}", v.id);
    let near = (joints[3] + 1.0, joints[4] - 1.0);
    let (tilt, rotary) = machine.angles_deg(&tool, near).unwrap();
    assert!((tilt - joints[3]).abs() < 1e-9 && (rotary - joints[4]).abs() < 1e-9);
}

#[test]
fn five_axis_layouts() {
    for (kind, tilt) in [
        ("5axis_table_table_AC", Tilt::A),
        ("5axis_table_table_BC", Tilt::B),
    ] {
        for v in vectors(kind) {
            let reversed = number(&v.input["sign"]) < 0.0;
            check_five_axis(&v, &table_table(tilt, reversed));
        }
    }
    for (kind, tilt) in [
        ("5axis_head_head_BC", Tilt::B),
        ("5axis_head_head_AC", Tilt::A),
    ] {
        for v in vectors(kind) {
            let reversed = number(&v.input["sign"]) < 0.0;
            check_five_axis(&v, &head_head(tilt, (reversed, reversed)));
        }
    }
    for v in vectors("5axis_head_head_BC_tilt_reversed") {
        check_five_axis(&v, &head_head(Tilt::B, (true, false)));
    }
    for v in vectors("5axis_head_head_BC_offsets") {
        let mut machine = head_head(Tilt::B, (false, false));
        machine.rotaries = Rotaries::HeadHead {
            rotary_to_tilt: point(&v.input["d_c_to_b_axis"]),
            tilt_to_spindle: point(&v.input["d_b_axis_to_spindle"]),
        };
        check_five_axis(&v, &machine);
    }
    for v in vectors("5axis_table_C_head_B") {
        let mut machine = head_head(Tilt::B, (false, false));
        machine.rotaries = Rotaries::TableHead {
            rotary_point: point(&v.input["c_axis_point"]),
        };
        check_five_axis(&v, &machine);
    }
}

#[test]
fn five_axis_orientation_has_two_branches_and_a_pole() {
    let machine = table_table(Tilt::A, false);
    for v in vectors("5axis_orientation_AC_table") {
        let tool = point(&v.input["tool_axis_in_work"]);
        let (a, c) = machine.angles_deg(&tool, (20.0, 100.0)).unwrap();
        v.close(&[a], &v.expect["A_deg"]);
        v.close(&[c], &v.expect["C_deg"]);
        let (a, c) = machine.angles_deg(&tool, (-20.0, 0.0)).unwrap();
        v.close(&[a], &v.expect["A2_deg"]);
        v.close(&[c], &v.expect["C2_deg"]);
        let (_, unwrapped) = machine.angles_deg(&tool, (20.0, 500.0)).unwrap();
        v.close(&[unwrapped - 360.0], &v.expect["C_deg"]);
    }
    let along = machine.angles_deg(&Vector3::z(), (0.3, 77.0));
    assert_eq!(along, Some((0.0, 77.0)));
}

#[test]
fn five_axis_rates_at_a_resting_tip() {
    for v in vectors("5axis_TCP_joint_rates_AC") {
        let machine = table_table(Tilt::A, false);
        let (a, c) = (
            number(&v.input["A_rate_deg_s"]),
            number(&v.input["C_rate_deg_s"]),
        );
        let velocity = axes(&[0.0, 0.0, 0.0, a, 0.0, c]);
        let motion = machine
            .motion(&tip(&v.input, Tilt::A), &velocity, &AxisVector::zeros())
            .unwrap();
        v.close(&first::<3>(&motion.velocity), &v.expect["xyz_rate"]);
        v.close(&first::<3>(&motion.acceleration), &v.expect["xyz_accel"]);
    }
    for v in vectors("5axis_linear_joint_interp_error") {
        let machine = FiveAxis {
            tool_mm: 0.0,
            ..table_table(Tilt::A, false)
        };
        let w = point(&v.input["w"]);
        let at = |c: f64| axes(&[w.x, w.y, w.z, number(&v.input["A_deg"]), 0.0, c]);
        let (from, to) = (number(&v.input["C_from_deg"]), number(&v.input["C_to_deg"]));
        let joints = |c: f64| machine.inverse(&at(c)).unwrap();
        let middle = (joints(from) + joints(to)) * 0.5;
        let got = machine.forward(&middle, &at(from)).unwrap();
        let error = (Vector3::new(got[0], got[1], got[2]) - w).norm();
        v.close(&[error], &v.expect["mid_tip_error"]);
    }
}
