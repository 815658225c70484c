//! A program beside others who take every core.

use std::fmt::Write as _;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glidepath_tests::{Instance, Process, SetpointFile, Watchdog};

use crate::programs::recorded;

/// Seconds of motion, unless `GLIDEPATH_LOAD` says otherwise: some hundred for a long check.
const SHORT_S: u32 = 6;

/// A number that a variable of the environment gives, or another.
fn number(name: &str, otherwise: u32) -> u32 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
}

/// Corners of every kind, which take long to plan: rows of a pocket, with waves on them, of another
/// form in each program.
fn pocket(seconds: u32, program: u32) -> String {
    // Rests, which are planned at once, before motion that is not.
    let mut text = "G21 G90 G64 P0.02 F2400\nT1 M6\nS1000 M3\n".to_owned();
    // About 40 mm a second.
    for row in 0..seconds {
        let y = 0.4 * f64::from(row);
        for step in 0..=40_u32 {
            let along = if row % 2 == 0 { step } else { 40 - step };
            let wave = 0.15 * f64::from((step * (7 + program) + row * 3) % 5);
            let _ = writeln!(text, "G1 X{along} Y{:.3}", y + wave);
        }
    }
    text + "M2\n"
}

/// Spins on every core until it is dropped.
fn beside_load<R>(work: impl FnOnce() -> R) -> R {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                while !stop.load(Ordering::Relaxed) {
                    std::hint::spin_loop();
                }
            });
        }
        let end = OnDrop(|| stop.store(true, Ordering::Relaxed));
        let result = work();
        drop(end);
        result
    })
}

struct OnDrop<F: Fn()>(F);

impl<F: Fn()> Drop for OnDrop<F> {
    fn drop(&mut self) {
        (self.0)();
    }
}

#[test]
fn a_run_beside_load_on_every_core_is_the_plan_and_does_not_starve() {
    let seconds = number("GLIDEPATH_LOAD", SHORT_S);
    for program in 0..number("GLIDEPATH_LOAD_PROGRAMS", 1) {
        play_beside_load(seconds, program);
    }
}

#[allow(clippy::print_stderr, reason = "the figures of a long check")]
fn play_beside_load(seconds: u32, program: u32) {
    let patience = Duration::from_secs(240 + 4 * u64::from(seconds));
    let (instance, _watchdog) = (Instance::alone(), Watchdog::new(patience));
    let program = instance.file("program.ngc", &pocket(seconds, program));
    let csv = instance.path("run.csv");
    let run = recorded(&program, &csv);
    let output = beside_load(|| Process::start(&instance, &run).wait_for(patience));
    let report = output.expect(0).json();
    for key in [
        "planned_s",
        "played_s",
        "starved_ticks",
        "missed_ticks",
        "time_lost_s",
    ] {
        eprintln!("{key}: {}", report[key]);
    }
    assert_eq!(report["starved_ticks"], 0, "{report:#}");
    assert_eq!(report["time_lost_s"]["starvation"], 0.0, "{report:#}");
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
    let received = SetpointFile::read(Path::new(&csv));
    let csv = instance.path("plan.csv");
    let plan = ["plan", &program, "--setpoints", &csv, "--json"];
    let _report = Process::start(&instance, &plan)
        .wait_for(patience)
        .expect(0);
    let planned = SetpointFile::read(Path::new(&csv));
    assert!(!planned.is_still(), "an empty plan proves nothing");
    assert_eq!(received.moving(), planned.moving());
}
