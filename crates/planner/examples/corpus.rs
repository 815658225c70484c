//! A folder of programs, planned with both efforts and with a stop at every corner, as a table:
//!
//! ```text
//! GLIDEPATH_CORPUS=folder cargo run --release -p glidepath-planner --example corpus -- dense print arc
//! ```
//!
//! The arguments are folders in it. The beginning of each program is planned for the milling
//! machine, at most [`MOST_SEGMENTS`] and [`MOST_FEED_T`], and judged by the auditor. Planning is
//! timed by the processor time of the thread, without parsing and audit. Tools are 50 mm long and
//! 6 mm thick, an extruder is axis U. `corpus.md` keeps what came out.
#![allow(clippy::print_stdout, reason = "a table")]

use std::error::Error;
use std::fs::File;
use std::io::{BufReader, Read, Write as _};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::smoothness::Figures;
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_gcode::{Dialect, Machine, Options, Program, ToolTable};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_motion::{PlanError, Planner};
use glidepath_program::{Effort, Item, ItemKind, Limits, Settings, Smoothing};

/// Segments planned of a program.
const MOST_SEGMENTS: usize = 3000;

/// Motion planned of a program, s at its feedrates. A last segment may go on for longer.
const MOST_FEED_T: f64 = 240.0;

const JERK_J: f64 = 40_000.0;
const PERIOD_T: f64 = 0.004;

/// A plan of a program, or of its beginning.
struct Plan {
    report: AuditReport,
    smooth: Figures,
    segments: usize,
    /// The time at the programmed feed everywhere, rapids at the speed of the axes, s.
    feed_t: f64,
    /// Processor time of planning.
    spent: Duration,
    is_whole: bool,
}

impl Plan {
    const fn time_t(&self) -> f64 {
        self.report.cycle_time_s
    }

    /// Processor time over time of motion, %.
    fn work_percent(&self) -> f64 {
        100.0 * self.spent.as_secs_f64() / self.time_t()
    }

    /// A figure of the axis where it is largest.
    fn most(of: &[f64]) -> f64 {
        of.iter().copied().fold(0.0, f64::max)
    }

    /// Largest rms and peak jerk of an axis over the limit.
    fn jerk(&self) -> String {
        let share = |of: &[f64]| Self::most(of) / JERK_J;
        let (rms, peak) = (&self.smooth.rms_jerk_j, &self.smooth.peak_jerk_j);
        format!("{:.3}, {:.2}", share(rms), share(peak))
    }

    fn ringing_a(&self) -> String {
        format!("{:.0}", Self::most(&self.smooth.ringing_a))
    }

    fn reversals(&self) -> String {
        self.smooth.reversals.iter().sum::<u64>().to_string()
    }

    /// Mean and rms deviation, µm.
    fn deviation(&self) -> String {
        let (mean, rms) = (self.smooth.mean_deviation_mm, self.smooth.rms_deviation_mm);
        format!("{:.2}, {:.2}", 1e3 * mean, 1e3 * rms)
    }
}

fn settings(effort: Effort, smoothing: Smoothing) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, JERK_J),
        tolerance_mm: 0.02,
        smoothing,
        corners: glidepath_program::Corners::default(),
        period_t: PERIOD_T,
        effort,
    }
}

/// Processor time of the thread so far.
fn processor_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    Duration::try_from(time).unwrap_or_default()
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
        dialect: Dialect::detect(&beginning, &Machine::unlimited()).dialect,
        extruder: Some(Axis::U),
        ..Options::default()
    })
}

/// The beginning of a program.
struct Beginning {
    items: Vec<Item>,
    segments: usize,
    feed_t: f64,
    is_whole: bool,
}

fn read(path: &Path) -> Result<Beginning, Box<dyn Error>> {
    let (mut items, mut segments, mut feed_t) = (Vec::new(), 0, 0.0);
    for item in Program::new(BufReader::new(File::open(path)?), options(path)?) {
        let item =
            item.map_err(|diagnostic| format!("{}: {}", diagnostic.line, diagnostic.message))?;
        if let ItemKind::Move { segment, rate, .. } = &item.kind {
            if segments == MOST_SEGMENTS || feed_t >= MOST_FEED_T {
                return Ok(Beginning {
                    items,
                    segments,
                    feed_t,
                    is_whole: false,
                });
            }
            segments += 1;
            let speed_v = rate.feed_v().map_or(200.0, |feed_v| feed_v.min(200.0));
            feed_t += segment.length() / speed_v;
        }
        items.push(item);
    }
    Ok(Beginning {
        items,
        segments,
        feed_t,
        is_whole: true,
    })
}

fn plan(beginning: &Beginning, settings: Settings) -> Result<Plan, PlanError> {
    let judged = AuditSettings {
        limits: settings.limits,
        period_t: settings.period_t,
        tolerance_mm: settings.tolerance_mm,
        corners: glidepath_program::Corners::default(),
    };
    let (mut audit, mut diagnosis) = (Audit::new(&judged), Diagnosis::new(&judged));
    let mut planner = Planner::new(settings, AxisVector::zeros());
    let mut spent = Duration::ZERO;
    for step in 0..=beginning.items.len() {
        let mut start = processor_time();
        match beginning.items.get(step) {
            Some(item) => {
                planner.push(item)?;
                audit.program(item);
                diagnosis.program(item);
            }
            None => planner.finish(),
        }
        while planner.make_frame()? {
            spent += processor_time().saturating_sub(start);
            audit.frame(planner.frame());
            diagnosis.frame(planner.frame());
            start = processor_time();
        }
        spent += processor_time().saturating_sub(start);
    }
    Ok(Plan {
        report: audit.finish(),
        smooth: diagnosis.finish().smoothness.whole,
        segments: beginning.segments,
        feed_t: beginning.feed_t,
        spent,
        is_whole: beginning.is_whole,
    })
}

/// The ways in which a program is planned.
struct Ways {
    optimal: Plan,
    fast: Plan,
    stops: Plan,
}

impl Ways {
    fn of(path: &Path) -> Result<Self, Box<dyn Error>> {
        let beginning = read(path)?;
        Ok(Self {
            optimal: plan(&beginning, settings(Effort::Optimal, Smoothing::Auto))?,
            fast: plan(&beginning, settings(Effort::Fast, Smoothing::Auto))?,
            stops: plan(&beginning, settings(Effort::Fast, Smoothing::ExactStop))?,
        })
    }

    /// By how much optimal is slower than fast, s, if it is.
    fn lost_t(&self) -> Option<f64> {
        let lost_t = self.optimal.time_t() - self.fast.time_t();
        (lost_t > 0.5 * PERIOD_T).then_some(lost_t)
    }

    fn row(&self, name: &str) -> String {
        let Self {
            optimal,
            fast,
            stops,
        } = self;
        let is_clean = [optimal, fast, stops]
            .iter()
            .all(|plan| plan.report.is_clean() && plan.report.is_complete);
        let part = if optimal.is_whole { "" } else { ", beginning" };
        let verdict = if is_clean { "clean" } else { "VIOLATIONS" };
        let both = |of: fn(&Plan) -> String| format!("{} / {}", of(optimal), of(fast));
        format!(
            "| {name} | {}{part} | {verdict} | {:.2} | {:.2} | {:.2} | {:.2} | {:.1} / {:.1} | {} | {} | {} | {} |",
            optimal.segments,
            optimal.time_t(),
            fast.time_t(),
            stops.time_t(),
            optimal.feed_t / optimal.time_t(),
            optimal.work_percent(),
            fast.work_percent(),
            both(Plan::jerk),
            both(Plan::ringing_a),
            both(Plan::reversals),
            both(Plan::deviation),
        )
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let Some(corpus) = std::env::var_os("GLIDEPATH_CORPUS").map(PathBuf::from) else {
        return Err(
            "GLIDEPATH_CORPUS is not set: it names the folder of folders of programs".into(),
        );
    };
    println!(
        "| program | segments | audit | optimal s | fast s | stops s | of feed | work % | jerk rms, peak | above 30 Hz | reversals | deviation mean, rms µm |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    let (mut count, mut slower) = (0, Vec::new());
    for folder in std::env::args().skip(1) {
        let entries = std::fs::read_dir(corpus.join(&folder))?;
        let mut paths: Vec<_> = entries
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<Result<_, _>>()?;
        paths.sort();
        for path in paths {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            let name = format!("{folder}/{file}");
            match Ways::of(&path) {
                Ok(ways) => {
                    println!("{}", ways.row(&name));
                    count += 1;
                    slower.extend(ways.lost_t().map(|lost_t| (name, lost_t)));
                }
                Err(error) => println!("| {name} | refused: {error} |||||||||||"),
            }
            std::io::stdout().flush()?;
        }
    }
    println!(
        "\nSlower with optimal than with fast: {} of {count}",
        slower.len()
    );
    for (name, lost_t) in slower {
        println!("* {name}: {lost_t:.3} s");
    }
    Ok(())
}
