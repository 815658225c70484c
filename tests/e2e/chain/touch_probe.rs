//! Touch probes of emulated drives, with the processes of a machine: where a contact was is what the drives
//! have kept, at any speed, and however late this host is.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);
/// Where the part begins, mm.
const PART_Z: f64 = -3.271_83;
/// Counts a mm: a micrometre is a hundred.
const COUNTS: f64 = 100_000.0;

fn line() -> String {
    let drive = |joint: usize| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = {COUNTS:.1}\nfollowing_error = 50.0\n\
             quick_stop = 2000.0\nprobe = {{ number = 0 }}\n"
        )
    };
    let drives: String = (0..3).map(drive).collect();
    format!(
        "[bus]\ninterface = \"none\"\n{drives}[[device]]\nposition = 3\n\
         inputs = [{{ at = \"0x6000:01\", number = 0 }}]\n"
    )
}

#[test]
fn a_contact_is_where_the_drives_have_kept_it_at_any_speed() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let reads = ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\"");
    let probe = ("# input = 0\n", "input = 0\n");
    let bench = Operated::new(&instance, &[reads, probe], "");
    let drives = instance.file("drives.toml", &line());
    let inputs = instance.file("inputs.txt", &format!("input 0 at J2 {PART_Z}\n"));
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let emulated = [
        "ethercat",
        "--emulated",
        "--emulated-period-us",
        "4000",
        "--best-effort",
        "--drives",
        &drives,
        "--emulated-inputs",
        &inputs,
    ];
    let bus = bench.process(&emulated);
    let Some(bus) = super::emulated(&instance, bus) else {
        let _ended = interpolator.end().expect(0);
        return;
    };
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    for feed in [60, 300, 1200] {
        let search = format!("G21 G90 G54 G38.2 X-2 Y1 Z-4 F{feed}");
        bench.operate(&["mdi", &search]);
        // To where the program was told that it touched, which is on the line from the machine's zero.
        bench.operate(&["mdi", "G0 X#5061 Y#5062 Z#5063"]);
        let [x, y, z] = bench.position();
        for (told, part) in [(x, PART_Z / 2.0), (y, -PART_Z / 4.0), (z, PART_Z)] {
            let error = (told - part).abs();
            assert!(error <= 1e-3, "F{feed}: {told} for {part}");
        }
        bench.operate(&["mdi", "G0 X0 Y0 Z0"]);
    }
    let ended = bus.end().expect(0);
    assert!(
        !ended.stderr.contains("is found from positions"),
        "{ended:?}"
    );
    for process in [service, interpolator] {
        let _ended = process.end().expect(0);
    }
}
