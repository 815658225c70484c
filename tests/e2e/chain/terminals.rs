//! Terminals beside emulated drives, with the processes of a machine: a program waits for an input and
//! moves by what it reads, and the bridge goes on without a terminal missing.

use std::time::Duration;

use glidepath_link::{MachineState, SpindleFlags, Status};
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);

/// Two drives in one device, one in another, terminals whose inputs are low, and the drive of a spindle.
const LINE: &str = r#"[bus]
interface = "none"
[[drive]]
joint = 0
position = 0
counts_per_mm = 100000.0
following_error = 50.0
quick_stop = 2000.0
[[drive]]
joint = 1
position = 0
axis = 1
counts_per_mm = 100000.0
following_error = 50.0
quick_stop = 2000.0
[[drive]]
joint = 2
position = 3
counts_per_mm = 100000.0
following_error = 50.0
quick_stop = 2000.0
[[device]]
position = 1
inputs = [
    { at = "0x6000:01", number = 0 },
    { at = "0x6010:01", number = 7, invert = true },
]
[[device]]
position = 2
outputs = [
    { at = "0x7000:01", from = "spindle.forward" },
    { at = "0x7010:01", from = "output 5" },
]
analog_outputs = [{ at = "0x7020:01", from = "spindle.speed", full = 24000.0, counts = 32767 }]
[[device]]
position = 4
spindle = { mode = "velocity", max_rpm = 24000.0, ramp = 20000.0 }
"#;

/// X says what the second input was, and Y what the first one was, which somebody closes meanwhile.
const PROGRAM: &str = "G21 G90 F3000\nM3 S6000\nM62 P5\nG1 X1\nM63 P5\nM66 P7 L3 Q30\nG1 X[2+#5399]\n\
                       M66 P0 L3 Q120\nG1 Y[2+#5399]\nM5\nM2\n";

#[test]
fn programs_read_terminals_and_switch_them() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let real = ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\"");
    let bench = Operated::new(&instance, &[real], "");
    let line = instance.file("drives.toml", LINE);
    let inputs = instance.file("inputs.txt", "input 7 on\n");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let emulated = [
        "ethercat",
        "--emulated",
        "--best-effort",
        "--json",
        "--drives",
        &line,
        "--emulated-inputs",
        &inputs,
    ];
    let bus = bench.process(&emulated);
    let Some(bus) = super::emulated(&instance, bus) else {
        let _ended = interpolator.end().expect(0);
        return;
    };
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    let program = instance.file("inputs.ngc", PROGRAM);
    let planner = bench.process(&["planner", &program]);
    // It rests there, and the spindle turns as fast as it was told to, in rev/s.
    let is_there = |status: &Status| (status.position[0] - 3.0).abs() < 1e-9;
    let turns = |status: &Status| (status.spindle_v - 100.0).abs() < 1.0;
    let waits = instance.wait_for_status(|status| is_there(status) && turns(status));
    assert!(waits.spindle().contains(SpindleFlags::SPEED));
    // What is wrong is told, and changes nothing.
    let _wrong = instance.file("inputs.txt", "input 7 on\ninput 0 closed\n");
    std::thread::sleep(Duration::from_millis(300));
    let _right = instance.file("inputs.txt", "input 7 on\ninput 0 on # by hand\n");
    let _ended = planner.wait().expect(0);
    bench.assert_at([3.0, 3.0, 0.0]);
    let ended = bus.end().expect(0);
    assert!(
        ended.stderr.contains("inputs.txt:2:1: a line is"),
        "{ended:?}"
    );
    let report = ended.json();
    assert_eq!(report["bad_working_counters"], 0, "{report:#}");
    assert_eq!(report["bus_restarts"], 0, "{report:#}");
    let _ended = interpolator.end().expect(0);
}
