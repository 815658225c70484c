//! Tests of one service for lines and files: modal state between them, M codes that wait, a line to
//! begin with, and aborts.

use std::time::Duration;

use glidepath_link::{FaultCause, MachineState, Transport};
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);

const M_CODES: &str = "\n[m_codes.M3]\ndone = \"spindle-at-speed\"\ntimeout_s = 20\n\
                       [m_codes.M6]\ntimeout_s = 60\n[m_codes.M100-M199]\n[m_codes.M150]\ntimeout_s = 0.5\n";

/// A start at a line takes the tool axis up to the end of its travel.
pub(crate) const SHORT_WAY_UP: (&str, &str) = (
    "[axis.Z]\nmin_position = -500.0\nmax_position = 500.0",
    "[axis.Z]\nmin_position = -500.0\nmax_position = 12.0",
);

const PART: &str = "G21 G90 G54\nT2 M6 (change to tool 2)\nS600 M3\nM8\n(MSG, cutting)\n\
                    G1 X5 F3000\nM101\nX8 Y3\nX2\nM5 M9\nM2\n";

#[test]
#[allow(
    clippy::too_many_lines,
    reason = "one life of a machine, from step to step"
)]
fn lines_and_files_are_executed_by_one_service() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let lift = ("\nlift = 0.0 ", "\nlift = 3.5 ");
    let bench = Operated::new(&instance, &[lift, SHORT_WAY_UP], M_CODES);
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "12.5,3,4"]);
    let _seen = bench.wait(|status| status.feedback_age_ns < 12_000_000);
    bench.refused(&["mdi", "G0 X1"], 5, "no planner serves");
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    bench.assert_at([12.5, 3.0, 4.0]);

    // Modes last from line to line, and a line that is refused changes nothing.
    bench.operate(&["mdi", "G91 G0 X2"]);
    bench.operate(&["mdi", "X2 Y1"]);
    bench.refused(&["mdi", "G90 X1O"], 1, "line 1");
    bench.refused(&["mdi", "G90 X1e9"], 1, "line 1");
    bench.operate(&["mdi", "X0.5"]);
    bench.assert_at([17.0, 4.0, 4.0]);
    bench.operate(&["mdi", "G10 L20 P1 X7 Y4 Z4"]);
    bench.operate(&["mdi", "G90 X0"]);
    bench.assert_at([10.0, 4.0, 4.0]);

    // A program waits for its tool, its spindle and the code of the machine's own.
    let part = instance.file("part.ngc", PART);
    let running = bench.process(&["run-file", &part]);
    let status = bench.wait_for(MachineState::Awaiting);
    assert_eq!((status.awaited_value, status.awaited_line), (6.0, 2));
    bench.refused(&["mdi", "G0 X1"], 5, "the planner executes part.ngc; wait");
    bench.refused(&["planner", &part], 5, "planner");
    bench.refused(&["acknowledge", "--event", "9999/1"], 5, "another event");
    bench.operate(&["acknowledge"]);
    let status = bench.wait(|status| (status.awaited_value - 101.0).abs() < 1e-9);
    assert!((status.position[0] - 15.0).abs() < 1e-9);
    // What the program says is there for whoever comes late, until another program begins.
    assert_eq!(status.message.as_str(), "cutting");
    let shown = bench.operate(&["status"]).stdout;
    assert!(shown.contains("  says          cutting"), "{shown}");
    let auxiliary = instance.connect();
    let mut auxiliary = auxiliary.auxiliary_source().unwrap();
    let record = loop {
        if let Some(record) = auxiliary.take().unwrap() {
            break record;
        }
        std::thread::sleep(Duration::from_millis(5));
    };
    assert_eq!((record.tool, record.spindle_speed), (2, 600.0));
    assert_eq!((record.spindle, record.coolant), (1, 2));
    bench.operate(&["hold"]);
    bench.operate(&["acknowledge"]);
    let _held = bench.wait_for(MachineState::Held);
    bench.operate(&["resume"]);
    let _done = running.wait().expect(0);
    bench.assert_at([12.0, 3.0, 4.0]);

    assert_eq!(bench.wait(|_| true).message.as_str(), "cutting");
    // From a line on: what differs is shown, and nothing moves before that is agreed to.
    let line = ["run-file", &part, "--from-line", "9"];
    let output = bench.process(&line).wait().expect(1);
    for words in [
        "spindle: M5 -> M3 S600",
        "coolant: M9 -> M8",
        "X12.0000",
        "X18.0000",
    ] {
        assert!(output.stderr.contains(words), "{words}: {output:#?}");
    }
    bench.assert_at([12.0, 3.0, 4.0]);
    bench.operate(&[&line[..], &["--yes"]].concat());
    bench.assert_at([12.0, 3.0, 4.0]);
    assert_eq!(bench.wait(|_| true).message.as_str(), "");
    let none = ["run-file", &part, "--from-line", "5", "--yes"];
    bench.refused(&none, 1, "line 6 is the next");

    // After an abort, what is in force is that of the block executed.
    let long = instance.file("long.ngc", "G21 G90 G54\nG1 X150 F2000\nG91 G55 X1\nM2\n");
    let running = bench.process(&["run-file", &long]);
    let _moving = bench.wait(|status| status.frames_executed > 60 && status.line == 2);
    bench.operate(&["abort"]);
    assert!((bench.position()[2] - 7.5).abs() < 1e-9);
    let output = running.wait().expect(5);
    assert!(output.stderr.contains("abort"), "{output:#?}");
    bench.operate(&["mdi", "X3"]);
    bench.assert_at([13.0, 3.0, 7.5]);

    // What is not answered in time, or failed, is a fault at rest.
    for (line, cause) in [
        ("M150", FaultCause::AuxTimeout),
        ("M151", FaultCause::AuxFailed),
    ] {
        let running = bench.process(&["mdi", line]);
        let _awaited = bench.wait(|status| status.state == MachineState::Awaiting.code());
        if line == "M151" {
            bench.operate(&["acknowledge", "--fail", "the vice does not close"]);
        }
        let status = bench.wait_for(MachineState::Faulted);
        assert_eq!(status.fault(), Ok(Some(cause)));
        let failed = running.wait().expect(5);
        if line == "M151" {
            let said = "has failed, line 1: the vice does not close";
            assert!(status.fault_text().unwrap().contains(said), "{status:#?}");
            assert!(failed.stderr.contains(said), "{failed:#?}");
        }
        bench.operate(&["reset"]);
    }

    // Either end can be started anew.
    let _ended = service.end().expect(0);
    let service = bench.service();
    let _idle = bench.wait_for(MachineState::Idle);
    std::thread::sleep(Duration::from_millis(300));
    bench.operate(&["mdi", "G0 X2"]);
    bench.assert_at([2.0, 3.0, 7.5]);
    let _ended = service.end().expect(0);
    let _servo = servo.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
}
