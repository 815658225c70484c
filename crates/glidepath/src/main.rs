//! The `glidepath` command.

use clap::Parser as _;
use glidepath::{cli::Cli, command};
use std::process::ExitCode;

fn main() -> ExitCode {
    command::main(&Cli::parse()).into()
}
