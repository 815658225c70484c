//! The report of `fit`.

use super::quantity::{grouped, seconds};
use crate::dense_runs::Run;
use core::fmt::Write as _;
use glidepath_fit::{Fit, FitError, PartReport};
use serde_json::{Value, json};

/// The report of `glidepath fit`.
#[derive(Debug)]
pub struct FitReport<'a> {
    /// The program.
    pub program: String,
    /// Asked for, mm.
    pub tolerance_mm: f64,
    /// Name of the method.
    pub method: &'static str,
    /// Seed of its search.
    pub seed: u64,
    /// Every dense run.
    pub runs: Vec<FittedRun<'a>>,
    /// Time of fitting all.
    pub wall_s: f64,
}

/// A run and its curve.
#[derive(Debug)]
pub struct FittedRun<'a> {
    lines: (u32, u32),
    points: usize,
    fit: &'a Result<Fit, FitError>,
    kept: bool,
}

impl<'a> FittedRun<'a> {
    /// A run with its result; kept if it is within the tolerance.
    #[must_use]
    pub fn new(run: &Run, fit: &'a Result<Fit, FitError>, tolerance_mm: f64) -> Self {
        let within = |fit: &Fit| fit.deviation.max_mm() <= tolerance_mm;
        Self {
            lines: run.lines(),
            points: run.items.len() + 1,
            fit,
            kept: fit.as_ref().is_ok_and(within),
        }
    }

    fn object(&self) -> Value {
        let mut object = json!({
            "first_line": self.lines.0,
            "last_line": self.lines.1,
            "points": self.points,
            "within_tolerance": self.kept,
        });
        match self.fit {
            Ok(fit) => {
                object["control_points"] = json!(fit.curve.control_points().len());
                object["corners"] = json!(fit.corners());
                object["points_to_curve_mm"] = json!(fit.deviation.points_to_curve_mm);
                object["curve_to_points_mm"] = json!(fit.deviation.curve_to_points_mm);
                object["max_error_mm"] = json!(fit.deviation.max_mm());
                object["parts"] = fit.parts.iter().map(part).collect();
            }
            Err(error) => object["error"] = json!(error.to_string()),
        }
        object
    }
}

fn part(part: &PartReport) -> Value {
    let mut object = json!({
        "points": part.points,
        "control_points": part.control_points,
        "squares_mm2": part.squares_mm2,
        "max_mm": part.max_mm,
    });
    if let Some(search) = &part.search {
        object["search"] = json!({
            "iterations": search.iterations,
            "evaluations": search.evaluations,
            "start_squares_mm2": search.start_mm2,
            "least_squares_mm2": search.least_squares_mm2,
            "least_squares_max_mm": search.least_squares_max_mm,
        });
    }
    object
}

impl FitReport<'_> {
    fn fits(&self) -> impl Iterator<Item = &Fit> {
        self.runs.iter().filter_map(|run| run.fit.as_ref().ok())
    }

    fn points(&self) -> usize {
        self.runs.iter().map(|run| run.points).sum()
    }

    fn control_points(&self) -> usize {
        self.fits()
            .map(|fit| fit.curve.control_points().len())
            .sum()
    }

    /// Runs whose curve is further off than the tolerance.
    #[must_use]
    pub fn beyond(&self) -> usize {
        let is_beyond = |run: &&FittedRun<'_>| run.fit.is_ok() && !run.kept;
        self.runs.iter().filter(is_beyond).count()
    }

    fn max_error_mm(&self) -> f64 {
        self.fits()
            .map(|fit| fit.deviation.max_mm())
            .fold(0.0, f64::max)
    }

    /// As one JSON object.
    #[must_use]
    pub fn object(&self) -> Value {
        json!({
            "program": self.program,
            "method": self.method,
            "seed": self.seed,
            "tolerance_mm": self.tolerance_mm,
            "points": self.points(),
            "control_points": self.control_points(),
            "max_error_mm": self.max_error_mm(),
            "beyond_tolerance": self.beyond(),
            "wall_s": self.wall_s,
            "runs": self.runs.iter().map(FittedRun::object).collect::<Vec<_>>(),
        })
    }

    /// For people.
    #[must_use]
    pub fn text(&self) -> String {
        // Writing to a String does not fail.
        let mut text = String::new();
        for run in &self.runs {
            let (first, last) = run.lines;
            let _ = write!(
                text,
                "lines {first} to {last}: {} points, ",
                grouped(run.points as u64)
            );
            let _ = match run.fit {
                Ok(fit) => writeln!(
                    text,
                    "{} control points, {} corners, {:.6} mm off{}",
                    fit.curve.control_points().len(),
                    fit.corners(),
                    fit.deviation.max_mm(),
                    if run.kept {
                        ""
                    } else {
                        ": more than the tolerance"
                    },
                ),
                Err(error) => writeln!(text, "left as lines: {error}"),
            };
        }
        let _ = writeln!(
            text,
            "{}: {} runs, {} points, {} control points, at most {:.6} mm off, {} in {}",
            self.program,
            self.runs.len(),
            grouped(self.points() as u64),
            grouped(self.control_points() as u64),
            self.max_error_mm(),
            self.method,
            seconds(self.wall_s),
        );
        let beyond = self.beyond();
        if beyond > 0 {
            let _ = writeln!(
                text,
                "  {beyond} of the curves {} further off than the tolerance of {} mm: a program keeps \
                 the lines there; give a larger --tolerance, or another --method",
                if beyond == 1 { "is" } else { "are" },
                self.tolerance_mm,
            );
        }
        text
    }
}
