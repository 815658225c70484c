//! Tests of stops that are asked for, setpoints that jump, and where a servo begins again.

use super::references::standing;
use super::{Bench, PERIOD_NS, START_NS, assert_continuous, ns_of, setpoint, state, truth};
use glidepath_link::servo::{JointState, JumpLimits, JumpOf, OwnStop, ServoSettings};
use glidepath_link::{MachineState, Setpoint};

/// The limits that [`truth`] is within: 314 mm/s and 1974 mm/s².
fn guarded() -> Bench {
    Bench::with(ServoSettings {
        jump: [JumpLimits::above(320.0, 2000.0); 9],
        ..ServoSettings::default()
    })
}

/// Plays so many setpoints, and gives where the joint is then.
fn played(bench: &mut Bench, count: u64) -> JointState {
    let numbers: Vec<u64> = (0..count).collect();
    bench.run_to(ns_of(count), &numbers).last().unwrap().1
}

fn is_at_rest(joints: &[(u64, JointState)]) -> bool {
    let last = joints.last().unwrap().1;
    (last.velocity, last.acceleration) == (0.0, 0.0)
}

#[test]
fn a_stop_that_is_asked_for_begins_at_once_and_is_latched() {
    let mut bench = Bench::new();
    let before = played(&mut bench, 50);
    assert!(before.velocity.abs() > 90.0, "it moves");
    bench.servo.stop(bench.now_ns);
    let more: Vec<u64> = (50..150).collect();
    let mut joints = vec![(bench.now_ns - 100_000, before)];
    joints.extend(bench.run_to(ns_of(150), &more));
    assert_continuous(&joints, 2000.0 * 1.001);
    assert!(is_at_rest(&joints));
    // As fast as its limits allow: 2000 mm/s² from at most 314 mm/s, and the jerk on both sides.
    let moves = |(_, joint): &&(u64, JointState)| joint.velocity != 0.0;
    let steps = joints.iter().filter(moves).count();
    assert!(steps < 2_100, "{steps} steps of 0.1 ms");
    assert_eq!(bench.servo.stopped(), Some(&OwnStop::Asked));
    let counts = *bench.servo.counts();
    assert_eq!(
        (counts.stops, counts.received),
        (1, 150),
        "counted, not played"
    );
    assert!(!bench.servo.is_armed());

    bench.servo.stop(bench.now_ns);
    assert_eq!(bench.servo.counts().stops, 1, "it stands already");
    bench.servo.rearm();
    assert_eq!(bench.servo.stopped(), None);
    let numbers: Vec<u64> = (150..160).collect();
    let joints = bench.run_to(ns_of(160), &numbers);
    assert_eq!(joints[0].1, truth((151 * PERIOD_NS) as f64 * 1e-9));
}

#[test]
fn a_stop_before_the_first_setpoint_keeps_it_from_being_played() {
    let mut bench = Bench::new();
    bench.servo.stop(bench.now_ns);
    let numbers: Vec<u64> = (0..10).collect();
    assert!(bench.run_to(ns_of(10), &numbers).is_empty());
    assert_eq!(bench.servo.counts().stops, 0, "nothing moved");
    assert_eq!(bench.servo.stopped(), Some(&OwnStop::Asked));
}

#[test]
fn motion_at_its_limits_is_no_jump() {
    let mut bench = guarded();
    let numbers: Vec<u64> = (0..250).collect();
    bench.run_to(ns_of(250), &numbers);
    let counts = bench.servo.counts();
    assert_eq!((counts.jumps, counts.stops), (0, 0));
    assert!(bench.servo.is_armed());
}

#[test]
fn a_setpoint_that_jumps_is_not_played() {
    // By how much it is off, and of what that is too much: a step of d within h is 1.875 d/h and
    // 5.6 d/h², beside what the motion has.
    for (step, of) in [
        (0.002, None),
        (0.1, Some(JumpOf::Acceleration)),
        (5.0, Some(JumpOf::Velocity)),
        (-5.0, Some(JumpOf::Velocity)),
    ] {
        let mut bench = guarded();
        let before = played(&mut bench, 50);
        let mut off = setpoint(50);
        off.joint_position[0] += step;
        bench.publish(&off);
        let mut joints = vec![(bench.now_ns - 100_000, before)];
        joints.extend(bench.run_to(ns_of(51), &[]));
        let after: Vec<u64> = (51..150).collect();
        joints.extend(bench.run_to(ns_of(150), &after));
        let counts = *bench.servo.counts();
        let Some(of) = of else {
            // Within the limits: played, and no jump back either.
            assert_eq!((counts.jumps, counts.stops), (0, 0), "{step}");
            continue;
        };
        assert_continuous(&joints, 2000.0 * 1.001);
        assert!(is_at_rest(&joints), "{step}");
        assert_eq!((counts.jumps, counts.stops, counts.received), (1, 1, 150));
        let Some(OwnStop::Jump(jump)) = bench.servo.stopped() else {
            panic!("{:?}", bench.servo.stopped());
        };
        assert_eq!(
            (jump.joint, jump.of, jump.to),
            (0, of, off.joint_position[0])
        );
        assert!(jump.asked > jump.limit && jump.to_string().starts_with("joint 0: from "));
    }
}

#[test]
fn a_servo_that_plays_later_stops_from_where_it_has_come_to() {
    const STEP_NS: u64 = 100_000;
    for delay_ns in [0, 2_000_000, 12_500_000] {
        for is_asked in [false, true] {
            let (mut bench, mut joints) = (guarded(), Vec::new());
            while bench.now_ns < ns_of(150) {
                if bench.now_ns.is_multiple_of(PERIOD_NS) {
                    let mut setpoint = setpoint((bench.now_ns - START_NS) / PERIOD_NS);
                    if !is_asked && setpoint.number >= 50 {
                        setpoint.joint_position[0] += 5.0;
                    }
                    bench.publish(&setpoint);
                }
                while bench.servo.receive(bench.now_ns).unwrap().is_some() {}
                let played_ns = bench.now_ns - delay_ns;
                if is_asked && bench.now_ns == ns_of(50) {
                    bench.servo.stop(bench.now_ns);
                }
                if let Some(demand) = bench.servo.demand(played_ns) {
                    joints.push((played_ns, demand[0]));
                }
                bench.now_ns += STEP_NS;
            }
            assert_continuous(&joints, 2000.0 * 1.001);
            assert!(is_at_rest(&joints), "{delay_ns} {is_asked}");
            assert_eq!(bench.servo.counts().stops, 1, "{delay_ns} {is_asked}");
        }
    }
}

#[test]
fn the_way_back_after_a_gap_is_guarded_too() {
    // While setpoints were missing for two periods the motion went elsewhere: three millimetres would
    // have to be made good within a period.
    let mut bench = guarded();
    let before = played(&mut bench, 50);
    bench.run_to(ns_of(52), &[]);
    let mut joints = vec![(
        bench.now_ns - 100_000,
        bench.servo.demand(bench.now_ns - 1).unwrap()[0],
    )];
    for number in 52..150 {
        let mut off = setpoint(number);
        off.joint_position[0] += 3.0;
        bench.publish(&off);
        joints.extend(bench.run_to(ns_of(number + 1), &[]));
    }
    assert_continuous(&joints[1..], 2000.0 * 1.001);
    assert!(is_at_rest(&joints));
    assert!((joints[1].1.position - before.position).abs() < 5.0);
    assert!(matches!(bench.servo.stopped(), Some(OwnStop::Jump(_))));
    let counts = bench.servo.counts();
    assert_eq!((counts.jumps, counts.stops), (1, 1));
}

#[test]
fn a_missed_tick_is_no_jump() {
    // The motion goes on a period later than the joints did: at 314 mm/s they are 1.2 mm ahead.
    let mut bench = guarded();
    let later = |number: u64| Setpoint {
        number: number - 1,
        missed_ticks: 1,
        ..setpoint(number)
    };
    for number in (0..250).filter(|number| *number != 3) {
        let mut told = if number < 3 {
            setpoint(number)
        } else {
            later(number)
        };
        let place = truth((number + 1 - u64::from(number > 3)) as f64 * PERIOD_NS as f64 * 1e-9);
        (told.joint_position[0], told.joint_velocity[0]) = (place.position, place.velocity);
        told.joint_acceleration[0] = place.acceleration;
        bench.publish(&told);
        bench.run_to(ns_of(number + 1), &[]);
    }
    let counts = bench.servo.counts();
    assert_eq!(
        (counts.jumps, counts.stops),
        (0, 0),
        "{:?}",
        bench.servo.stopped()
    );
    assert_eq!((counts.missed_ticks, counts.lost), (1, 0));
}

#[test]
fn late_then_missed_is_no_jump() {
    // Setpoint 50 comes 3 ms late (the joints coast), then the interpolator misses a tick: 51 comes two periods
    // after 50 and leads to where 51 periods lead, a period behind the joints.
    let mut bench = guarded();
    played(&mut bench, 50);
    bench.run_to(ns_of(50) + 3_000_000, &[]);
    bench.publish(&setpoint(50));
    bench.run_to(ns_of(52), &[]);
    let after = |number: u64| Setpoint {
        missed_ticks: 1,
        tick: number + 1,
        scheduled_ns: ns_of(number + 1),
        apply_ns: ns_of(number + 2),
        ..setpoint(number)
    };
    for number in 51..60 {
        bench.publish(&after(number));
        bench.run_to(ns_of(number + 2), &[]);
    }
    assert_eq!(bench.servo.stopped(), None, "{:?}", bench.servo.stopped());
}

#[test]
fn without_limits_there_is_no_guard() {
    let mut bench = Bench::new();
    played(&mut bench, 50);
    let mut off = setpoint(50);
    off.joint_position[0] += 5.0;
    bench.publish(&off);
    let joints = bench.run_to(ns_of(51) + 1, &[]);
    assert_eq!(joints.last().unwrap().1.position, off.joint_position[0]);
    assert_eq!(bench.servo.counts().jumps, 0);
}

#[test]
fn a_new_reference_settles_a_jump() {
    let mut bench = guarded();
    played(&mut bench, 50);
    for number in 50..60 {
        bench.publish(&standing(number, 0, MachineState::Idle, 400.0));
        bench.run_to(ns_of(number + 1), &[]);
    }
    assert!(!bench.servo.is_armed());
    bench.publish(&standing(60, 1, MachineState::Idle, 400.0));
    let joints = bench.run_to(ns_of(61), &[]);
    assert!(bench.servo.is_armed() && bench.servo.stopped().is_none());
    assert!(
        joints
            .iter()
            .all(|(_, joint)| *joint == state(400.0, 0.0, 0.0))
    );
}

#[test]
fn a_servo_that_knows_its_drives_begins_where_they_stand() {
    let mut bench = Bench::new();
    let (mut actual, mut window) = ([0.0; 9], [f64::INFINITY; 9]);
    (actual[0], window[0]) = (3.02, 0.05);
    bench.servo.rearm_at(&actual, &window);
    let mut number = 0;
    let mut tell = |bench: &mut Bench, setpoint: &dyn Fn(u64) -> Setpoint| {
        bench.publish(&setpoint(number));
        number += 1;
        bench.run_to(ns_of(number), &[])
    };
    // Elsewhere, moving, without power: none of these is where it begins.
    let elsewhere = |number| standing(number, 0, MachineState::Idle, 3.08);
    assert!(tell(&mut bench, &elsewhere).is_empty());
    let moving = |number| {
        let mut moving = standing(number, 0, MachineState::Running, 3.0);
        moving.joint_velocity[0] = 0.1;
        moving
    };
    assert!(tell(&mut bench, &moving).is_empty());
    let off = |number| standing(number, 0, MachineState::Off, 3.0);
    assert!(tell(&mut bench, &off).is_empty());
    let there = |number| standing(number, 0, MachineState::Idle, 3.0);
    let joints = tell(&mut bench, &there);
    assert_eq!(joints.len(), 40);
    assert!(
        joints
            .iter()
            .all(|(_, joint)| *joint == state(3.0, 0.0, 0.0))
    );
    // From then on it plays, wherever they go.
    let goes = |number| standing(number, 0, MachineState::Idle, 3.08);
    assert!(tell(&mut bench, &goes).last().unwrap().1.position > 3.07);
}

#[test]
fn silence_stops_nothing_where_nothing_moves() {
    let mut bench = guarded();
    let mut joints = Vec::new();
    // A quarter of a second without any, which is far more than its patience.
    for number in (0..50).chain(112..150) {
        joints.extend(bench.run_to(ns_of(number), &[]));
        bench.publish(&standing(number, 1, MachineState::Idle, 2.0));
    }
    joints.extend(bench.run_to(ns_of(150), &[]));
    let first = joints.first().unwrap().1;
    assert!(joints.iter().all(|(_, joint)| *joint == first), "it stays");
    assert_eq!(
        (bench.servo.counts().stops, bench.servo.stopped()),
        (0, None)
    );
    assert!(bench.servo.is_armed());
}
