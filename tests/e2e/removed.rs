//! Somebody removes the directory by which the processes of an instance find each other: nobody could stop the machine
//! any more, so it comes to rest by itself, and says why.

use std::time::Duration;

use glidepath_link::{FaultCause, MachineState, Transport as _};
use glidepath_tests::{Instance, Process, Tape, Watchdog};

const PATIENCE: Duration = Duration::from_secs(400);
const TOLD: &str = "it was removed while processes of this instance ran";

/// What the machine is at.
const STATES: [MachineState; 6] = [
    MachineState::Idle,
    MachineState::Preparing,
    MachineState::Running,
    MachineState::Held,
    MachineState::ProgramStop,
    MachineState::Jogging,
];

/// Seconds before there is a motion.
const SLOW: &str = "G21 G90\n#1=0\no1 while [#1 lt 900000]\n#2=[sin[#1]*cos[#1]]\n#1=[#1+1]\no1 endwhile\nG1 X5 F600\nM2\n";
const LONG: &str = "G21 G90\nG1 X200 F1200\nM2\n";
const STOPS: &str = "G21 G90\nG1 X4 F1200\nM0\nG1 X0\nM2\n";

/// A machine without drives, and its service.
fn start(instance: &Instance) -> [Process; 2] {
    let interpolator = Process::join(instance, &["interpolator", "--best-effort"]);
    let service = Process::service(instance);
    let _idle = instance.wait_for_status(|status| status.state == MachineState::Idle.code());
    let _done = Process::join(instance, &["mdi", "G0 X0"]).wait().expect(0);
    [interpolator, service]
}

/// Brings the machine there; whoever waits for it then.
fn bring(instance: &Instance, state: MachineState) -> Option<Process> {
    let runs = |text: &str| {
        let part = instance.file("part.ngc", text);
        Some(Process::join(instance, &["run-file", &part]))
    };
    let client = match state {
        MachineState::Preparing => runs(SLOW),
        MachineState::ProgramStop => runs(STOPS),
        MachineState::Running | MachineState::Held => runs(LONG),
        MachineState::Jogging => Some(Process::join(instance, &["jog", "X200"])),
        _ => None,
    };
    if state == MachineState::Held {
        let _moving = instance.wait_for_status(|status| status.position[0] > 3.0);
        let _held = Process::join(instance, &["hold"]).wait().expect(0);
    }
    let _there = instance.wait_for_status(|status| status.state == state.code());
    client
}

#[test]
fn a_machine_that_nobody_finds_any_more_comes_to_rest_and_ends() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    for state in STATES {
        let [interpolator, service] = start(&instance);
        let tape = Tape::start(&instance);
        let client = bring(&instance, state);
        let connection = instance.connect();
        let mut statuses = connection.status_source().unwrap();
        // Connected: what comes after that is not found.
        while statuses.take().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(2));
        }
        std::fs::remove_dir_all(instance.config().directory()).unwrap();

        let interpolator = interpolator.wait().expect(5);
        let told = interpolator.stderr.contains(TOLD);
        assert!(told, "{state:?}: {interpolator:#?}");
        let last = statuses.take().unwrap().unwrap();
        assert_eq!(last.fault(), Ok(Some(FaultCause::Ports)), "{state:?}");
        let told = last.fault_text().unwrap();
        assert!(told.contains(TOLD), "{state:?}: {told}");
        let service = service.wait().expect(5);
        assert!(service.stderr.contains(TOLD), "{state:?}: {service:#?}");
        if let Some(client) = client {
            let output = client.wait();
            assert_ne!(output.status.code(), Some(0), "{state:?}: {output:#?}");
        }
        assert_eq!(tape.judge(), Vec::<String>::new(), "{state:?}");
    }
}

#[test]
fn what_is_left_of_a_removed_instance_takes_nothing_from_the_next() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let processes = start(&instance);
    let left = instance.connect();
    std::fs::remove_dir_all(instance.config().directory()).unwrap();
    // It makes nothing anew either.
    assert!(left.status_source().is_err());
    assert!(!instance.config().directory().exists());
    drop(processes);
    let [interpolator, service] = start(&instance);
    drop(left);
    let moved = Process::join(&instance, &["mdi", "G0 X1"]);
    let _moved = moved.wait().expect(0);
    let _service = service.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
}
