//! Tests of what keeps joints inside their limits: shares of the axes' limits, and speeds along a
//! path.

use crate::support::*;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::*;

const TRAVEL: [(Axis, f64, f64); 6] = [
    (Axis::X, -60.0, 60.0),
    (Axis::Y, -60.0, 60.0),
    (Axis::Z, 460.0, 540.0),
    (Axis::A, -10.0, 10.0),
    (Axis::B, -10.0, 10.0),
    (Axis::C, -10.0, 10.0),
];

fn rates() -> AxisRates {
    AxisRates {
        acceleration: axes(&[1500.0, 1200.0, 900.0, 200.0, 150.0, 100.0]),
        jerk: axes(&[30_000.0, 20_000.0, 40_000.0, 4_000.0, 3_000.0, 2_000.0]),
    }
}

fn limits() -> JointLimits {
    let joint = JointLimit {
        velocity: 60.0,
        acceleration: 900.0,
        jerk: 15_000.0,
        ..JointLimit::NONE
    };
    let mut limits = JointLimits([joint; JOINTS]);
    limits.0[3].acceleration = 700.0;
    limits
}

fn hexapod() -> Mechanism {
    Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0))
}

fn share() -> AxisShare {
    AxisShare::over(&hexapod(), &limits(), &TRAVEL, &rates())
}

fn place(unit: &[f64; 6]) -> AxisVector {
    let mut place = AxisVector::zeros();
    for ((axis, low, high), unit) in TRAVEL.iter().zip(unit) {
        place[axis.index()] = low + (high - low) * unit;
    }
    place
}

#[test]
fn the_share_is_what_the_worst_joint_leaves() {
    const POWERS: [u32; 6] = [1, 5, 25, 125, 625, 3125];
    let share = share();
    // Brute force over a finer lattice, with each axis at its limit and the worst signs.
    let mut worst = [0.0_f64; 2];
    for index in 0..15_625_u32 {
        let unit = core::array::from_fn(|k| f64::from(index / POWERS[k] % 5) / 4.0);
        let jacobian = hexapod().jacobian(&place(&unit)).unwrap();
        let needed = |i: usize, of: &AxisVector| -> f64 {
            (0..6).map(|k| (jacobian[(i, k)] * of[k]).abs()).sum()
        };
        for i in 0..6 {
            let limit = &limits().0[i];
            worst[0] = worst[0].max(needed(i, &rates().acceleration) / limit.acceleration);
            worst[1] = worst[1].max(needed(i, &rates().jerk) / limit.jerk);
        }
    }
    let [acceleration, jerk] = worst;
    assert!(
        (share.acceleration * acceleration / 0.9 - 1.0).abs() < 0.005,
        "{share:?} {worst:?}"
    );
    assert!(
        (share.jerk * jerk / 0.75 - 1.0).abs() < 0.005,
        "{share:?} {worst:?}"
    );
    assert_eq!(share.joints[0], Some(3));
}

#[test]
fn strong_joints_leave_everything() {
    let joint = JointLimit {
        velocity: 1e3,
        acceleration: 1e4,
        jerk: 1e6,
        ..JointLimit::NONE
    };
    let strong = JointLimits([joint; JOINTS]);
    assert_eq!(
        AxisShare::over(&hexapod(), &strong, &TRAVEL, &rates()),
        AxisShare::FULL
    );
    let free = AxisShare::over(&hexapod(), &JointLimits::NONE, &TRAVEL, &rates());
    assert_eq!(free, AxisShare::FULL);
}
