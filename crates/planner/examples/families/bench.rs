//! The programs of a folder against their reference optima.

use crate::arguments::{Arguments, Setup};
use crate::figures::{self, FiguresByWay};
use crate::plan::{Together, Way};
use crate::statistics::{Figures, shown};
use crate::trial::Trial;
use crate::workers::in_order;
use serde_json::Value;
use std::error::Error;
use std::path::{Path, PathBuf};

/// The columns before those of the figure.
const HEAD: &str = "\
| program | machine | tolerance mm | period ms | optimal s | fast s | stop s | /tube | /exact | /least stop | fast/tube | /least stop | /fast | /stop | violations | tremors | jerk optimal | fast | jerk at feed optimal | fast | ringing at feed optimal | fast | reversals at feed optimal | fast | deviation µm | cpu % optimal | fast | longest call ms |";

/// A program with what is known of it.
struct Bench {
    name: String,
    text: Vec<u8>,
    references: References,
}

/// What is known of a program, s, for the milling machine at 0.02 mm.
#[derive(Debug, Clone, Copy, Default)]
struct References {
    /// The least time in the tube.
    tube_t: Option<f64>,
    /// The least time along the exact curve.
    exact_t: Option<f64>,
    /// The least time with a rest at every junction. The planner's own stops may take longer.
    stop_t: Option<f64>,
}

fn read(folder: &Path) -> Result<Vec<Bench>, Box<dyn Error>> {
    let references = std::fs::read(folder.join("families.json")).ok();
    let references: Value = match references {
        Some(text) => serde_json::from_slice(&text)?,
        None => Value::Null,
    };
    let entries = std::fs::read_dir(folder)
        .map_err(|error| format!("{} cannot be read: {error}", folder.display()))?;
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    paths.retain(|path| path.extension().is_some_and(|end| end == "ngc"));
    paths.sort();
    let bench = |path: PathBuf| {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let reference = |key: &str| references[name.as_ref()][key].as_f64();
        Ok(Bench {
            references: References {
                tube_t: reference("tube_s"),
                exact_t: reference("exact_curve_s"),
                stop_t: reference("exact_stop_s"),
            },
            text: std::fs::read(&path)?,
            name: name.into_owned(),
        })
    };
    paths.into_iter().map(bench).collect()
}

/// What is summed up below the table.
#[derive(Default)]
struct Sums {
    tube: Figures,
    fast: Figures,
    stop: Figures,
    slower: [u32; 2],
    fast_slower: u32,
    /// Slower than the least time with a rest at every junction: optimal, fast, stops.
    above_least_stop: [u32; 3],
    violations: u64,
    /// Tremors: optimal, fast, stops.
    tremors: [u64; 3],
    failed: u32,
    figures: FiguresByWay,
    /// Planned time by side of corners and effort, s.
    times_t: [[f64; 2]; 2],
}

fn row(bench: &Bench, setup: &Setup, trial: &Trial) -> String {
    let both = |figure: fn(&Together) -> f64, of: [Option<Together>; 2]| {
        let [optimal, fast] = of.map(|together| shown(together.as_ref().map(figure), 0));
        format!("{optimal} | {fast}")
    };
    let ways = [Way::Optimal, Way::Fast];
    let (whole, at_feed) = (
        ways.map(|way| trial.whole(way)),
        ways.map(|way| trial.at_feed(way)),
    );
    let over = |way: Way, reference: Option<f64>| {
        shown(reference.map(|least_t| trial.time_t(way) / least_t), 3)
    };
    let known = references(bench, setup);
    let violations = Way::ALL.map(|way| trial.plan(way).violations().to_string());
    let tremors = Way::ALL.map(|way| trial.plan(way).tremors().to_string());
    let reversals = |together: &Together| {
        #[allow(clippy::cast_precision_loss, reason = "thousands")]
        let count = together.reversals as f64;
        count
    };
    format!(
        "| {} | {} | {} | {} | {:.3} | {:.3} | {:.3} | {} | {} | {} | {} | {} | {:.3} | {:.3} | {} | {} | {} | {} | {} | {} | {:.1} | {:.1} | {:.1} | {:.1} |",
        bench.name,
        setup.machine.name,
        setup.tolerance_mm(),
        1e3 * setup.period_t,
        trial.time_t(Way::Optimal),
        trial.time_t(Way::Fast),
        trial.time_t(Way::Stop),
        over(Way::Optimal, known.tube_t),
        over(Way::Optimal, known.exact_t),
        over(Way::Optimal, known.stop_t),
        over(Way::Fast, known.tube_t),
        over(Way::Fast, known.stop_t),
        trial.ratio(Way::Optimal, Way::Fast),
        trial.ratio(Way::Optimal, Way::Stop),
        violations.join("/"),
        tremors.join("/"),
        both(|figures| figures.jerk_j, whole),
        both(|figures| figures.jerk_j, at_feed),
        both(|figures| figures.ringing_a, at_feed),
        both(reversals, at_feed),
        1e3 * trial.plan(Way::Optimal).report.max_deviation_mm,
        100.0 * trial.plan(Way::Optimal).load_r(),
        100.0 * trial.plan(Way::Fast).load_r(),
        1e3 * trial.plan(Way::Optimal).longest.as_secs_f64(),
    )
}

/// The references that hold for a setup.
fn references(bench: &Bench, setup: &Setup) -> References {
    if setup.machine.name == "mill" && (setup.tolerance_mm() - 0.02).abs() < 1e-12 {
        bench.references
    } else {
        References::default()
    }
}

impl Sums {
    fn add(&mut self, bench: &Bench, setup: &Setup, trial: &Trial) {
        let known = references(bench, setup);
        if let Some(tube_t) = known.tube_t {
            self.tube.add(trial.time_t(Way::Optimal) / tube_t);
        }
        for (slower, way) in self.above_least_stop.iter_mut().zip(Way::ALL) {
            let grid_t = 1.5 * setup.period_t;
            let is_slower = |least_t: f64| trial.time_t(way) > least_t + grid_t;
            *slower += u32::from(known.stop_t.is_some_and(is_slower));
        }
        self.figures.add(trial);
        for (sum_t, way) in self.times_t[setup.corners as usize]
            .iter_mut()
            .zip([Way::Optimal, Way::Fast])
        {
            *sum_t += trial.time_t(way);
        }
        self.fast.add(trial.ratio(Way::Optimal, Way::Fast));
        self.stop.add(trial.ratio(Way::Optimal, Way::Stop));
        for (slower, rival) in self.slower.iter_mut().zip([Way::Fast, Way::Stop]) {
            *slower += u32::from(trial.is_slower(Way::Optimal, rival));
        }
        self.fast_slower += u32::from(trial.is_slower(Way::Fast, Way::Stop));
        let violations = Way::ALL.map(|way| trial.plan(way).violations());
        self.violations += violations.iter().sum::<u64>();
        for (tremors, way) in self.tremors.iter_mut().zip(Way::ALL) {
            *tremors += trial.plan(way).tremors();
        }
    }

    fn print(&self) {
        let of = |figures: &Figures| {
            format!(
                "median {}, worst {}",
                shown(figures.median(), 4),
                shown(figures.largest(), 4)
            )
        };
        println!();
        println!("optimal/tube: {}", of(&self.tube));
        println!(
            "optimal/fast: {}; slower {}",
            of(&self.fast),
            self.slower[0]
        );
        println!(
            "optimal/stop: {}; slower {}",
            of(&self.stop),
            self.slower[1]
        );
        println!("fast slower than stop: {}", self.fast_slower);
        let [optimal, fast, stop] = self.above_least_stop;
        println!(
            "slower than the least time with stops: optimal {optimal}, fast {fast}, stop {stop}"
        );
        let [optimal, fast, stop] = self.tremors;
        println!("tremors: optimal {optimal}, fast {fast}, stop {stop}");
        for (corners, [optimal_t, fast_t]) in ["inner", "either"].iter().zip(self.times_t) {
            println!("all of corners {corners}: optimal {optimal_t:.3} s, fast {fast_t:.3} s");
        }
        self.figures.print("");
        println!(
            "violations: {}; not planned: {}",
            self.violations, self.failed
        );
    }
}

/// Plans every program in every setup, and prints a table.
pub(crate) fn run(folder: &Path, arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let programs = read(folder)?;
    let setups = arguments.setups();
    let tasks: Vec<_> = setups
        .iter()
        .flat_map(|setup| programs.iter().map(move |bench| (bench, setup)))
        .collect();
    if !arguments.is_json {
        let head = format!("{HEAD} {} |", figures::HEAD);
        println!("{head}\n|{}", "---|".repeat(head.matches('|').count() - 1));
    }
    let mut sums = Sums::default();
    let work = |task: usize| Trial::run(&tasks[task].0.text, tasks[task].1);
    in_order(arguments.threads, tasks.len(), work, |task, trial| {
        let (bench, setup) = tasks[task];
        match trial {
            Ok(trial) => {
                sums.add(bench, setup, &trial);
                if arguments.is_json {
                    let mut value = trial.json();
                    value["program"] = bench.name.as_str().into();
                    value["machine"] = setup.machine.name.into();
                    value["tolerance_mm"] = setup.tolerance_mm().into();
                    value["corners"] = setup.corners_name().into();
                    value["period_s"] = setup.period_t.into();
                    let known = references(bench, setup);
                    value["tube_s"] = known.tube_t.into();
                    value["exact_curve_s"] = known.exact_t.into();
                    value["least_stop_s"] = known.stop_t.into();
                    println!("{value}");
                } else {
                    let figure = figures::columns(setup.corners_name(), &trial);
                    println!("{} {figure} |", row(bench, setup, &trial));
                }
            }
            Err(reason) => {
                sums.failed += 1;
                eprintln!("{}: not planned: {reason}", bench.name);
            }
        }
    });
    if !arguments.is_json {
        sums.print();
    }
    Ok(sums.violations == 0 && sums.failed == 0 && sums.figures.is_kept())
}
