//! Tests of the counts: what is counted, and what is not played.

use super::*;
use glidepath_link::servo::JointStates;

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
