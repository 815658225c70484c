//! Arguments of `live`.

use super::operator::OperatorArgs;
use super::path::PathArgs;
use super::program::{ProgramArgs, program_file};
use crate::program_file::ProgramFile;
use clap::Args;

/// Arguments of `live`.
#[derive(Debug, Args)]
pub struct LiveArgs {
    /// The program that runs, to show its path, its lines, and how long it takes yet
    #[arg(value_name = "PROGRAM", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: Option<ProgramFile>,
    /// The port on 127.0.0.1; 0 takes any that is free
    #[arg(long, default_value_t = 8420)]
    pub port: u16,
    /// Let the page hold, resume, step, abort and set overrides; without it, it only shows
    #[arg(long)]
    pub commands: bool,
    /// How the program is read.
    #[command(flatten)]
    pub program: ProgramArgs,
    /// How the path is followed.
    #[command(flatten)]
    pub path: PathArgs,
    /// The interpolator that is meant.
    #[command(flatten)]
    pub operator: OperatorArgs,
}
