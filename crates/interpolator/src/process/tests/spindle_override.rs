//! The override of the spindle: what an operator sets, what a machine allows, and what a program locks.

use super::m_code_waits::{bench, told};
use crate::shared::m_code_waits::MCodeWaits;
use glidepath_link::{Auxiliary, Command, MachineState, Subscriber, Transport as _};
use glidepath_program::Event;

/// The newest record.
fn newest(records: &mut dyn Subscriber<Auxiliary>) -> Auxiliary {
    let mut last = None;
    while let Some(newer) = records.take().unwrap() {
        last = Some(newer);
    }
    last.expect("a record")
}

fn override_of(record: &Auxiliary) -> f64 {
    record.spindle_override
}

#[test]
fn the_record_has_it_unless_a_program_locks_it() {
    let mut bench = bench(MCodeWaits::NONE);
    let mut records = bench.link.auxiliary_source().unwrap();
    bench.command(Command::SpindleOverride(0.8)).unwrap();
    bench.run(10);
    assert!((override_of(&newest(&mut *records)) - 0.8).abs() < 1e-12);
    assert!((bench.status().spindle_override - 0.8).abs() < 1e-12);

    let locks = [Event::PassingCode(49), Event::MCode(100)];
    bench.load_events(4, 200, &locks);
    assert!(bench.run_to(MachineState::Running, 50));
    let _code = told(&mut bench, 100.0);
    bench.run(2);
    let record = newest(&mut *records);
    assert!((override_of(&record) - 1.0).abs() < 1e-12, "it is locked");
    assert!(record.is_spindle_override_locked());
    // What is set meanwhile counts later.
    bench.command(Command::SpindleOverride(0.6)).unwrap();
    bench.command(Command::Abort).unwrap();
    assert!(bench.run_to(MachineState::Idle, 500));
    bench.run(10);
    let record = newest(&mut *records);
    assert!((override_of(&record) - 0.6).abs() < 1e-12);
    assert!(!record.is_spindle_override_locked());
}

#[test]
fn what_the_machine_does_not_allow_is_refused_with_its_range() {
    let mut bench = bench(MCodeWaits::NONE);
    for ratio in [0.4, 1.3] {
        let why = bench
            .command(Command::SpindleOverride(ratio))
            .expect_err("it is out of range");
        assert!(why.contains("this machine allows 50 to 120 %"), "{why}");
    }
    assert!((bench.status().spindle_override - 1.0).abs() < 1e-12);
}
