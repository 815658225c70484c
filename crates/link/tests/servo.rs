//! The servo: interpolation, counting, gaps, and the stop of its own.
#![allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test that cannot go on fails; what is exact is compared exactly"
)]

use bytemuck::Zeroable;
use glidepath_link::servo::{
    JointState, JointStates, Servo, ServoSettings, Stop, StopLimits, quintic,
};
use glidepath_link::{InProcess, MachineState, Publisher, Setpoint, Transport};
use proptest::prelude::*;

const PERIOD_NS: u64 = 4_000_000;
const BOOT: u64 = 77;
/// Far from zero, as a monotonic clock is.
const START_NS: u64 = 9_000_000_000_000;

fn state(position: f64, velocity: f64, acceleration: f64) -> JointState {
    JointState {
        position,
        velocity,
        acceleration,
    }
}

/// Value and first two derivatives of a polynomial, by Horner's rule on its coefficients.
fn polynomial(coefficients: &[f64; 6], t: f64) -> JointState {
    let derive = |c: &[f64]| -> Vec<f64> {
        c.iter()
            .enumerate()
            .skip(1)
            .map(|(n, c)| n as f64 * c)
            .collect()
    };
    let value = |c: &[f64]| c.iter().rev().fold(0.0, |sum, c| sum * t + c);
    let first = derive(coefficients);
    let second = derive(&first);
    state(value(coefficients), value(&first), value(&second))
}

proptest! {
    #[test]
    fn the_quintic_through_two_points_of_a_quintic_is_that_quintic(
        coefficients in proptest::array::uniform6(-10.0..10.0),
        span_t in 0.1..2.0,
        fraction in 0.0..=1.0,
    ) {
        let (from, to) = (polynomial(&coefficients, 0.0), polynomial(&coefficients, span_t));
        let expected = polynomial(&coefficients, fraction * span_t);
        let found = quintic(&from, &to, span_t, fraction * span_t);
        // Conditioning: differences of values up to 10³, divided by h².
        prop_assert!((found.position - expected.position).abs() < 1e-11);
        prop_assert!((found.velocity - expected.velocity).abs() < 1e-9);
        prop_assert!((found.acceleration - expected.acceleration).abs() < 1e-8);
        prop_assert_eq!(quintic(&from, &to, span_t, 0.0), from);
        prop_assert_eq!(quintic(&from, &to, span_t, span_t), to);
    }

    #[test]
    fn a_stop_ends_at_rest_within_its_limits(
        velocity in -300.0..300.0,
        acceleration in -4000.0..4000.0,
        limit in 500.0..5000.0,
        jerk in 10_000.0..1e6,
    ) {
        let from = state(5.0, velocity, acceleration);
        let stop = Stop::new(from, StopLimits { acceleration: limit, jerk });
        let duration_t = stop.duration_t();
        prop_assert_eq!(stop.at(0.0), from);
        let end = stop.at(duration_t + 1.0);
        prop_assert_eq!((end.velocity, end.acceleration), (0.0, 0.0));
        prop_assert_eq!(stop.at(duration_t + 2.0), end);
        // Just before the end it is at rest by itself.
        let nearly = stop.at(duration_t * (1.0 - 1e-9));
        prop_assert!(nearly.velocity.abs() < 1e-4, "{}", nearly.velocity);
        prop_assert!(nearly.acceleration.abs() < 1e-2, "{}", nearly.acceleration);
        let limit = limit.max(acceleration.abs()) * (1.0 + 1e-9);
        let steps = 500;
        let dt = duration_t / f64::from(steps);
        let mut before = from;
        for step in 1..=steps {
            let now = stop.at(f64::from(step) * dt);
            prop_assert!(now.acceleration.abs() <= limit);
            let rounding = 1e-9 * limit;
            prop_assert!((now.acceleration - before.acceleration).abs() <= jerk * dt + rounding);
            // The velocity is the integral of the acceleration, the position that of the velocity:
            // by the trapezoidal rule, whose error is bounded by the jerk.
            let mean_a = 0.5 * (now.acceleration + before.acceleration);
            let dv = now.velocity - before.velocity;
            prop_assert!((dv - mean_a * dt).abs() <= jerk * dt * dt + 1e-9);
            let mean_v = 0.5 * (now.velocity + before.velocity);
            let dp = now.position - before.position;
            prop_assert!((dp - mean_v * dt).abs() <= limit * dt * dt + 1e-9);
            before = now;
        }
    }

    #[test]
    fn a_stop_is_the_shortest_within_its_limits(
        velocity in 0.0..300.0,
        limit in 500.0..5000.0,
        jerk in 10_000.0..1e6,
    ) {
        // From steady motion: the trapezoid of deceleration, or the triangle if the limit is not
        // met.
        let stop = Stop::new(state(0.0, velocity, 0.0), StopLimits { acceleration: limit, jerk });
        let shortest_t = if velocity * jerk <= limit * limit {
            2.0 * (velocity / jerk).sqrt()
        } else {
            velocity / limit + limit / jerk
        };
        prop_assert!((stop.duration_t() - shortest_t).abs() < 1e-9);
        let mirrored = Stop::new(state(0.0, -velocity, 0.0), StopLimits { acceleration: limit, jerk });
        prop_assert_eq!(mirrored.at(0.3 * shortest_t).position, -stop.at(0.3 * shortest_t).position);
    }
}

/// A joint that goes to and fro: 50 mm amplitude at 1 Hz, 314 mm/s, 1974 mm/s², 12 403 mm/s³.
fn truth(time_t: f64) -> JointState {
    let omega = core::f64::consts::TAU;
    let (sin, cos) = (omega * time_t).sin_cos();
    state(50.0 * sin, 50.0 * omega * cos, -50.0 * omega * omega * sin)
}

fn setpoint(number: u64) -> Setpoint {
    let mut setpoint = Setpoint {
        boot_id: BOOT,
        number,
        tick: number,
        state: MachineState::Running.code(),
        enable: 1,
        scheduled_ns: START_NS + number * PERIOD_NS,
        apply_ns: START_NS + (number + 1) * PERIOD_NS,
        ..Setpoint::zeroed()
    };
    let at = truth((number + 1) as f64 * PERIOD_NS as f64 * 1e-9);
    setpoint.joint_position[0] = at.position;
    setpoint.joint_velocity[0] = at.velocity;
    setpoint.joint_acceleration[0] = at.acceleration;
    setpoint
}

struct Bench {
    sink: Box<dyn Publisher<Setpoint>>,
    servo: Servo,
    now_ns: u64,
}

impl Bench {
    fn new() -> Self {
        let link = InProcess::default();
        let servo = Servo::new(link.setpoint_source().unwrap(), ServoSettings::default());
        Self {
            sink: link.setpoint_sink().unwrap(),
            servo,
            now_ns: START_NS,
        }
    }

    fn publish(&mut self, setpoint: &Setpoint) {
        self.sink.publish(setpoint).unwrap();
    }

    /// Goes on in small steps; publishes each setpoint of the list when it is scheduled, and takes
    /// what arrives. Returns the first joint at each step.
    fn run_to(&mut self, end_ns: u64, numbers: &[u64]) -> Vec<(u64, JointState)> {
        const STEP_NS: u64 = 100_000;
        let mut joints = Vec::new();
        while self.now_ns < end_ns {
            if self.now_ns.is_multiple_of(PERIOD_NS) {
                let number = (self.now_ns - START_NS) / PERIOD_NS;
                if numbers.contains(&number) {
                    self.publish(&setpoint(number));
                }
            }
            while self.servo.receive(self.now_ns).unwrap().is_some() {}
            if let Some(demand) = self.servo.demand(self.now_ns) {
                joints.push((self.now_ns, demand[0]));
            }
            self.now_ns += STEP_NS;
        }
        joints
    }
}

fn ns_of(ticks: u64) -> u64 {
    START_NS + ticks * PERIOD_NS
}

/// Velocity and acceleration are those of the positions: no jump anywhere.
fn assert_continuous(joints: &[(u64, JointState)], limit_a: f64) {
    for pair in joints.windows(2) {
        let [(t0, a), (t1, b)] = pair else {
            unreachable!()
        };
        let dt = (t1 - t0) as f64 * 1e-9;
        let dv = b.velocity - a.velocity;
        assert!(
            dv.abs() <= limit_a * dt,
            "at {t1}: velocity {} to {}",
            a.velocity,
            b.velocity
        );
        let dp = b.position - a.position - 0.5 * dt * (a.velocity + b.velocity);
        assert!(
            dp.abs() <= limit_a * dt * dt,
            "at {t1}: position {} to {}",
            a.position,
            b.position
        );
    }
}

#[test]
fn setpoints_are_played_at_their_times_and_between() {
    let mut bench = Bench::new();
    let numbers: Vec<u64> = (0..250).collect();
    let joints = bench.run_to(ns_of(250), &numbers);
    assert_eq!(
        joints.first().unwrap().0,
        ns_of(1),
        "the first is applied one period after its tick"
    );
    for (now_ns, joint) in &joints {
        let expected = truth((now_ns - START_NS) as f64 * 1e-9);
        if (now_ns - START_NS).is_multiple_of(PERIOD_NS) {
            assert_eq!(joint, &expected);
        }
        // Between: the quintic differs from a sine by h⁶ p⁽⁶⁾ / (6! · 2⁶) at most.
        let p6 = 50.0 * core::f64::consts::TAU.powi(6);
        let bound = (PERIOD_NS as f64 * 1e-9).powi(6) * p6 / (720.0 * 64.0);
        assert!((joint.position - expected.position).abs() <= bound + 1e-13);
    }
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.received, counts.lost, counts.late, counts.stops),
        (250, 0, 0, 0)
    );
}

#[test]
fn a_short_gap_is_bridged_without_a_jump() {
    for missing in [vec![50], vec![50, 51], vec![50, 60, 61, 70]] {
        let mut bench = Bench::new();
        let numbers: Vec<u64> = (0..100)
            .filter(|number| !missing.contains(number))
            .collect();
        let joints = bench.run_to(ns_of(100), &numbers);
        // The motion itself has 1974 mm/s²; making good a gap takes a little more.
        assert_continuous(&joints, 1.2 * 1974.0);
        for (now_ns, joint) in &joints {
            let expected = truth((now_ns - START_NS) as f64 * 1e-9);
            // Error of constant acceleration for 8 ms and the way back: ½ a + j t³ / 6 and less.
            assert!((joint.position - expected.position).abs() < 0.01);
        }
        let (last_ns, last) = joints.last().unwrap();
        let expected = truth((last_ns - START_NS) as f64 * 1e-9);
        assert!(
            (last.position - expected.position).abs() < 1e-9,
            "back on the path"
        );
        let counts = bench.servo.counts();
        assert_eq!(counts.lost, missing.len() as u64);
        assert_eq!(counts.stops, 0);
        assert!(bench.servo.is_armed());
    }
}

#[test]
fn a_long_gap_ends_in_an_own_stop_that_is_latched() {
    let mut bench = Bench::new();
    let mut numbers: Vec<u64> = (0..50).collect();
    numbers.extend(80..150);
    let joints = bench.run_to(ns_of(150), &numbers);
    let limits = ServoSettings::default();
    assert_continuous(&joints, limits.stop[0].acceleration.max(1974.0) * 1.001);
    let rest = joints.last().unwrap().1;
    assert_eq!((rest.velocity, rest.acceleration), (0.0, 0.0));
    let counts = *bench.servo.counts();
    assert_eq!((counts.stops, counts.lost, counts.gaps), (1, 30, 1));
    assert!(
        !bench.servo.is_armed(),
        "later setpoints are counted, not played"
    );
    assert_eq!(counts.received, 120);

    bench.servo.rearm();
    let numbers: Vec<u64> = (150..160).collect();
    let joints = bench.run_to(ns_of(160), &numbers);
    assert_eq!(
        joints.first().unwrap().1,
        truth((151 * PERIOD_NS) as f64 * 1e-9)
    );
}

#[test]
fn duplicates_late_and_bad_records_are_counted() {
    let mut bench = Bench::new();
    let mut bad = setpoint(2);
    bad.joint_velocity[3] = f64::NAN;
    for setpoint in [
        &setpoint(0),
        &setpoint(1),
        &setpoint(0),
        &setpoint(1),
        &bad,
        &setpoint(4),
    ] {
        bench.publish(setpoint);
    }
    let numbers: Vec<u64> =
        core::iter::from_fn(|| bench.servo.receive(ns_of(2) + 1).unwrap().map(|s| s.number))
            .collect();
    assert_eq!(numbers, [0, 1, 4]);
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.received, counts.duplicates, counts.refused),
        (3, 2, 1)
    );
    assert_eq!((counts.lost, counts.gaps), (2, 1));
    assert_eq!(counts.late, 2, "setpoints 0 and 1 were for ticks 1 and 2");
    assert!(
        bench
            .servo
            .last_refusal()
            .unwrap()
            .to_string()
            .contains("joint_velocity[3]")
    );
}

#[test]
fn missed_ticks_are_not_lost_setpoints() {
    let mut bench = Bench::new();
    bench.publish(&setpoint(0));
    bench.publish(&Setpoint {
        tick: 4,
        missed_ticks: 3,
        ..setpoint(1)
    });
    while bench.servo.receive(START_NS).unwrap().is_some() {}
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.received, counts.lost, counts.missed_ticks),
        (2, 0, 3)
    );
}

#[test]
fn setpoints_of_another_life_of_the_interpolator_are_not_played() {
    let mut bench = Bench::new();
    let numbers: Vec<u64> = (0..50).collect();
    bench.run_to(ns_of(50), &numbers);
    for number in 50..60 {
        let reborn = Setpoint {
            boot_id: BOOT + 1,
            number: number - 50,
            ..setpoint(number)
        };
        bench.publish(&reborn);
        bench.run_to(ns_of(number + 1), &[]);
    }
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.restarts, counts.lost, counts.received, counts.stops),
        (1, 0, 60, 1)
    );
    assert!(!bench.servo.is_armed());
    let joints: Option<JointStates> = bench.servo.demand(bench.now_ns + 1_000_000_000);
    assert_eq!(joints.unwrap()[0].velocity, 0.0);
}

#[test]
fn a_setpoint_from_long_ago_is_not_played() {
    let mut bench = Bench::new();
    bench.publish(&setpoint(0));
    bench.now_ns = ns_of(1000);
    let joints = bench.run_to(ns_of(1010), &[]);
    assert!(joints.is_empty(), "the history of a dead interpolator");
    assert_eq!(bench.servo.counts().stops, 0);
}

/// A setpoint that stands at a position, of a reference and in a state.
fn standing(number: u64, reference: u64, state: MachineState, position: f64) -> Setpoint {
    let mut standing = Setpoint {
        reference,
        state: state.code(),
        ..setpoint(number)
    };
    standing.joint_position[0] = position;
    standing.joint_velocity[0] = 0.0;
    standing.joint_acceleration[0] = 0.0;
    standing
}

#[test]
fn a_new_reference_is_taken_up_at_rest_and_never_gone_to() {
    let mut bench = Bench::new();
    let numbers: Vec<u64> = (0..50).collect();
    bench.run_to(ns_of(50), &numbers);
    assert!(bench.servo.demand(bench.now_ns).is_some());
    // In the middle of a motion the power is lost: the setpoints repeat what the drives report.
    for number in 50..60 {
        bench.publish(&standing(number, 1, MachineState::Off, number as f64));
        let joints = bench.run_to(ns_of(number + 1), &[]);
        assert!(joints.is_empty(), "a drive without power has no demand");
    }
    // A setpoint that moves does not hand a position over.
    let mut moves = standing(60, 2, MachineState::Idle, 500.0);
    moves.joint_velocity[0] = 1.0;
    bench.publish(&moves);
    assert!(bench.run_to(ns_of(61), &[]).is_empty());
    for number in 61..70 {
        bench.publish(&standing(number, 2, MachineState::Idle, 100.0));
        let joints = bench.run_to(ns_of(number + 1), &[]);
        assert_eq!(joints.len(), 40, "a demand in every step");
        let stands = |(_, joint): &(u64, JointState)| *joint == state(100.0, 0.0, 0.0);
        assert!(joints.iter().all(stands), "it went there");
    }
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.references, counts.restarts, counts.stops),
        (2, 0, 0)
    );
}

#[test]
fn a_reference_that_changes_at_rest_leaves_no_moment_without_a_demand() {
    let mut bench = Bench::new();
    for number in 0..20 {
        let reference = number / 5;
        bench.publish(&standing(number, reference, MachineState::Idle, 3.0));
        let joints = bench.run_to(ns_of(number + 1), &[]);
        let expected = if number == 0 { 0 } else { 40 };
        assert_eq!(joints.len(), expected, "setpoint {number}");
    }
}

#[test]
fn a_servo_that_stopped_by_itself_begins_again_when_the_position_was_taken_over() {
    let mut bench = Bench::new();
    let numbers: Vec<u64> = (0..50).collect();
    bench.run_to(ns_of(80), &numbers);
    assert!(!bench.servo.is_armed());
    let rest = bench.servo.demand(bench.now_ns).unwrap()[0].position;
    bench.publish(&standing(80, 0, MachineState::Idle, rest + 1.0));
    let joints = bench.run_to(ns_of(81), &[]);
    let is_there = |(_, joint): &(u64, JointState)| (joint.position - rest).abs() < 1e-9;
    assert!(joints.iter().all(is_there), "not by itself");
    bench.publish(&standing(81, 1, MachineState::Idle, rest + 1.0));
    let joints = bench.run_to(ns_of(82), &[]);
    assert!(bench.servo.is_armed());
    assert!(joints.iter().all(|(_, j)| j.position == rest + 1.0));
}

#[test]
fn a_gap_is_bridged_though_setpoints_arrive_less_than_a_period_ahead() {
    let mut bench = Bench::new();
    for number in (0..10).chain(11..40) {
        // As they come over shared memory: a while after they were computed.
        bench.run_to(ns_of(number) + 300_000, &[]);
        bench.publish(&setpoint(number));
    }
    let joints = bench.run_to(ns_of(40), &[]);
    let (last_ns, last) = *joints.last().unwrap();
    let expected = truth((last_ns - START_NS) as f64 * 1e-9);
    assert!(
        (last.position - expected.position).abs() < 1e-3,
        "{last:?} for {expected:?}"
    );
    assert_eq!(bench.servo.counts().stops, 0);
}
