//! Tests of servo stacks that say what no drive says.

use super::bench::{Bench, PERIOD_NS, numbers};
use crate::testing::Numbers;
use glidepath_link::{
    Command, Feedback, MachineState, Record as _, Setpoint, Status, Transport as _,
};
use glidepath_plant::InjectedFault;

/// What is published can be used, whatever came in.
fn assert_usable(bench: &Bench, status: &Status, what: &str) {
    let unusable = |setpoint: &Setpoint| setpoint.check().is_err();
    let found = bench.setpoints.iter().find(|setpoint| unusable(setpoint));
    assert!(found.is_none(), "{what}: {found:?}");
    status.check().unwrap();
}

#[test]
fn positions_of_no_machine_are_not_taken_over() {
    for far in [1e308, -1e308, f64::MAX, 1e10] {
        let mut bench = Bench::mill();
        bench.run(10);
        bench.inject(InjectedFault::Dropout(true));
        bench.run(30);
        let mut sink = bench.link.feedback_sink().unwrap();
        for number in 0..40 {
            let hostile = Feedback {
                boot_id: 6,
                number,
                sample_ns: bench.now_ns(),
                joints: 0b111,
                position: [far; 9],
                velocity: [0.0; 9],
                ..bench.plant.measured()
            };
            sink.publish(&hostile).unwrap();
            bench.tick();
            if number == 20 {
                let position = -far;
                bench
                    .command(Command::SetPosition { joint: 0, position })
                    .unwrap_err();
                bench.command(Command::Enable).unwrap_err();
            }
        }
        let status = bench.status();
        let text = status.last_error.as_str();
        assert!(text.contains("no position of a joint"), "{text}");
        assert_usable(&bench, &status, &format!("{far}"));
    }
}

/// A record as no drive sends it.
fn garble(record: &mut Feedback, numbers: &mut Numbers) {
    const STRANGE: [f64; 6] = [f64::NAN, f64::INFINITY, -1e300, 1e10, 999.0, 0.0];
    let joint = numbers.whole(0, 3) as usize;
    let strange = STRANGE[numbers.whole(0, 5) as usize];
    let mask = numbers.whole(0, 0x1ff) as u32;
    match numbers.whole(0, 7) {
        0 => record.position[joint] = strange,
        1 => record.velocity[joint] = strange,
        2 => record.joints = mask,
        3 => record.boot_id = numbers.whole(1, 30),
        4 => (record.enabled, record.homing) = (mask, mask >> 3),
        5 => (record.homed, record.limit_low) = (mask, mask >> 3),
        6 => record.sample_ns = numbers.whole(0, 2 * record.sample_ns),
        _ => {
            let bytes = bytemuck::bytes_of_mut(record);
            let at = numbers.whole(0, bytes.len() as u64 - 1) as usize;
            bytes[at] = numbers.whole(0, 255) as u8;
        }
    }
}

/// Some records are garbled, of the stack that drives the machine or of another; then none.
fn garbled_at_random(seed: u64) {
    let mut numbers = numbers(seed);
    let mut bench = Bench::mill();
    if !seed.is_multiple_of(3) {
        bench.enable(MachineState::Idle);
    }
    if seed % 3 == 2 {
        bench.load(seed, 600);
    }
    bench.run(numbers.whole(5, 150) as usize);
    let mut sink = bench.link.feedback_sink().unwrap();
    for _ in 0..numbers.whole(1, 20) {
        let mut record = bench.plant.measured();
        record.sample_ns = bench.now_ns() + numbers.whole(0, PERIOD_NS);
        for _ in 0..numbers.whole(1, 3) {
            garble(&mut record, &mut numbers);
        }
        sink.publish(&record).unwrap();
        bench.run(numbers.whole(1, 4) as usize);
    }
    bench.run(300);
    bench.feed.clear();
    if bench.command(Command::Abort).is_ok() {
        bench.run(100);
    }
    let status = bench.status();
    assert_usable(&bench, &status, &format!("seed {seed}"));
    assert!(bench.worst_ratio() <= 1.0 + 1e-6, "seed {seed}");
    bench.assert_no_joint_jumps();
    // It can go on.
    if bench.state() == MachineState::Faulted {
        bench.command(Command::Reset).unwrap();
        bench.run(3);
    }
    if bench.state() == MachineState::Off {
        bench.enable(MachineState::Idle);
    }
    assert_eq!(bench.state(), MachineState::Idle, "seed {seed}");
}

#[test]
fn garbled_feedback_moves_nothing_and_stops_the_machine_at_most() {
    for seed in 0..90 {
        garbled_at_random(seed);
    }
}
