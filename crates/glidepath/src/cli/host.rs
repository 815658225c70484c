//! Arguments of the commands that measure: the host, the real-time loop, the benchmark programs.

use super::basic::{BasicArgs, OverwriteArgs};
use clap::Args;
use std::path::PathBuf;

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Folder with the programs and their catalogue, bench.json
    #[arg(default_value = "tests/data/bench")]
    pub folder: PathBuf,
    /// Folder with the configuration of each machine that the catalogue names, such as mill.toml;
    /// without it, the built-in ones
    #[arg(long, value_name = "FOLDER", conflicts_with = "config")]
    pub config_dir: Option<PathBuf>,
    /// Configuration and form of the report. A configuration given holds for all programs.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `doctor`.
#[derive(Debug, Args)]
pub struct DoctorArgs {
    /// Also check this network interface of drives
    #[arg(long, value_name = "NAME")]
    pub interface: Option<String>,
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
}

/// Arguments of `jitter`. What is not given is taken from the configuration.
#[derive(Debug, Args)]
pub struct JitterArgs {
    /// Configuration and form of the report.
    #[command(flatten)]
    pub basic: BasicArgs,
    /// Period of the loop, µs
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(50..=1_000_000))]
    pub period_us: Option<u32>,
    /// How long to measure, s
    #[arg(long, value_name = "S", default_value_t = 10,
          value_parser = clap::value_parser!(u32).range(1..=604_800))]
    pub seconds: u32,
    /// CPU to which the loop is pinned
    #[arg(long, value_name = "N")]
    pub cpu: Option<usize>,
    /// SCHED_FIFO priority, 1 to 99
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=99))]
    pub priority: Option<u8>,
    /// Measure even without real-time privileges
    #[arg(long)]
    pub best_effort: bool,
    /// Do the interpolator's work in every period, on a synthetic motion
    #[arg(long)]
    pub full_tick: bool,
    /// Run cyclictest at the same time on the same CPU, half a period apart, and compare
    #[arg(long)]
    pub against_cyclictest: bool,
    /// Write a plot of the latency (SVG)
    #[arg(long, value_name = "SVG")]
    pub plot: Option<PathBuf>,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
}
