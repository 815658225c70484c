//! Arguments of `record`, `replay` and `audit`.

use super::basic::{BasicArgs, OverwriteArgs};
use super::operator::OperatorArgs;
use super::path::PathArgs;
use super::program::{ProgramArgs, program_file};
use super::time::{seconds, time};
use crate::program_file::ProgramFile;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// Arguments of `record`.
#[derive(Debug, Args)]
pub struct RecordArgs {
    /// The recording (MCAP); while it grows, its name is FILE.part
    pub file: PathBuf,
    /// The running program, to be part of the recording, so that `audit` can check against it
    #[arg(long, value_name = "PROGRAM", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub program: Option<ProgramFile>,
    /// Be a black box: keep the last minutes (such as 10min or 90s) in memory, and write them to
    /// FILE, with the time in its name, when a fault stops the machine
    #[arg(long, value_name = "TIME", value_parser = duration, conflicts_with = "seconds")]
    pub ring: Option<Duration>,
    /// End after this many seconds; without it, record until Ctrl-C
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub seconds: Option<f64>,
    /// How the path is followed: what the planner was told.
    #[command(flatten)]
    pub path: PathArgs,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
    /// Which files may be overwritten.
    #[command(flatten)]
    pub overwrite: OverwriteArgs,
}

/// Arguments of `replay`.
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// The recording (MCAP)
    pub file: PathBuf,
    /// The instance whose servo stack plays it.
    #[command(flatten)]
    pub operator: OperatorArgs,
}

/// Arguments of `audit`.
#[derive(Debug, Args)]
pub struct AuditArgs {
    /// The recording (MCAP), or setpoints (CSV) of `plan`, `run` or `servo`; `-` is standard input
    #[arg(value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: ProgramFile,
    /// The program that the motion has to follow; a recording may contain its own
    #[arg(long, value_name = "PROGRAM", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub program: Option<ProgramFile>,
    /// How the program is read, where a recording does not tell it.
    #[command(flatten)]
    pub reading: ProgramArgs,
    /// How the path was to be followed.
    #[command(flatten)]
    pub path: PathArgs,
    /// Configuration and form of the report; a recording has a configuration of its own.
    #[command(flatten)]
    pub basic: BasicArgs,
}

fn duration(text: &str) -> Result<Duration, &'static str> {
    let time = time(text)?;
    if time <= Duration::from_secs(14_400) {
        Ok(time)
    } else {
        Err("give 4 h at most: they are kept in memory")
    }
}
