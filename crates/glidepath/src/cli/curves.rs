//! Arguments of the commands about curves.

use super::basic::{BasicArgs, OverwriteArgs};
use super::program::program_file;
use crate::program_file::ProgramFile;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// How `preview` reads a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PreviewMethod {
    /// Tick by tick
    Traditional,
    /// By growing steps that go back where they find something
    AdvanceRetreat,
    /// By bounds and roots of polynomials; misses nothing
    Certified,
}

/// Arguments of `preview`. What is not given is taken from the curve file or the configuration.
#[derive(Debug, Args)]
pub struct PreviewArgs {
    /// The curve file (TOML or JSON); `-` is standard input
    #[arg(value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// How to read the curve
    #[arg(long, value_enum, default_value = "certified")]
    pub method: PreviewMethod,
    /// Period of a setpoint, µs
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    pub period_us: Option<u32>,
    /// Feedrate, mm/min
    #[arg(long, value_name = "MM_PER_MIN", value_parser = positive)]
    pub feed: Option<f64>,
    /// Chord error of one period, mm; without it, the path tolerance
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub chord_error: Option<f64>,
    /// Write a plot of the curve, coloured by the speed it allows (SVG)
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
}

/// How `fit` finds a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum FitMethod {
    /// Knots step by step, control points by least squares
    LeastSquares,
    /// Control points by bacterial foraging, as published
    Foraging,
    /// Knots by bacterial foraging, control points by least squares
    Hybrid,
}

impl FitMethod {
    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::LeastSquares => "least-squares",
            Self::Foraging => "foraging",
            Self::Hybrid => "hybrid",
        }
    }
}

/// Arguments of `fit`.
#[derive(Debug, Args)]
pub struct FitArgs {
    /// The G-code program; `-` is standard input
    #[arg(value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Largest distance between curve and lines, in both directions, mm
    #[arg(long, value_name = "MM", value_parser = positive)]
    pub tolerance: f64,
    /// How to find the curve
    #[arg(long, value_enum, default_value = "least-squares")]
    pub method: FitMethod,
    /// Seed of the search; the same seed gives the same curve
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
    /// Write the result: a curve file (.toml, of one run) or a program (.ngc)
    #[arg(long, value_name = "FILE", value_parser = fit_output)]
    pub output: Option<PathBuf>,
    /// Write a plot of the curves with their control points (SVG)
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
}

fn fit_output(text: &str) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(text);
    match path.extension().and_then(std::ffi::OsStr::to_str) {
        Some("toml" | "ngc") => Ok(path),
        _ => Err("give a file that ends in .toml or .ngc"),
    }
}

fn positive(text: &str) -> Result<f64, &'static str> {
    text.parse()
        .ok()
        .filter(|number: &f64| *number > 0.0 && number.is_finite())
        .ok_or("give a number greater than zero")
}
