//! Tests of what holds for every mechanism, all over its workspace.

use crate::support::*;
use glidepath_geometry::{Axis, AxisVector};
use glidepath_kinematics::*;
use nalgebra::Vector3;
use proptest::prelude::*;

/// A mechanism with the middle and the half widths of a box inside its workspace (X Y Z A B C).
type Boxed = (Mechanism, [f64; 6], [f64; 6]);

const ZERO: [f64; 6] = [0.0; 6];

/// All of them.
fn machines() -> Vec<Boxed> {
    let mut all = cartesian();
    all.extend(arms());
    all.extend(five_axes());
    all.extend(hexapods());
    all
}

fn cartesian() -> Vec<Boxed> {
    let all = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C];
    let half = [300.0, 300.0, 200.0, 100.0, 100.0, 400.0];
    let trivial = Trivial::new(AxisList::new(&all));
    vec![
        (Mechanism::Trivial(trivial), ZERO, half),
        (Mechanism::CoreXy(CoreXy::new(&all)), ZERO, half),
    ]
}

fn arms() -> Vec<Boxed> {
    let turning = LinearDelta {
        others: AxisList::new(&[Axis::C]),
        ..delta()
    };
    vec![
        (
            Mechanism::LinearDelta(turning),
            [0.0, 0.0, 50.0, 0.0, 0.0, 0.0],
            [80.0, 80.0, 100.0, 0.0, 0.0, 90.0],
        ),
        (
            Mechanism::RotaryDelta(rotary_delta()),
            [0.0, 0.0, -230.0, 0.0, 0.0, 0.0],
            [60.0, 60.0, 40.0, 0.0, 0.0, 0.0],
        ),
        (
            Mechanism::Scara(scara(Elbow::Positive)),
            [350.0, 0.0, 100.0, 0.0, 0.0, 0.0],
            [100.0, 150.0, 90.0, 0.0, 0.0, 80.0],
        ),
        (
            Mechanism::FiveBar(five_bar()),
            [0.0, 390.0, 50.0, 0.0, 0.0, 0.0],
            [120.0, 110.0, 100.0, 0.0, 0.0, 0.0],
        ),
    ]
}

fn five_axes() -> Vec<Boxed> {
    let offsets = FiveAxis {
        rotaries: Rotaries::HeadHead {
            rotary_to_tilt: Vector3::new(10.0, 0.0, 5.0),
            tilt_to_spindle: Vector3::new(-6.0, 2.0, 0.0),
        },
        ..head_head(Tilt::A, (true, false))
    };
    let table_head = FiveAxis {
        rotaries: Rotaries::TableHead {
            rotary_point: Vector3::new(5.0, -7.0, 0.0),
        },
        ..head_head(Tilt::B, (false, true))
    };
    let tilting_a = [300.0, 300.0, 200.0, 100.0, 0.0, 400.0];
    let tilting_b = [300.0, 300.0, 200.0, 0.0, 100.0, 400.0];
    let tables = table_table(Tilt::A, true);
    let nutating = FiveAxis {
        tilt: skewed(Axis::B, [0.0, 1.0, 1.0]),
        ..table_head
    };
    vec![
        (Mechanism::FiveAxis(offsets), ZERO, tilting_a),
        (Mechanism::FiveAxis(table_head), ZERO, tilting_b),
        (Mechanism::FiveAxis(tables), ZERO, tilting_a),
        (Mechanism::FiveAxis(nutating), ZERO, tilting_b),
    ]
}

fn hexapods() -> Vec<Boxed> {
    let tilted_tool = Hexapod {
        tool: Vector3::new(10.0, -5.0, 60.0),
        ..Hexapod::paired(400.0, 150.0, 15.0)
    };
    let raised = TranslationalHexapod {
        base_z_mm: 700.0,
        ..translational()
    };
    let at_height = |z| [0.0, 0.0, z, 0.0, 0.0, 0.0];
    let moved = [150.0, 150.0, 150.0, 0.0, 0.0, 0.0];
    let turned = [80.0, 80.0, 80.0, 12.0, 12.0, 12.0];
    let plain = Mechanism::Translational(translational());
    vec![
        (Mechanism::Hexapod(tilted_tool), at_height(520.0), turned),
        (plain, at_height(500.0), moved),
        // Hanging below its base, and below one that is not at zero.
        (plain, at_height(-420.0), moved),
        (Mechanism::Translational(raised), at_height(200.0), moved),
    ]
}

fn inside(middle: &[f64; 6], half: &[f64; 6], unit: &[f64; 6]) -> AxisVector {
    let values: [f64; 6] = core::array::from_fn(|i| middle[i] + half[i] * unit[i]);
    axes(&values)
}

fn units() -> impl Strategy<Value = [f64; 6]> {
    prop::array::uniform6(-1.0..1.0_f64)
}

proptest! {
    #[test]
    fn forward_undoes_inverse(unit in units()) {
        for (machine, middle, half) in machines() {
            let axes = inside(&middle, &half, &unit);
            let joints = machine.inverse(&axes).unwrap();
            let near = inside(&middle, &half, &unit.map(|u| 0.98 * u));
            let back = machine.forward(&joints, &near).unwrap();
            let size = axes.amax().max(joints.amax());
            prop_assert!((back - axes).amax() <= 1e-12 * size, "{machine:?}: {axes} {back}");
            let again = machine.inverse(&back).unwrap();
            prop_assert!((again - joints).amax() <= 1e-12 * size);
            prop_assert_eq!(machine.admit(&axes), Ok(()));
        }
    }

    /// Rates and accelerations are those of the joints' positions in time.
    #[test]
    fn rates_are_differences(unit in units(), v in units(), a in units()) {
        let h = 1e-4;
        for (machine, middle, half) in machines() {
            let (p, v) = (inside(&middle, &half, &unit), inside(&[0.0; 6], &[100.0; 6], &v));
            let a = inside(&[0.0; 6], &[1000.0; 6], &a);
            let at = |t: f64| machine.motion(&(p + v * t + a * (0.5 * t * t)), &(v + a * t), &a).unwrap();
            let (before, now, after) = (at(-h), at(0.0), at(h));
            let rates = (after.position - before.position) / (2.0 * h);
            let accelerations = (after.velocity - before.velocity) / (2.0 * h);
            let (fast, hard) = (now.velocity.amax().max(1.0), now.acceleration.amax().max(1.0));
            prop_assert!((rates - now.velocity).amax() <= 1e-6 * fast, "{machine:?}");
            prop_assert!((accelerations - now.acceleration).amax() <= 1e-4 * hard, "{machine:?}");
            let jacobian = machine.jacobian(&p).unwrap();
            prop_assert!((jacobian * v - now.velocity).amax() <= 1e-10 * fast);
        }
    }
}

/// Joint positions of a motion that is evaluated every tick have the joint rates, too.
#[test]
fn second_differences_along_a_line_are_accelerations() {
    let machine = translational();
    let period_t = 0.004;
    let velocity = axes(&[100.0, 0.0, 0.0]);
    let at = |tick: i32| {
        let x = -150.0 + 100.0 * period_t * f64::from(tick);
        machine
            .motion(&axes(&[x, 20.0, 500.0]), &velocity, &AxisVector::zeros())
            .unwrap()
    };
    for tick in 1..749 {
        let second = (at(tick + 1).position - at(tick).position * 2.0 + at(tick - 1).position)
            / (period_t * period_t);
        assert!((second - at(tick).acceleration).amax() < 1e-5);
    }
}

#[test]
fn out_of_reach_is_an_error_not_a_number() {
    let far = axes(&[1000.0, 0.0, 0.0]);
    for (machine, _, _) in machines() {
        match machine {
            Mechanism::LinearDelta(_)
            | Mechanism::RotaryDelta(_)
            | Mechanism::Scara(_)
            | Mechanism::FiveBar(_) => {
                assert!(matches!(
                    machine.inverse(&far),
                    Err(KinematicsError::Unreachable { .. })
                ));
                let nan = axes(&[f64::NAN, 0.0, 0.0]);
                assert!(machine.inverse(&nan).is_err());
            }
            _ => {}
        }
    }
    let short = JointVector::repeat(10.0);
    let home = axes(&[0.0, 0.0, 500.0]);
    assert!(translational().forward(&short, &home).is_err());
    assert!(
        Hexapod::paired(400.0, 150.0, 15.0)
            .forward(&short, &home)
            .is_err()
    );
    let mut apart = JointVector::zeros();
    apart[1] = 900.0;
    assert_eq!(
        delta().forward(&apart, &home),
        Err(KinematicsError::NoPosition)
    );
}

#[test]
fn singular_positions_are_refused() {
    // A rod that lies almost flat, an arm almost stretched, a platform turned by a right angle.
    let flat = delta();
    assert!(matches!(
        flat.admit(&axes(&[0.0, -138.74, 0.0])),
        Err(KinematicsError::Singular { .. })
    ));
    assert!(matches!(
        scara(Elbow::Positive).admit(&axes(&[639.99, 0.0, 0.0])),
        Err(KinematicsError::Singular { .. })
    ));
    let turned =
        Hexapod::paired(400.0, 150.0, 15.0).admit(&axes(&[0.0, 0.0, 500.0, 0.0, 0.0, 89.9]));
    assert!(matches!(turned, Err(KinematicsError::Singular { .. })));
    let conditioning = |half_angle: f64| {
        let machine = Hexapod::paired(400.0, 150.0, half_angle);
        machine
            .conditioning(&axes(&[0.0, 0.0, 500.0]))
            .unwrap()
            .condition
    };
    assert!((conditioning(25.0) - 11.3).abs() < 0.05);
    assert!((conditioning(29.0) - 57.0).abs() < 0.5);
    assert!(conditioning(30.0) > 1e9);
}

#[test]
fn guards_of_a_hexapod() {
    let mut machine = Hexapod::paired(400.0, 150.0, 15.0);
    let level = axes(&[0.0, 0.0, 500.0]);
    machine.guards.min_strut_distance_mm = 1.0;
    assert_eq!(machine.admit(&level), Ok(()));
    machine.guards.min_strut_distance_mm = 200.0;
    assert!(matches!(
        machine.admit(&level),
        Err(KinematicsError::Colliding { .. })
    ));
    machine.guards = Guards {
        max_platform_angle_deg: 40.0,
        ..Guards::NONE
    };
    assert_eq!(machine.admit(&level), Ok(()));
    let tilted = machine.admit(&axes(&[0.0, 0.0, 500.0, 20.0]));
    assert!(matches!(tilted, Err(KinematicsError::Tilted { .. })));
}

#[test]
fn the_first_joint_limit_that_breaks_is_named() {
    let machine = translational();
    let velocity = axes(&[0.0, 0.0, 50.0]);
    let motion = machine
        .motion(&axes(&[0.0, 0.0, 500.0]), &velocity, &AxisVector::zeros())
        .unwrap();
    let mut limits = JointLimits::NONE;
    assert_eq!(limits.broken_by(&motion), None);
    limits.0[4].max_position = motion.position[4] - 0.1;
    let broken = limits.broken_by(&motion).unwrap();
    assert_eq!((broken.joint, broken.quantity), (4, Quantity::Highest));
    limits.0[2].velocity = motion.velocity[2].abs() * 0.999;
    let broken = limits.broken_by(&motion).unwrap();
    assert_eq!((broken.joint, broken.quantity), (2, Quantity::Velocity));
    limits.0[2].velocity = motion.velocity[2].abs();
    assert_eq!(limits.broken_by(&motion).unwrap().joint, 4);
    let mut jerk = JointVector::zeros();
    jerk[3] = -5.0;
    limits.0[3].jerk = 4.0;
    assert_eq!(limits.jerk_broken_by(&jerk).unwrap().joint, 3);
}

#[test]
fn four_positions_are_judged_as_they_are_in_a_motion() {
    let mechanism = Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0));
    let mut limits = JointLimits::NONE;
    for joint in &mut limits.0 {
        (joint.velocity, joint.acceleration, joint.jerk) = (20.0, 35.0, 90.0);
    }
    let period_t = 0.004;
    let place = |tick: u32| {
        let t = period_t * f64::from(tick);
        let [x, y] = [(1.3 * t).sin(), (1.7 * t).cos()].map(|part| 12.0 * part);
        axes(&[x, y, 500.0, 0.5 * x])
    };
    let (mut kept, mut broken) = (0, 0);
    for first in 0..2000 {
        let four = [3, 2, 1, 0].map(|k| place(first + k));
        let judged = JointWatch::new(mechanism, limits, period_t).judge(&four);
        let [q, q1, q2, q3] = four.map(|place| mechanism.inverse(&place).unwrap());
        let differences = [q - q1, q - q1 * 2.0 + q2, q - q1 * 3.0 + q2 * 3.0 - q3];
        let limits = [20.0, 35.0, 90.0];
        let mut used = (1..).zip(differences.iter().zip(limits));
        let is_kept = used.all(|(order, (difference, limit))| {
            difference.amax() <= limit * period_t.powi(order) * (1.0 + 1e-6)
        });
        assert_eq!(judged.is_ok(), is_kept, "{first}");
        *if judged.is_ok() {
            &mut kept
        } else {
            &mut broken
        } += 1;
    }
    assert!(kept > 100 && broken > 100, "{kept} {broken}");
}

#[test]
fn a_watch_finds_what_the_differences_show() {
    let mechanism = Mechanism::Translational(translational());
    let period_t = 0.004;
    let mut limits = JointLimits::NONE;
    limits.0[3].velocity = 44.0;
    // Along x at 100 mm/s strut 3 runs at 44.72 mm/s in the middle, slower before.
    let mut watch = JointWatch::new(mechanism, limits, period_t);
    let mut found = None;
    for tick in 0..1000 {
        // Smooth from rest: x = 100 (t - sin(5 t)/5) up to 0.6 s, then at constant speed.
        let t = period_t * f64::from(tick);
        let x = -100.0 + 100.0 * (t - (5.0 * t).sin() / 5.0) / 2.0;
        if let Err(fault) = watch.take(&axes(&[x, 0.0, 500.0])) {
            found = Some((tick, fault));
            break;
        }
    }
    let (tick, fault) = found.unwrap();
    assert!(
        matches!(
            fault,
            JointFault::Limit(JointViolation {
                joint: 3,
                quantity: Quantity::Velocity,
                ..
            })
        ),
        "{fault}"
    );
    // The formula says when.
    let speed = |tick: i32| {
        let t = period_t * f64::from(tick);
        let x = -100.0 + 100.0 * (t - (5.0 * t).sin() / 5.0) / 2.0;
        let v = 100.0 * (1.0 - (5.0 * t).cos()) / 2.0;
        let motion = mechanism.motion(&axes(&[x, 0.0, 500.0]), &axes(&[v]), &AxisVector::zeros());
        motion.unwrap().velocity[3].abs()
    };
    assert!(
        speed(tick - 3) < 44.1 && speed(tick + 3) > 43.9,
        "{tick}: {}",
        speed(tick)
    );

    // A jump is a jerk.
    limits = JointLimits::NONE;
    limits.0[0].jerk = 1e6;
    let mut watch = JointWatch::new(mechanism, limits, period_t);
    assert_eq!(watch.take(&axes(&[0.0, 0.0, 500.0])), Ok(()));
    let jump = watch.take(&axes(&[0.0, 0.0, 500.1]));
    assert!(matches!(
        jump,
        Err(JointFault::Limit(JointViolation {
            quantity: Quantity::Jerk,
            ..
        }))
    ));
    watch.rest();
    assert_eq!(watch.take(&axes(&[0.0, 0.0, 500.1])), Ok(()));

    let mut hexapod = JointWatch::new(
        Mechanism::Hexapod(Hexapod::paired(400.0, 150.0, 15.0)),
        JointLimits::NONE,
        period_t,
    );
    let turned = hexapod.take(&axes(&[0.0, 0.0, 500.0, 0.0, 0.0, 90.0]));
    assert!(matches!(
        turned,
        Err(JointFault::Position(KinematicsError::Singular { .. }))
    ));
}
