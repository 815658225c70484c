//! Tests of what is told of a program that was left: `--resume` does what was said of it.

use std::time::Duration;

use glidepath_link::{JobStage, MachineState};
use glidepath_tests::{Instance, Operated, Watchdog};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(240);

#[test]
fn a_program_that_was_left_is_said_to_be_resumed_where_it_is() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let lift = ("\nlift = 0.0 ", "\nlift = 3.5 ");
    let encoder = ("encoder = false", "encoder = true ");
    let bench = Operated::new(&instance, &[lift, encoder], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);

    // A fault in a pass: eight seconds of it, of which the drives hear none.
    let thread = instance.file(
        "pass.ngc",
        "G21 G90 G97 S60 M3\nG0 X1 Z2\nG33 Z-6 K1\nG0 X9\nM2\n",
    );
    let running = bench.process(&["run-file", &thread]);
    // A busy host may end the pass in a fault before.
    let faulted = MachineState::Faulted.code();
    let _in_pass = bench.wait(|status| status.position[2] < 0.0 || status.state == faulted);
    servo.signal(Signal::STOP);
    let _stopped = bench.wait_for(MachineState::Faulted);
    servo.signal(Signal::CONT);
    let told = running.wait().expect(5).stderr;
    let why = "left in the thread of line 3";
    assert!(
        told.contains(why) && !told.contains("goes on from there"),
        "{told}"
    );
    let _heard = bench.wait(|status| status.feedback_age_ns < 12_000_000);
    bench.operate(&["reset"]);
    let rests = bench.wait(|status| status.state != MachineState::Faulted.code());
    if rests.state == MachineState::Off.code() {
        bench.operate(&["enable"]);
    }
    let _ready = bench.wait_for(MachineState::Idle);
    bench.refused(&["run-file", &thread, "--resume"], 1, why);

    // An abort that lifts the tool.
    bench.operate(&["jog", "Z5"]);
    let cut = instance.file("cut.ngc", "G21 G90 M5\nG0 X0 Z-6\nG1 X20 F1200\nM2\n");
    let running = bench.process(&["run-file", &cut]);
    let _cuts = bench.wait(|status| status.position[0] > 5.0 && status.position[2] < -5.9);
    let told = bench.operate(&["abort"]).stderr;
    assert!(told.contains("refused until it is back"), "{told}");
    let told = running.wait().expect(5).stderr;
    assert!(
        told.contains("raised the tool axis (lift of [jog]), bring it back first"),
        "{told}"
    );
    bench.refused(&["run-file", &cut, "--resume"], 1, "`glidepath jog Z-3.5");
    bench.operate(&["jog", "Z-3.5"]);
    bench.operate(&["run-file", &cut, "--resume"]);
    bench.assert_at([20.0, 0.0, -6.0]);
    for process in [&service, &servo, &interpolator] {
        process.signal(Signal::TERM);
    }
}

#[test]
fn a_program_whose_planner_was_killed_is_said_to_be_resumed_where_it_may_be() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let simulated = ("source = \"drives\"", "source = \"none\"");
    let bench = Operated::new(&instance, &[simulated], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);

    // On the way to a line.
    let service = bench.service();
    bench.operate(&["mdi", "G0 X30 Y30 Z20"]);
    let part = instance.file(
        "part.ngc",
        "G21 G90 G54\nG0 X0 Y0 Z0\nG1 X60 F900\nY60\nX0\nY0\nX60\nM2\n",
    );
    let before = bench.wait(|_| true).epoch;
    let running = bench.process(&["run-file", &part, "--from-line", "7", "--yes"]);
    let _moves = bench.wait(|status| status.epoch > before && status.frames_executed > 2);
    service.signal(Signal::KILL);
    let _killed = service.wait();
    let told = running.wait().expect(5).stderr;
    assert!(told.contains("or says why that cannot be"), "{told}");
    let _faulted = bench.wait_for(MachineState::Faulted);
    let status = bench.operate(&["status", "--json"]).json();
    let remedy = status["fault_remedy"].as_str().unwrap();
    assert!(remedy.contains("or says why that cannot be"), "{remedy}");
    bench.operate(&["reset"]);
    let service = bench.service();
    bench.refused(&["run-file", &part, "--resume"], 1, "--from-line 7");

    // While it is checked: nothing of it was executed, and nothing of it can be resumed.
    let long = "G21 G90\no1 repeat [300000]\nG1 X30 F900\nX31\no1 endrepeat\nM2\n";
    let long = instance.file("long.ngc", long);
    let running = bench.process(&["run-file", &long]);
    let _checks = bench.wait(|status| {
        status.job_stage == JobStage::Preparing.code() && status.job.as_str().starts_with("long")
    });
    service.signal(Signal::KILL);
    let _killed = service.wait();
    let told = running.wait().expect(5).stderr;
    assert!(
        told.contains("nothing of the program was executed"),
        "{told}"
    );
    assert!(!told.contains("--resume"), "{told}");

    // With the interpolator.
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    let before = bench.wait(|_| true).epoch;
    let running = bench.process(&["run-file", &part]);
    let _moves = bench.wait(|status| status.epoch > before && status.frames_executed > 200);
    interpolator.signal(Signal::KILL);
    service.signal(Signal::KILL);
    let _killed = (interpolator.wait(), service.wait());
    let told = running.wait().expect(5).stderr;
    assert!(told.contains("no interpolator runs either"), "{told}");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    let why = "no program was under way";
    bench.refused(&["run-file", &part, "--resume"], 1, why);
    let _ended = (service.end(), interpolator.end());
}
