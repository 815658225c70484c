//! Arguments of `live`.

use super::operator::OperatorArgs;
use super::path::PathArgs;
use super::program::{ProgramArgs, program_file};
use crate::program_file::ProgramFile;
use clap::{Args, ValueEnum};
use glidepath_live::Role;
use std::path::PathBuf;

/// Arguments of `live`.
#[derive(Debug, Args)]
pub struct LiveArgs {
    /// A program to show until the machine executes another one. The running program is shown even
    /// without it
    #[arg(value_name = "PROGRAM", value_parser = program_file(), value_hint = clap::ValueHint::AnyPath)]
    pub file: Option<ProgramFile>,
    /// The port on 127.0.0.1; 0 selects any free one
    #[arg(long, default_value_t = 8420)]
    pub port: u16,
    /// What the page may do: only look; hold and abort; or operate the machine
    #[arg(long, value_name = "ROLE", value_enum, default_value_t = May::Look)]
    pub may: May,
    /// Folder of the programs that the page lists, runs and stores
    #[arg(long, value_name = "FOLDER", value_hint = clap::ValueHint::DirPath)]
    pub programs: Option<PathBuf>,
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

/// What a page may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum May {
    /// See the machine
    Look,
    /// See it and stop it: hold and abort
    Hold,
    /// Do all that an operator does
    Operate,
}

impl May {
    /// The role of the page.
    #[must_use]
    pub const fn role(self) -> Role {
        match self {
            Self::Look => Role::Look,
            Self::Hold => Role::Hold,
            Self::Operate => Role::Operate,
        }
    }
}
