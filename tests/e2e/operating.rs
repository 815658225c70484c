//! Tests of a machine with drives: switched on, homed, used, lost, and switched on again.

use std::time::Duration;

use glidepath_link::{EndOfEpoch, FaultCause, MachineState, Power};
use glidepath_tests::{Instance, Operated, Process, Watchdog};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(240);

const PROGRAM: &str = "G21 G90 G1 X8 Y2 F3000\nX-4 Y-6\nX5 Y5 Z3\nM2\n";

const LOOKS_FOR_HOME: (&str, &str) = ("homing = \"none\"", "homing = \"drive\"");

#[test]
fn a_machine_is_switched_on_homed_used_and_recovers_from_the_loss_of_its_drives() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let machine = Operated::new(&instance, &[LOOKS_FOR_HOME], "");
    let program = instance.file("program.ngc", PROGRAM);
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let status = machine.wait_for(MachineState::Off);
    assert_eq!((status.power(), status.homed), (Ok(Power::Off), 0));
    machine.refused(&["enable"], 5, "where they are");

    // The position is that of the drives, which count from anywhere.
    let servo = machine.process(&["servo", "--best-effort", "--stands", "12.5,-3,40"]);
    let status = machine.wait_for_drives();
    assert_eq!(status.joint_actual[..3], [0.0; 3]);
    machine.operate(&["enable"]);
    let status = machine.wait_for(MachineState::NotHomed);
    assert_eq!((status.power(), status.homed), (Ok(Power::On), 0));
    // What is shown of a machine that does not know where it is, is marked.
    let told = machine.operate(&["status"]).stdout;
    assert!(told.contains("X 0.0000 (not homed)"), "{told}");
    let told = machine.operate(&["status", "--json"]).json();
    assert_eq!(told["axes_not_homed"], serde_json::json!(["X", "Y", "Z"]));
    machine.operate(&["set-position", "J1", "7.25"]);
    let _set = machine.wait(|status| (status.position[1] - 7.25).abs() < 1e-12);
    machine.operate(&["home"]);
    let status = machine.wait_for(MachineState::Idle);
    assert_eq!(status.position[..3], [7.5, -8.0, 35.0]);
    assert_eq!(status.homed, 0b111);
    let told = machine.operate(&["status"]).stdout;
    assert!(!told.contains("(not homed)"), "{told}");

    // A program begins where the machine stands.
    machine.operate(&["planner", &program]);
    let status = machine.wait_for(MachineState::Idle);
    assert_eq!(status.end_of_epoch(), Ok(EndOfEpoch::Completed));
    assert_eq!(status.position[..3], [5.0, 5.0, 3.0]);
    assert!(
        status.following_peak[0] < 0.05,
        "{:?}",
        status.following_peak
    );

    // The servo stack dies in the middle of a motion.
    let back = instance.file("back.ngc", "G21 G90 G1 X200 Y100 Z40 F3000\nM2\n");
    let planner = machine.process(&["planner", &back]);
    let _moving = machine.wait(|status| status.state == MachineState::Running.code());
    let _under_way = machine.wait(|status| status.frames_executed > 100);
    servo.signal(Signal::KILL);
    let _killed = servo.wait();
    let status = machine.wait_for(MachineState::Faulted);
    assert_eq!(status.fault(), Ok(Some(FaultCause::FeedbackLost)));
    let _planner = planner.wait().expect(5);
    let _off = machine.wait(|status| status.power() == Ok(Power::Off));

    // Another comes: nothing moves before the operator says so, and where it stands is its word.
    let servo = machine.process(&["servo", "--best-effort", "--stands", "1,2,3"]);
    machine.wait(|status| status.feedback_age_ns < 12_000_000);
    machine.refused(&["enable"], 5, "reset");
    machine.operate(&["reset"]);
    let _off = machine.wait_for_drives();
    machine.operate(&["enable"]);
    let _on = machine.wait_for(MachineState::NotHomed);
    machine.operate(&["home"]);
    let status = machine.wait_for(MachineState::Idle);
    assert_eq!(status.position[..3], [-4.0, -3.0, -2.0]);
    machine.operate(&["planner", &program]);
    // What is typed behind it finds the machine off, also out of a motion.
    let planner = machine.process(&["planner", &back]);
    let running = MachineState::Running.code();
    let _under_way = machine.wait(|status| status.state == running && status.frames_executed > 100);
    machine.operate(&["disable"]);
    machine.operate(&["enable"]);
    let _planner = planner.wait().expect(5);
    machine.operate(&["disable"]);
    let _off = machine.wait_for(MachineState::Off);
    let _servo = servo.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
}

#[test]
fn a_pause_of_the_interpolator_is_told_as_what_it_is_and_blames_no_joint() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let machine = Operated::new(&instance, &[], "");
    let program = instance.file("program.ngc", "G21 G90 G1 X50 F600\nX0\nM2\n");
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let servo = machine.process(&["servo", "--best-effort"]);
    let _off = machine.wait_for_drives();
    machine.operate(&["enable"]);
    let _idle = machine.wait_for(MachineState::Idle);
    let pause = || {
        interpolator.signal(Signal::STOP);
        std::thread::sleep(Duration::from_secs(1));
        interpolator.signal(Signal::CONT);
    };
    // At rest nothing stops by it.
    pause();
    std::thread::sleep(Duration::from_millis(500));
    let _idle = machine.wait_for(MachineState::Idle);
    let planner = machine.process(&["planner", &program]);
    let running = MachineState::Running.code();
    let _under_way = machine.wait(|status| status.state == running && status.position[0] > 2.0);
    pause();
    let status = machine.wait_for(MachineState::Faulted);
    assert_eq!(status.fault(), Ok(Some(FaultCause::SetpointsLost)));
    let text = status.fault_text().unwrap_or_default();
    let told = "the drives heard no setpoints for ";
    assert!(text.starts_with(told), "{text}");
    let ended = planner.wait().expect(5);
    assert!(ended.stderr.contains(told), "{ended:?}");
    let _cut = machine.wait(|status| status.power() == Ok(Power::Off));
    machine.operate(&["reset"]);
    machine.operate(&["enable"]);
    let _idle = machine.wait_for(MachineState::Idle);
    machine.operate(&["jog", "X2"]);
    let _servo = servo.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
}

#[test]
fn joints_that_are_not_homed_are_jogged_and_what_ends_a_motion_by_hand_is_told() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let machine = Operated::new(&instance, &[LOOKS_FOR_HOME], "");
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let servo = machine.process(&["servo", "--best-effort"]);
    let _off = machine.wait_for_drives();
    machine.refused(&["jog", "X1"], 5, "`glidepath enable");
    machine.operate(&["enable"]);
    let at = machine.wait_for(MachineState::NotHomed).position;
    machine.operate(&["jog", "X2"]);
    machine.operate(&["jog", "Y-1", "--by-joint"]);
    let status = machine.wait_for(MachineState::NotHomed);
    assert!((status.position[0] - at[0] - 2.0).abs() < 1e-9);
    assert!((status.position[1] - at[1] + 1.0).abs() < 1e-9);

    // At home, and home again.
    machine.operate(&["home"]);
    let _idle = machine.wait_for(MachineState::Idle);
    machine.operate(&["home"]);
    let _idle = machine.wait_for(MachineState::Idle);

    // Somebody else ends a jog, and a way home.
    let jog = machine.process(&["jog", "X60", "--feed", "1200"]);
    let _moving = machine.wait_for(MachineState::Jogging);
    machine.operate(&["hold"]);
    let ended = jog.wait().expect(5);
    assert!(ended.stdout.contains("a hold ended the jog"), "{ended:#?}");
    machine.operate(&["jog", "X60"]);
    let home = machine.process(&["home"]);
    let _homing = machine.wait_for(MachineState::Homing);
    machine.operate(&["abort"]);
    let ended = home.wait().expect(5);
    let why = "an abort ended the way home";
    assert!(ended.stderr.contains(why), "{ended:#?}");
    let status = machine.wait_for(MachineState::NotHomed);
    assert_eq!(status.homed & 1, 0);
    machine.operate(&["home"]);

    // The drives fall silent.
    let jog = machine.process(&["jog", "X60", "--feed", "600"]);
    let _moving = machine.wait_for(MachineState::Jogging);
    servo.signal(Signal::STOP);
    let ended = jog.wait().expect(5);
    let why = FaultCause::FeedbackLost.text();
    assert!(ended.stdout.contains(why), "{ended:#?}");
    let _faulted = machine.wait_for(MachineState::Faulted);
    for word in ["jog", "home", "unhome"] {
        let joints = if word == "jog" { "X1" } else { "J0" };
        machine.refused(&[word, joints], 5, "a fault is latched");
    }
    servo.signal(Signal::CONT);
    let _servo = servo.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
}

#[test]
fn run_switches_a_machine_with_drives_on() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let machine = Operated::new(&instance, &[LOOKS_FOR_HOME], "");
    let program = instance.file("program.ngc", "G21 G91 G1 X3 F3000\nY2\nM2\n");
    let run = [
        "run",
        &program,
        "--best-effort",
        "--json",
        "--config",
        machine.config(),
    ];
    let report = Process::start(&instance, &run).wait().expect(0).json();
    assert_eq!(report["lost_setpoints"], 0);
}

/// An interpolator that hung sees a command late: its client has ended by itself, by Ctrl-C, or was killed.
#[test]
fn a_command_that_was_given_up_is_not_carried_out_later() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let machine = Operated::new(&instance, &[], "");
    let interpolator = machine.process(&["interpolator", "--best-effort"]);
    let _off = machine.wait_for(MachineState::Off);
    let servo = machine.process(&["servo", "--best-effort"]);
    let _answer = machine.wait_for_drives();
    for signal in [None, Some(Signal::INT), Some(Signal::KILL)] {
        interpolator.signal(Signal::STOP);
        let client = machine.process(&["enable"]);
        if let Some(signal) = signal {
            std::thread::sleep(Duration::from_millis(500));
            client.signal(signal);
        }
        let output = client.wait();
        assert_ne!(output.status.code(), Some(0), "{output:#?}");
        interpolator.signal(Signal::CONT);
        std::thread::sleep(Duration::from_millis(500));
        let status = machine.wait_for_drives();
        assert_eq!(status.power(), Ok(Power::Off), "{signal:?}");
    }
    machine.operate(&["enable"]);
    let _on = machine.wait(|status| status.power() == Ok(Power::On));
    let _servo = servo.end().expect(0);
    let _interpolator = interpolator.end().expect(0);
}
