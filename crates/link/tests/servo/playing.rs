//! Tests of the player: setpoints are played at their times, and what a gap in them does.

use super::*;

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
    assert_eq!(counts.coasts, 0);
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
    assert!(counts.coasts > 0);
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

#[test]
fn setpoints_that_always_come_shortly_before_their_time_are_followed() {
    for tenths in [6, 8, 11, 13] {
        let mut bench = Bench::new();
        for number in (0..10).chain(11..60) {
            bench.run_to(ns_of(number) + PERIOD_NS / 10 * tenths, &[]);
            bench.publish(&setpoint(number));
        }
        let joints = bench.run_to(ns_of(61), &[]);
        let (last_ns, last) = *joints.last().unwrap();
        let expected = truth((last_ns - START_NS) as f64 * 1e-9);
        assert!(
            (last.position - expected.position).abs() < 0.02,
            "{tenths}: {last:?} for {expected:?}"
        );
        assert_eq!(bench.servo.counts().stops, 0, "{tenths}");
    }
}

#[test]
fn setpoints_that_all_come_too_late_end_in_an_own_stop() {
    let mut bench = Bench::new();
    for number in 0..60 {
        // Eight tenths of a period after their time: where they lead is the past as well.
        bench.run_to(ns_of(number) + PERIOD_NS / 10 * 18, &[]);
        bench.publish(&setpoint(number));
    }
    let joints = bench.run_to(ns_of(200), &[]);
    let rest = joints.last().unwrap().1;
    assert_eq!((rest.velocity, rest.acceleration), (0.0, 0.0));
    assert_eq!(bench.servo.counts().stops, 1);
    // Nobody coasts for longer than patience lasts.
    let gone = (rest.position - truth(PERIOD_NS as f64 * 1e-9).position).abs();
    assert!(gone < 60.0, "{gone}");
}
