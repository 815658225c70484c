//! Tests of compensation: there and back, the drive's limits under random motion, and tables that are none.

#![allow(clippy::unwrap_used, clippy::float_cmp, reason = "a test")]

use super::*;

const DRIVE: JointLimit = JointLimit {
    velocity: 200.0,
    acceleration: 2_000.0,
    jerk: 40_000.0,
    ..JointLimit::NONE
};

/// A screw measured every 25 mm, both ways.
fn screw(backlash: f64) -> JointCompensation {
    let points: Vec<_> = (0..13)
        .map(|k| {
            let up = 0.006 * (1.3 * f64::from(k)).sin();
            CompensationPoint {
                position: 25.0 * f64::from(k),
                up,
                down: up - 0.004 + 0.001 * (0.9 * f64::from(k)).cos(),
            }
        })
        .collect();
    JointCompensation::new(&points, backlash, &DRIVE).unwrap()
}

#[test]
fn what_is_meant_is_what_was_told() {
    let screw = screw(0.02);
    for k in -50..350 {
        let q = f64::from(k) + 0.31;
        for side in [-1.0, -0.3, 0.0, 1.0] {
            let m = screw.compensated(q, side);
            assert!((screw.nominal(m, side) - q).abs() < 1e-12, "{q} {side}");
            let [_, m_v, m_a] = screw.compensated_rates([q, 130.0, -900.0], [side, 0.0, 0.0]);
            let [v, a] = screw.nominal_rates(q, [m_v, m_a], side);
            assert!((v - 130.0).abs() < 1e-9 && (a + 900.0).abs() < 1e-7);
        }
    }
}

#[test]
fn a_table_of_zeros_is_none_to_the_bit() {
    let zero = [0.0, 40.0, 90.0].map(|position| CompensationPoint {
        position,
        up: 0.0,
        down: 0.0,
    });
    let none = JointCompensation::new(&zero, 0.0, &DRIVE).unwrap();
    assert!(!none.has_play());
    for q in [-3.7, 0.1, 55.123_456, 1e3] {
        assert_eq!(none.compensated(q, 0.0).to_bits(), q.to_bits());
        assert_eq!(none.nominal(q, 0.0).to_bits(), q.to_bits());
    }
}

/// A motion that is driven by jerks from one of its limits to another: each step the jerk that a random bit wants,
/// if it can still be taken back before the next limit.
#[derive(Default)]
struct Driven {
    x: f64,
    v: f64,
    a: f64,
}

impl Driven {
    fn step(&mut self, wanted: f64, [v, a, j]: [f64; 3], t: f64) {
        let keeps = |jerk: f64| {
            let next_a = self.a + jerk * t;
            let next_v = self.v + t * (self.a + next_a) / 2.0;
            let last_v = next_v + next_a * next_a.abs() / (2.0 * j);
            next_a.abs() <= a && last_v.abs() <= v
        };
        let jerk = [wanted * j, 0.0, -wanted * j]
            .into_iter()
            .find(|jerk| keeps(*jerk))
            .unwrap_or(-self.a.signum() * j);
        self.x += t * (self.v + t * (self.a / 2.0 + t * jerk / 6.0));
        self.v += t * (self.a + t * jerk / 2.0);
        self.a += t * jerk;
    }
}

#[test]
fn a_drive_keeps_its_limits_whatever_its_joint_does_inside_what_is_left() {
    let screw = screw(0.05);
    let left = *screw.left();
    let joint_limits = [left.velocity, left.acceleration, left.jerk];
    let side_limits = screw.side_limits();
    let (mut joint, mut side) = (
        Driven {
            x: 150.0,
            ..Driven::default()
        },
        Driven::default(),
    );
    let t = 1e-4;
    let (mut state, mut before, mut most) = (7_u64, 0.0, [0.0_f64; 3]);
    let mut wanted = [1.0, 1.0];
    for step in 0..400_000_u64 {
        if step % 97 == 0 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            wanted = [state >> 40, state >> 45].map(|bits| if bits & 1 == 0 { 1.0 } else { -1.0 });
        }
        // Inside the table, where it bends.
        let inwards = if joint.x > 300.0 {
            -1.0
        } else if joint.x < 0.0 {
            1.0
        } else {
            wanted[0]
        };
        joint.step(inwards, joint_limits, t);
        let back = if side.x > 1.0 {
            -1.0
        } else if side.x < -1.0 {
            1.0
        } else {
            wanted[1]
        };
        side.step(back, side_limits, t);
        let [_, v, a] = screw.compensated_rates(
            [joint.x, joint.v, joint.a],
            [side.x.clamp(-1.0, 1.0), side.v, side.a],
        );
        let j = if step == 0 { 0.0 } else { (a - before) / t };
        before = a;
        for (most, rate) in most.iter_mut().zip([v, a, j]) {
            *most = most.max(rate.abs());
        }
    }
    for (most, limit) in most
        .into_iter()
        .zip([DRIVE.velocity, DRIVE.acceleration, DRIVE.jerk])
    {
        assert!(most <= limit * (1.0 + 1e-6), "{most} of {limit}");
        assert!(
            most > 0.8 * limit,
            "the test does not come near: {most} of {limit}"
        );
    }
}

#[test]
fn what_is_no_table_is_refused() {
    let at = |position, up| CompensationPoint {
        position,
        up,
        down: up,
    };
    let refused =
        |points: &[CompensationPoint]| JointCompensation::new(points, 0.0, &DRIVE).unwrap_err();
    assert_eq!(refused(&[at(0.0, 0.0)]), CompensationError::Points(1));
    assert_eq!(
        refused(&[at(0.0, 0.0), at(0.0, 0.1)]),
        CompensationError::Order(0.0, 0.0)
    );
    // Measured positions in place of corrections.
    let measured = refused(&[at(0.0, 0.0), at(100.0, 100.003)]);
    assert!(
        matches!(measured, CompensationError::TooSteep(_)),
        "{measured}"
    );
    let exchanged = [0.0, 50.0].map(|position| CompensationPoint {
        position,
        up: 0.0,
        down: 0.012,
    });
    assert_eq!(refused(&exchanged), CompensationError::Exchanged(0.0));
    let rough: Vec<_> = (0..40)
        .map(|k| at(f64::from(k), 0.003 * f64::from(k % 2)))
        .collect();
    assert!(matches!(
        refused(&rough),
        CompensationError::TooRough { .. }
    ));
}
