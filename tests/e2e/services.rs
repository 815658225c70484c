//! Tests of interpolator, planner, servo and clients, each started by itself.

use std::time::Duration;

use glidepath_link::{EndOfEpoch, MachineState};
use glidepath_tests::{Instance, Process, Services, Watchdog, planned};
use rustix::process::Signal;

use crate::programs::{PROGRAM, long_program};

const PATIENCE: Duration = Duration::from_secs(240);

#[test]
fn file_pipe_and_feed_give_the_same_setpoints() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let planned = planned(&instance, &program);
    let ways: [(&str, Way); 3] = [
        ("file", play_file),
        ("pipe", play_pipe),
        ("feed", play_feed),
    ];
    for (name, way) in ways {
        let services = Services::start(&instance);
        way(&instance, &program);
        let (received, report) = services.end();
        assert_eq!(report["lost_setpoints"], 0, "{name}: {report:#}");
        assert_eq!(received.moving(), planned.moving(), "{name}");
    }
}

/// A way to have a program executed.
type Way = fn(&Instance, &str);

fn play_file(instance: &Instance, program: &str) {
    let _output = Process::join(instance, &["planner", program])
        .wait()
        .expect(0);
}

fn play_pipe(instance: &Instance, program: &str) {
    let mut planner = Process::join(instance, &["planner", "-"]);
    planner.feed(&std::fs::read_to_string(program).unwrap());
    let _output = planner.wait().expect(0);
}

fn play_feed(instance: &Instance, program: &str) {
    let planner = Process::service(instance);
    let _output = Process::join(instance, &["feed", program]).wait().expect(0);
    let _listener = planner.end().expect(0);
}

#[test]
fn a_malformed_program_is_rejected_without_motion() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("broken.ngc", "G1 X10 F3000\nG1 X1O Y5\nG1 X20\nG777\n");
    let services = Services::start(&instance);
    let output = Process::join(&instance, &["planner", &program])
        .wait()
        .expect(1);
    for place in ["broken.ngc:2:6", "broken.ngc:4:1"] {
        assert!(output.stderr.contains(place), "{place}: {output:#?}");
    }
    let (received, _) = services.end();
    assert!(received.is_still(), "something moved");
}

#[test]
fn an_error_in_a_pipe_stops_the_motion_before_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let good = "G21 G90 F6000\nG1 X10 Y5\nG1 X20\n";
    let planned = planned(&instance, &instance.file("good.ngc", good));
    let services = Services::start(&instance);
    let mut planner = Process::join(&instance, &["planner", "-"]);
    planner.feed(&format!("{good}G1 X\nG1 X0 Y0\n"));
    let output = planner.wait().expect(1);
    assert!(output.stderr.contains(":4:4"), "{output:#?}");
    assert_eq!(services.end().0.moving(), planned.moving());
}

#[test]
fn a_killed_planner_leaves_the_machine_at_rest_and_a_new_one_goes_on() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 150);
    planner.signal(Signal::KILL);
    let _killed = planner.wait();
    let status = services.wait_for(MachineState::Faulted);
    assert!(
        status.position[0] > 0.0 && status.position[0] < 50.0,
        "{status:#?}"
    );
    // On the line from X0 Y0 to X50 Y10.
    let off = status.position[1] - status.position[0] / 5.0;
    assert!(off.abs() < 0.02, "{off} mm off the path");
    let shown = Process::join(&instance, &["status", "--json"])
        .wait()
        .expect(0)
        .json();
    assert!(
        shown.to_string().contains("planner"),
        "the cause is not told: {shown:#}"
    );
    let home = instance.file("home.ngc", "G21 G90 F6000\nG1 X0 Y0\n");
    // Nothing but a reset clears a fault.
    let _refused = Process::join(&instance, &["planner", &home])
        .wait()
        .expect(5);
    let _reset = Process::join(&instance, &["reset"]).wait().expect(0);
    let _output = Process::join(&instance, &["planner", &home])
        .wait()
        .expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.position.map(f64::abs).map(f64::to_bits), [0; 9]);
    let (_, report) = services.end();
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
}

#[test]
fn a_second_client_is_refused_and_a_killed_one_is_forgotten() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let home = instance.file("home.ngc", "G21 G90 F6000\nG1 X0 Y0\n");
    let services = Services::start(&instance);
    let planner = Process::service(&instance);
    let first = Process::join(&instance, &["feed", &program]);
    let _moving = services.wait(|status| status.frames_executed > 150);
    let second = Process::join(&instance, &["feed", &home]).wait();
    assert_ne!(second.status.code(), Some(0), "{second:#?}");
    first.signal(Signal::KILL);
    let _killed = first.wait();
    let _abort = Process::join(&instance, &["abort"]).wait().expect(0);
    let _idle = services.wait_for(MachineState::Idle);
    let _third = Process::join(&instance, &["feed", &home]).wait().expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.position.map(f64::abs).map(f64::to_bits), [0; 9]);
    let _listener = planner.end().expect(0);
    let _received = services.end();
}

#[test]
fn a_second_planner_is_refused_and_does_not_disturb_the_first() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let planned = planned(&instance, &program);
    let services = Services::start(&instance);
    let first = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 50);
    let second = Process::join(&instance, &["planner", &program]).wait();
    assert!(!second.status.success(), "{second:#?}");
    assert!(second.stderr.contains("another planner"), "{second:#?}");
    let _first = first.wait().expect(0);
    assert_eq!(services.end().0.moving(), planned.moving());
}

#[test]
fn the_operator_holds_resumes_and_slows() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let services = Services::start(&instance);
    let operate = |command: &[&str]| Process::join(&instance, command).wait().expect(0);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 50);
    let _held = operate(&["hold"]);
    let held = services.wait_for(MachineState::Held);
    let shown = operate(&["status", "--json"]).json();
    assert_eq!(shown["state"], "held", "{shown:#}");
    let _slower = operate(&["override", "50"]);
    let _resumed = operate(&["resume"]);
    let on = services.wait(|status| status.frames_executed > held.frames_executed + 20);
    assert_eq!(on.feed_override.to_bits(), 0.5_f64.to_bits());
    let _planner = planner.wait().expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert_eq!(status.position.map(f64::abs).map(f64::to_bits), [0; 9]);
    let (_, report) = services.end();
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
}

#[test]
fn a_program_that_is_aborted_ends_with_a_fault() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 150);
    let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
    let output = planner.wait().expect(5);
    assert!(output.stderr.contains("aborted"), "{output:#?}");
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Aborted));
    let _received = services.end();
}

#[test]
fn a_planner_whose_interpolator_is_killed_says_so_and_a_new_pair_works() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", &long_program());
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 150);
    services.kill_interpolator();
    let output = planner.wait().expect(5);
    assert!(
        output.stderr.contains("interpolator is gone"),
        "{output:#?}"
    );
    let program = instance.file("program.ngc", PROGRAM);
    let services = Services::start(&instance);
    let _planner = Process::join(&instance, &["planner", &program])
        .wait()
        .expect(0);
    assert_eq!(
        services.end().0.moving(),
        planned(&instance, &program).moving()
    );
}
