//! Joints that are where encoders at a terminal say, one that only counts and an absolute one, with the processes of a
//! machine.

use std::time::Duration;

use glidepath_link::MachineState;
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);

fn line() -> String {
    let drives = super::three_drives();
    format!(
        "[bus]\ninterface = \"none\"\n{drives}[[device]]\nposition = 3\njoint_encoders = [\n\
         {{ joint = 0, use = \"position\", counts_per_mm = 2000.0, apart = 0.5, invert = true }},\n\
         {{ joint = 2, use = \"position\", at = \"0x6010:11\", counts_per_mm = 2000.0, apart = 0.5, \
         home_offset = 7.5 }},\n]\n"
    )
}

#[test]
fn joints_are_where_encoders_at_a_terminal_say() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = Operated::new(&instance, &[], "");
    let drives = instance.file("drives.toml", &line());
    let Some((interpolator, bus)) = super::emulated_drives(&instance, &bench, &drives) else {
        return;
    };
    let service = bench.service();
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    bench.operate(&["mdi", "G1 X12 Z-4 F3000"]);
    let is_there = |joint: usize, at: f64| {
        move |status: &glidepath_link::Status| (status.joint_actual[joint] - at).abs() < 0.002
    };
    let _x = instance.wait_for_status(is_there(0, 12.0));
    let _z = instance.wait_for_status(is_there(2, -4.0));
    let _rests = bench.wait_for(MachineState::Idle);
    bench.assert_at([12.0, 0.0, -4.0]);
    let ended = bus.end().expect(0);
    assert!(!ended.stderr.contains("what its drive"), "{ended:?}");
    for process in [service, interpolator] {
        let _ended = process.end();
    }
}
