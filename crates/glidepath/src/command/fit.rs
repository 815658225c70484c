//! `glidepath fit`: NURBS through the dense runs of a program.

use super::check;
use super::plan::title;
use super::reading::for_program;
use super::session;
use crate::cli::{FitArgs, FitMethod};
use crate::clock;
use crate::command::failure::Failure;
use crate::config::MachineConfig;
use crate::curve_file;
use crate::dense_runs::{ProgramPiece, Run, Runs};
use crate::exit::Exit;
use crate::file_error::FileError;
use crate::interrupt::Interrupt;
use crate::output;
use crate::output_file::{self, OutputKind};
use crate::plot::curve::{CurvePlot, Mark};
use crate::program_text::ProgramText;
use crate::progress::ProgressDisplay;
use crate::report::{FitReport, FittedRun};
use glidepath_fit::{Fit, FitError, Method, Settings, fit as fit_points};
use glidepath_gcode::Program;
use glidepath_planner::UnchangedFile;
use std::io::BufReader;
use std::path::Path;
use std::time::Duration;

/// Between two looks whether the process was asked to end.
const POLL: Duration = Duration::from_millis(20);
/// Steps of the progress bar for each run.
const STEPS: f64 = 1000.0;

/// Fits every run and writes what was asked for.
///
/// # Errors
/// The program is rejected, a file cannot be written, or it would have a curve that is beyond the
/// tolerance.
pub(super) fn fit(args: &FitArgs, config: &MachineConfig) -> Result<Exit, Failure> {
    args.file.open()?;
    let interrupt = Interrupt::install().map_err(Failure::Signals)?;
    let config = &for_program(&args.file, config);
    let settings = Settings {
        method: match args.method {
            FitMethod::LeastSquares => Method::LeastSquares,
            FitMethod::Foraging => Method::Foraging,
            FitMethod::Hybrid => Method::Hybrid,
        },
        seed: args.seed,
        ..Settings::new(args.tolerance)
    };
    let guard = session::guard(Some(&args.file), &args.basic, config, args.overwrite);
    let (file, machine, json) = (args.file.clone(), config.clone(), args.basic.json);
    let fitted = interruptible(&interrupt, move || {
        check::accepted(&file, &machine, json)?;
        let pieces = read(file.path(), &machine)?;
        let runs: Vec<&Run> = pieces.iter().filter_map(run).collect();
        let start = clock::elapsed();
        let results = fit_runs(&runs, &settings);
        let wall_s = (clock::elapsed() - start).as_secs_f64();
        Ok((pieces, results, wall_s))
    });
    let (pieces, results, wall_s) = fitted?;
    let runs: Vec<&Run> = pieces.iter().filter_map(run).collect();
    if let Some(path) = &args.output {
        let text = written(path, &pieces, &runs, &results, config, args.tolerance)?;
        let kind = if is_curve_file(path) {
            OutputKind::Curve
        } else {
            OutputKind::Program
        };
        output_file::write(path, kind, &guard, &text)?;
    }
    if let Some(path) = &args.plot {
        let text = plot(&title(args.file.name()), &runs, &results);
        output_file::write(path, OutputKind::Plot, &guard, &text)?;
    }
    let fitted = runs.iter().zip(&results);
    let report = FitReport {
        program: args.file.name().display().to_string(),
        tolerance_mm: args.tolerance,
        method: args.method.name(),
        seed: args.seed,
        runs: fitted
            .map(|(run, fit)| FittedRun::new(run, fit, args.tolerance))
            .collect(),
        wall_s,
    };
    if args.basic.json {
        output::object(&report.object());
    } else {
        output::result(&report.text());
    }
    // A script must not take for fitted what is not.
    Ok(if report.beyond() == 0 {
        Exit::Done
    } else {
        Exit::Rejected
    })
}

/// Has something done in a thread of its own that takes long and writes nothing, until it is done or the process is
/// asked to end: then it is left where it is.
fn interruptible<T: Send + 'static>(
    interrupt: &Interrupt,
    work: impl FnOnce() -> Result<T, Failure> + Send + 'static,
) -> Result<T, Failure> {
    let thread = std::thread::Builder::new().name("fitting".to_owned());
    let worker = thread.spawn(work).map_err(Failure::Process)?;
    while !worker.is_finished() {
        if interrupt.is_set() {
            return Err(Failure::Interrupted);
        }
        std::thread::sleep(POLL);
    }
    match worker.join() {
        Ok(done) => done,
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

fn read(path: &Path, config: &MachineConfig) -> Result<Vec<ProgramPiece>, Failure> {
    let file = UnchangedFile::open(path).map_err(FileError::open(path))?;
    let options = config.program_options(config.home());
    let mut runs = Runs::default();
    for item in Program::new(BufReader::with_capacity(1 << 16, file), options) {
        let item = item.map_err(|diagnostic| Failure::Rejected {
            program: path.display().to_string(),
            diagnostics: vec![diagnostic],
            more: 0,
            moved: false,
        })?;
        runs.push(item);
    }
    Ok(runs.finish())
}

const fn run(piece: &ProgramPiece) -> Option<&Run> {
    match piece {
        ProgramPiece::Run(run) => Some(run),
        ProgramPiece::Item(_) => None,
    }
}

fn fit_runs(runs: &[&Run], settings: &Settings) -> Vec<Result<Fit, FitError>> {
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "steps of a bar"
    )]
    let steps = |done: f64| (done * STEPS) as u64;
    let progress = ProgressDisplay::share(steps(runs.len() as f64));
    progress.doing("fitting");
    let fit_run = |(index, run): (usize, &&Run)| {
        fit_points(&run.points(), settings, &mut |done| {
            progress.at(steps(index as f64 + done));
        })
    };
    let results = runs.iter().enumerate().map(fit_run).collect();
    progress.finish();
    results
}

/// The text of the output file: a curve file of the one run, or a program with every run that
/// could be fitted as a curve.
fn written(
    path: &Path,
    pieces: &[ProgramPiece],
    runs: &[&Run],
    results: &[Result<Fit, FitError>],
    config: &MachineConfig,
    tolerance_mm: f64,
) -> Result<String, Failure> {
    if is_curve_file(path) {
        let ([run], [Ok(fit)]) = (runs, results) else {
            return Err(Failure::NotOneCurve { runs: runs.len() });
        };
        let error_mm = fit.deviation.max_mm();
        if error_mm > tolerance_mm {
            return Err(Failure::CurveBeyond {
                error_mm,
                tolerance_mm,
            });
        }
        return Ok(curve_file::to_toml(
            &title(path),
            Some(run.feed_v * 60.0),
            &fit.curve,
        ));
    }
    let mut text = ProgramText::new(config.home());
    let mut results = results.iter();
    for piece in pieces {
        match piece {
            ProgramPiece::Item(item) => text.item(item)?,
            ProgramPiece::Run(run) => match results.next() {
                Some(Ok(fit)) if fit.deviation.max_mm() <= tolerance_mm => {
                    text.curve(&fit.curve, run.feed_v, run.mode);
                }
                _ => run.items.iter().try_for_each(|item| text.item(item))?,
            },
        }
    }
    Ok(text.finish())
}

/// Whether an output is to be a curve file, by its name.
fn is_curve_file(path: &Path) -> bool {
    let extension = path.extension();
    extension.is_some_and(|extension| extension == "toml")
}

/// The curves with their control points.
fn plot(title: &str, runs: &[&Run], results: &[Result<Fit, FitError>]) -> String {
    let mut plot = CurvePlot::new();
    let mut control_points = 0;
    for (run, fit) in runs.iter().zip(results) {
        let Ok(fit) = fit else { continue };
        for span in fit.curve.spans() {
            for i in 0..=40 {
                let u = span.from_u() + (span.to_u() - span.from_u()) * f64::from(i) / 40.0;
                plot.point(&fit.curve.jet(u).position, run.feed_v);
            }
        }
        for point in fit.curve.control_points() {
            plot.mark(point, Mark::Control);
        }
        control_points += fit.curve.control_points().len();
    }
    plot.render(
        title,
        &format!("{} runs, {control_points} control points", runs.len()),
    )
}
