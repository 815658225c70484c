//! Tests of resumption: a program goes on after its planner was killed.

use std::time::Duration;

use glidepath_geometry::AxisVector;
use glidepath_link::{EndOfEpoch, MachineState};
use glidepath_tests::{Instance, Operated, Process, Services, Watchdog, audit, plan};
use rustix::process::Signal;

use crate::programs::PROGRAM;

const PATIENCE: Duration = Duration::from_secs(240);

/// Several times over the same lines: full circles, corners, dense chords.
fn laps() -> String {
    let mut text =
        "G21 G90 G64 P0.02 F6000\nG1 X20 Y5\no1 repeat [3]\nG2 X20 Y5 I10 J0\n".to_owned();
    text.push_str("G1 X35 Y5\n");
    for k in 1..=40 {
        let angle = f64::from(k) * 0.04;
        let (x, y) = (35.0 + 8.0 * angle.sin(), 13.0 - 8.0 * angle.cos());
        text.push_str(&format!("G1 X{x:.4} Y{y:.4}\n"));
    }
    text.push_str("G1 X30 Y25\nX20 Y5\no1 endrepeat\nG0 X0 Y0\nM2\n");
    text
}

#[test]
fn a_killed_planner_is_replaced_in_the_middle_of_the_program() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let text = laps();
    let program = instance.file("laps.ngc", &text);
    let other = instance.file("other.ngc", PROGRAM);
    let services = Services::start(&instance);
    let resume = |file: &str| Process::join(&instance, &["planner", file, "--resume"]).wait();
    let refused = resume(&program).expect(1);
    assert!(
        refused.stderr.contains("no program was under way"),
        "{refused:#?}"
    );

    let mut planner = Process::join(&instance, &["planner", &program]);
    // In the first lap, and in the rest of it again. What was refused has used numbers of epochs up.
    let mut epoch = 0;
    for executed in [230, 330] {
        let moving =
            services.wait(|status| status.epoch > epoch && status.frames_executed > executed);
        epoch = moving.epoch;
        planner.signal(Signal::KILL);
        let _killed = planner.wait();
        let left = services.wait_for(MachineState::Faulted);
        assert_eq!(left.end_of_epoch(), Ok(EndOfEpoch::Faulted));
        // No fault is cleared in passing.
        for command in [
            &["planner", &program][..],
            &["planner", &program, "--resume"],
        ] {
            let refused = Process::join(&instance, command).wait().expect(5);
            assert!(refused.stderr.contains("glidepath reset"), "{refused:#?}");
        }
        let _reset = Process::join(&instance, &["reset"]).wait().expect(0);
        let refused = resume(&other).expect(1);
        assert!(refused.stderr.contains("not the program"), "{refused:#?}");
        planner = Process::join(&instance, &["planner", &program, "--resume"]);
    }
    let _output = planner.wait().expect(0);
    let status = services.wait_for(MachineState::Idle);
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert!(status.epoch > epoch, "{status:#?}");
    assert_eq!(status.position.map(f64::abs).map(f64::to_bits), [0; 9]);
    let refused = resume(&program).expect(1);
    assert!(refused.stderr.contains("came to its end"), "{refused:#?}");

    let (received, report) = services.end();
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
    let (_, items) = plan(&text, AxisVector::zeros());
    let report = audit(&items, received.positions().into_iter());
    assert!(report.violations.is_empty(), "{:#?}", report.violations);
    assert!(
        report.max_deviation_mm <= 0.02,
        "{}",
        report.max_deviation_mm
    );
}

#[test]
fn a_stream_that_is_rejected_takes_nothing_from_the_program_that_was_left() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let simulated = ("source = \"drives\"", "source = \"none\"");
    let bench = Operated::new(&instance, &[simulated], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    let part = instance.file("part.ngc", "G21 G90 G54\nG1 X30 F600\nM2\n");
    let running = bench.process(&["run-file", &part]);
    let _moves = bench.wait(|status| status.frames_executed > 100);
    bench.operate(&["abort"]);
    let _ended = running.wait().expect(5);
    let bad = instance.file("bad.ngc", "G21 G90 G54\nG1 X5 F600 F700\n");
    bench.refused(&["feed", &bad], 1, "duplicate-word");
    bench.operate(&["run-file", &part, "--resume"]);
    let rests = bench.wait_for(MachineState::Idle);
    assert!(
        (rests.position[0] - 30.0).abs() < 1e-9,
        "{:?}",
        rests.position
    );
    let _ended = (service.end(), interpolator.end());
}

/// A square in Z0 from which the machine stands far away.
const SQUARE: &str = "G21 G90 G54\nG0 X0 Y0 Z0\nG1 X60 F900\nY60\nX0\nY0\nX60\nM2\n";

#[test]
fn what_was_left_on_the_way_to_its_line_is_begun_there_again() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let simulated = ("source = \"drives\"", "source = \"none\"");
    // The way to a line goes over the top of Z, and down from there at the feed.
    let low = (
        "[axis.Z]\nmin_position = -500.0\nmax_position = 500.0",
        "[axis.Z]\nmin_position = -500.0\nmax_position = 40.0",
    );
    let bench = Operated::new(&instance, &[simulated, low], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    bench.operate(&["mdi", "G0 X30 Y30 Z20"]);
    let part = instance.file("part.ngc", SQUARE);
    // The way to line 3 has more parts than there are blocks in front of it.
    for line in ["3", "7"] {
        let begun = ["run-file", &part, "--from-line", line, "--yes"];
        let before = bench.wait(|_| true).epoch;
        let running = bench.process(&begun);
        let _moves = bench.wait(|status| status.epoch > before && status.frames_executed > 2);
        bench.operate(&["abort"]);
        let told = running.wait().expect(5).stderr;
        let way = format!("left on the way to line {line}");
        assert!(told.contains(&way), "{told}");
        let place = bench.position();
        let again = format!("--from-line {line}");
        bench.refused(&["run-file", &part, "--resume"], 1, &again);
        let moved = bench.position().map(f64::to_bits) != place.map(f64::to_bits);
        assert!(!moved, "refused, and moved all the same");
    }

    // In its line it is resumed as ever.
    let running = bench.process(&["run-file", &part, "--from-line", "7", "--yes"]);
    let _cuts = bench.wait(|status| {
        status.state == MachineState::Running.code()
            && status.line == 7
            && status.position[0] > 20.0
            && status.position[1].abs() < 1e-9
            && status.position[2].abs() < 1e-9
    });
    bench.operate(&["abort"]);
    let told = running.wait().expect(5).stderr;
    assert!(told.contains("--resume"), "{told}");
    bench.operate(&["run-file", &part, "--resume"]);
    assert!((bench.position()[0] - 60.0).abs() < 1e-9);
    let _ended = (service.end(), interpolator.end());
}

#[test]
fn behind_the_loss_of_its_interpolator_no_older_run_is_gone_on_with() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[], "");
    let mut interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    let part = instance.file("part.ngc", "G21 G90\nG0 X0 Y0 Z0\nG1 X100 F1800\nM2\n");

    // Left at 20 mm, then a line, then again from the beginning.
    let running = bench.process(&["run-file", &part]);
    let _far = bench.wait(|status| status.position[0] > 20.0);
    bench.operate(&["abort"]);
    let _aborted = running.wait();
    bench.operate(&["mdi", "G90 G0 X0 Y0 Z0"]);
    let running = bench.process(&["run-file", &part]);
    let _near = bench.wait(|status| status.position[0] > 3.0);
    interpolator.signal(Signal::KILL);
    let _killed = interpolator.wait();
    let _lost = running.wait();

    interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _seen = bench.wait_for_drives();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    bench.refused(
        &["run-file", &part, "--resume"],
        1,
        "no program was under way",
    );
    for process in [&service, &servo, &interpolator] {
        process.signal(Signal::TERM);
    }
}
