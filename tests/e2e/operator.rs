//! Tests of what an operator does, by the commands of the command line.

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{EndOfEpoch, MachineState};
use glidepath_tests::{Instance, Process, Services, Watchdog, audit, plan, planned};

use crate::programs::PROGRAM;

const PATIENCE: Duration = Duration::from_secs(240);

#[test]
fn a_machine_is_watched_until_somebody_has_seen_enough() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 60);
    // Until somebody watches.
    operate(&instance, &["hold"]);
    let arguments = ["status", "--watch", &program, "--json", "--every", "0.05"];
    let watch = Process::join(&instance, &arguments);
    // Which is known when the program has been planned.
    watch.wait_until_it_says("\"progress\":0.");
    operate(&instance, &["resume"]);
    let _planner = planner.wait().expect(0);
    let _rests = services.wait_for(MachineState::Idle);
    watch.signal(rustix::process::Signal::INT);
    let output = watch.wait().expect(0);
    let looks: Vec<serde_json::Value> = output
        .stdout
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let running = looks.iter().filter(|look| look["state"] == "running");
    let running: Vec<_> = running.collect();
    assert!(running.len() > 5, "{} of {}", running.len(), looks.len());
    // The text of the block, and a progress that goes on to its end.
    let lines: Vec<&str> = PROGRAM.lines().collect();
    let told = running.iter().rev().find(|look| look["progress"].is_f64());
    let told = told.unwrap();
    let line = usize::try_from(told["line"].as_u64().unwrap()).unwrap();
    assert_eq!(told["block_text"], lines[line - 1]);
    let left = told["left_s"].as_f64().unwrap();
    assert!(left < told["planned_s"].as_f64().unwrap(), "{told}");
    drop(services.end());
}

fn operate(instance: &Instance, command: &[&str]) {
    let _output = Process::join(instance, command).wait().expect(0);
}

#[test]
fn single_block_goes_from_block_to_block() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let services = Services::start(&instance);
    let refused = Process::join(&instance, &["step"]).wait().expect(5);
    assert!(refused.stderr.contains("nothing is held"), "{refused:#?}");
    operate(&instance, &["single-block", "on"]);
    let planner = Process::join(&instance, &["planner", &program]);
    let mut lines = Vec::new();
    let mut block = 0;
    // The moves of lines 2 to 5, the dwell, the spindle.
    for goes_on in [
        "step", "resume", "step", "resume", "step", "resume", "resume",
    ] {
        let stood = services.wait(|status| {
            status.state == MachineState::ProgramStop.code() && status.block > block
        });
        block = stood.block;
        lines.push(stood.line);
        operate(&instance, &[goes_on]);
    }
    assert_eq!(lines, [2, 3, 4, 5, 6, 7, 8]);
    let _stood = services
        .wait(|status| status.state == MachineState::ProgramStop.code() && status.block > block);
    operate(&instance, &["single-block", "off"]);
    operate(&instance, &["resume"]);
    let _planner = planner.wait().expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert_path(&services.end().0.positions(), PROGRAM);
}

#[test]
fn a_stop_at_the_end_of_the_block_is_on_the_path() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", PROGRAM);
    let planned = planned(&instance, &program).positions();
    let services = Services::start(&instance);
    let planner = Process::join(&instance, &["planner", &program]);
    let _moving = services.wait(|status| status.frames_executed > 60);
    operate(&instance, &["stop-at-block-end"]);
    let stood = services.wait_for(MachineState::ProgramStop);
    // Bit for bit a setpoint of the plan.
    let place = AxisVector::from(stood.position);
    assert!(planned.contains(&place), "{place}");
    operate(&instance, &["resume"]);
    let _planner = planner.wait().expect(0);
    assert_path(&services.end().0.positions(), PROGRAM);
}

#[test]
fn rapids_have_an_override_of_their_own() {
    // There and back: the way there is a rapid.
    let text = "G21 G90 G64 P0.02 F6000\nG0 X60\nG1 X0\nM2\n";
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("program.ngc", text);
    let services = Services::start(&instance);
    operate(&instance, &["override", "--rapid", "25"]);
    let usage = Process::join(&instance, &["override", "--rapid", "101"]).wait();
    assert_eq!(usage.status.code(), Some(2), "{usage:#?}");
    let planner = Process::join(&instance, &["planner", &program]);
    let _planner = planner.wait().expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.rapid_override.to_bits(), 0.25_f64.to_bits());
    assert_eq!(status.feed_override.to_bits(), 1.0_f64.to_bits());
    let positions = services.end().0.positions();
    let fastest = |back: bool| {
        let speed = |pair: &[AxisVector]| (pair[1][0] - pair[0][0]) / 0.004;
        let speeds = positions.windows(2).map(speed);
        let of_way = speeds.map(|v| if back { -v } else { v });
        of_way.fold(0.0, f64::max)
    };
    // A quarter of the axis' 200 mm/s, and the feed of 100 mm/s as programmed.
    assert!((fastest(false) - 50.0).abs() < 0.01, "{}", fastest(false));
    assert!((fastest(true) - 100.0).abs() < 0.01, "{}", fastest(true));
    assert_path(&positions, text);
}

fn assert_path(positions: &[AxisVector], text: &str) {
    let (_, items) = plan(text, AxisVector::zeros());
    let report = audit(&items, positions.iter().copied());
    assert!(report.violations.is_empty(), "{:#?}", report.violations);
    assert!(
        report.max_deviation_mm <= 0.02,
        "{}",
        report.max_deviation_mm
    );
}
