//! What waits for an answer and did not get it is not done, however the program is left, and whoever goes on
//! with it.

use std::time::Duration;

use glidepath_link::{MachineState, Status};
use glidepath_program::Event;
use glidepath_tests::{Instance, Operated, Process, Watchdog};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(300);

const PART: &str = "G21 G90 G54\nG0 X1\nT2 M6\nM3 S5000\nG1 X30 F600\nM2\n";

/// A machine with drives, and its service.
struct Bench<'a> {
    operated: Operated<'a>,
    /// The service is the last one.
    processes: Vec<Process>,
    part: String,
}

impl<'a> Bench<'a> {
    fn start(instance: &'a Instance, program: &str) -> Self {
        let tools = instance.file("tools.tbl", "T1 P1 Z5 D6\nT2 P2 Z10 D6\n");
        let table = format!("tool_table = \"{tools}\"");
        let operated = Operated::new(instance, &[("# tool_table = \"tools.tbl\"", &table)], "");
        let interpolator = operated.process(&["interpolator", "--best-effort"]);
        let servo = operated.process(&["servo", "--best-effort"]);
        let _drives = operated.wait_for_drives();
        operated.operate(&["enable"]);
        let _idle = operated.wait_for(MachineState::Idle);
        let part = instance.file("part.ngc", program);
        let mut bench = Self {
            operated,
            processes: vec![interpolator, servo],
            part,
        };
        bench.serve();
        bench
    }

    fn serve(&mut self) {
        let service = self.operated.service();
        self.processes.push(service);
    }

    /// Runs the part, from the beginning or from where it was left, until it asks for its tool.
    fn asks(&self, arguments: &[&str]) -> (Process, Status) {
        let before = self.operated.wait(|_| true).epoch;
        let client = self.operated.process(arguments);
        let asks = self
            .operated
            .wait(|status| status.epoch > before && status.state == MachineState::Awaiting.code());
        assert_eq!(asks.awaited_event(), Ok(Some(Event::MCode(6))));
        assert!((asks.position[0] - 1.0).abs() < 1e-9, "{:?}", asks.position);
        (client, asks)
    }

    /// What the service takes for the tool in the spindle, in the words of a program.
    fn believed(&self) -> f64 {
        self.operated.operate(&["mdi", "G21 G90 G53 G0 Y[#5400]"]);
        let [_, tool, _] = self.operated.position();
        self.operated.operate(&["mdi", "G53 G0 Y0"]);
        tool
    }
}

#[test]
fn a_tool_change_that_nobody_answered_is_waited_for_again_however_it_was_left() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let mut bench = Bench::start(&instance, PART);
    let part = bench.part.clone();
    let mut command = vec!["run-file", part.as_str()];
    for end in ["abort", "fail", "hold", "client", "planner"] {
        let (client, _) = bench.asks(&command);
        match end {
            "abort" => drop(bench.operated.operate(&["abort"])),
            "fail" => drop(
                bench
                    .operated
                    .operate(&["acknowledge", "--fail", "no tool 2"]),
            ),
            "hold" => {
                bench.operated.operate(&["hold"]);
                bench.operated.operate(&["abort"]);
            }
            "client" => client.signal(Signal::INT),
            _ => bench.processes.pop().unwrap().signal(Signal::KILL),
        }
        let _ended = client.wait();
        if matches!(end, "fail" | "planner") {
            let _fault = bench.operated.wait_for(MachineState::Faulted);
            bench.operated.operate(&["reset"]);
        }
        let left = bench.operated.wait_for(MachineState::Idle);
        assert_eq!(left.unanswered, 1, "{end}");
        if end == "planner" {
            bench.serve();
        }
        assert!(bench.believed().abs() < 1e-9, "{end}: T2 is not in");
        command = vec!["run-file", part.as_str(), "--resume"];
    }
    // By itself, too.
    bench.operated.operate(&["abort"]);
    let (client, _) = bench.asks(&command);
    bench.operated.operate(&["acknowledge"]);
    let _done = client.wait().expect(0);
    assert!((bench.operated.position()[0] - 30.0).abs() < 1e-9);
    assert!((bench.believed() - 2.0).abs() < 1e-9, "now it is");
}

#[test]
fn a_tool_that_was_not_put_in_is_asked_for_where_a_program_begins_behind_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance, PART);
    let (client, _) = bench.asks(&["run-file", &bench.part]);
    bench.operated.operate(&["abort"]);
    let _ended = client.wait().expect(5);
    // The length of the tool that is in is that of none.
    bench.operated.operate(&["mdi", "G43"]);
    bench.operated.operate(&["mdi", "G0 Z0"]);
    assert!(bench.operated.position()[2].abs() < 1e-9);
    let behind = ["run-file", &bench.part, "--from-line", "5"];
    bench.operated.refused(&behind, 1, "T0 -> T2");
    let (client, asks) = bench.asks(&[&behind[..], &["--yes"]].concat());
    assert_eq!(asks.line, 5);
    bench.operated.operate(&["abort"]);
    let _ended = client.wait();
}

#[test]
fn a_program_stop_that_nobody_let_pass_stops_again() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = "G21 G90\nG1 X1 F600\nM0\nG1 X30\nM2\n";
    let bench = Bench::start(&instance, program);
    let running = bench.operated.process(&["run-file", &bench.part]);
    let first = bench.operated.wait_for(MachineState::ProgramStop);
    bench.operated.operate(&["abort"]);
    let _ended = running.wait().expect(5);
    let resumed = bench
        .operated
        .process(&["run-file", &bench.part, "--resume"]);
    let stop = MachineState::ProgramStop.code();
    let again = bench
        .operated
        .wait(|status| status.epoch > first.epoch && status.state == stop);
    assert_eq!(again.line, 3);
    assert!((again.position[0] - 1.0).abs() < 1e-9);
    bench.operated.operate(&["resume"]);
    let _done = resumed.wait().expect(0);
    assert!((bench.operated.position()[0] - 30.0).abs() < 1e-9);
}

/// Where the machine stands in the way of the hand that changes the tool.
#[test]
fn the_axes_are_jogged_while_a_tool_is_asked_for() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance, PART);
    let (client, _) = bench.asks(&["run-file", &bench.part]);
    bench.operated.operate(&["jog", "Z5"]);
    let away = bench
        .operated
        .wait(|status| (status.away[2] - 5.0).abs() < 1e-9);
    assert_eq!(away.state(), Ok(MachineState::Held));
    bench.operated.operate(&["acknowledge"]);
    bench.operated.operate(&["return"]);
    let _back = bench
        .operated
        .wait(|status| status.away.map(f64::abs).iter().sum::<f64>() <= 0.0);
    bench.operated.operate(&["resume"]);
    let _done = client.wait().expect(0);
    assert!((bench.operated.position()[0] - 30.0).abs() < 1e-9);
}
