//! A folder of programs, planned with both efforts and with a stop at every corner, as a table:
//!
//! ```text
//! GLIDEPATH_CORPUS=folder cargo run --release -p glidepath-planner --example corpus -- dense print arc
//! ```
//!
//! The arguments are folders in it, `--corners either`, `--walls` (travel ends where what is planned of a
//! program does), `--most S` (less of each) and `--threads N`. The beginning of each program is planned for the milling
//! machine, at most [`MOST_SEGMENTS`] and [`MOST_FEED_T`], and judged by the auditor. Planning is
//! timed by the processor time of the thread, without parsing and audit. Tools are 50 mm long and
//! 6 mm thick, an extruder is axis U. `corpus.md` keeps what came out. Below the
//! table stand the programs that break a limit, a tolerance or a rule of the figure (an axis beyond its
//! travel, a straight move beside its line, a tremor, an event lost or off its place) with effort "optimal"
//! or "fast"; the exit code is 1 if there are any.
#![allow(clippy::print_stdout, reason = "a table")]

#[path = "judged/figure.rs"]
mod figure;
#[path = "corpus/sums.rs"]
mod sums;
#[path = "judged/walls.rs"]
mod walls;
#[path = "families/workers.rs"]
mod workers;

use figure::Figure;
use std::error::Error;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;
use sums::Sums;

use glidepath_audit::diagnosis::Diagnosis;
use glidepath_audit::smoothness::Figures;
use glidepath_audit::{Audit, AuditReport, AuditSettings};
use glidepath_gcode::{Dialect, Machine, Options, Program, ToolTable};
use glidepath_geometry::{Axis, AxisVector};
use glidepath_motion::{PlanError, Planner};
use glidepath_program::{Corners, Effort, Item, ItemKind, Limits, Settings, Smoothing};

/// Segments planned of a program.
const MOST_SEGMENTS: usize = 3000;

/// Motion planned of a program, s at its feedrates. A last segment may go on for longer.
const MOST_FEED_T: f64 = 240.0;

/// The head of the table.
const HEAD: &str = "| program | segments | audit | optimal s | fast s | stops s | of feed | work % | jerk rms, peak | above 30 Hz | reversals | deviation mean, rms µm | outer side | depth, overshoot, outside, beside µm | event off µm |";

const JERK_J: f64 = 40_000.0;
const PERIOD_T: f64 = 0.004;

/// A plan of a program, or of its beginning.
struct Plan {
    report: AuditReport,
    smooth: Figures,
    figure: Figure,
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

    /// Reversals, and those of the program.
    fn reversals(&self) -> String {
        self.figure
            .reversals()
            .map(|count| count.to_string())
            .join(" of ")
    }

    /// Whether limits, tolerance and the rules of the figure are kept; what is not.
    fn broken(&self) -> Vec<String> {
        let mut broken = self.figure.broken();
        if !self.report.is_complete {
            broken.push("incomplete".to_owned());
        }
        if let Some(first) = self.report.violations.first() {
            broken.push(format!(
                "{} violations, {first}",
                self.report.violation_count
            ));
        }
        broken
    }

    /// Mean and rms deviation, µm.
    fn deviation(&self) -> String {
        let (mean, rms) = (self.smooth.mean_deviation_mm, self.smooth.rms_deviation_mm);
        format!("{:.2}, {:.2}", 1e3 * mean, 1e3 * rms)
    }
}

/// How programs are planned.
#[derive(Debug, Default)]
struct Task {
    folders: Vec<String>,
    corners: Corners,
    has_walls: bool,
    threads: usize,
    /// Motion planned of a program, s.
    most_feed_t: f64,
}

impl Task {
    fn read() -> Result<Self, Box<dyn Error>> {
        let mut task = Self {
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            most_feed_t: MOST_FEED_T,
            ..Self::default()
        };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            match word.as_str() {
                "--walls" => task.has_walls = true,
                "--threads" => {
                    task.threads = words.next().ok_or("--threads wants a number")?.parse()?;
                }
                "--most" => {
                    task.most_feed_t = words.next().ok_or("--most wants seconds")?.parse()?;
                }
                "--corners" => {
                    task.corners = match words.next().as_deref() {
                        Some("inner") => Corners::Inner,
                        Some("either") => Corners::Either,
                        _ => return Err("--corners wants inner or either".into()),
                    }
                }
                _ => task.folders.push(word),
            }
        }
        Ok(task)
    }
}

fn settings(effort: Effort, smoothing: Smoothing, corners: Corners) -> Settings {
    Settings {
        limits: Limits::uniform(200.0, 2000.0, JERK_J),
        tolerance_mm: 0.02,
        direction: glidepath_program::DirectionTolerance::default(),
        smoothing,
        corners,
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

fn read(path: &Path, most_feed_t: f64) -> Result<Beginning, Box<dyn Error>> {
    let (mut items, mut segments, mut feed_t) = (Vec::new(), 0, 0.0);
    for item in Program::new(BufReader::new(File::open(path)?), options(path)?) {
        let item =
            item.map_err(|diagnostic| format!("{}: {}", diagnostic.line, diagnostic.message))?;
        if let ItemKind::Move { segment, rate, .. } = &item.kind {
            if segments == MOST_SEGMENTS || feed_t >= most_feed_t {
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
    let judged = AuditSettings::from(&settings);
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
    let (report, told) = (audit.finish(), diagnosis.finish());
    Ok(Plan {
        figure: Figure::new(&beginning.items, settings.period_t, &report, told.shape),
        report,
        smooth: told.smoothness.whole,
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
    fn of(path: &Path, task: &Task) -> Result<Self, Box<dyn Error>> {
        let beginning = read(path, task.most_feed_t)?;
        let planned = |effort, smoothing| {
            let mut settings = settings(effort, smoothing, task.corners);
            if task.has_walls {
                settings.limits.travel = walls::walls(&beginning.items);
            }
            plan(&beginning, settings)
        };
        Ok(Self {
            optimal: planned(Effort::Optimal, Smoothing::Auto)?,
            fast: planned(Effort::Fast, Smoothing::Auto)?,
            stops: planned(Effort::Fast, Smoothing::ExactStop)?,
        })
    }

    /// What is broken by plans that are handed out: those at rest at every corner are for comparison alone.
    fn broken(&self) -> Vec<String> {
        let mut all = Vec::new();
        for (name, plan) in [("optimal", &self.optimal), ("fast", &self.fast)] {
            all.extend(
                plan.broken()
                    .into_iter()
                    .map(|what| format!("{name}: {what}")),
            );
            if let Some(outer) = plan.figure.first_outer() {
                let count = plan.figure.outer_count();
                all.push(format!("{name}: (outer side {count} times, {outer})"));
            }
        }
        all
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
            .all(|plan| plan.broken().is_empty());
        let part = if optimal.is_whole { "" } else { ", beginning" };
        let verdict = if is_clean { "clean" } else { "BROKEN" };
        let distances = optimal
            .figure
            .distances_um()
            .map(|um| format!("{um:.2}"))
            .join(", ");
        let outer = optimal.figure.outer_count();
        let both = |of: fn(&Plan) -> String| format!("{} / {}", of(optimal), of(fast));
        format!(
            "| {name} | {}{part} | {verdict} | {:.2} | {:.2} | {:.2} | {:.2} | {:.1} / {:.1} | {} | {} | {} | {} | {outer} | {distances} | {:.2} |",
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
            optimal.figure.events().1,
        )
    }
}

/// The programs of the folders, by name.
fn programs(corpus: &Path, task: &Task) -> Result<Vec<(String, PathBuf)>, Box<dyn Error>> {
    let mut programs = Vec::new();
    for folder in &task.folders {
        let entries = std::fs::read_dir(corpus.join(folder))?;
        let mut paths: Vec<_> = entries
            .map(|entry| entry.map(|entry| entry.path()))
            .collect::<Result<_, _>>()?;
        paths.sort();
        programs.extend(paths.into_iter().map(|path| {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            (format!("{folder}/{file}"), path)
        }));
    }
    Ok(programs)
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let Some(corpus) = std::env::var_os("GLIDEPATH_CORPUS").map(PathBuf::from) else {
        return Err(
            "GLIDEPATH_CORPUS is not set: it names the folder of folders of programs".into(),
        );
    };
    let task = Task::read()?;
    let programs = programs(&corpus, &task)?;
    println!("{HEAD}\n|{}", "---|".repeat(HEAD.matches('|').count() - 1));
    let work = |index: usize| {
        // A program that makes the planner panic is to be told like any other.
        let planned = std::panic::catch_unwind(|| {
            Ways::of(&programs[index].1, &task).map_err(|error| error.to_string())
        });
        planned.unwrap_or_else(|_| Err("the planner panicked".to_owned()))
    };
    let mut sums = Sums::default();
    workers::in_order(task.threads, programs.len(), work, |index, ways| {
        sums.add(&programs[index].0, &ways);
    });
    sums.print();
    Ok(ExitCode::from(u8::from(!sums.is_kept())))
}
