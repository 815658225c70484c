//! Tests of the five-bar linkage against other formulas than its own, all over its workspace.

#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test; other axes pass as they are"
)]

use crate::support::*;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::*;

/// The angle of the upper arm whose knee is outside, by the tangent of half of it: of
/// |tool − shoulder − a (cos θ, sin θ)|² = f², which is E cos θ + F sin θ = G.
fn by_half_angles(machine: &FiveBar, side: f64, x: f64, y: f64) -> f64 {
    let (a, f) = (machine.upper_arm_mm, machine.forearm_mm);
    let (u, v) = (x - side * machine.shoulder_distance_mm / 2.0, y);
    let (e, h, g) = (2.0 * a * u, 2.0 * a * v, u * u + v * v + a * a - f * f);
    let root = (e * e + h * h - g * g).sqrt();
    let angles = [root, -root].map(|root| 2.0 * (h + root).atan2(g + e));
    // Outside: the knee is on the left of the way to the tool for the left arm.
    let outside = angles.into_iter().find(|angle| {
        let (sin, cos) = angle.sin_cos();
        (u * sin - v * cos) * side < 0.0
    });
    let degrees = outside.unwrap().to_degrees();
    (degrees + 90.0).rem_euclid(360.0) - 90.0
}

/// Where circles of a forearm's length about both knees cross, by the line through both crossings:
/// the crossing with the larger y of a linkage whose knees are beside each other.
fn by_circles(machine: &FiveBar, joints: &JointVector) -> [f64; 2] {
    let knee = |side: f64, degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let shoulder = side * machine.shoulder_distance_mm / 2.0;
        [
            shoulder + machine.upper_arm_mm * cos,
            machine.upper_arm_mm * sin,
        ]
    };
    let ([x0, y0], [x1, y1]) = (knee(-1.0, joints[0]), knee(1.0, joints[1]));
    // The difference of both equations: x = p + q y.
    let p = (x1 * x1 + y1 * y1 - x0 * x0 - y0 * y0) / (2.0 * (x1 - x0));
    let q = -(y1 - y0) / (x1 - x0);
    let (a, b) = (1.0 + q * q, q * (p - x0) - y0);
    let c = (p - x0).powi(2) + y0 * y0 - machine.forearm_mm.powi(2);
    let y = (-b + (b * b - a * c).sqrt()) / a;
    [p + q * y, y]
}

#[test]
fn ten_thousand_poses_are_those_of_other_formulas() {
    let machine = five_bar();
    let mut most = [0.0_f64; 2];
    for number in 1..=10_000 {
        let [u, v] = halton_place(number);
        let (x, y) = (240.0 * u - 120.0, 280.0 + 220.0 * v);
        let place = axes(&[x, y, 30.0]);
        let joints = machine.inverse(&place).unwrap();
        for (joint, side) in [-1.0, 1.0].into_iter().enumerate() {
            let other = by_half_angles(&machine, side, x, y);
            most[0] = most[0].max((joints[joint] - other).abs());
        }
        assert_eq!(joints[2], 30.0);
        let tool = machine.forward(&joints, &AxisVector::zeros()).unwrap();
        let [other_x, other_y] = by_circles(&machine, &joints);
        most[1] = most[1].max((tool[0] - other_x).hypot(tool[1] - other_y));
        most[1] = most[1].max((tool - place).amax());
        assert_eq!(machine.admit(&place), Ok(()));
    }
    assert!(most[0] < 1e-9 && most[1] < 1e-10, "{most:?}");
}

#[test]
fn no_pose_at_the_knees_or_behind_them_is_held() {
    // Upper arms of 250 from shoulders at ∓100, at atan(3/4): knees at ∓300 and y = 150, and forearms of 300
    // in line between them.
    let short = FiveBar {
        forearm_mm: 300.0,
        ..five_bar()
    };
    let at = |machine: &FiveBar, y: f64| machine.admit(&axes(&[0.0, y]));
    assert_eq!(at(&short, 200.0), Ok(()));
    for y in [151.0, 150.001, 149.999, 149.0, 100.0, 1.0] {
        let refused = at(&short, y);
        assert!(
            matches!(refused, Err(KinematicsError::Singular { .. })),
            "{y}: {refused:?}"
        );
    }
    let machine = five_bar();
    let straight_down = |y: f64| at(&machine, y);
    for y in [0.0, -0.5, -400.0, f64::NAN] {
        let behind = straight_down(y);
        assert_eq!(behind, Err(KinematicsError::Unreachable { joint: 0 }));
    }
    // Both arms stretched: at a reach of 600 from shoulders at ∓100.
    let stretched = (600.0_f64 * 600.0 - 100.0 * 100.0).sqrt();
    assert!(matches!(
        straight_down(stretched - 1e-3),
        Err(KinematicsError::Singular { .. })
    ));
    assert!(matches!(
        straight_down(stretched + 1e-3),
        Err(KinematicsError::Unreachable { joint: 0 })
    ));
    assert_eq!(
        short.forward(&axes(&[180.0, 0.0]), &AxisVector::zeros()),
        Err(KinematicsError::NoPosition),
        "knees 700 mm apart, forearms of 300 mm"
    );
}

#[test]
fn axes_beside_the_plane_have_drives_of_their_own() {
    let machine = FiveBar::new(200.0, 250.0, 350.0, &[Axis::X, Axis::Y, Axis::Z, Axis::C]);
    assert_eq!(machine.joints(), 4);
    let place = axes(&[10.0, 400.0, -7.0, 0.0, 0.0, 33.0]);
    let joints = machine.inverse(&place).unwrap();
    assert_eq!([joints[2], joints[3]], [-7.0, 33.0]);
    let back = machine.forward(&joints, &place).unwrap();
    assert!((back - place).amax() < 1e-12);
}
