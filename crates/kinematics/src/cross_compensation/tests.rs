//! There and back, rates by differences, what is left against random motion, and tables that are none.

#![allow(clippy::unwrap_used, clippy::float_cmp, reason = "a test")]

use super::*;
use crate::{AxisList, Kinematics as _, Mechanism, Trivial};

const DRIVE: JointLimit = JointLimit {
    min_position: -20.0,
    max_position: 400.0,
    velocity: 200.0,
    acceleration: 2_000.0,
    jerk: 40_000.0,
};
const AXES_HERE: [Axis; 3] = [Axis::X, Axis::Y, Axis::Z];

fn limits() -> [(Axis, JointLimit); 3] {
    AXES_HERE.map(|axis| (axis, DRIVE))
}

fn table(corrected: Axis, along: Axis, points: &[(f64, f64)]) -> CrossTable {
    CrossTable {
        corrected,
        along,
        points: points.to_vec(),
    }
}

fn curve(step: f64, size: f64) -> Vec<(f64, f64)> {
    let points = (-1..=16).map(f64::from);
    let value = |k: f64| size * ((1.3 * k).sin() + 0.3 * k);
    points.map(|k| (step * k, value(k))).collect()
}

/// X leans along Y, and is bent along Z; Z sags along X and Y; Y is bent along X.
fn machine() -> (Mechanism, &'static CrossCompensation) {
    let tables = [
        table(Axis::X, Axis::Y, &[(0.0, 0.0), (1_000.0, 0.8)]),
        table(Axis::X, Axis::Z, &curve(25.0, 0.02)),
        table(Axis::Z, Axis::X, &curve(25.0, 0.03)),
        table(Axis::Z, Axis::Y, &curve(25.0, -0.01)),
        table(Axis::Y, Axis::X, &curve(25.0, 0.005)),
    ];
    let cross = CrossCompensation::new(&tables, &limits()).unwrap();
    let cross: &'static CrossCompensation = Box::leak(Box::new(cross));
    let trivial = Trivial {
        cross: Some(cross),
        ..Trivial::new(AxisList::new(&AXES_HERE))
    };
    (Mechanism::Trivial(trivial), cross)
}

/// Numbers from 0 to 1.
struct Numbers(u64);

impl Numbers {
    #[allow(clippy::cast_precision_loss, reason = "53 bits")]
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 9_007_199_254_740_992.0
    }

    fn place(&mut self) -> AxisVector {
        let mut place = AxisVector::zeros();
        for k in 0..3 {
            place[k] = 420.0 * self.next() - 20.0;
        }
        place
    }
}

#[test]
fn what_is_meant_is_what_was_told() {
    let (machine, _) = machine();
    let Mechanism::Trivial(trivial) = machine else {
        unreachable!()
    };
    let mut numbers = Numbers(3);
    for _ in 0..500 {
        let place = numbers.place();
        let [v, a] = [1.0, 8.0].map(|size| numbers.place() * size);
        let told = machine.motion(&place, &v, &a).unwrap();
        assert_eq!(told.position, machine.inverse(&place).unwrap());
        let back = machine.forward(&told.position, &place).unwrap();
        assert!((back - place).amax() < 1e-12, "{place} {back}");
        let [x, own_v, own_a] = trivial.axes_motion(&told);
        assert!((x - place).amax() < 1e-12);
        assert!((own_v - v).amax() < 1e-9 && (own_a - a).amax() < 1e-7);
    }
}

#[test]
fn rates_are_those_of_positions() {
    let (machine, _) = machine();
    let mut numbers = Numbers(5);
    let t = 1e-3;
    for _ in 0..200 {
        let (place, v, a) = (numbers.place(), numbers.place(), numbers.place());
        let at = |t: f64| {
            let moved = place + v * t + a * (0.5 * t * t);
            machine.inverse(&moved).unwrap()
        };
        let told = machine.motion(&place, &v, &a).unwrap();
        let first = (at(t) - at(-t)) / (2.0 * t);
        let second = (at(t) - at(0.0) * 2.0 + at(-t)) / (t * t);
        assert!((first - told.velocity).amax() < 1e-4);
        assert!((second - told.acceleration).amax() < 0.2);
    }
}

/// A motion whose jerk a random bit chooses, as far as it can be taken back before its limits and travel.
struct Driven {
    x: f64,
    v: f64,
    a: f64,
}

impl Driven {
    fn step(&mut self, wanted: f64, limit: &JointLimit, t: f64) {
        let (v, a, j) = (limit.velocity, limit.acceleration, limit.jerk);
        let keeps = |jerk: f64| {
            let next_a = self.a + jerk * t;
            let next_v = self.v + t * f64::midpoint(self.a, next_a);
            let last_v = next_v + next_a * next_a.abs() / (2.0 * j);
            next_a.abs() <= a && last_v.abs() <= v
        };
        let choices = [wanted * j, 0.0, -wanted * j];
        let kept = choices.into_iter().find(|jerk| keeps(*jerk));
        let jerk = kept.unwrap_or(-self.a.signum() * j);
        self.x += t * (self.v + t * (self.a / 2.0 + t * jerk / 6.0));
        self.v += t * (self.a + t * jerk / 2.0);
        self.a += t * jerk;
    }
}

#[test]
fn joints_keep_their_limits_whatever_axes_do_inside_what_is_left() {
    let (machine, cross) = machine();
    let left = AXES_HERE.map(|axis| *cross.left(axis).unwrap());
    let mut axes = [0, 1, 2].map(|_| Driven {
        x: 150.0,
        v: 0.0,
        a: 0.0,
    });
    let (t, mut numbers) = (1e-4, Numbers(11));
    let (mut wanted, mut before) = ([1.0; 3], AxisVector::zeros());
    let mut most = [[0.0_f64; 3]; 3];
    for step in 0..300_000 {
        if step % 97 == 0 {
            wanted = [0, 1, 2].map(|_| if numbers.next() < 0.5 { -1.0 } else { 1.0 });
        }
        for ((axis, limit), wanted) in axes.iter_mut().zip(&left).zip(wanted) {
            let inwards = match axis.x {
                x if x > 330.0 => -1.0,
                x if x < 50.0 => 1.0,
                _ => wanted,
            };
            axis.step(inwards, limit, t);
        }
        let of = |rate: &dyn Fn(&Driven) -> f64| {
            let mut all = AxisVector::zeros();
            for k in 0..3 {
                all[k] = rate(&axes[k]);
            }
            all
        };
        let told = machine.motion(
            &of(&|axis| axis.x),
            &of(&|axis| axis.v),
            &of(&|axis| axis.a),
        );
        let told = told.unwrap();
        for joint in 0..3 {
            let jerk = if step == 0 {
                0.0
            } else {
                (told.acceleration[joint] - before[joint]) / t
            };
            let rates = [told.velocity[joint], told.acceleration[joint], jerk];
            for (most, rate) in most[joint].iter_mut().zip(rates) {
                *most = most.max(rate.abs());
            }
        }
        before.copy_from(&told.acceleration);
    }
    for most in most {
        for (most, limit) in most
            .into_iter()
            .zip([DRIVE.velocity, DRIVE.acceleration, DRIVE.jerk])
        {
            assert!(most <= limit * (1.0 + 1e-6), "{most} of {limit}");
            assert!(
                most > 0.9 * limit,
                "the test does not come near: {most} of {limit}"
            );
        }
    }
}

#[test]
fn no_joint_leaves_the_travel_wherever_axes_are_inside_what_is_left() {
    let (machine, cross) = machine();
    let mut numbers = Numbers(17);
    let mut nearest = f64::INFINITY;
    for _ in 0..100_000 {
        let mut place = AxisVector::zeros();
        for (k, axis) in AXES_HERE.into_iter().enumerate() {
            let left = cross.left(axis).unwrap();
            let width = left.max_position - left.min_position;
            let part = numbers.next();
            // Most of all at the ends.
            let part = if part < 0.25 {
                0.0
            } else if part > 0.75 {
                1.0
            } else {
                part
            };
            place[k] = left.min_position + width * part;
        }
        let joints = machine.inverse(&place).unwrap();
        for joint in 0..3 {
            let room = (joints[joint] - DRIVE.min_position).min(DRIVE.max_position - joints[joint]);
            assert!(room > -1e-9, "{place} {joints}");
            nearest = nearest.min(room);
        }
    }
    assert!(
        nearest < 0.01,
        "more is kept back than is needed: {nearest}"
    );
}

#[test]
fn tables_of_zeros_change_no_bit() {
    let zero = table(Axis::X, Axis::Y, &[(0.0, 0.0), (10.0, 0.0), (20.0, 0.0)]);
    let cross = CrossCompensation::new(&[zero], &limits()).unwrap();
    let plain = Trivial::new(AxisList::new(&AXES_HERE));
    let crossed = Trivial {
        cross: Some(Box::leak(Box::new(cross))),
        ..plain
    };
    let place = Numbers(1).place();
    let told = crossed.inverse(&place).unwrap();
    assert_eq!(told, plain.inverse(&place).unwrap());
    assert_eq!(crossed.forward(&told, &place), plain.forward(&told, &place));
}

#[test]
fn what_is_no_table_is_refused_and_which_it_was() {
    let good = table(Axis::X, Axis::Y, &[(0.0, 0.0), (1_000.0, 6.0)]);
    let refused =
        |other: CrossTable| CrossCompensation::new(&[good.clone(), other], &limits()).unwrap_err();
    let points = refused(table(Axis::X, Axis::Z, &[(0.0, 0.0)]));
    assert_eq!(points, (1, CompensationError::Points(1)));
    let order = refused(table(Axis::X, Axis::Z, &[(5.0, 0.0), (5.0, 0.1)]));
    assert_eq!(order, (1, CompensationError::Order(5.0, 5.0)));
    // Neither is too steep, and both together are.
    let steep = refused(table(Axis::X, Axis::Z, &[(0.0, 0.0), (1_000.0, -6.0)]));
    assert!(
        matches!(steep, (1, CompensationError::TooSteep(_))),
        "{steep:?}"
    );
    let rough: Vec<_> = (0..40)
        .map(|k| (f64::from(k), 0.003 * f64::from(k % 2)))
        .collect();
    let rough = refused(table(Axis::Z, Axis::X, &rough));
    assert!(
        matches!(rough, (1, CompensationError::TooRough { .. })),
        "{rough:?}"
    );
}
