//! The whole chain over emulated drives: planner, interpolator, bridge, a pair of virtual interfaces,
//! drives. Judged by what the drives themselves recorded at every SYNC0.
//!
//! `GLIDEPATH_CHAIN` is the length of the program in seconds, about; then all periods of the bus are run, and
//! a host that left too little to be judged is a failure, too.
#![allow(
    clippy::print_stderr,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a test that tells what it measured"
)]

mod between;
mod encoder;
mod gears;
mod judge;
mod load_side;
mod terminals;
mod touch_probe;

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use glidepath_link::MachineState;
use glidepath_testing::leave_out;
use glidepath_tests::{Instance, Operated, Process, Watchdog, planned};
use judge::{COUNTS, Row, judge, rows, was_left_alone};

/// What is left out where the host was not in time.
const LIMITS: &str = "limits of the chain over emulated drives";
/// How a following error is told.
const TOO_FAR: &str = "a joint is too far from where it is to be";
/// Time constant of their lag, s.
const LAG_T: f64 = 0.002;

/// How old what drives say may be, ns: a host of tests stands still now and then.
const FRESH_NS: u64 = 100_000_000;
/// How long emulated drives may take to come up.
const UP: Duration = Duration::from_secs(240);

/// A bridge that emulates its drives, when they are there, without power. `None`, and told, if this host cannot
/// emulate drives.
fn emulated(instance: &Instance, mut bus: Process) -> Option<Process> {
    let (began, off) = (Instant::now(), MachineState::Off.code());
    let is_there = || {
        let status = instance.wait_for_status(|_| true);
        status.state == off && status.feedback_age_ns < FRESH_NS
    };
    while !is_there() {
        if !bus.runs() {
            let output = bus.wait();
            assert!(
                output.stderr.contains("cannot emulate drives"),
                "{output:?}"
            );
            leave_out("emulated drives", &output.stderr);
            return None;
        }
        assert!(began.elapsed() < UP);
        std::thread::sleep(Duration::from_millis(20));
    }
    Some(bus)
}

/// The interpolator of a bench, and a bridge that emulates the drives of a file, when they are there. `None`, and told,
/// if this host cannot emulate drives.
fn emulated_drives(
    instance: &Instance,
    bench: &Operated<'_>,
    drives: &str,
) -> Option<(Process, Process)> {
    let interpolator = bench.process(&["interpolator", "--best-effort"]);
    let arguments = [
        "ethercat",
        "--emulated",
        "--best-effort",
        "--drives",
        drives,
    ];
    let Some(bus) = emulated(instance, bench.process(&arguments)) else {
        let _ended = interpolator.end().expect(0);
        return None;
    };
    Some((interpolator, bus))
}

/// The lines of three drives on a bus, with 100 000 counts a millimetre.
fn three_drives() -> String {
    let drive = |joint: usize| {
        format!(
            "[[drive]]\njoint = {joint}\nposition = {joint}\ncounts_per_mm = 100000.0\nfollowing_error = 50.0\n\
             quick_stop = 2000.0\n"
        )
    };
    (0..3).map(drive).collect()
}

/// A zigzag of about so many seconds.
fn program(seconds: u32) -> String {
    let mut text = String::from("G21 G90 G64 P0.02 F9000\n");
    for leg in 0..seconds * 3 {
        let (x, y) = (20 * (leg % 2), 3 * (leg % 7));
        let _ = writeln!(text, "G1 X{x} Y{y} Z{}", leg % 3);
    }
    text + "M2\n"
}

/// How far each time is from the one it was meant for, sorted, µs.
fn phase_errors_us(rows: &[Row]) -> Vec<f64> {
    let led = rows.iter().filter(|row| row.follows && row.meant_ns != 0);
    let mut errors: Vec<f64> = led
        .map(|row| row.sync_ns.abs_diff(row.meant_ns) as f64 / 1e3)
        .collect();
    errors.sort_by(f64::total_cmp);
    errors
}

/// The largest difference of a motor to where the model of its lag has it, mm.
fn model_error(rows: &[Row], period_t: f64) -> f64 {
    let stays = (-period_t / LAG_T).exp();
    let pairs = rows
        .windows(2)
        .filter(|pair| pair[0].follows && pair[1].follows);
    pairs
        .map(|pair| {
            let expected = pair[1].target - (pair[1].target - pair[0].actual) * stays;
            (pair[1].actual - expected).abs()
        })
        .fold(0.0, f64::max)
}

/// Runs the chain. Whether its limits were judged: not if this host cannot emulate drives, or stood
/// still for too long.
fn chain(seconds: u32, period_us: u32) -> bool {
    let patience = Duration::from_secs(u64::from(seconds) * 3 + 120);
    let (instance, _watchdog) = (Instance::alone(), Watchdog::new(patience * 2));
    let program = instance.file("program.ngc", &program(seconds));
    let period_t = f64::from(period_us) * 1e-6;
    let planned = between::jerk_ratio(&planned(&instance, &program).states(), period_t);
    let (csv, period) = (instance.path("drives.csv"), period_us.to_string());
    let arguments = [
        "run",
        &program,
        "--drives",
        "emulated",
        "--best-effort",
        "--json",
        "--bus-period-us",
        &period,
        "--drives-record",
        &csv,
    ];
    let output = Process::join(&instance, &arguments).wait_for(patience);
    if output.stdout.contains("cannot emulate drives on this host") {
        leave_out("emulated drives", &output.stdout);
        return false;
    }
    let recorded = std::fs::read_to_string(&csv);
    assert!(recorded.is_ok(), "{csv}: {recorded:?}; {output:?}");
    let rows = rows(&recorded.unwrap());
    if output.stdout.contains(TOO_FAR) && was_left_alone(&rows[0]) {
        leave_out(LIMITS, "the host stood still, and nobody led the drives");
        return false;
    }
    let report = output.expect(0).json();
    let drives = &report["drives"];
    assert_eq!(drives["bad_working_counters"], 0, "{report:#}");
    let errors = phase_errors_us(&rows[0]);
    let at = |part: f64| errors[((errors.len() - 1) as f64 * part) as usize];
    let verdict = judge(&rows, period_t, planned);
    let [v, a, j] = verdict.ratios;
    eprintln!(
        "bus {period_us} us: {} rows, phase error p50 {:.1} us, p99 {:.1} us, max {:.1} us; v {v:.4}, a \
         {a:.4}, j {j:.4} of the limits (planned {:.4}, rounding {:.4}) at {:.2} % of the SYNC0, {:.2} % left \
         out around missing setpoints; frames lost {}, cycles missed {}, coasted {}, ticks missed {}, round trip {}, \
         sent late {}",
        rows[0].len(),
        at(0.5),
        at(0.99),
        at(1.0),
        verdict.planned,
        verdict.rounding,
        100.0 * verdict.judged,
        100.0 * verdict.left_out,
        drives["lost_frames"],
        drives["missed_cycles"],
        drives["coasted_cycles"],
        report["missed_ticks"],
        drives["round_trip_us"],
        drives["lateness_us"],
    );
    for rows in &rows {
        let error = model_error(rows, period_t);
        assert!(error < 2.0 / COUNTS, "{error} mm off the model of the lag");
        let end = rows.last().unwrap();
        assert!(!end.follows, "without power at the end");
    }
    // Where frames run out, setpoints keep the limits at their own period only.
    if !verdict.is_enough() || report["starved_ticks"] != 0 {
        let ticks = &report["starved_ticks"];
        let why = format!("the host stood still for too long; frames ran out for {ticks} ticks");
        leave_out(LIMITS, &why);
        return false;
    }
    assert!(verdict.keeps_limits(), "{verdict:?} {report:#}");
    true
}

#[test]
fn the_chain_keeps_the_limits_at_the_period_of_the_bus() {
    let Ok(seconds) = std::env::var("GLIDEPATH_CHAIN").map(|text| text.parse().unwrap()) else {
        let _judged = chain(3, 2000);
        return;
    };
    let judged = [1000, 2000, 4000].map(|period_us| chain(seconds, period_us));
    assert_eq!(judged, [true; 3], "not all of it was judged");
}
