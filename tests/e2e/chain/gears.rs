//! The gears of an emulated spindle, with the processes of a machine: by the speed of a program and by its words,
//! and one that does not come in.

use std::time::Duration;

use glidepath_link::{FaultCause, MachineState, SpindleFlags};
use glidepath_tests::{Instance, Operated, Watchdog};

const PATIENCE: Duration = Duration::from_secs(240);
/// How near a spindle is to its speed where it is "at speed", as a part of it, and a little for its noise.
const AT_SPEED: f64 = 0.04;

/// Three drives, the outputs and inputs of two gears, and the drive of the spindle. `shift` says how they are changed.
fn line(shift: &str) -> String {
    let drives = super::three_drives();
    format!(
        "[bus]\ninterface = \"none\"\n{drives}\
         [[device]]\nposition = 3\ninputs = [{{ at = \"0x6000:01\", number = 10 }}, {{ at = \"0x6010:01\", number = 11 }}]\n\
         [[device]]\nposition = 4\noutputs = [{{ at = \"0x7000:01\", from = \"spindle.gear 1\" }}, \
         {{ at = \"0x7010:01\", from = \"spindle.gear 2\" }}]\n\
         [[device]]\nposition = 5\nspindle = {{ mode = \"velocity\", max_rpm = 4000.0, ramp = 8000.0, gears = [\n\
         {{ ratio = 4.0, max_rpm = 800.0, ramp = 2000.0, input = 10 }},\n\
         {{ ratio = 0.8, invert = true, input = 11 }},\n], shift = {{ {shift} }} }}\n"
    )
}

/// A machine with these gears. S chooses between them until a program has a word for it.
fn bench(instance: &Instance) -> Operated<'_> {
    let changes = [
        ("inputs_outputs = \"none\"", "inputs_outputs = \"feedback\""),
        ("# gear_max = ", "gear_max = "),
        ("# gear_min = ", "gear_min = "),
        ("gear_choice = \"words\"", "gear_choice = \"speed\""),
    ];
    let waits = "\n[m_codes.M3-M4]\ndone = \"spindle-at-speed\"\nat = \"next-feed\"\ntimeout_s = 60\n\
                 [m_codes.M41-M42]\ndone = \"spindle-in-gear\"\ntimeout_s = 60\n";
    Operated::new(instance, &changes, waits)
}

/// Y is 2 where the second gear was in, and Z 1 where the first one was behind it.
const PROGRAM: &str = "G21 G90 G64 P0.02 F1200\nS600 M3\nG1 X10\nS3000 M3\nG1 X20\nM66 P11 L0\nG1 Y[2*#5399]\n\
                       M41 S400 M4\nG1 X10\nM66 P10 L0\nG1 Z[#5399]\nM5\nM2\n";
/// Its lines with long feeds, and how fast the spindle turns in each, rev/s.
const FEEDS: [(u64, f64); 3] = [(3, 10.0), (5, 50.0), (9, -400.0 / 60.0)];

#[test]
fn speeds_and_words_change_gears_and_axes_move_when_one_is_in() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = bench(&instance);
    let drives = instance.file("drives.toml", &line("swing_rpm = 60.0"));
    let Some((interpolator, bus)) = super::emulated_drives(&instance, &bench, &drives) else {
        return;
    };
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    let program = instance.file("gears.ngc", PROGRAM);
    let planner = bench.process(&["planner", &program]);
    for (line, turns_v) in FEEDS {
        // In the middle of the feed, so that what is told of the spindle is of the same feed.
        let feed = instance.wait_for_status(|status| {
            let way = (status.position[0] - 15.0)
                .abs()
                .min((status.position[0] - 5.0).abs());
            u64::from(status.line) == line && way < 4.0
        });
        let off = (feed.spindle_v - turns_v).abs();
        assert!(off < AT_SPEED * turns_v.abs(), "line {line}: {feed:#?}");
        assert!(
            feed.spindle().contains(SpindleFlags::IN_GEAR),
            "line {line}"
        );
    }
    let _ended = planner.wait().expect(0);
    bench.assert_at([10.0, 2.0, 1.0]);
    for process in [bus, interpolator] {
        let _ended = process.end().expect(0);
    }
}

#[test]
fn a_gear_that_does_not_come_in_stops_the_motion_in_front_of_it() {
    let (instance, _watchdog) = (Instance::for_processes(), Watchdog::new(PATIENCE));
    let bench = bench(&instance);
    // The emulated gearbox takes .3 s.
    let drives = instance.file("drives.toml", &line("within_s = 0.1"));
    let Some((interpolator, bus)) = super::emulated_drives(&instance, &bench, &drives) else {
        return;
    };
    bench.operate(&["enable"]);
    let _ready = bench.wait_for(MachineState::Idle);
    let program = instance.file(
        "gears.ngc",
        "G21 G90 F1200\nM41 S600 M3\nG1 X5\nM42\nG1 X9\nM5\nM2\n",
    );
    let planner = bench.process(&["planner", &program]);
    let stopped = bench.wait_for(MachineState::Faulted);
    assert_eq!(stopped.fault(), Ok(Some(FaultCause::SpindleGear)));
    let text = stopped.fault_text().unwrap_or_default();
    assert!(text.contains("gear 2 (M42)"), "{text}");
    assert!((stopped.position[0] - 5.0).abs() < 1e-9, "{stopped:#?}");
    assert!(stopped.spindle_v.abs() < 0.1, "{stopped:#?}");
    let output = planner.wait();
    assert_ne!(output.status.code(), Some(0), "{output:#?}");
    assert!(output.stderr.contains("gear 2 (M42)"), "{output:#?}");
    // It has come in meanwhile: after a reset the same word finds it.
    bench.operate(&["reset"]);
    let _ready = bench.wait_for(MachineState::Idle);
    let rest = instance.file("rest.ngc", "G21 G90 F1200\nM42 S3000 M3\nG1 X9\nM5\nM2\n");
    let _ended = bench.process(&["planner", &rest]).wait().expect(0);
    bench.assert_at([9.0, 0.0, 0.0]);
    for process in [bus, interpolator] {
        let _ended = process.end().expect(0);
    }
}
