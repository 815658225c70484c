//! A thread by the encoder of an emulated spindle, with the processes of a machine.

use std::time::Duration;

use glidepath_link::{MachineState, SpindleFlags, Status};
use glidepath_testing::{Pulse, is_crowded, skip};
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);
/// By how much a thread may be late on a host that hands frames on in time.
const IN_TIME: Duration = Duration::from_millis(4);
/// S, rev/min.
const SPEED: f64 = 600.0;

fn line() -> String {
    let drives = super::three_drives();
    format!(
        "[bus]\ninterface = \"none\"\n{drives}[[device]]\nposition = 3\n\
         spindle = {{ mode = \"velocity\", max_rpm = 6000.0, ramp = 4000.0 }}\n\
         [[device]]\nposition = 4\nencoder = {{ counts_per_rev = 4096 }}\n"
    )
}

#[test]
fn a_thread_follows_an_encoder_at_a_terminal() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let changes = [
        ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\""),
        ("encoder = false", "encoder = true"),
    ];
    let bench = Operated::new(&instance, &changes, "");
    let drives = instance.file("drives.toml", &line());
    let Some((interpolator, bus)) = super::emulated_drives(&instance, &bench, &drives) else {
        return;
    };
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    bench.operate(&["mdi", "M3 S600"]);
    let turns = |status: &Status| (status.spindle_v - SPEED / 60.0).abs() < 0.1;
    let status = instance.wait_for_status(turns);
    assert!(status.spindle().contains(SpindleFlags::ANGLE));
    assert!(status.spindle().contains(SpindleFlags::INDEX));
    let program = instance.file(
        "thread.ngc",
        "G21 G90 G97 S600 M3\nG0 Z2\nG33 Z-10 K1.5\nM5\nM2\n",
    );
    let pulse = Pulse::start();
    let output = bench.process(&["run-file", &program]).wait();
    // In a thread nothing can be slowed down: what comes late is a fault, and should be.
    let late = ["frames ran out", "old", "angle was not told"];
    let is_late = |text: &str| late.iter().any(|what| text.contains(what));
    let is_busy = pulse.worst() > IN_TIME || is_crowded();
    let is_skipped = output.status.code() != Some(0) && is_late(&output.stderr) && is_busy;
    if is_skipped {
        skip("a thread", &output.stderr);
    } else {
        let _done = output.expect(0);
        bench.assert_at([0.0, 0.0, -10.0]);
    }
    let ended = bus.end().expect(0);
    assert!(!ended.stderr.contains("is off by"), "{ended:?}");
    for process in [service, interpolator] {
        let _ended = process.end();
    }
}
