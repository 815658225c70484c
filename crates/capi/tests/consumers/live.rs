//! Tests of consumers of an interpolator that moves: nothing is lost, and all read the same bytes.
//!
//! Two seconds by default. A minute:
//!
//! ```text
//! GLIDEPATH_CONSUMERS=60 cargo test -p glidepath-capi --test consumers live -- --nocapture
//! ```

use crate::build::{self, Language, Linked, Place};
use crate::process::{self, Consumer};
use crate::{IN_PYTHON, NO_COMPILER, NO_PYTHON};
use glidepath_link::{MachineState, Setpoint};
use glidepath_testing::leave_out;
use glidepath_tests::{Instance, Machine, Watchdog, program_from};
use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

const PERIOD: Duration = Duration::from_millis(4);

/// To and fro in two axes for as long as it takes.
fn to_and_fro(time: Duration) -> String {
    let mut text = "G21 G90 G64 P0.02 F6000\n".to_owned();
    // Each line takes half a second or more.
    for _ in 0..=time.as_secs() {
        text.push_str("G1 X50 Y10\nG3 X60 Y20 I0 J10\nG1 X0 Y0\n");
    }
    text
}

/// A program, the script it runs if it is an interpreter, and what to call it.
type Program = (String, String, Option<String>);

/// Those that can be built here.
fn programs(place: Place<'_>) -> Vec<Program> {
    let mut programs = Vec::new();
    for (language, linked) in [
        (Language::C, Linked::Shared),
        (Language::C, Linked::Static),
        (Language::Cpp, Linked::Shared),
        (Language::Cpp, Linked::Static),
    ] {
        let name = format!("{language:?}-{linked:?}");
        match build::example(place, "follow", language, linked) {
            Some(program) => programs.push((name, program, None)),
            None => leave_out(&format!("programs in {language:?}"), NO_COMPILER),
        }
    }
    match process::python() {
        Some(python) => {
            let script = build::source("examples/follow.py");
            programs.push(("Python".to_owned(), python, Some(script)));
        }
        None => leave_out(IN_PYTHON, NO_PYTHON),
    }
    programs
}

/// Moves the machine until all have what they wait for, and gives what they did.
fn follow(
    place: Place<'_>,
    programs: &[Program],
    machine: &Machine<'_>,
    time: Duration,
    count: u64,
) -> Vec<(String, String, Vec<u8>)> {
    let start = |(name, program, script): &Program| {
        let script: Vec<&str> = script.iter().map(String::as_str).collect();
        Consumer::follow(place, name, program, &script, count)
    };
    let stop = AtomicBool::new(false);
    // On a busy host consumers take a while to start.
    let text = to_and_fro(time + Duration::from_secs(60));
    std::thread::scope(|scope| {
        // It ends with an error when it is told to stop under way.
        scope.spawn(|| machine.publish(&stop, |start| program_from(&text, start), || {}));
        let _running = machine.wait_for_state(MachineState::Running);
        let consumers: Vec<Consumer> = programs.iter().map(start).collect();
        let ready = |mut consumer: Consumer| {
            consumer.wait_until_ready();
            consumer.finish()
        };
        let ended = consumers.into_iter().map(ready).collect();
        stop.store(true, Ordering::Relaxed);
        ended
    })
}

/// What a consumer wrote is what the recorder has from the same setpoint on; how many of those moved.
fn compared(name: &str, read: &[u8], recorded: &[Setpoint]) -> usize {
    let first: Setpoint = bytemuck::pod_read_unaligned(&read[..size_of::<Setpoint>()]);
    let same = recorded.iter().skip_while(|s| s.number < first.number);
    let same: Vec<Setpoint> = same
        .take(read.len() / size_of::<Setpoint>())
        .copied()
        .collect();
    let expected: &[u8] = bytemuck::cast_slice(&same);
    assert!(
        read == expected,
        "{name}: other bytes than those that Rust received"
    );
    same.iter()
        .filter(|s| s.joint_velocity[0].abs() > 1.0)
        .count()
}

#[test]
fn nothing_is_lost_while_a_machine_moves() {
    let seconds = std::env::var("GLIDEPATH_CONSUMERS").ok();
    let time = Duration::from_secs(seconds.map_or(2, |seconds| seconds.parse().unwrap()));
    let count = u64::try_from(time.as_nanos() / PERIOD.as_nanos()).unwrap();
    let instance = Instance::new();
    let _watchdog = Watchdog::new(Duration::from_secs(120) + 3 * time);
    let place = Place {
        directory: instance.directory(),
        instance: &instance.config().instance,
    };
    let programs = programs(place);
    let results = RefCell::new(Vec::new());
    let recording = Machine::run(
        instance.config(),
        |_| {},
        |machine| *results.borrow_mut() = follow(place, &programs, machine, time, count),
    );
    assert!(recording.is_gapless(), "the recorder lost some");
    let results = results.into_inner();
    assert_eq!(results.len(), programs.len());
    for (name, told, read) in results {
        let expected = format!("{count} received, 0 lost");
        assert!(told.contains(&expected), "{name}: {told}");
        let moving = compared(&name, &read, &recording.setpoints);
        let moving = u64::try_from(moving).unwrap();
        assert!(
            moving > count / 10,
            "{name}: {moving} setpoints of a motion"
        );
        println!(
            "{name}: {count} setpoints, {moving} of them in motion, none lost, the same bytes"
        );
    }
}
