//! Tests of jobs, which are answerable from the moment they are accepted: what an operator wants of
//! one holds before its first motion as it does behind.

use std::time::{Duration, Instant};

use glidepath_link::{FaultCause, JobStage, MachineState, Status};
use glidepath_tests::{Instance, Operated, Output, Process, Watchdog};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(400);
/// How soon a command ends that is told to.
const SOON: Duration = Duration::from_secs(2);

/// A program whose loops take seconds before there is a motion.
fn slow_to_check() -> String {
    let mut text = "G21 G90\n".to_owned();
    for part in 1..=6 {
        text.push_str(&format!(
            "#1=0\no{part} while [#1 lt 240000]\n#2=[sin[#1]*cos[#1]+sqrt[#1]]\n#1=[#1+1]\n\
             o{part} endwhile\nG1 X0.00{part} F600\n"
        ));
    }
    text.push_str("G1 X50 F6000\nM2\n");
    text
}

/// A machine with drives, its service, and a program that takes long to be checked.
pub(crate) struct Bench<'a> {
    pub(crate) operated: Operated<'a>,
    pub(crate) slow: String,
    pub(crate) processes: Vec<Process>,
}

impl<'a> Bench<'a> {
    pub(crate) fn start(instance: &'a Instance) -> Self {
        let mut bench = Self::without_service(instance);
        let service = bench.operated.service();
        bench.processes.push(service);
        bench
    }

    fn without_service(instance: &'a Instance) -> Self {
        let operated = Operated::new(instance, &[], "");
        let interpolator = operated.process(&["interpolator", "--best-effort"]);
        let servo = operated.process(&["servo", "--best-effort"]);
        let _drives = operated.wait_for_drives();
        operated.operate(&["enable"]);
        let _idle = operated.wait_for(MachineState::Idle);
        Self {
            operated,
            slow: instance.file("slow.ngc", &slow_to_check()),
            processes: vec![interpolator, servo],
        }
    }

    /// Hands the slow program in, and waits until it is being checked.
    fn preparing(&self) -> Process {
        let client = self.operated.process(&["run-file", &self.slow]);
        let status = self.operated.wait_for(MachineState::Preparing);
        assert_eq!(status.job_stage(), Ok(JobStage::Preparing));
        client
    }

    /// Nothing moves, for longer than a job would take to begin.
    pub(crate) fn stays(&self, before: &Status) {
        std::thread::sleep(Duration::from_millis(2500));
        let after = self.operated.wait(|_| true);
        assert_eq!(
            after.position.map(f64::to_bits),
            before.position.map(f64::to_bits)
        );
        assert_eq!((after.state(), after.epoch), (before.state(), before.epoch));
    }

    /// The next job is executed.
    pub(crate) fn goes_on(&self) {
        self.operated.operate(&["mdi", "G21 G90 G1 X3 F6000"]);
        self.operated.operate(&["mdi", "G0 X0"]);
        assert!(self.operated.position()[0].abs() < 1e-9);
    }
}

/// A planner that hangs hears of it late, however long it hangs.
#[test]
fn what_waits_at_a_planner_that_hangs_does_not_outlive_an_abort() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    bench.goes_on();
    let part = instance.file("part.ngc", "G21 G90\nG1 X20 F600\nM2\n");
    for stall in [Duration::from_millis(700), Duration::from_secs(2)] {
        for command in [
            &["mdi", "G1 X20 F600"][..],
            &["run-file", &part],
            &["feed", &part],
        ] {
            let service = bench.processes.last().unwrap();
            service.signal(Signal::STOP);
            let before = bench.operated.wait(|_| true);
            let client = bench.operated.process(command);
            std::thread::sleep(stall);
            bench.operated.operate(&["abort"]);
            service.signal(Signal::CONT);
            bench.stays(&before);
            let output = client.wait();
            assert_ne!(output.status.code(), Some(0), "{output:#?}");
            bench.goes_on();
        }
    }
    // Where the machine was not stopped meanwhile, what waited is executed.
    let service = bench.processes.last().unwrap();
    for command in [&["run-file", &part][..], &["feed", &part]] {
        service.signal(Signal::STOP);
        let client = bench.operated.process(command);
        std::thread::sleep(Duration::from_millis(1500));
        service.signal(Signal::CONT);
        let _done = client.wait().expect(0);
        assert!((bench.operated.position()[0] - 20.0).abs() < 1e-9);
        bench.goes_on();
    }
}

#[test]
fn a_planner_that_dies_while_its_program_rests_ends_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let mut bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G21 G90\nG1 X2 F600\nM0\nG1 X30\nM2\n");
    let client = bench.operated.process(&["run-file", &part]);
    let stands = bench.operated.wait_for(MachineState::ProgramStop);
    let service = bench.processes.pop().unwrap();
    service.signal(Signal::KILL);
    let fault = bench.operated.wait_for(MachineState::Faulted);
    assert_eq!(fault.fault(), Ok(Some(FaultCause::PlannerLost)));
    assert_eq!(
        fault.position.map(f64::to_bits),
        stands.position.map(f64::to_bits)
    );
    let output = client.wait().expect(5);
    assert!(output.stderr.contains("--resume"), "{output:#?}");
    bench.operated.operate(&["reset"]);
    let service = bench.operated.service();
    bench.processes.push(service);
    bench.goes_on();
}

pub(crate) fn ended_within(process: Process, patience: Duration) -> Output {
    let begun = Instant::now();
    let output = process.wait();
    assert!(
        begun.elapsed() < patience,
        "{:?}: {output:#?}",
        begun.elapsed()
    );
    output
}

#[test]
fn an_abort_and_the_end_of_a_client_end_a_job_that_is_prepared() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);

    let client = bench.preparing();
    let shown = bench.operated.operate(&["status"]).stdout;
    assert!(shown.contains("slow.ngc: "), "{shown}");
    bench.operated.operate(&["abort"]);
    let idle = bench.operated.wait_for(MachineState::Idle);
    assert_eq!(idle.job_stage(), Ok(JobStage::Aborted));
    let output = ended_within(client, SOON).expect(5);
    assert!(output.stderr.contains("abort"), "{output:#?}");
    bench.stays(&idle);
    bench.goes_on();

    for signal in [Signal::INT, Signal::TERM, Signal::HUP, Signal::KILL] {
        let client = bench.preparing();
        client.signal(signal);
        let output = ended_within(client, SOON);
        assert!(
            signal == Signal::KILL || output.status.code() == Some(130),
            "{output:#?}"
        );
        // Without a word of its client a job lives for 2 s more.
        let idle = bench.operated.wait_for(MachineState::Idle);
        bench.stays(&idle);
        bench.goes_on();
    }
}

#[test]
fn a_job_begins_held_and_nothing_else_has_the_machine() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);

    let client = bench.preparing();
    for command in [
        &["jog", "X5"][..],
        &["home"],
        &["unhome"],
        &["set-position", "J0", "7"],
        &["mdi", "G0 X1"],
    ] {
        let output = bench.operated.process(command).wait().expect(5);
        let why = output.stderr.contains("job") || output.stderr.contains("executes");
        assert!(why || command[0] == "jog", "{output:#?}");
    }
    bench.operated.operate(&["hold"]);
    let shown = bench.operated.operate(&["status"]).stdout;
    assert!(shown.contains("begins held"), "{shown}");
    let held = bench.operated.wait_for(MachineState::Held);
    bench.stays(&held);
    bench.operated.operate(&["resume"]);
    let _done = client.wait().expect(0);
    assert!((bench.operated.position()[0] - 50.0).abs() < 1e-9);
    bench.operated.operate(&["mdi", "G0 X0"]);

    // What takes the power takes the job.
    let client = bench.preparing();
    bench.operated.operate(&["disable"]);
    let _off = bench.operated.wait_for(MachineState::Off);
    let output = ended_within(client, SOON).expect(5);
    assert!(output.stderr.contains("drives"), "{output:#?}");
    bench.operated.operate(&["enable"]);
    let idle = bench.operated.wait_for(MachineState::Idle);
    bench.stays(&idle);
    bench.goes_on();

    // At rest there is nothing to end, and that is what was wanted.
    bench.operated.operate(&["abort"]);
    bench.operated.operate(&["hold"]);
    bench.goes_on();
}

/// It lives: to start another would fail.
#[test]
fn an_interpolator_that_hangs_is_not_told_as_gone() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let mut bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G21 G90\nG1 X60 F600\nM2\n");
    let client = bench.operated.process(&["run-file", &part]);
    let _moving = bench.operated.wait(|status| status.position[0] > 3.0);
    let interpolator = bench.processes.remove(0);
    interpolator.signal(Signal::STOP);
    let output = client.wait().expect(5);
    let told = format!("(process {}) lives and does not answer", interpolator.id());
    assert!(output.stderr.contains(&told), "{output:#?}");
    // The last resort says at once what it waits for.
    let abort = bench.operated.process(&["abort", "--signal"]);
    std::thread::sleep(Duration::from_millis(1500));
    interpolator.signal(Signal::CONT);
    let output = abort.wait().expect(0);
    let waits = output.stderr.contains("was signalled; waiting");
    assert!(waits, "{output:#?}");
    let _interpolator = interpolator.wait();
}

/// Its client hears within seconds that it hangs, what to do, and of the fault that the motion ended by.
#[test]
fn a_planner_that_hangs_is_told_to_its_client_and_so_is_the_fault() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let mut bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G21 G90\nG1 X60 F600\nM2\n");
    let client = bench.operated.process(&["run-file", &part]);
    let _moving = bench.operated.wait(|status| status.position[0] > 3.0);
    let service = bench.processes.pop().unwrap();
    service.signal(Signal::STOP);
    let output = client.wait().expect(5);
    let hangs = format!("(process {}) lives and does not answer", service.id());
    for told in ["no more frames came", &hangs, "--resume"] {
        assert!(output.stderr.contains(told), "{told}: {output:#?}");
    }
    // Nothing was taken of the next one, and no fault is its own: it waits, and says for whom.
    let waits = bench.operated.process(&["run-file", &part]);
    std::thread::sleep(Duration::from_secs(5));
    waits.signal(Signal::INT);
    let output = waits.wait();
    assert!(output.stderr.contains(&hangs), "{output:#?}");
    service.signal(Signal::CONT);
}

/// Of a second one the interpolator uses nothing: it is not to say that it is ready.
#[test]
fn a_second_servo_is_refused_and_told_who_answers_for_the_drives() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let [_, servo, planner] = &bench.processes[..] else {
        unreachable!("interpolator, servo and planner");
    };
    let output = bench
        .operated
        .process(&["servo", "--best-effort"])
        .wait()
        .expect(5);
    let holder = format!("(process {})", servo.id());
    assert!(
        output.stderr.contains("no place for another servo"),
        "{output:#?}"
    );
    assert!(output.stderr.contains(&holder), "{output:#?}");
    let output = bench
        .operated
        .process(&["planner", "--listen"])
        .wait()
        .expect(5);
    let holder = format!("(process {})", planner.id());
    assert!(output.stderr.contains(&holder), "{output:#?}");
}

#[test]
fn a_planner_without_a_service_is_answerable_too() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::without_service(&instance);
    for signal in [
        None,
        Some(Signal::INT),
        Some(Signal::TERM),
        Some(Signal::KILL),
    ] {
        let planner = bench.operated.process(&["planner", &bench.slow]);
        let _preparing = bench.operated.wait_for(MachineState::Preparing);
        match signal {
            Some(signal) => planner.signal(signal),
            None => drop(bench.operated.operate(&["abort"])),
        }
        let _ended = ended_within(planner, SOON);
        // Of one that was killed nothing is heard for 3 s.
        let idle = bench.operated.wait_for(MachineState::Idle);
        bench.stays(&idle);
    }
    // It waits for the drives; an abort ends that, too.
    bench.operated.operate(&["disable"]);
    let _off = bench.operated.wait_for(MachineState::Off);
    let planner = bench.operated.process(&["planner", &bench.slow]);
    let _waits = bench
        .operated
        .wait(|status| status.job_stage() == Ok(JobStage::Waiting));
    bench.operated.operate(&["abort"]);
    let _ended = ended_within(planner, SOON).expect(5);
    bench.operated.operate(&["enable"]);
    let idle = bench.operated.wait_for(MachineState::Idle);
    bench.stays(&idle);
}

#[test]
fn a_planner_that_hangs_through_an_abort_moves_nothing_afterwards() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let mut bench = Bench::start(&instance);
    let client = bench.preparing();
    let service = bench.processes.pop().unwrap();
    service.signal(Signal::STOP);
    bench.operated.operate(&["abort"]);
    let idle = bench.operated.wait_for(MachineState::Idle);
    // Its client ends, whoever does not answer.
    client.signal(Signal::TERM);
    let _ended = ended_within(client, SOON);
    let typed = bench.operated.process(&["mdi", "G0 X7"]);
    std::thread::sleep(Duration::from_millis(300));
    typed.signal(Signal::INT);
    let _ended = ended_within(typed, SOON);
    service.signal(Signal::CONT);
    bench.stays(&idle);
    bench.goes_on();
    let _ended = service.end().expect(0);
}

#[test]
fn a_service_goes_on_with_a_program_where_it_was_left() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G1 X40 F1500\nX40 Y20\nG90 X0 Y0\nM2\n");
    let other = instance.file("other.ngc", "G21 G90 G1 X1 F600\nM2\n");
    bench.operated.refused(
        &["run-file", &part, "--resume"],
        1,
        "no program was under way",
    );
    // It is read with what was in force when it began.
    bench.operated.operate(&["mdi", "G21 G91"]);
    let running = bench.operated.process(&["run-file", &part]);
    let _moving = bench.operated.wait(|status| status.position[0] > 10.0);
    bench.operated.operate(&["abort"]);
    let _ended = running.wait().expect(5);
    bench
        .operated
        .refused(&["run-file", &other, "--resume"], 1, "not the program");
    // Lines do not count: not what they leave in force, and not where they go, if they come back.
    for line in ["G20 G90", "G21 G91 G1 Z2 F1000", "G4 P0.1"] {
        bench.operated.operate(&["mdi", line]);
    }
    bench
        .operated
        .refused(&["run-file", &part, "--resume"], 1, "does not stand on");
    bench.operated.operate(&["mdi", "G1 Z-2"]);
    let resumed = bench.operated.process(&["run-file", &part, "--resume"]);
    let turned = bench.operated.wait(|status| status.position[1] > 19.9);
    assert!(turned.position[0] > 40.0, "{:?}", turned.position);
    let _done = resumed.wait().expect(0);
    assert!(bench.operated.position()[0].abs() < 1e-9);
    bench
        .operated
        .refused(&["run-file", &part, "--resume"], 1, "came to its end");
    bench.operated.operate(&["mdi", "G0 X1"]);
    bench
        .operated
        .refused(&["run-file", &part, "--resume"], 1, "came to its end");
}
