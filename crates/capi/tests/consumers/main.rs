//! Tests of programs in C, C++ and Python against an instance: what they read is what was
//! published, to the byte, and what they send arrives.
//!
//! The examples are compiled as a user would, and run as processes. The interpolator's part is
//! played by this process, over the transport that the interpolator uses; a real one is in `live`.
//! Where a compiler or Python is not installed, that is said.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    reason = "a test that cannot go on fails; a long one tells its figures"
)]

mod build;
mod live;
mod machine;
mod moving;
mod process;

use build::{Language, Linked, library};
use glidepath_link::servo::{JointState, ServoSettings, Stop};
use glidepath_testing::{leave_out, skip};
use machine::{Machine, from_rest, setpoint};
use process::Consumer;
use std::time::Duration;

const COUNT: u64 = 300;

const NO_COMPILER: &str = "no compiler is installed";
const IN_PYTHON: &str = "programs in Python";
const NO_PYTHON: &str = "it is not installed";

#[test]
fn every_language_reads_the_same_bytes() {
    let machine = Machine::start();
    let place = machine.place();
    let mut programs = Vec::new();
    for (language, linked) in [
        (Language::C, Linked::Shared),
        (Language::C, Linked::Static),
        (Language::Cpp, Linked::Shared),
        (Language::Cpp, Linked::Static),
    ] {
        let name = format!("{language:?}, {linked:?}");
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
    // Started when all are compiled: they do not wait for ever.
    let start = |(name, program, script): &(String, String, Option<String>)| {
        let script: Vec<&str> = script.iter().map(String::as_str).collect();
        Consumer::follow(place, name, program, &script, COUNT)
    };
    let mut consumers: Vec<Consumer> = programs.iter().map(start).collect();
    let rust = machine.follow(COUNT);
    // From here on all have a place of their own in the transport.
    for consumer in &mut consumers {
        consumer.wait_until_ready();
    }
    machine.publish(0..COUNT, setpoint);
    let expected: Vec<u8> = (0..COUNT)
        .flat_map(|number| bytemuck::bytes_of(&setpoint(number)).to_vec())
        .collect();
    assert_eq!(rust.join().unwrap(), expected, "Rust");
    for consumer in consumers {
        let (name, told, read) = consumer.finish();
        assert!(told.contains("300 received, 0 lost"), "{name}: {told}");
        assert!(read == expected, "{name}: {} bytes differ", read.len());
    }
}

#[test]
fn a_servo_in_c_follows_and_stops_by_itself() {
    let machine = Machine::start();
    let Some(program) = build::example(machine.place(), "servo", Language::C, Linked::Shared)
    else {
        skip("programs in C", NO_COMPILER);
        return;
    };
    // A busy host may not run this process for longer than a servo would bear.
    let mut servo = Consumer::start(machine.place(), "servo", &program, &["1.8", "300"]);
    servo.wait_until_ready();
    machine.publish_in_time(150, Duration::from_millis(4));
    let (_, told, _) = servo.finish();
    // All arrived; then none, and it came to rest by itself.
    assert!(
        told.contains("150 received, 0 lost, 0 jumps, 1 own stop, stopped 1, at "),
        "{told}"
    );
    let place: f64 = told.rsplit(' ').next().unwrap().trim().parse().unwrap();
    // On at constant acceleration from the last setpoint that came in time, which on a busy host may
    // not be the last of all, for as long as it bears; then to rest by its own limits.
    let rests_from = |number: u64| {
        let last = from_rest(number);
        let last = JointState {
            position: last.joint_position[0],
            velocity: last.joint_velocity[0],
            acceleration: last.joint_acceleration[0],
        };
        Stop::new(last.coast(0.3), ServoSettings::default().stop[0])
            .at(1e3)
            .position
    };
    assert!(
        (100..150).any(|number| (place - rests_from(number)).abs() < 2e-6),
        "at {place}, expected {}",
        rests_from(149)
    );
    let (received, last) = machine.feedback();
    assert!(received > 100, "{received} received");
    assert_eq!(last.setpoint_number, 149);
    assert!((last.position[0] - place).abs() < 1e-6);
    assert_eq!((last.joints, last.homed, last.drive_state[2]), (7, 7, 5));
}

#[test]
fn the_python_package_commands_reads_status_and_fails_as_it_should() {
    let machine = Machine::start();
    let Some(python) = process::python() else {
        skip(IN_PYTHON, NO_PYTHON);
        return;
    };
    let _ticking = machine.keep_publishing();
    let script = build::source("python/tests/test_glidepath.py");
    let (_, told, _) = Consumer::start(machine.place(), "python", &python, &[&script]).finish();
    assert!(told.contains("tests passed"), "{told}");
}

#[test]
fn a_header_that_is_off_by_a_byte_does_not_compile() {
    let machine = Machine::start();
    let header = std::fs::read_to_string(build::source("include/glidepath.h")).unwrap();
    let source = "#include <glidepath.h>\nint main(void) { return GP_ABI == 0; }\n";
    for language in [Language::C, Language::Cpp] {
        let Some(result) = build::compiles(machine.place(), &header, source, language) else {
            leave_out(&format!("programs in {language:?}"), NO_COMPILER);
            continue;
        };
        assert_eq!(result, Ok(()), "as it is");
        for (from, to) in [
            (
                "    uint64_t boot_id;\n",
                "    uint64_t boot_id; char more;\n",
            ),
            (
                "    double joint_velocity[9];\n",
                "    double joint_velocity[8];\n",
            ),
            ("    uint32_t home;\n", "    uint16_t home;\n"),
        ] {
            assert!(header.contains(from), "{from}");
            let off = header.replacen(from, to, 1);
            let result = build::compiles(machine.place(), &off, source, language).unwrap();
            let message = result.expect_err(to);
            assert!(message.contains("is elsewhere") || message.contains("another size"));
        }
    }
}

#[test]
fn the_library_gives_out_its_functions_and_its_name() {
    let library = std::fs::read(library(Linked::Shared)).unwrap();
    let has = |text: &[u8]| library.windows(text.len()).any(|part| part == text);
    assert!(
        has(format!("{}\0", build::soname()).as_bytes()),
        "no soname"
    );
    let manual = std::fs::read_to_string(build::source("../glidepath/docs/consumers.md")).unwrap();
    assert!(manual.contains(&format!("/usr/local/lib/{}", build::soname())));
    let header = std::fs::read_to_string(build::source("include/glidepath.h")).unwrap();
    let declared = header.lines().filter_map(|line| {
        let (head, _) = line.split_once('(')?;
        let name = head.rsplit([' ', '*']).next()?;
        (name.starts_with("gp_") && !line.starts_with([' ', '/'])).then_some(name)
    });
    let mut count = 0;
    for name in declared.filter(|name| *name != "gp_open") {
        assert!(
            has(format!("\0{name}\0").as_bytes()),
            "{name} is declared, and not there"
        );
        count += 1;
    }
    assert_eq!(count, 38);
}
