//! Tests of following errors, and of who says what of which joint.

use super::bench::{Bench, config};
use bytemuck::Zeroable as _;
use glidepath_link::{
    Command, FaultCause, Feedback, JogDemand, JogMode, MachineState, Transport as _,
};
use glidepath_plant::{InjectedFault, JointSettings, Plant};

fn played(joints: &[JointSettings; 3], latency_ns: u64) -> Bench {
    let mut bench = Bench::new(config(false), joints);
    bench.plant = Plant::new(5, joints).with_latency(latency_ns);
    bench.enable(MachineState::Idle);
    bench.run(40);
    bench.load(8, 500);
    assert!(bench.run_to(MachineState::Running, 50));
    bench
}

#[test]
fn feedback_that_comes_late_is_no_following_error() {
    let mut bench = played(&[JointSettings::default(); 3], 3_000_000);
    assert!(bench.run_to(MachineState::Idle, 1_500));
    let status = bench.status();
    assert_eq!(status.fault, 0);
    assert!(
        status.following_peak.iter().all(|peak| *peak < 1e-6),
        "{:?}",
        status.following_peak
    );
}

#[test]
fn a_drive_that_lags_has_the_error_of_its_lag() {
    const LAG_T: f64 = 0.002;
    let joint = JointSettings {
        lag_t: LAG_T,
        ..JointSettings::default()
    };
    let mut bench = played(&[joint; 3], 0);
    assert!(bench.run_to(MachineState::Idle, 1_500));
    let speeds = bench.setpoints.iter().map(|s| s.joint_velocity[0].abs());
    let fastest = speeds.fold(0.0, f64::max);
    let status = bench.status();
    // The lag of the first order, and what the steps of a millisecond make of it.
    let expected = fastest * LAG_T;
    let peak = status.following_peak[0];
    assert!(
        fastest > 20.0 && (peak / expected - 1.0).abs() < 0.35,
        "{peak} for {expected}"
    );
    assert_eq!(status.fault, 0);
}

#[test]
fn a_joint_that_is_stuck_stops_the_machine_and_loses_the_power() {
    let mut bench = played(&[JointSettings::default(); 3], 0);
    bench.run(60);
    bench.inject(InjectedFault::Stuck(0, true));
    let before = bench.setpoints.len();
    let is_found = |bench: &mut Bench| bench.tick().state() != Ok(MachineState::Running);
    assert!((0..80).any(|_| is_found(&mut bench)));
    // As soon as the demand has gone further than allowed: then within three ticks.
    let away = |k: usize| {
        let stuck = bench.joints()[0];
        (bench.setpoints[k].joint_position[0] - stuck).abs()
    };
    let allowed = |k: usize| {
        let v = bench.setpoints[k].joint_velocity[0].abs();
        (2.0 * v / 200.0).max(0.1)
    };
    let beyond = (before..bench.setpoints.len()).find(|k| away(*k) > allowed(*k));
    let late = bench.setpoints.len() - beyond.unwrap();
    assert!(late <= 4, "{late} ticks after the demand was too far away");
    bench.run(200);
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::FollowingError)));
    assert_eq!(status.fault_joint(), Some(0));
    assert_eq!(bench.state(), MachineState::Faulted);
    assert!(status.following_peak[0] > 0.1);
}

/// Asks for a slow step of the first axis.
pub(super) fn step(bench: &mut Bench, number: u64, distance: f64) {
    let mut demand = JogDemand {
        client: 3,
        number,
        sent_ns: bench.now_ns(),
        mode: JogMode::Incremental.code(),
        mask: 0b001,
        velocity_v: 5.0,
        ..JogDemand::zeroed()
    };
    demand.value[0] = distance;
    bench.jog(&demand);
}

/// What a status tells to do for a joint that is not where it is to be.
pub(super) fn take_the_position_over(bench: &mut Bench) {
    bench.command(Command::Disable).unwrap();
    bench.run(3);
    bench.command(Command::Reset).unwrap();
    bench.run(3);
    bench.command(Command::Enable).unwrap();
}

#[test]
fn an_error_that_stays_is_not_reset_but_told_how_to_be_cleared() {
    let sticky = JointSettings {
        stiction: 0.16,
        ..JointSettings::default()
    };
    let others = JointSettings::default();
    let mut bench = Bench::new(config(false), &[sticky, others, others]);
    bench.enable(MachineState::Idle);
    bench.run(40);
    // Between once and twice what is allowed: the motion stops, and power stays on.
    step(&mut bench, 1, 0.15);
    assert!(bench.run_to(MachineState::Faulted, 200));
    bench.run(100);
    assert_eq!(bench.fault(), Some(FaultCause::FollowingError));
    let why = bench.command(Command::Reset).unwrap_err();
    assert!(why.contains("still too far"), "{why}");
    // Nothing is left to stop, and the fault stays.
    bench.command(Command::Abort).unwrap();
    bench.run(5);
    assert_eq!(bench.state(), MachineState::Faulted);
    take_the_position_over(&mut bench);
    assert!(bench.run_to(MachineState::Idle, 200));
    bench.run(200);
    assert_eq!((bench.state(), bench.fault()), (MachineState::Idle, None));
    assert_eq!(bench.last().joint_position, bench.joints());
    // One that has followed by then is reset as it is.
    step(&mut bench, 2, 0.15);
    assert!(bench.run_to(MachineState::Faulted, 200));
    bench.inject(InjectedFault::Pushed(0, 0.12));
    bench.run(20);
    bench.command(Command::Reset).unwrap();
    bench.run(100);
    assert_eq!((bench.state(), bench.fault()), (MachineState::Idle, None));
}

#[test]
fn a_second_stack_that_claims_a_joint_is_refused() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    let mut other = bench.link.feedback_sink().unwrap();
    for number in 0..50 {
        let mut claims = Feedback {
            boot_id: 6,
            number,
            sample_ns: bench.now_ns() + 1,
            joints: 0b001,
            ..Feedback::zeroed()
        };
        claims.position[0] = 999.0;
        other.publish(&claims).unwrap();
        bench.tick();
    }
    let status = bench.status();
    assert_eq!((status.fault, status.joint_actual[0]), (0, 12.5));
    let text = status.last_error.as_str();
    assert!(text.contains("another drives already"), "{text}");
    assert!(!text.contains("0x") && text.contains(" J0"), "{text}");
}

/// Two at once, of which one dies: the other was refused until then, and both is told. One that begins
/// when the other is dead was refused by nobody.
#[test]
fn a_stack_that_follows_another_is_told_of_as_it_is() {
    for is_dead in [false, true] {
        let mut bench = Bench::mill();
        bench.run(20);
        let mut next = Plant::new(9, &[JointSettings::default(); 3]);
        let mut sink = bench.link.feedback_sink().unwrap();
        let mut heard = Vec::new();
        for tick in 0..200 {
            if tick == 50 || tick == 0 && is_dead {
                bench.inject(InjectedFault::Dropout(true));
            }
            bench.tick();
            next.step(bench.now_ns() + 1_000_000, None, None);
            let mut feedback = next.feedback().unwrap();
            feedback.position[1] = 7.0;
            sink.publish(&feedback).unwrap();
            let said = bench.status().last_error.as_str().to_owned();
            if heard.last() != Some(&said) {
                heard.push(said);
            }
        }
        assert_eq!(bench.last().position[1], 7.0);
        let drives = |words: &str| heard.iter().filter(|said| said.contains(words)).count();
        let wanted = usize::from(!is_dead);
        assert_eq!(drives("another drives already"), wanted, "{heard:?}");
        assert_eq!(drives("that was refused does now"), wanted, "{heard:?}");
    }
}

#[test]
fn two_stacks_share_the_joints() {
    let mut bench = Bench::mill();
    let mut plants = [
        Plant::new(8, &[JointSettings::default()]),
        Plant::new(9, &[JointSettings::default(); 3]),
    ];
    // The bench's own is silent: these two are the machine.
    bench.inject(InjectedFault::Dropout(true));
    let mut sinks = [(); 2].map(|()| bench.link.feedback_sink().unwrap());
    for _ in 0..20 {
        bench.tick();
        for (index, (plant, sink)) in plants.iter_mut().zip(&mut sinks).enumerate() {
            plant.step(bench.now_ns() + 1_000_000, None, None);
            let mut feedback = plant.feedback().unwrap();
            feedback.joints = if index == 0 { 0b001 } else { 0b110 };
            feedback.position[1] = 7.0;
            sink.publish(&feedback).unwrap();
        }
    }
    assert_eq!(bench.last().position[..3], [0.0, 7.0, 0.0]);
}

#[test]
fn feedback_of_the_future_is_refused() {
    let mut bench = Bench::mill();
    bench.enable(MachineState::Idle);
    bench.inject(InjectedFault::Dropout(true));
    let mut sink = bench.link.feedback_sink().unwrap();
    for _ in 0..10 {
        let mut ahead = bench.plant.measured();
        ahead.sample_ns += 1_000_000_000;
        sink.publish(&ahead).unwrap();
        bench.tick();
    }
    let status = bench.status();
    assert_eq!(status.fault(), Ok(Some(FaultCause::FeedbackLost)));
    let text = status.last_error.as_str();
    assert!(text.contains("no longer say where they are"), "{text}");
}
