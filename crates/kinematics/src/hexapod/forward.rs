//! Pose from strut lengths.
//!
//! Newton's method on position and rotation: solve J δ = l − l(pose), move by the first three
//! components and turn by the rotation vector of the last three, R ← exp(δω) R. Turning by a
//! rotation vector, not adding to angles, keeps convergence quadratic away from level. J is the matrix
//! of the struts' changes by position (mm) and by a rotation vector of the platform (rad): a row is the
//! unit vector along a strut, and the lever of its joint crossed with that ([`Hexapod::rows`]). It is
//! square and far from singular wherever the platform is moved ([`super::admission`]), so it is solved
//! as it is, without damping.
//!
//! Up to forty real poses have the same lengths. Only the one next to the last known pose is the
//! machine's, so a step that leaves its neighbourhood is a failure, not progress.

use super::struts::{Hexapod, Pose, STRUTS};
use crate::{JointVector, KinematicsError};
use glidepath_geometry::AxisVector;
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

/// Newton steps at most; two to five are taken, from the home pose up to seven. More are an error.
const STEPS: usize = 20;
/// Residual at which a pose is exact, relative to the longest strut: some units in the last place of a
/// length.
const EXACT: f64 = 4e-15;
/// Residual at which rounding may end the iteration, if a step no longer halves it. Near the solution a step
/// squares the error, so one that does not halve it is rounding's.
const GOOD: f64 = 1e-12;
const STALLED_R: f64 = 0.5;

/// The pose next to `near` with these lengths, as axes.
pub(super) fn forward(
    hexapod: &Hexapod,
    joints: &JointVector,
    near: &AxisVector,
) -> Result<AxisVector, KinematicsError> {
    let (pose, _) = newton(hexapod, joints, hexapod.pose(near))?;
    let tip = pose.position + pose.rotation * hexapod.tool;
    let angles = angles_deg(&pose.rotation, [near[3], near[4], near[5]]);
    let mut axes = AxisVector::zeros();
    axes.fixed_rows_mut::<3>(0).copy_from(&tip);
    axes.fixed_rows_mut::<3>(3).copy_from_slice(&angles);
    Ok(axes)
}

/// Solves for the pose; returns it with the number of steps.
pub(super) fn newton(
    hexapod: &Hexapod,
    joints: &JointVector,
    start: Pose,
) -> Result<(Pose, usize), KinematicsError> {
    let scale = joints.fixed_rows::<STRUTS>(0).amax();
    let mut pose = start;
    let mut last = f64::INFINITY;
    for step in 0..STEPS {
        let struts = hexapod.struts(&pose);
        let residual = Vector6::from_fn(|i, _| joints[i] - struts[i].norm());
        let size = residual.amax() / scale;
        if size <= EXACT || (size <= GOOD && size >= STALLED_R * last) {
            return Ok((pose, step));
        }
        last = size;
        let delta = hexapod
            .rows(&pose)
            .lu()
            .solve(&residual)
            .filter(|delta| delta.iter().all(|d| d.is_finite()))
            .ok_or(KinematicsError::NotConverged)?;
        let turn = Vector3::new(delta[3], delta[4], delta[5]);
        // Half a turn in one step is another assembly mode.
        if turn.norm() > core::f64::consts::PI {
            return Err(KinematicsError::NotConverged);
        }
        pose.position += Vector3::new(delta[0], delta[1], delta[2]);
        pose.rotation =
            (Rotation3::new(turn) * Rotation3::from_matrix_unchecked(pose.rotation)).into_inner();
    }
    Err(KinematicsError::NotConverged)
}

/// The cosine of B below which A and C turn about the same axis: a pose settles their sum or difference
/// alone, and rounding would settle the rest.
const POLE_COS: f64 = 1e-9;

/// A, B and C of R = Rz(C) Ry(B) Rx(A) nearest to some others. Every pose has two such triples: one with B
/// from −90° to 90°, and A + 180°, 180° − B, C + 180°.
fn angles_deg(r: &Matrix3<f64>, near: [f64; 3]) -> [f64; 3] {
    let cos = r.m32.hypot(r.m33);
    let b = (-r.m31).atan2(cos);
    let [a, c] = if cos > POLE_COS {
        [r.m32.atan2(r.m33), r.m21.atan2(r.m11)]
    } else {
        // The second column of R·Rx(−A) = Rz(C)·Ry(B) is (−sin C, cos C, 0), whatever A is.
        let (sin_a, cos_a) = near[0].to_radians().sin_cos();
        let [x, y] = [[r.m12, r.m13], [r.m22, r.m23]].map(|[s, t]| cos_a * s - sin_a * t);
        [near[0].to_radians(), (-x).atan2(y)]
    };
    let [a, b, c] = [a, b, c].map(f64::to_degrees);
    let [first, second] = [[a, b, c], [a + 180.0, 180.0 - b, c + 180.0]].map(|angles| {
        // Angles of a matrix are within a turn; an axis may have made several.
        let turned = |i: usize| angles[i] + 360.0 * ((near[i] - angles[i]) / 360.0).round();
        [turned(0), turned(1), turned(2)]
    });
    let away = |angles: &[f64; 3]| -> f64 {
        let pairs = angles.iter().zip(near);
        pairs.map(|(angle, near)| (angle - near).abs()).sum()
    };
    if away(&second) < away(&first) {
        second
    } else {
        first
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Kinematics;

    #[test]
    fn few_steps_from_the_home_pose() {
        let hexapod = Hexapod::paired(400.0, 150.0, 15.0);
        let home = AxisVector::from_column_slice(&[0.0, 0.0, 500.0, 0., 0., 0., 0., 0., 0.]);
        let mut worst = 0;
        for i in 0..64 {
            let sign = |bit: u32| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let mut axes = home;
            for (k, reach) in [80.0, 80.0, 80.0, 12.0, 12.0, 12.0].into_iter().enumerate() {
                axes[k] += sign(u32::try_from(k).unwrap()) * reach;
            }
            let joints = hexapod.inverse(&axes).unwrap();
            let (pose, steps) = newton(&hexapod, &joints, hexapod.pose(&home)).unwrap();
            let wanted = hexapod.pose(&axes);
            assert!((pose.position - wanted.position).norm() < 1e-9);
            assert!((pose.rotation - wanted.rotation).norm() < 1e-11);
            worst = worst.max(steps);
        }
        assert!(worst <= 7, "{worst} steps");
    }

    #[test]
    fn angles_are_those_next_to_the_ones_that_they_were() {
        for b in [-120.0, -90.0, -89.0, 0.0, 60.0, 90.0, 91.0, 120.0, 300.0] {
            let axes = AxisVector::from_column_slice(&[0., 0., 0., 10.0, b, 350.0, 0., 0., 0.]);
            let pose = Hexapod::paired(150.0, 150.0, 8.0).pose(&axes);
            let angles = angles_deg(&pose.rotation, [11.0, b - 0.5, 349.0]);
            let back = AxisVector::from_column_slice(&[
                0., 0., 0., angles[0], angles[1], angles[2], 0., 0., 0.,
            ]);
            let again = Hexapod::paired(150.0, 150.0, 8.0).pose(&back);
            assert!((again.rotation - pose.rotation).norm() < 1e-9, "{b}");
            let is_near = |angle: f64, wanted: f64| (angle - wanted).abs() < 3.0;
            assert!(
                is_near(angles[0], 10.0) && is_near(angles[1], b) && is_near(angles[2], 350.0),
                "{b}: {angles:?}"
            );
        }
    }

    #[test]
    fn two_steps_from_the_last_tick() {
        let hexapod = Hexapod::paired(400.0, 150.0, 15.0);
        let mut axes =
            AxisVector::from_column_slice(&[30., -20., 500., 5.0, -3.0, 10.0, 0., 0., 0.]);
        let before = hexapod.pose(&axes);
        axes[0] += 0.4;
        axes[5] += 0.1;
        let joints = hexapod.inverse(&axes).unwrap();
        let (_, steps) = newton(&hexapod, &joints, before).unwrap();
        assert!(steps <= 3, "{steps}");
    }
}
