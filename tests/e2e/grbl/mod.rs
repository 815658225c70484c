//! Tests of senders of grbl: they stream, hold, stop, jog and go away, and the machine does what
//! they mean.

mod left_on;
mod sender;

use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_link::servo::JointState;
use glidepath_tests::{Instance, Operated, Process, Services, SetpointFile, Watchdog, planned};
use rustix::process::Signal;
use sender::{Endpoint, Sender};

const PATIENCE: Duration = Duration::from_secs(400);
/// That of the built-in machine, and a little for the numbers of a file.
const TOLERANCE_MM: f64 = 0.02 + 1e-6;

/// Lines of a long program, besides its first and last.
fn lines() -> usize {
    let asked = std::env::var("GLIDEPATH_SENT").ok();
    asked.and_then(|asked| asked.parse().ok()).unwrap_or(5_000)
}

/// A wave of short lines, there and back again.
fn wave(lines: usize) -> String {
    let mut text = "G21 G90 G94 G17\nG0 X0 Y0\nG1 F4000\n".to_owned();
    for number in 1..=lines {
        let turn = number % 800;
        let x = 0.25 * (if turn <= 400 { turn } else { 800 - turn }) as f64;
        let y = 4.0 * (0.06 * number as f64).sin();
        text.push_str(&format!("X{x:.3} Y{y:.3}\n"));
    }
    text.push_str("G0 X0 Y0\nM30\n");
    text
}

/// The ends of the lines of a program.
fn ends(program: &str) -> Vec<[f64; 2]> {
    let end = |line: &str| {
        let (x, y) = line
            .trim_start_matches("G0 ")
            .strip_prefix('X')?
            .split_once(" Y")?;
        Some([x.parse().ok()?, y.parse().ok()?])
    };
    let ends: Vec<[f64; 2]> = program.lines().filter_map(end).collect();
    assert!(ends.len() > program.lines().count() - 5);
    ends
}

/// Asserts that setpoints are within the tolerance of the lines of a program, in their order, from its beginning
/// to its end.
fn follows(received: &SetpointFile, program: &str) {
    let ends = ends(program);
    let mut line = 0;
    for at in received.positions() {
        let away = |line: usize| {
            let [from, to] = [ends[line], ends[line + 1]];
            let along = [to[0] - from[0], to[1] - from[1]];
            let length = along[0] * along[0] + along[1] * along[1];
            let way = (at[0] - from[0]) * along[0] + (at[1] - from[1]) * along[1];
            let part = if length > 0.0 {
                (way / length).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (at[0] - from[0] - part * along[0]).hypot(at[1] - from[1] - part * along[1])
        };
        // A setpoint is a line or two behind the one before, and a few more where ticks were missed.
        let last = (line + 60).min(ends.len() - 2);
        let found = (line..=last).find(|line| away(*line) <= TOLERANCE_MM);
        assert!(found.is_some(), "{at:?} is off the path behind line {line}");
        line = found.unwrap();
    }
    assert!(
        line >= ends.len() - 3,
        "it ends at line {line} of {}",
        ends.len()
    );
}

/// Interpolator, mock servo, the planner's service, and an endpoint.
struct Bench<'a> {
    services: Services<'a>,
    planner: Process,
    endpoint: Endpoint,
}

impl<'a> Bench<'a> {
    fn start(instance: &'a Instance) -> Self {
        Self::with(instance, &[])
    }

    fn with(instance: &'a Instance, arguments: &[&str]) -> Self {
        let services = Services::start(instance);
        let planner = Process::service(instance);
        let endpoint = Endpoint::start(instance, arguments);
        Self {
            services,
            planner,
            endpoint,
        }
    }

    fn sender(&self) -> Sender {
        Sender::connect(self.endpoint.port)
    }

    fn x(&self) -> f64 {
        self.services.wait(|_| true).position[0]
    }

    /// Nothing moves any more; where it stands.
    fn rests(&self) -> [f64; 2] {
        let place = || {
            let status = self.services.wait(|_| true);
            [status.position[0], status.position[1]]
        };
        let begun = Instant::now();
        let mut before = place();
        loop {
            std::thread::sleep(Duration::from_millis(300));
            let now = place();
            if now.map(f64::to_bits) == before.map(f64::to_bits) {
                return now;
            }
            assert!(begun.elapsed() < Duration::from_secs(30), "it moves on");
            before = now;
        }
    }

    /// Nothing moves any more, and the machine is there.
    fn rests_at(&self, wanted: [f64; 2]) {
        let found = self.rests();
        let is_there = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(is_there, "{found:?}, wanted {wanted:?}");
    }

    /// Ends the processes; what the servo received is in the instance's directory.
    fn end(self) {
        let Self {
            services,
            planner,
            endpoint,
        } = self;
        endpoint.end();
        let _planner = planner.end().expect(0);
        drop(services.end());
    }
}

#[test]
fn a_long_program_is_streamed_without_a_stop_and_on_its_path() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(Duration::MAX / 4));
    let text = wave(lines());
    let part = instance.file("part.ngc", &text);
    let program: Vec<&str> = text.lines().collect();
    // A host of tests stands still for tens of milliseconds: more lines have to be on their way than 128 bytes. The
    // motion begins with the first of them and must not rest at the end of these.
    let bench = Bench::with(&instance, &["--rx-bytes", "1024"]);
    let mut sender = bench.sender();
    sender.window = 1000;
    let answered = sender.stream(&program, &mut |_, _| true);
    let refused = answered.iter().position(|answer| answer != "ok");
    assert_eq!((answered.len(), refused), (program.len(), None));
    sender.wait_for_state("Idle");
    assert!(sender.said("[MSG:Pgm End]"), "{:?}", sender.log);
    let ticks = bench
        .services
        .wait(|status| status.state == MachineState::Idle.code());
    assert_eq!(ticks.starved_ticks, 0, "the machine waited for lines");
    bench.end();
    let received = SetpointFile::read(instance.path("servo.csv").as_ref());
    follows(&received, &text);
    // What a file of it takes, but for the beginning of a stream.
    let rows = |file: &SetpointFile| file.moving().len() as f64;
    let streamed = rows(&received);
    let whole = rows(&planned(&instance, &part));
    assert!(streamed < whole * 1.02 + 50.0, "{streamed} for {whole}");
    let states = received.states();
    let is_moving = |row: &[JointState; 3]| row.iter().any(|joint| joint.velocity.abs() > 0.0);
    let moving: Vec<_> = states.iter().map(is_moving).collect();
    let begins = moving.windows(2).filter(|pair| !pair[0] && pair[1]).count();
    assert_eq!(begins, 1, "times that the motion sets out");
}

#[test]
fn a_sender_holds_goes_on_stops_and_begins_anew() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    let long = ["G21 G90", "G1 F3000 X100", "Y50", "X0", "Y0"];
    // Held in its middle.
    assert_eq!(sender.stream(&long, &mut |_, _| true), ["ok"; 5]);
    sender.wait_until_beyond(10.0);
    sender.send(b"!");
    sender.wait_for_state("Hold:0");
    let [x, y] = bench.rests();
    assert!(x > 10.0 && x < 100.0 && y.abs() < 1e-9, "{x} {y}");
    sender.send(b"~");
    sender.wait_for_state("Run");
    sender.wait_for_state("Idle");
    bench.rests_at([0.0, 0.0]);
    // Stopped in its middle: no alarm, on the path, and the next line goes from there.
    assert_eq!(sender.stream(&long, &mut |_, _| true), ["ok"; 5]);
    sender.wait_until_beyond(20.0);
    sender.send(b"\x18G55\n");
    sender.wait_for("Grbl 1.1");
    sender.wait_for("ok");
    let [x, y] = bench.rests();
    assert!((20.0..100.0).contains(&x) && y.abs() < 1e-9, "{x} {y}");
    sender.wait_for_state("Idle");
    assert!(!sender.said("ALARM"), "{:?}", sender.log);
    assert_eq!(sender.answers(&["G54 G91 G0 X1", "G4 P0.1"]), ["ok", "ok"]);
    assert!((bench.x() - x - 1.0).abs() < 1e-9);
    // What a finished job is followed by.
    sender.send(b"!");
    sender.wait_for_state("Hold:0");
    sender.send(b"\x18");
    sender.wait_for_state("Idle");
    assert!(!sender.said("ALARM"), "{:?}", sender.log);
    bench.end();
}

#[test]
fn a_single_line_moves_at_once_and_a_slow_sender_stops_at_ends_of_lines() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    assert_eq!(sender.answers(&["G21 G90 G1 F6000"]), ["ok"]);
    for place in [5.0, 10.0, 15.0] {
        let from = bench.rests();
        let begun = Instant::now();
        sender.send(format!("X{place}\n").as_bytes());
        let moved = bench
            .services
            .wait(|status| (status.position[0] - from[0]).abs() > 0.0);
        let took = begun.elapsed();
        // A host of tests stands still for a tenth of a second now and then.
        assert!(
            took < Duration::from_millis(400),
            "{took:?} {}",
            moved.position[0]
        );
        sender.wait_for("ok");
        sender.wait_for_state("Idle");
        bench.rests_at([place, 0.0]);
    }
    bench.end();
}

#[test]
fn a_sender_that_dies_leaves_the_machine_at_rest_and_the_next_one_goes_on() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    let text = wave(2_000);
    let program: Vec<&str> = text.lines().collect();
    let _sent = sender.stream(&program, &mut |sender, _| sender.position()[0] < 10.0);
    // One at a time.
    let second = Sender::connect(bench.endpoint.port);
    assert!(second.rest().contains("[MSG:Busy"), "a second sender");
    // It dies in the middle of a line: one that has an answer to all it sent may be done.
    sender.send(b"G1 X1");
    drop(sender);
    let [x, y] = bench.rests();
    let is_end = |line: &str| line == format!("X{x:.3} Y{y:.3}");
    assert!(
        program.iter().any(|line| is_end(line)),
        "no end of a line: {x} {y}"
    );
    let mut next = bench.sender();
    next.wait_for("The sender before was lost");
    assert_eq!(next.state(), "Hold:0");
    next.send(b"~");
    next.wait_for_state("Idle");
    assert_eq!(next.answers(&["G90 G0 X0 Y0", "G4 P0.1"]), ["ok", "ok"]);
    bench.rests_at([0.0, 0.0]);
    bench.end();
}

#[test]
fn what_is_refused_moves_nothing_and_holds_what_is_behind_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    assert_eq!(sender.answers(&["G21 G90 G0 X9999"]), ["error:33"]);
    assert!(sender.said("column"), "{:?}", sender.log);
    assert_eq!(
        sender.answers(&["$J=X9999 F100", "$130=5", "G999"]),
        ["error:15", "error:3", "error:20"]
    );
    bench.rests_at([0.0, 0.0]);
    assert_eq!(sender.state(), "Idle");
    // In mid-stream.
    sender.send(b"G1 F3000 X20\nG999\nX40\n");
    sender.wait_for("error:20");
    sender.wait_for_state("Hold:0");
    bench.rests_at([20.0, 0.0]);
    sender.send(b"~");
    sender.wait_for_state("Idle");
    bench.rests_at([40.0, 0.0]);
    // A page of a browser may open the port.
    let browser = Sender::connect_raw(bench.endpoint.port);
    drop(sender);
    std::thread::sleep(Duration::from_millis(200));
    drop(browser);
    let mut browser = Sender::connect(bench.endpoint.port);
    browser.send(b"POST / HTTP/1.1\r\n\r\nG0 X0\n");
    let _closed = browser.rest();
    bench.rests_at([40.0, 0.0]);
    bench.end();
}

#[test]
fn jogs_come_to_their_ends_and_are_ended() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    let three = ["$J=G91 X5 F3000"; 3];
    assert_eq!(sender.answers(&three), ["ok"; 3]);
    sender.wait_for_state("Idle");
    bench.rests_at([15.0, 0.0]);
    assert_eq!(
        sender.answers(&["$J=G91 G21 Y5 F3000", "$J=G90 X0 Y0 F3000"]),
        ["ok"; 2]
    );
    sender.wait_for_state("Idle");
    bench.rests_at([0.0, 0.0]);
    sender.send(b"$J=G91 X200 F3000\n");
    sender.wait_for_state("Jog");
    sender.wait_until_beyond(1.0);
    sender.send(b"G0 X1\n");
    sender.wait_for("error:9");
    sender.send(b"\x85");
    sender.wait_for_state("Idle");
    let [x, _] = bench.rests();
    assert!(x > 0.0 && x < 150.0, "{x}");
    // The sender that jogs goes away.
    sender.send(b"$J=G91 X200 F600\n");
    sender.wait_for_state("Jog");
    drop(sender);
    let [end, _] = bench.rests();
    assert!(end < x + 100.0, "{x} {end}");
    bench.end();
}

/// A sender takes the machine that is idle for the end of its lines.
#[test]
fn between_ok_and_the_end_of_its_motion_no_line_is_told_as_done() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    assert_eq!(sender.answers(&["G21 G90", "G1 X0 F2400"]), ["ok"; 2]);
    for round in 1..=12_u32 {
        let wanted = if round.is_multiple_of(2) { 1.0 } else { 6.0 };
        assert_eq!(sender.answers(&[&format!("G1 X{wanted}")]), ["ok"]);
        loop {
            sender.send(b"?");
            let state = sender.state();
            let x = sender.position()[0];
            if (x - wanted).abs() < 1e-3 {
                break;
            }
            assert_ne!(state, "Idle", "in round {round}, at X {x}");
        }
        // Into a job that lives on, and into a new one.
        std::thread::sleep(Duration::from_millis(u64::from(round) * 20));
    }
    bench.end();
}

/// What waited at an endpoint that stood still.
#[test]
fn what_came_before_an_abort_and_is_heard_behind_it_moves_nothing() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    assert_eq!(sender.answers(&["G21 G90", "G0 X4 Y0"]), ["ok"; 2]);
    bench.rests_at([4.0, 0.0]);
    for line in ["G1 X20 F600\n", "$J=G91 X5 F3000\n"] {
        bench.endpoint.signal(Signal::STOP);
        sender.send(line.as_bytes());
        std::thread::sleep(Duration::from_secs(2));
        let _aborted = Process::join(&instance, &["abort"]).wait().expect(0);
        bench.endpoint.signal(Signal::CONT);
        std::thread::sleep(Duration::from_secs(1));
        bench.rests_at([4.0, 0.0]);
        sender.send(b"$X\n");
        sender.wait_for_state("Idle");
    }
    sender.send(b"G90 G0 X6\n");
    let _there = bench
        .services
        .wait(|status| (status.position[0] - 6.0).abs() < 1e-9);
    bench.end();
}

#[test]
fn offsets_and_modes_are_those_of_the_machine_whoever_sets_them() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Bench::start(&instance);
    let mut sender = bench.sender();
    let mdi = |line: &str| {
        // A sender's job has ended a tenth of a second behind its last line.
        std::thread::sleep(Duration::from_millis(600));
        let _output = Process::join(&instance, &["mdi", line]).wait().expect(0);
    };
    mdi("G21 G90 G0 X10");
    mdi("G10 L20 P2 X0");
    mdi("G55");
    assert_eq!(sender.answers(&["G0 X5", "G4 P0.1"]), ["ok", "ok"]);
    bench.rests_at([15.0, 0.0]);
    sender.send(b"$#\n");
    sender.wait_for("[G55:10.000,0.000,0.000]");
    sender.send(b"$G\n");
    sender.wait_for("[GC:G0 G55 G17 G21 G90 G94");
    assert_eq!(sender.answers(&["G10 L20 P2 X1", "G91"]), ["ok", "ok"]);
    mdi("G0 X1");
    bench.rests_at([16.0, 0.0]);
    mdi("G90 G0 X1");
    bench.rests_at([15.0, 0.0]);
    bench.end();
}

#[test]
fn tools_stops_and_probes_are_answered_when_they_are_done() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let reads = ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\"");
    let probe = ("# input = 0\n", "input = 0\n");
    let bench = Operated::new(&instance, &[reads, probe], "");
    let _interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _servo = bench.process(&[
        "servo",
        "--best-effort",
        "--stands",
        "1,2,10",
        "--probe",
        "J2=-7.25",
    ]);
    let _seen = bench.wait_for_drives();
    let _service = bench.service();
    let endpoint = Endpoint::start(&instance, &["--config", bench.config()]);
    let mut sender = Sender::connect(endpoint.port);
    // Without power it is an alarm, and $X gives it.
    sender.wait_for_state("Alarm");
    assert_eq!(sender.answers(&["G0 X1"]), ["error:9"]);
    assert_eq!(sender.answers(&["$X"]), ["ok"]);
    sender.wait_for_state("Idle");
    assert_eq!(
        sender
            .answers(&["G21 G90 G0 X5", "M0 (turn it round)"])
            .len(),
        1
    );
    sender.wait_for_state("Hold:0");
    assert!(sender.said("turn it round"), "{:?}", sender.log);
    sender.send(b"~");
    sender.wait_for("ok");
    assert_eq!(sender.answers(&["G38.2 Z-20 F300"]), ["ok"]);
    assert!(sender.said("[PRB:5.000,2.000,-7.2"), "{:?}", sender.log);
    assert_eq!(sender.answers(&["G0 Z10"]), ["ok"]);
    sender.wait_for_state("Idle");
    assert_eq!(sender.answers(&["G38.2 Z15 F600"]), ["ok"]);
    assert!(sender.said("ALARM:5"), "{:?}", sender.log);
    sender.wait_for_state("Alarm");
    assert_eq!(
        sender.answers(&["G0 Z1", "$X", "G0 Z12", "G4 P0.1"]),
        ["error:9", "ok", "ok", "ok"]
    );
    assert!((bench.position()[2] - 12.0).abs() < 1e-9);
    endpoint.end();
}
