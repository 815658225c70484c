//! A stream of segments obeys whoever streams it and every stop, from when it was asked for to its end.

use std::process::Stdio;
use std::time::{Duration, Instant};

use glidepath_link::{JobStage, MachineState};
use glidepath_tests::{Instance, Process, Watchdog};
use rustix::process::Signal;

use crate::jobs::{Bench, ended_within};

const PATIENCE: Duration = Duration::from_secs(400);
/// How soon a command ends that is told to, on a host that is busy.
const SOON: Duration = Duration::from_secs(2);

const SIGNALS: [Signal; 3] = [Signal::INT, Signal::TERM, Signal::HUP];

#[test]
fn the_end_of_its_client_ends_a_stream_and_its_motion() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G21 G90\nG1 X200 F1200\nX0\nM2\n");
    for signal in SIGNALS {
        let client = bench.operated.process(&["feed", &part]);
        let _moving = bench.operated.wait(|status| status.position[0] > 2.0);
        client.signal(signal);
        let output = ended_within(client, SOON).expect(130);
        let told = output
            .stderr
            .contains("the stream has ended: the command that asked for it was ended");
        assert!(told, "{output:#?}");
        let rests = bench.operated.wait_for(MachineState::Idle);
        assert!(rests.position[0] < 100.0, "{:?}", rests.position);
        bench.stays(&rests);
        bench.goes_on();

        // So it is where its program has not come to its end.
        let before = bench.operated.wait(|_| true);
        if !is_ignored(signal) {
            let arguments = ["feed", "-", "--config", bench.operated.config()];
            let mut client = Process::join_with(&instance, &arguments, Stdio::piped());
            client.write("G21 G90\nG1 X20 F600\n");
            std::thread::sleep(Duration::from_millis(500));
            client.signal(signal);
            ends_within(&mut client, SOON);
            bench.stays(&before);
        }

        // While the client checks its program nothing is streamed, and everybody sees that it is a job.
        let client = bench.operated.process(&["feed", &bench.slow]);
        let reads = bench.operated.wait_for(MachineState::Preparing);
        assert_eq!(reads.job_stage(), Ok(JobStage::Preparing));
        let job = bench
            .operated
            .wait(|status| status.job.as_str().contains("client"));
        let told = "a stream of segments: waits for its client, which reads it";
        assert_eq!(job.job.as_str(), told);
        client.signal(signal);
        let output = ended_within(client, SOON).expect(130);
        let told = output.stderr.contains("nothing was streamed");
        assert!(told, "{output:#?}");
        bench.stays(&before);
        bench.goes_on();
    }
}

/// The planner hangs: what tells the machine is the interpolator.
#[test]
fn a_stream_whose_planner_hangs_is_ended_all_the_same() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G21 G90\nG1 X200 F1200\nX0\nM2\n");
    let client = bench.operated.process(&["feed", &part]);
    let _moving = bench.operated.wait(|status| status.position[0] > 2.0);
    let service = &bench.processes[2];
    service.signal(Signal::STOP);
    client.signal(Signal::TERM);
    let output = ended_within(client, SOON).expect(130);
    let told = output.stderr.contains("has not said yet");
    assert!(told, "{output:#?}");
    let rests = bench.operated.wait_for(MachineState::Idle);
    assert!(rests.position[0] < 100.0, "{:?}", rests.position);
    service.signal(Signal::CONT);
    bench.stays(&rests);
    bench.goes_on();
}

/// However long the program takes to come through its pipe.
#[test]
fn an_abort_counts_for_what_still_reads_its_program() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let mut bench = Bench::start(&instance);
    for command in ["feed", "planner"] {
        if command == "planner" {
            // It plans by itself.
            let service = bench.processes.remove(2);
            let _ended = service.end().expect(0);
        }
        let before = bench.operated.wait(|_| true);
        let arguments = [command, "/dev/stdin", "--config", bench.operated.config()];
        let mut client = Process::join_with(&instance, &arguments, Stdio::piped());
        client.write("G21 G90\nG1 X20 F600\n");
        std::thread::sleep(Duration::from_secs(1));
        bench.operated.operate(&["abort"]);
        client.write("M2\n");
        client.close();
        let output = client.wait();
        assert_ne!(output.status.code(), Some(0), "{output:#?}");
        let words = ["was stopped after", "abort"];
        let told = words.iter().any(|words| output.stderr.contains(words));
        assert!(told, "{output:#?}");
        bench.stays(&before);
    }
}

/// Its client asks again and again for a machine that is not ready, for some seconds.
#[test]
fn an_abort_ends_a_stream_that_waits_for_a_machine_that_is_off() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let part = instance.file("part.ngc", "G21 G90\nG1 X20 F600\nM2\n");
    bench.operated.operate(&["disable"]);
    let _off = bench.operated.wait_for(MachineState::Off);
    let client = bench.operated.process(&["feed", &part]);
    let _waits = bench
        .operated
        .wait(|status| status.job_stage() == Ok(JobStage::Waiting));
    bench.operated.operate(&["abort"]);
    let output = ended_within(client, SOON).expect(5);
    assert!(output.stderr.contains("was stopped after"), "{output:#?}");
    bench.operated.operate(&["enable"]);
    let ready = bench.operated.wait_for(MachineState::Idle);
    bench.stays(&ready);
    bench.goes_on();
}

/// What begins motion is asked for when its process starts, however long it reads its configuration.
#[test]
fn an_abort_counts_for_a_command_that_still_reads_its_configuration() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let config = std::fs::read_to_string(bench.operated.config()).unwrap();
    for command in [&["home"][..], &["enable"], &["jog", "X1"]] {
        let before = bench.operated.wait(|_| true);
        let arguments = [command, &["--config", "/dev/stdin"]].concat();
        let mut client = Process::join_with(&instance, &arguments, Stdio::piped());
        std::thread::sleep(Duration::from_secs(1));
        bench.operated.operate(&["abort"]);
        client.write(&config);
        client.close();
        let output = client.wait();
        assert_ne!(output.status.code(), Some(0), "{output:#?}");
        assert!(output.stderr.contains("was stopped after"), "{output:#?}");
        bench.stays(&before);
    }
}

/// Whether this process ignores a signal, and so does what it starts until that has a handler of its own: a shell has
/// what it runs in the background ignore SIGINT.
fn is_ignored(signal: Signal) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let ignored = u64::from_str_radix(ignored.unwrap().trim(), 16).unwrap();
    ignored >> (signal.as_raw() - 1) & 1 == 1
}

/// A process whose standard input is still open ends.
fn ends_within(process: &mut Process, patience: Duration) {
    let begun = Instant::now();
    while process.runs() {
        assert!(begun.elapsed() < patience, "it goes on");
        std::thread::sleep(Duration::from_millis(5));
    }
}
