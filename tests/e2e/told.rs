//! Tests of what people are told: at the client that waits, in refusals, and by a watch that
//! outlasts silence.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Instance, Operated, Process, Watchdog};
use rustix::process::Signal;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(240);

/// Without a table for M6 and without a word of state, as a machine is at first.
const PART: &str = "G21 G90 G54\nG0 X1\nT2 M6\nG0 X2\nM0 (turn the part)\nG0 X3\nM2\n";

/// What `check` warns of is told by whoever starts the program, before it moves, in the same words.
#[test]
fn what_a_program_does_not_say_is_told_where_it_was_started() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    // Words of FANUC's language alone make them programs of it.
    let unsaid = instance.file(
        "unsaid.nc",
        "O1234\nG90 G54 G0 X1.\n#1=#0\nG65 P9\nM30\nO9\nM99\n",
    );
    let cut_off = instance.file("cut-off.ngc", "G21 G90\nG0 X2\n");
    let whole = instance.file("whole.ngc", "G21 G90\nG0 X3\nM2\n");
    let told = |part: &String| bench.process(&["run-file", part]).wait().expect(0).stderr;
    let warned = |part: &String, words: &str| format!("{part}: warning: {words}");
    let units = told(&unsaid);
    assert!(
        units.contains(&warned(&unsaid, "it moves before G20 or G21")),
        "{units}"
    );
    assert!(!units.contains("the text ends"), "{units}");
    let end = told(&cut_off);
    assert!(
        end.contains(&warned(&cut_off, "the text ends without M2")),
        "{end}"
    );
    assert!(!end.contains("it moves before"), "{end}");
    let nothing = told(&whole);
    assert!(!nothing.contains("warning"), "{nothing}");
    // `check` says the same.
    let checked = bench.process(&["check", &cut_off]).wait().expect(0).stderr;
    let line = end.lines().find(|line| line.contains("warning")).unwrap();
    assert!(checked.contains(line), "{line}: {checked}");
    for process in [&service, &servo, &interpolator] {
        process.signal(Signal::TERM);
    }
    let log = service.wait().expect(0).stderr;
    assert!(log.contains("cut-off.ngc: warning: the text ends"), "{log}");
}

#[test]
fn a_tool_change_waits_for_a_person_and_says_so_where_the_program_was_started() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let table = instance.file("tools.tbl", "T2 P2 Z10 D6 ; 6 mm end mill\n");
    let named = format!("tool_table = \"{table}\"");
    let bench = Operated::new(&instance, &[("# tool_table = \"tools.tbl\"", &named)], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    // One sentence, and what it tells to type is complete.
    let name = &instance.config().instance;
    let complete = format!("--instance {name} --config {}", bench.config());
    let told = bench.process(&["resume"]).wait().expect(5).stderr;
    let status = format!("`glidepath status {complete}`");
    assert_eq!(
        told.trim(),
        format!("error: resume refused: nothing is held; {status} says what the machine does")
    );

    let part = instance.file("part.ngc", PART);
    let running = bench.process(&["run-file", &part]);
    let status = bench.wait_for(MachineState::Awaiting);
    assert!(
        (status.position[0] - 1.0).abs() < 1e-9,
        "the wrong tool cuts"
    );
    let told = bench.operate(&["status"]).stdout;
    assert!(
        told.contains("the answer to M6, tool T2 (6 mm end mill), of line 3"),
        "{told}"
    );
    let told = bench.operate(&["status", "--json"]).json();
    assert_eq!(told["awaited"]["tool"]["number"], 2, "{told}");
    assert_eq!(told["awaited"]["tool"]["name"], "6 mm end mill", "{told}");
    std::thread::sleep(Duration::from_millis(500));
    bench.operate(&["acknowledge"]);
    let status = bench.wait_for(MachineState::ProgramStop);
    assert!((status.position[0] - 2.0).abs() < 1e-9);
    std::thread::sleep(Duration::from_millis(500));
    bench.operate(&["resume"]);
    let told = running.wait().expect(0).stderr;
    for words in [
        "line 3: change to tool T2 (6 mm end mill)".to_owned(),
        format!("`glidepath acknowledge {complete}`"),
        "line 5 (turn the part): at rest at a stop of the program, or at the end of a block"
            .to_owned(),
        format!("`glidepath resume {complete}` goes on"),
    ] {
        assert!(told.contains(&words), "{words}: {told}");
    }
    for process in [&service, &servo, &interpolator] {
        process.signal(Signal::TERM);
    }
    // Each says when it is ready, and names no variant.
    let told = service.wait().expect(0).stderr;
    assert!(told.contains("planner: ready"), "{told}");
    assert!(told.contains("nothing is kept over a restart"), "{told}");
    let told = servo.wait().expect(0).stderr;
    assert!(told.contains("servo: ready"), "{told}");
    let told = interpolator.wait().expect(0).stderr;
    assert!(told.contains("interpolator: ready"), "{told}");
    assert!(told.contains("running, before that "), "{told}");
    assert!(!told.contains("->") && !told.contains("Idle"), "{told}");
}

/// The second stop says nothing, and the tool is to be taken out.
const STOPS: &str = "G21 G90 G54\nG0 X1\nM0 (turn the part)\nG0 X2\nM0\nT0 M6\nG0 X3\nM2\n";

#[test]
fn what_a_stop_said_is_not_said_of_the_next_one() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let simulated = ("source = \"drives\"", "source = \"none\"");
    let bench = Operated::new(&instance, &[simulated], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    let part = instance.file("part.ngc", STOPS);
    let running = bench.process(&["run-file", &part]);
    for (line, said) in [(3, "turn the part"), (5, "")] {
        let stop = bench.wait(|status| {
            status.state == MachineState::ProgramStop.code()
                && status.line == line
                && (said.is_empty() || !status.message.as_str().is_empty())
        });
        assert_eq!(stop.message.as_str(), said, "line {line}");
        std::thread::sleep(Duration::from_millis(500));
        bench.operate(&["resume"]);
    }
    let _asks = bench.wait_for(MachineState::Awaiting);
    std::thread::sleep(Duration::from_millis(500));
    bench.operate(&["acknowledge"]);
    let told = running.wait().expect(0).stderr;
    for words in [
        "line 3 (turn the part): at rest",
        "line 5: at rest",
        "line 6: take the tool out of the spindle; when that is done",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }

    // On a machine without feedback there is no power to take: `disable` ends the motion.
    let long = instance.file("long.ngc", "G21 G90 G54\nG1 X50 F600\nM2\n");
    let running = bench.process(&["run-file", &long]);
    let _moves = bench.wait_for(MachineState::Running);
    bench.operate(&["disable"]);
    let rests = bench.wait_for(MachineState::Idle);
    assert!(rests.position[0] < 49.0, "{:?}", rests.position);
    let told = running.wait().expect(5).stderr;
    assert!(told.contains("`disable` ended it"), "{told}");
    bench.refused(&["disable"], 5, "no feedback is configured");

    // What was moved away in a hold does not stand where the program goes on.
    let running = bench.process(&["run-file", &long]);
    let _moves = bench.wait(|status| status.frames_executed > 100);
    bench.operate(&["hold"]);
    let _held = bench.wait_for(MachineState::Held);
    bench.operate(&["jog", "Z5"]);
    bench.operate(&["abort"]);
    let told = running.wait().expect(5).stderr;
    assert!(told.contains("once the axes are back: "), "{told}");
    assert!(told.contains("`glidepath jog Z-5"), "{told}");
    bench.refused(&["return"], 5, "no program is held");

    // A planner with a program of its own takes no jobs, and is not said to be away.
    let _ended = service.end();
    let own = bench.process(&["planner", &long]);
    let _moves = bench.wait_for(MachineState::Running);
    bench.refused(&["mdi", "G0 X1"], 5, "one of its own executes long.ngc");
    bench.operate(&["abort"]);
    let _aborted = own.wait().expect(5);
    let _ended = interpolator.end();
}

#[test]
fn a_watch_waits_for_an_interpolator_that_is_silent_and_says_so() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _seen = bench.wait(|status| status.ticks > 0);
    let watch = bench.process(&["status", "--watch", "--json", "--every", "0.1"]);
    for form in [&["--json"][..], &[]] {
        let read_once = [&["status", "--watch", "--every", "0.1"], form].concat();
        assert_eq!(
            Process::join_read_once(&instance, &read_once).code(),
            Some(0)
        );
    }
    std::thread::sleep(Duration::from_secs(1));
    interpolator.signal(Signal::STOP);
    std::thread::sleep(Duration::from_secs(4));
    interpolator.signal(Signal::CONT);
    std::thread::sleep(Duration::from_secs(2));
    interpolator.signal(Signal::TERM);
    let told = watch.wait().expect(5).stdout;
    let lines: Vec<Value> = told
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|error| panic!("{line}: {error}")))
        .collect();
    let is_silent = |line: &&Value| line["state"] == "silent";
    let silent = lines
        .iter()
        .rposition(|line| is_silent(&line))
        .expect(&told);
    assert!(lines[silent]["silent_s"].as_f64() > Some(2.0), "{told}");
    let after = lines[silent..].iter().filter(|line| line["ticks"].is_u64());
    assert!(after.count() > 1, "it goes on: {told}");
    assert!(
        lines.last().is_some_and(|line| line["error"].is_string()),
        "{told}"
    );
    let _ended = interpolator.wait();
}

#[test]
fn what_ended_a_way_back_to_the_path_is_told_as_it_was() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    for (ends, told) in [
        ("hold", "a hold ended the way back"),
        ("abort", "an abort or a fault ended the program"),
    ] {
        bench.operate(&["mdi", "G90 G0 X0 Y0 Z0"]);
        let running = bench.process(&["mdi", "G1 X50 F600"]);
        let _far = bench.wait(|status| status.position[0] > 2.0);
        bench.operate(&["hold"]);
        bench.operate(&["jog", "X30"]);
        let returning = bench.process(&["return"]);
        let _on_the_way = bench.wait_for(MachineState::Jogging);
        bench.operate(&[ends]);
        let said = returning.wait().stderr;
        assert!(said.contains(told), "{ends}: {said}");
        bench.operate(&["abort"]);
        let _ended = running.wait();
        let _rests = bench.wait_for(MachineState::Idle);
    }
    for process in [&service, &servo, &interpolator] {
        process.signal(Signal::TERM);
    }
}
