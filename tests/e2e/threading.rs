//! Tests of threads: the machine that is shipped for them, with a spindle that is simulated.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_testing::{is_crowded, skip};
use glidepath_tests::{Instance, Operated, Process, Watchdog};
use rustix::process::Signal;

const PATIENCE: Duration = Duration::from_secs(240);

/// Three passes of an outside thread with a way out, a pass by itself, and a tapped hole.
const THREAD: &str = "G18 G21 G90 G97 S600 M3\nG0 X12 Z4\nG76 P1.5 Z-10 I-2 J0.4 K0.8 E1 L2\n\
                      G0 Z4\nX8\nG33 Z-6 K1.5\nG0 X12\nZ2\nX0\nG33.1 Z-8 K1\nG0 Z5\nM5\nM2\n";

#[test]
fn a_thread_is_cut_by_the_machine_that_is_shipped_and_refused_by_one_without_an_encoder() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let program = instance.file("thread.ngc", THREAD);
    let lathe = concat!(env!("CARGO_MANIFEST_DIR"), "/../config/lathe.toml");
    let csv = instance.path("run.csv");
    let run = [
        "run",
        &program,
        "--config",
        lathe,
        "--best-effort",
        "--setpoints",
        &csv,
        "--json",
    ];
    let output = Process::start(&instance, &run).wait();
    // In a thread nothing can be slowed down: frames that come late are a fault, and should be.
    if output.stdout.contains("frames ran out") && is_crowded() {
        skip(
            "a thread",
            "the host had other things to do, and frames ran out",
        );
        return;
    }
    let report = output.expect(0).json();
    for ratio in [
        "max_velocity_ratio",
        "max_acceleration_ratio",
        "max_jerk_ratio",
    ] {
        assert!(report[ratio].as_f64().unwrap() <= 1.0 + 1e-6, "{report:#}");
    }
    // At the bottom of a groove, Z goes by the spindle: 1.5 mm at 10 revolutions a second.
    let text = std::fs::read_to_string(&csv).unwrap();
    let positions: Vec<[f64; 2]> = text.lines().skip(1).map(x_and_z).collect();
    let steady = positions.windows(2).filter(|pair| {
        let [way_x, way_z] = [0, 1].map(|axis| pair[1][axis] - pair[0][axis]);
        way_x.abs() < 1e-9 && (way_z + 1.5 * 10.0 * 0.004).abs() < 1e-9
    });
    assert!(steady.count() > 400);
    // The hole: down to where the program says, with the spindle told to turn back before, by what
    // the machine's configuration says that it runs on; in and out with 1 mm a revolution.
    let hole: Vec<f64> = positions
        .iter()
        .filter(|[x, _]| *x == 0.0)
        .map(|[_, z]| *z)
        .collect();
    let deepest = hole.iter().fold(0.0_f64, |low, z| low.min(*z));
    assert!((-8.2..-7.9).contains(&deepest), "{deepest}");
    for way in [-1.0, 1.0] {
        let with = hole
            .windows(2)
            .filter(|pair| (pair[1] - pair[0] - way * 10.0 * 0.004).abs() < 1e-6);
        assert!(with.count() > 100, "{way}");
    }
    assert_eq!(
        report["final_position"]["Z"].as_f64(),
        Some(5.0),
        "{report:#}"
    );

    let check = ["check", &program];
    let refused = Process::start(&instance, &check).wait().expect(1);
    let said = format!("{}{}", refused.stdout, refused.stderr);
    assert!(
        said.contains("[spindle]") && said.contains("encoder = true"),
        "{said}"
    );
}

#[test]
fn an_abort_in_a_thread_does_not_lift_the_tool() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let lift = ("\nlift = 0.0 ", "\nlift = 3.5 ");
    let encoder = ("encoder = false", "encoder = true ");
    let bench = Operated::new(&instance, &[lift, encoder], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let servo = bench.process(&["servo", "--best-effort", "--stands", "0,0,0"]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);

    // 16 s of it are left, of which both stops wait for 2 s each: a busy host takes its time in between.
    let part = "G21 G90 G97 S30 M3\nG0 X1 Z2\nG33 Z-6 K1\nG0 X9\nM2\n";
    let part = instance.file("pass.ngc", part);
    let running = bench.process(&["run-file", &part]);
    let _in_pass = bench.wait(|status| status.line == 3 && status.position[2] < 1.9);
    // Stops that were accepted, and have not come to their end: neither is a machine at rest.
    let held = bench.process(&["hold"]).wait();
    let told = bench.process(&["abort"]).wait();
    // Where frames ran out, the pass has ended in a fault, and both found a machine at rest.
    if bench.wait(|_| true).state == MachineState::Faulted.code() && is_crowded() {
        skip(
            "a thread",
            "the host had other things to do, and frames ran out",
        );
        return;
    }
    let held = held.expect(8);
    assert!(held.stdout.contains("still moves"), "{}", held.stdout);
    let told = told.expect(8);
    assert!(told.stderr.contains("not lifted"), "{}", told.stderr);
    assert!(told.stdout.contains("still moves"), "{}", told.stdout);
    let status = bench.operate(&["status", "--json"]).json();
    let text = status["state_text"].as_str().unwrap();
    assert!(text.contains("comes to its end first"), "{text}");
    let _ended = running.wait();
    let status = bench.wait_for(MachineState::Idle);
    assert_eq!(status.position[..3], [1.0, 0.0, -6.0]);

    // Anywhere else it is.
    let part = instance.file("cut.ngc", "G21 G90\nG0 Z-6\nG1 X60 F1200\nM2\n");
    let running = bench.process(&["run-file", &part]);
    let _cuts = bench.wait(|status| status.position[0] > 5.0);
    bench.operate(&["abort"]);
    let _ended = running.wait();
    let status = bench.wait_for(MachineState::Idle);
    assert!((status.position[2] + 2.5).abs() < 1e-9);
    for process in [&service, &servo, &interpolator] {
        process.signal(Signal::TERM);
    }
}

/// The positions of both axes in a row of setpoints: behind six columns, with velocity and
/// acceleration behind each.
fn x_and_z(row: &str) -> [f64; 2] {
    let column = |index| row.split(',').nth(index).unwrap().parse().unwrap();
    [column(6), column(9)]
}
