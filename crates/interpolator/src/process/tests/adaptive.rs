//! Tests of adaptive feed: an input slows programs down, and holds them.

use super::bench::{Bench, config};
use crate::shared::config::Config;
use crate::shared::config::feedback::AdaptiveFeed;
use glidepath_link::{Command, MachineState, MotionMode};
use glidepath_plant::{InjectedFault, JointSettings};

const INPUT: usize = 3;

fn bench(always: bool) -> Bench {
    let joint = |start| JointSettings {
        start,
        count: start,
        ..JointSettings::default()
    };
    let mut config = config(false);
    if let Some(feedback) = &mut config.feedback {
        feedback.adaptive = Some(AdaptiveFeed {
            input: INPUT as u8,
            at_zero: 0.0,
            at_full: 10.0,
            always,
            // Below zero the other tests do not go.
            backwards: true,
        });
    }
    let mut bench = Bench::new(
        Config { ..config },
        &[joint(12.5), joint(-3.0), joint(40.0)],
    );
    bench.enable(MachineState::Idle);
    bench
}

#[test]
fn the_input_is_a_factor_of_the_override_and_zero_holds() {
    let mut bench = bench(true);
    bench.inject(InjectedFault::Analog(INPUT, 5.0));
    bench.run(20);
    bench.load(5, 900);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(150);
    let override_r = |bench: &Bench| bench.last().effective_override;
    assert!(
        (override_r(&bench) - 0.5).abs() < 1e-9,
        "{}",
        override_r(&bench)
    );
    bench.command(Command::FeedOverride(0.5)).unwrap();
    bench.run(150);
    assert!(
        (override_r(&bench) - 0.25).abs() < 1e-9,
        "{}",
        override_r(&bench)
    );
    // No current, no way.
    bench.inject(InjectedFault::Analog(INPUT, 0.0));
    assert!(bench.run_to(MachineState::Held, 500));
    let stood = bench.last().position;
    bench.run(300);
    assert_eq!(bench.last().position, stood);
    bench.inject(InjectedFault::Analog(INPUT, 30.0));
    bench.command(Command::FeedOverride(1.0)).unwrap();
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(150);
    assert!(
        (override_r(&bench) - 1.0).abs() < 1e-9,
        "{}",
        override_r(&bench)
    );
    assert!(bench.run_to(MachineState::Idle, 4000));
    assert_eq!(bench.fault(), None);
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
}

#[test]
fn below_zero_the_input_turns_the_motion_round() {
    let mut bench = bench(true);
    bench.inject(InjectedFault::Analog(INPUT, 10.0));
    bench.run(20);
    bench.load(5, 900);
    assert!(bench.run_to(MachineState::Running, 50));
    bench.run(300);
    let turned = bench.last();
    bench.inject(InjectedFault::Analog(INPUT, -5.0));
    bench.run(200);
    let back = bench.last();
    assert!(
        back.feed_v < 0.0 && back.sequence + 40 < turned.sequence,
        "{back:?}"
    );
    assert!((back.effective_override - 0.5).abs() < 1e-9, "{back:?}");
    let status = bench.status();
    assert_eq!(status.mode(), Ok(MotionMode::Backwards));
    assert!((status.adaptive_feed + 0.5).abs() < 1e-9);
    // To the beginning, where there is no more way.
    assert!(bench.run_to(MachineState::Held, 4000));
    assert_eq!(bench.last().sequence, 0);
    bench.inject(InjectedFault::Analog(INPUT, 10.0));
    assert!(bench.run_to(MachineState::Idle, 4000));
    assert_eq!(bench.fault(), None);
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
}

#[test]
fn a_machine_whose_input_trembles_keeps_its_limits() {
    let mut bench = bench(true);
    let mut numbers = super::bench::numbers(77);
    bench.load(6, 700);
    for _ in 0..1500 {
        let value = 12.0 * numbers.unit();
        bench.inject(InjectedFault::Analog(INPUT, value));
        bench.run(5);
    }
    // And one that turns the motion round now and then.
    for _ in 0..150 {
        let value = 24.0 * numbers.unit() - 8.0;
        bench.inject(InjectedFault::Analog(INPUT, value));
        bench.run(40);
    }
    bench.inject(InjectedFault::Analog(INPUT, 10.0));
    assert!(bench.run_to(MachineState::Idle, 4000));
    assert_eq!(bench.fault(), None);
    assert!(bench.worst_ratio() < 1.0 + 1e-6, "{}", bench.worst_ratio());
}
