//! What is told of a machine at rest in a program: what keeps it there, and what goes on from there.

use std::time::Duration;

use glidepath_link::{MachineState, Status};
use glidepath_tests::{Instance, Operated, Watchdog};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(240);

/// Without drives that answer.
const SIMULATED: (&str, &str) = ("source = \"drives\"", "source = \"none\"");

const PART: &str = "G21 G90 G54\nG1 X120 F600\nG1 X150\nM2\n";

/// What plain `status` says, in one piece.
fn status(bench: &Operated<'_>) -> String {
    bench.operate(&["status"]).stdout
}

/// The commands that a text names, as they are typed.
fn commands(text: &str) -> Vec<Vec<&str>> {
    let told = text
        .split('`')
        .filter_map(|it| it.strip_prefix("glidepath "));
    told.map(|command| {
        let words = command.split(" --instance").next().unwrap_or_default();
        words.split_whitespace().collect()
    })
    .collect()
}

/// Does what the state tells, one after the other, until the program runs.
fn does_what_is_told(bench: &Operated<'_>) {
    let told = status(bench);
    let doing = told.lines().find(|line| line.contains("this is"));
    assert!(doing.is_some(), "{told}");
    let doing = doing.unwrap();
    let told = commands(doing);
    assert!(!told.is_empty(), "{doing}");
    for command in told {
        let state = bench.wait(|_| true).state();
        if state == Ok(MachineState::Running) {
            break;
        }
        bench.operate(&command);
        std::thread::sleep(Duration::from_millis(300));
    }
    let _runs = bench.wait_for(MachineState::Running);
}

#[test]
fn what_a_state_tells_is_what_goes_on_from_there() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[SIMULATED], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _seen = bench.wait(|status| status.ticks > 0);
    let planner = bench.service();
    let part = instance.file("part.ngc", PART);
    bench.operate(&["single-block", "on"]);
    let running = bench.process(&["run-file", &part]);

    // A jog in a hold: the way back comes first, and how far it is is shown.
    let _moves = bench.wait(|status| status.position[0] > 1.0);
    bench.operate(&["hold"]);
    let _held = bench.wait_for(MachineState::Held);
    assert!(!status(&bench).contains("  away "));
    bench.operate(&["jog", "Z5"]);
    let told = status(&bench);
    assert!(
        told.contains("  away          Z 5.0000, from the path"),
        "{told}"
    );
    bench.refused(&["resume"], 5, "away from the path");
    does_what_is_told(&bench);

    // Overrides of 0.
    for (stop, words) in [
        (&["override", "0"][..], "feed override of 0 %"),
        (&["override", "0", "--rapid", "0"], "overrides of 0 %"),
    ] {
        bench.operate(stop);
        let _held = bench.wait_for(MachineState::Held);
        let told = status(&bench);
        assert!(told.contains(words), "{told}");
        bench.refused(&["resume"], 5, "override is 0 %");
        bench.refused(&["step"], 5, "override is 0 %");
        does_what_is_told(&bench);
    }
    // With a hold besides.
    bench.operate(&["hold"]);
    bench.operate(&["override", "0"]);
    let _held = bench.wait_for(MachineState::Held);
    does_what_is_told(&bench);

    // Away from the path at the end of a block.
    let at_end = |status: &Status| status.state() == Ok(MachineState::ProgramStop);
    let _stands = bench.wait(at_end);
    std::thread::sleep(Duration::from_millis(500));
    bench.operate(&["jog", "Y2"]);
    let _stands = bench.wait(at_end);
    bench.operate(&["single-block", "off"]);
    does_what_is_told(&bench);
    let told = running.wait().expect(0).stderr;
    assert!(
        told.contains("line 2: at rest at a stop of the program, or at the end of a block"),
        "{told}"
    );
    assert!(!told.contains("the program stopped"), "{told}");
    drop((planner, interpolator));
}

#[test]
fn whoever_jogs_while_another_does_is_told_so_and_not_to_stop_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[SIMULATED], "");
    let _interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _seen = bench.wait(|status| status.ticks > 0);
    let first = bench.process(&["jog", "X20", "--feed", "600"]);
    let _jogs = bench.wait_for(MachineState::Jogging);
    bench.refused(&["jog", "X5"], 5, "another client jogs");
    let _first = first.wait().expect(0);
    bench.operate(&["jog", "X5"]);
    bench.assert_at([25.0, 0.0, 0.0]);
}

#[test]
fn a_program_that_ends_early_says_where_and_what_goes_on_with_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[SIMULATED], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _seen = bench.wait(|status| status.ticks > 0);
    let part = instance.file("a part.ngc", PART);
    let at = |mm: f64| {
        let _there = bench.wait(|status| status.position[0] > mm);
    };
    // Goes on with what was told, which is complete, up to a place.
    let go_on = |told: &str, command: &str| {
        let told = told
            .split('`')
            .find(|it| it.starts_with(&format!("glidepath {command}")));
        let told = told.expect("a command");
        assert!(
            told.contains("--resume") && told.contains(&format!("'{part}'")),
            "{told}"
        );
        bench.process(&[command, &part, "--resume"])
    };
    let planner = bench.process(&["planner", &part]);
    at(1.0);
    bench.operate(&["abort"]);
    let told = planner.wait().expect(5).stderr;
    assert!(
        told.contains("aborted by an operator; it was left in line 2, and "),
        "{told}"
    );

    let service = bench.service();
    let running = go_on(&told.replace("planner", "run-file"), "run-file");
    at(10.0);
    bench.operate(&["abort"]);
    let told = running.wait().expect(5).stderr;
    assert!(
        told.contains("aborted by an operator; it was left in line 2, and "),
        "{told}"
    );

    let running = go_on(&told, "run-file");
    at(20.0);
    service.signal(Signal::KILL);
    let told = running.wait().expect(5).stderr;
    let _faulted = bench.wait_for(MachineState::Faulted);
    bench.operate(&["reset"]);
    let _service = bench.service();
    let running = go_on(&told, "run-file");
    at(30.0);
    interpolator.signal(Signal::TERM);
    let told = running.wait().expect(5).stderr;
    assert!(told.contains("the interpolator was told to end"), "{told}");
    assert!(
        !told.contains("operator") && !told.contains("--resume"),
        "{told}"
    );
}
