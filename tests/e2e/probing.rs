//! Tests of a probe: programs and lines that go on from where it touched.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);

/// Where the imitated part begins, machine coordinates, mm.
const PART_Z: f64 = -7.25;

/// Fast to the part, back, and slowly to it again; then Z0 is its surface.
const TOUCH_OFF: &str = "G21 G90 G94 G54\nG0 X5 Y2\nG38.2 Z-20 F300\nG91 G0 Z1\nG38.2 Z-3 F30\nG90\n\
                         G10 L20 P1 Z[#5422 - #5063]\nG0 Z3\nM2\n";

#[test]
fn programs_go_on_from_where_the_probe_touched() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let reads = ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\"");
    let probe = ("# input = 0\n", "input = 0\n");
    let bench = Operated::new(&instance, &[reads, probe], "");
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let touches = format!("J2={PART_Z}");
    let servo = bench.process(&[
        "servo",
        "--best-effort",
        "--stands",
        "1,2,10",
        "--probe",
        &touches,
    ]);
    let _seen = bench.wait_for_drives();
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);

    let program = instance.file("touch.ngc", TOUCH_OFF);
    // The second time its offset is in force already.
    for _ in 0..2 {
        bench.operate(&["run-file", &program]);
        let [x, y, z] = bench.position();
        assert!((x - 5.0).abs() < 1e-9 && (y - 2.0).abs() < 1e-9, "{x} {y}");
        // F30 is half a micrometre between two samples of a drive; a host of tests takes fewer.
        assert!((z - PART_Z - 3.0).abs() < 0.02, "{z}");
    }
    let z = bench.position()[2];

    // Without a contact it is an error, or not, as the code says.
    bench.operate(&["mdi", "G38.3 Z20 F600"]);
    bench.operate(&["mdi", "G0 X[5+#5070]"]);
    let position = bench.position();
    assert!((position[0] - 5.0).abs() < 1e-9, "{position:?}");
    bench.refused(&["mdi", "G38.2 Z30 F600"], 5, "did not find a contact");
    bench.refused(&["mdi", "G38.2 Z-90 F9000"], 1, "too fast for the probe");
    bench.operate(&["mdi", "G0 Z3"]);
    assert!((bench.position()[2] - z).abs() < 1e-9);

    for process in [service, servo, interpolator] {
        let _ended = process.end().expect(0);
    }
}
