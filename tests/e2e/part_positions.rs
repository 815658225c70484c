//! What is told of positions from part zero: those of the tip of the tool in force, as programs have them.
#![allow(clippy::float_cmp, reason = "values are exact")]

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Instance, Operated, Process, Watchdog};
use rustix::process::Signal;
use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(240);

/// Without drives that answer.
const SIMULATED: (&str, &str) = ("source = \"drives\"", "source = \"none\"");

/// The tool is changed, and its length called, in one block.
const PROGRAM: &str = "G21 G90 G54\nG0 Z-1\nT2 M6 G43.1 Z30\nM0\nG0 Z5\nM0\nM2\n";

/// Z of the machine and of the part, and the length, of plain `status` and of the watch.
fn told(bench: &Operated<'_>) -> [f64; 3] {
    let once = bench.operate(&["status", "--json"]).json();
    let watch = bench.process(&["status", "--watch", "--json", "--every", "0.05"]);
    watch.wait_until_it_says("\n");
    watch.signal(Signal::INT);
    let watched = watch.wait().expect(0).stdout;
    let watched: Value = serde_json::from_str(watched.lines().next().unwrap()).unwrap();
    for key in ["offset", "work_position", "position"] {
        let axis = |object: &Value| match key {
            "offset" => object[key].clone(),
            _ => object[key]["Z"].clone(),
        };
        assert_eq!(axis(&once), axis(&watched), "{key}");
    }
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let (machine, part) = (&once["position"]["Z"], &once["work_position"]["Z"]);
    [machine, part, &once["offset"]["tool_length"]["Z"]].map(number)
}

/// What a program would begin with is what whoever reads it beside the service begins with.
#[test]
fn a_program_is_checked_and_planned_with_what_the_service_has_in_force() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[SIMULATED], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    bench.operate(&["mdi", "G43.1 Z4"]);
    bench.operate(&["mdi", "G92 Y-2"]);
    bench.operate(&["mdi", "G20 G91"]);
    // Inches, from where the machine is, and then to the places of the part.
    let program = instance.file("program.ngc", "G1 X1 F20\nG90 Y0.5 Z0\nM2\n");
    let wanted = [25.4, 12.7 + 2.0, 4.0];
    let box_of = |arguments: &[&str]| {
        let report = bench.operate(arguments).json();
        let found = &report["programs"][0]["box"];
        ["X", "Y", "Z"].map(|axis| found[axis][1].as_f64().unwrap())
    };
    let end_of = |arguments: &[&str]| {
        let report = bench.operate(arguments).json();
        ["X", "Y", "Z"].map(|axis| report["final_position"][axis].as_f64().unwrap())
    };
    let near = |found: [f64; 3], wanted: [f64; 3]| {
        let is_near = found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9);
        assert!(is_near, "{found:?}, wanted {wanted:?}");
    };
    let check = ["check", &program, "--json"];
    near(box_of(&check), wanted);
    near(end_of(&["plan", &program, "--json"]), wanted);
    let said = bench.operate(&["check", &program]).stderr;
    let words = "G91 G94 M5 M9 T0 F0 S0 in force, shift of G92 or G52 Y2, tool length Z4";
    assert!(said.contains(words), "{said}");
    bench.operate(&["feed", &program]);
    bench.assert_at(wanted);
    bench.operate(&["mdi", "G90 G53 G0 X0 Y0 Z0"]);
    bench.operate(&["mdi", "G91"]);
    bench.operate(&["run-file", &program]);
    bench.assert_at(wanted);

    // A program begins where the machine stands.
    let on = instance.file("on.ngc", "G91 G1 X2\nM2\n");
    let report = bench.operate(&["check", &on, "--json"]).json();
    let found = &report["programs"][0]["box"]["X"];
    let ends = [0, 1].map(|end| found[end].as_f64().unwrap());
    assert!(
        (ends[0] - wanted[0]).abs() < 1e-9 && (ends[1] - wanted[0] - 50.8).abs() < 1e-9,
        "{ends:?}"
    );

    // What an abort has stopped is not in force, whatever a program has left.
    bench.operate(&["mdi", "M3 S500"]);
    let said = || bench.operate(&["check", &program]).stderr;
    assert!(said().contains(" M3 "), "{}", said());
    bench.operate(&["abort"]);
    bench.operate(&["mdi", "G4 P0.1"]);
    assert!(said().contains(" M5 "), "{}", said());

    // A service that was killed has nothing in force any more, and neither has the next one.
    service.signal(Signal::KILL);
    let _killed = service.wait();
    let fresh = "G21 G1 X1 F600\nY0.5 Z0\nM2\n";
    let fresh = instance.file("fresh.ngc", fresh);
    let report = bench.operate(&["check", &fresh, "--json"]).json();
    assert_eq!(report["programs"][0]["box"]["X"][1], 1.0);
    let said = bench.operate(&["check", &fresh]).stderr;
    assert!(!said.contains("in force"), "{said}");
    let _ended = interpolator.end();
}

#[test]
fn positions_from_part_zero_are_those_of_the_tip_from_the_move_behind_g43_on() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let state = format!("directory = {:?}", instance.path("kept"));
    let changes = [SIMULATED, ("# directory = \"state\"", state.as_str())];
    let bench = Operated::new(&instance, &changes, "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let _idle = bench.wait_for(MachineState::Idle);
    let service = bench.service();
    bench.operate(&["mdi", "G10 L2 P1 Z-10"]);
    assert_eq!(told(&bench), [0.0, 10.0, 0.0]);
    bench.operate(&["mdi", "G43.1 Z4"]);
    assert_eq!(told(&bench), [0.0, 6.0, 4.0]);
    let text = bench.operate(&["status"]).stdout;
    assert!(
        text.contains("  part          X 0.0000  Y 0.0000  Z 6.0000  (G54)"),
        "{text}"
    );

    // While the tool is changed, the one before is in force.
    let program = instance.file("program.ngc", PROGRAM);
    let job = bench.process(&["run-file", &program]);
    let _asked = bench.wait_for(MachineState::Awaiting);
    assert_eq!(told(&bench), [-7.0, -1.0, 4.0]);
    bench.operate(&["acknowledge"]);
    let _stop = bench.wait_for(MachineState::ProgramStop);
    bench.operate(&["resume"]);
    let _moved =
        bench.wait(|status| status.state == MachineState::ProgramStop.code() && status.line == 6);
    assert_eq!(told(&bench), [25.0, 5.0, 30.0]);
    // What was executed is in force, also behind an abort.
    bench.operate(&["abort"]);
    let _ended = job.wait();
    let _idle = bench.wait_for(MachineState::Idle);
    assert_eq!(told(&bench), [25.0, 5.0, 30.0]);
    bench.operate(&["mdi", "G49"]);
    assert_eq!(told(&bench), [25.0, 35.0, 0.0]);

    // So are they from the zero that G92 has shifted, and that is said.
    bench.operate(&["mdi", "G92 Z3"]);
    assert_eq!(told(&bench), [25.0, 3.0, 0.0]);
    let text = bench.operate(&["status"]).stdout;
    assert!(
        text.contains("Z 3.0000  (G54, shifted by Z32 (G92 or G52))"),
        "{text}"
    );
    bench.operate(&["mdi", "G92.2"]);
    assert_eq!(told(&bench), [25.0, 35.0, 0.0]);
    let show = ["offsets", "show", "--config", bench.config()];
    let kept = Process::start(&instance, &show).wait().expect(0).stdout;
    assert!(kept.contains("G92   Z32   kept; "), "{kept}");
    bench.operate(&["mdi", "G92.3"]);
    assert_eq!(told(&bench), [25.0, 3.0, 0.0]);

    // What a stream has in force, its client alone knows.
    let streamed = instance.file(
        "streamed.ngc",
        "G21 G90 G55\nG92 Z100\nG1 Z101 F600\nM0\nM2\n",
    );
    let feed = bench.process(&["feed", &streamed]);
    let _stop = bench.wait_for(MachineState::ProgramStop);
    let told_of_stream = bench.operate(&["status", "--json"]).json();
    for key in ["offset", "work_position"] {
        assert_eq!(told_of_stream[key], Value::Null, "{key}");
    }
    bench.operate(&["resume"]);
    let _fed = feed.wait().expect(0);
    let _idle = bench.wait_for(MachineState::Idle);
    assert_eq!(told(&bench), [26.0, 4.0, 0.0]);

    // A service that begins, begins without.
    bench.operate(&["mdi", "G43.1 Z4"]);
    let _service = service.end().expect(0);
    let service = bench.service();
    bench.operate(&["mdi", "G4 P0.1"]);
    assert_eq!(told(&bench), [26.0, 36.0, 0.0]);
    drop((service, interpolator));
}
