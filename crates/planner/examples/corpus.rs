//! A folder of programs, planned with both efforts and with a stop at every corner, as a table:
//!
//! ```text
//! GLIDEPATH_CORPUS=folder cargo run --release -p glidepath-planner --example corpus -- dense print arc
//! ```
//!
//! The arguments are folders in it. The first segments of each program are planned for the milling
//! machine, at most [`MOST_SEGMENTS`], and judged by the auditor. Planning is timed by the
//! processor time of the process, parsing and audit included. Tools are 50 mm long and 6 mm thick,
//! an extruder is axis U. `corpus.md` keeps what came out.
#![allow(clippy::print_stdout, reason = "a table")]

use std::error::Error;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use glidepath_audit::{Audit, AuditSettings, Report};
use glidepath_gcode::{Dialect, Options, Program, ToolTable};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_motion::Planner;
use glidepath_program::{Effort, ItemKind, Limits, Settings, Smoothing};

/// Segments planned of a program.
const MOST_SEGMENTS: usize = 3000;

/// A plan of a program, or of its beginning.
struct Plan {
    report: Report,
    segments: usize,
    /// The time at the programmed feed everywhere, rapids at the speed of the axes, s.
    feed_t: f64,
    spent: Duration,
    is_whole: bool,
}

fn settings(effort: Effort, smoothing: Smoothing) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, 40_000.0),
        tolerance_mm: 0.02,
        smoothing,
        period_t: 0.004,
        effort,
    }
}

/// Processor time of the process so far.
fn processor_time() -> Duration {
    // Fields 14 and 15, user and system time in hundredths of a second; the name before has no
    // blanks.
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let ticks = text.split_whitespace().skip(13).take(2);
    let sum: u64 = ticks.filter_map(|field| field.parse::<u64>().ok()).sum();
    Duration::from_millis(10 * sum)
}

/// How a program is read: in the dialect its beginning is in.
fn options(path: &Path) -> Result<Options, Box<dyn Error>> {
    let mut beginning = Vec::new();
    File::open(path)?
        .take(1 << 16)
        .read_to_end(&mut beginning)?;
    let lines = (1..100).map(|number| format!("T{number} P{number} Z50 D6\n"));
    let tools = ToolTable::parse(lines.collect::<String>().as_bytes());
    Ok(Options {
        default_feed_mm_min: Some(1000.0),
        tools: Some(Arc::new(tools.map_err(|_| "the tool table is wrong")?)),
        dialect: Dialect::detect(&beginning).0,
        extruder: Some(Axis::U),
        ..Options::default()
    })
}

fn plan(path: &Path, settings: Settings) -> Result<Plan, Box<dyn Error>> {
    let start = processor_time();
    let mut audit = Audit::new(&AuditSettings {
        limits: settings.limits,
        period_t: settings.period_t,
        tolerance_mm: settings.tolerance_mm,
    });
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let options = options(path)?;
    let (mut segments, mut feed_t, mut is_whole) = (0, 0.0, true);
    for item in Program::new(BufReader::new(File::open(path)?), options) {
        let item =
            item.map_err(|diagnostic| format!("{}: {}", diagnostic.line, diagnostic.message))?;
        if let ItemKind::Move { segment, rate, .. } = &item.kind {
            if segments == MOST_SEGMENTS {
                is_whole = false;
                break;
            }
            segments += 1;
            let speed_v = rate.feed_v().map_or(200.0, |feed_v| feed_v.min(200.0));
            feed_t += segment.length() / speed_v;
        }
        planner.push(&item)?;
        audit.program(&item);
        while planner.make_frame()? {
            audit.frame(planner.frame());
        }
    }
    planner.finish();
    while planner.make_frame()? {
        audit.frame(planner.frame());
    }
    Ok(Plan {
        report: audit.finish(),
        segments,
        feed_t,
        spent: processor_time().saturating_sub(start),
        is_whole,
    })
}

fn row(name: &str, path: &Path) -> Result<String, Box<dyn Error>> {
    let optimal = plan(path, settings(Effort::Optimal, Smoothing::Auto))?;
    let fast = plan(path, settings(Effort::Fast, Smoothing::Auto))?;
    let stops = plan(path, settings(Effort::Fast, Smoothing::ExactStop))?;
    let is_clean = [&optimal, &fast, &stops]
        .iter()
        .all(|plan| plan.report.is_clean() && plan.report.is_complete);
    let [optimal_t, fast_t, stop_t] =
        [&optimal, &fast, &stops].map(|plan| plan.report.cycle_time_s);
    #[expect(clippy::cast_precision_loss, reason = "thousands")]
    let per_second =
        |plan: &Plan| plan.segments as f64 / plan.spent.max(Duration::from_millis(5)).as_secs_f64();
    let part = if optimal.is_whole { "" } else { ", beginning" };
    let verdict = if is_clean { "clean" } else { "VIOLATIONS" };
    Ok(format!(
        "| {name} | {}{part} | {verdict} | {optimal_t:.2} | {fast_t:.2} | {stop_t:.2} | {:.2} | {:.2} | {:.3} | {:.0} | {:.0} |",
        optimal.segments,
        optimal.feed_t / optimal_t,
        fast.feed_t / fast_t,
        optimal.report.max_deviation_mm,
        per_second(&optimal),
        per_second(&fast),
    ))
}

fn main() -> Result<(), Box<dyn Error>> {
    let Some(corpus) = std::env::var_os("GLIDEPATH_CORPUS").map(PathBuf::from) else {
        return Err(
            "GLIDEPATH_CORPUS is not set: it names the folder of folders of programs".into(),
        );
    };
    println!(
        "| program | segments | audit | optimal s | fast s | stops s | of feed | fast | deviation mm | optimal /s | fast /s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for folder in std::env::args().skip(1) {
        let entries = std::fs::read_dir(corpus.join(&folder))?;
        let mut paths: Vec<_> = entries
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<Result<_, _>>()?;
        paths.sort();
        for path in paths {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            let name = format!("{folder}/{file}");
            match row(&name, &path) {
                Ok(row) => println!("{row}"),
                Err(error) => println!("| {name} | refused: {error} ||||||||||"),
            }
        }
    }
    Ok(())
}
