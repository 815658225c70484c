//! The whole chain over emulated drives: planner, interpolator, bridge, a pair of virtual interfaces,
//! drives. Judged by what the drives themselves recorded at every SYNC0.
//!
//! `GLIDEPATH_CHAIN` is the length of the program in seconds, about; then all periods of the bus are run.
#![allow(
    clippy::print_stderr,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "a test that tells what it measured"
)]

use std::fmt::Write as _;
use std::time::Duration;

use glidepath_audit::{Audit, AuditSettings, Sample};
use glidepath_geometry::AxisVector;
use glidepath_tests::{Instance, Process, Watchdog, settings};

const JOINTS: usize = 3;
/// Counts a mm of the emulated drives.
const COUNTS: f64 = 8_388_608.0 / 5.0;
/// How far a SYNC0 may be from where it was expected, ns; a lost frame is a period.
const IN_TIME_NS: u64 = 100_000;
/// Time constant of their lag, s.
const LAG_T: f64 = 0.002;

/// A drive at a SYNC0.
#[derive(Debug, Clone, Copy)]
struct Row {
    sync_ns: u64,
    meant_ns: u64,
    target: f64,
    actual: f64,
    follows: bool,
}

impl Row {
    /// Whether its target was meant for this SYNC0; before there is power, any is.
    const fn came_in_time(&self) -> bool {
        !self.follows || self.sync_ns.abs_diff(self.meant_ns) < IN_TIME_NS
    }
}

fn rows(text: &str) -> [Vec<Row>; JOINTS] {
    let mut rows: [Vec<Row>; JOINTS] = Default::default();
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        rows[cells[0].parse::<usize>().unwrap()].push(Row {
            sync_ns: cells[1].parse().unwrap(),
            meant_ns: cells[2].parse().unwrap(),
            target: cells[3].parse().unwrap(),
            actual: cells[4].parse().unwrap(),
            follows: cells[6] == "1",
        });
    }
    rows
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

/// The largest ratios to velocity, acceleration and jerk at the period of the bus, and the share of the
/// SYNC0 that were judged. At those for which no frame came in time, because it was lost or the host
/// stood still, drives repeat what they had: differences across them tell nothing of what was sent.
fn ratios(all: &[Vec<Row>; JOINTS], period_t: f64) -> ([f64; 3], f64) {
    let mut audit = Audit::new(&AuditSettings {
        limits: settings().limits,
        period_t,
        tolerance_mm: 0.02,
    });
    let mut position = AxisVector::zeros();
    let count = all.iter().map(Vec::len).min().unwrap();
    let mut judged = 0;
    for nth in 0..count {
        let in_time = |rows: &Vec<Row>| rows[nth].came_in_time();
        if !all.iter().all(in_time) {
            continue;
        }
        judged += 1;
        for (joint, rows) in all.iter().enumerate() {
            let row = rows[nth];
            if row.follows {
                position[joint] = row.target;
            }
        }
        audit.sample(&Sample {
            tick: nth as u64,
            line: 0,
            position,
            reported: None,
        });
    }
    let report = audit.finish();
    let ratios = [
        report.max_velocity_ratio.ratio,
        report.max_acceleration_ratio.ratio,
        report.max_jerk_ratio.ratio,
    ];
    (ratios, f64::from(judged) / count as f64)
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

/// Runs the chain; false if this host cannot emulate drives.
fn chain(seconds: u32, period_us: u32) -> bool {
    let patience = Duration::from_secs(u64::from(seconds) * 3 + 120);
    let (instance, _watchdog) = (Instance::alone(), Watchdog::new(patience * 2));
    let program = instance.file("program.ngc", &program(seconds));
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
        eprintln!("SKIPPED: {}", output.stdout);
        return false;
    }
    let report = output.expect(0).json();
    let drives = &report["drives"];
    assert_eq!(drives["bad_working_counters"], 0, "{report:#}");
    let rows = rows(&std::fs::read_to_string(&csv).unwrap());
    let period_t = f64::from(period_us) * 1e-6;
    let errors = phase_errors_us(&rows[0]);
    let at = |part: f64| errors[((errors.len() - 1) as f64 * part) as usize];
    let ([v, a, j], judged) = ratios(&rows, period_t);
    // What rounding adds to a third difference: to counts, and of the time to whole nanoseconds.
    let fastest_v = 150.0;
    let rounding = (4.0 / COUNTS + 4e-9 * fastest_v) / period_t.powi(3) / 40_000.0;
    eprintln!(
        "bus {period_us} us: {} rows, phase error p50 {:.1} us, p99 {:.1} us, max {:.1} us; v {v:.4}, a \
         {a:.4}, j {j:.4} of the limits (rounding {rounding:.4}) at {:.2} % of the SYNC0; frames lost {}, cycles missed {}, \
         coasted {}, ticks missed {}, round trip {}, sent late {}",
        rows[0].len(),
        at(0.5),
        at(0.99),
        at(1.0),
        100.0 * judged,
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
    // Ticks that were left out or so late that nothing led on are counted, and no fault of what was
    // computed.
    if report["missed_ticks"] != 0 || drives["coasted_cycles"] != 0 || judged < 0.9 {
        eprintln!("the host stood still for too long: the limits are not judged");
        return true;
    }
    // Between setpoints the demand is a quintic, whose third difference at any phase of the bus is up
    // to 0.53 % above that of the setpoints.
    let most = 1.0 + 5.3e-3;
    assert!(
        v <= most && a <= most && j <= most + rounding,
        "{v} {a} {j}"
    );
    true
}

#[test]
fn the_chain_keeps_the_limits_at_the_period_of_the_bus() {
    match std::env::var("GLIDEPATH_CHAIN").map(|text| text.parse().unwrap()) {
        Ok(seconds) => {
            let _done = [1000, 2000, 4000].map(|period_us| chain(seconds, period_us));
        }
        Err(_) => {
            let _done = chain(3, 2000);
        }
    }
}
