//! Tests of a program beside others who take every core.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use glidepath_testing::leave_out;
use glidepath_tests::{Instance, Process, SetpointFile, Watchdog, pocket};

use crate::programs::recorded;

/// Seconds of motion, unless `GLIDEPATH_LOAD` says otherwise: some hundred for a long check.
const SHORT_S: u32 = 6;

/// The part of the time of a motion in which a host plans it beside the load that must not wait for frames: the
/// interpolator, which is another load, is not there then.
const IN_TIME: f64 = 0.5;

/// A number that a variable of the environment gives, or another.
fn number(name: &str, otherwise: u32) -> u32 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
}

/// Rests, which are planned at once, before motion that is not.
fn program(seconds: u32, form: u32) -> String {
    // About 40 mm a second.
    format!("T1 M6\nS1000 M3\n{}", pocket(seconds, form))
}

/// Spins on every core meanwhile: once, unless `GLIDEPATH_LOAD_BUSY` says otherwise. Eight a core are a host that
/// compiles something large, and leave ordinary planning too little.
fn beside_load<R>(work: impl FnOnce() -> R) -> R {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let busy = cores * number("GLIDEPATH_LOAD_BUSY", 1) as usize;
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for _ in 0..busy {
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
    for form in 0..number("GLIDEPATH_LOAD_PROGRAMS", 1) {
        play_beside_load(seconds, form);
    }
}

#[allow(clippy::print_stderr, reason = "the figures of a long check")]
fn play_beside_load(seconds: u32, form: u32) {
    let patience = Duration::from_secs(240 + 4 * u64::from(seconds));
    let (instance, _watchdog) = (Instance::alone(), Watchdog::new(patience));
    let program = instance.file("program.ngc", &program(seconds, form));
    let csv = instance.path("plan.csv");
    let plan = ["plan", &program, "--setpoints", &csv, "--json", "--force"];
    // How long planning takes beside the load, as a part of the time that the motion takes.
    let planning = || {
        let output = beside_load(|| Process::start(&instance, &plan).wait_for(patience));
        let report = output.expect(0).json();
        let seconds_of = |key: &str| report[key].as_f64().unwrap();
        seconds_of("plan_wall_s") / seconds_of("cycle_time_s")
    };
    let before = planning();
    let planned = SetpointFile::read(Path::new(&csv));
    assert!(!planned.is_still(), "an empty plan proves nothing");
    let played = instance.path("run.csv");
    let run = recorded(&program, &played);
    let output = beside_load(|| Process::start(&instance, &run).wait_for(patience));
    if let Some(why) = output.ended_by_host() {
        return leave_out("a run beside load", &why);
    }
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
    assert_eq!(report["lost_setpoints"], 0, "{report:#}");
    let has_waited = report["starved_ticks"] != 0;
    let took = if has_waited {
        before.max(planning())
    } else {
        before
    };
    if has_waited && took > IN_TIME {
        // It has waited on the path, and what it did between is no plan.
        let why = format!("planning takes {took:.2} of the time of the motion");
        return leave_out("no waiting for frames beside load", &why);
    }
    assert_eq!(report["starved_ticks"], 0, "{report:#}");
    assert_eq!(report["time_lost_s"]["starvation"], 0.0, "{report:#}");
    let received = SetpointFile::read(Path::new(&played));
    let (received, planned) = (received.moving(), planned.moving());
    let first_off = received.iter().zip(&planned).position(|(a, b)| a != b);
    assert_eq!(first_off, None, "{report:#}");
    assert_eq!(received.len(), planned.len());
}
